//! `hikage pose` follows the reference trajectories: those in this repository, and all of them where `../shared/motion` is there
//! (or the folder that `HIKAGE_MOTION` names).

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use hikage::glam::{DQuat, DVec3};
use serde::Deserialize;

/// What is compared of a scenario.
#[derive(Deserialize)]
struct Reference {
    name: String,
    model: Model,
    #[serde(default = "always")]
    scored: bool,
    run: Vec<String>,
    output: Output,
    tolerance: Option<Tolerance>,
    result: Outcome,
    #[serde(default)]
    alternatives: Vec<Alternative>,
}

fn always() -> bool {
    true
}

#[derive(Deserialize)]
struct Model {
    file: PathBuf,
    #[serde(default)]
    generated: bool,
}

#[derive(Deserialize)]
struct Output {
    #[serde(default)]
    nodes: Vec<String>,
}

#[derive(Deserialize)]
struct Tolerance {
    position_mm: f64,
    angle_deg: f64,
    weight: f64,
}

#[derive(Deserialize)]
struct Alternative {
    accepted: bool,
    frames: Vec<Frame>,
}

/// A reference, and what `hikage pose` writes.
#[derive(Deserialize)]
struct Outcome {
    #[serde(default)]
    frames: Vec<Frame>,
    #[serde(default)]
    first_person: BTreeMap<String, Triangles>,
}

#[derive(Deserialize, PartialEq, Debug)]
struct Triangles {
    first_person_triangles: usize,
    third_person_triangles: usize,
}

#[derive(Deserialize)]
struct Frame {
    step: usize,
    #[serde(default)]
    nodes: Vec<[f64; 7]>,
    #[serde(default)]
    expressions: BTreeMap<String, f64>,
    #[serde(default)]
    morphs: BTreeMap<String, Vec<f64>>,
    #[serde(default)]
    materials: BTreeMap<String, BTreeMap<String, Vec<f64>>>,
    look_at: Option<[f64; 2]>,
}

/// Greatest errors, and where.
#[derive(Default, Debug)]
struct Errors {
    position_mm: (f64, String),
    angle_deg: (f64, String),
    weight: (f64, String),
}

fn add(worst: &mut (f64, String), error: f64, at: impl FnOnce() -> String) {
    if error.is_nan() || error > worst.0 {
        *worst = (if error.is_nan() { f64::INFINITY } else { error }, at());
    }
}

impl Errors {
    fn of(names: &[String], wanted: &[Frame], frames: &[Frame]) -> Self {
        let mut errors = Self::default();
        for want in wanted {
            let step = want.step;
            let have = frames.iter().find(|f| f.step == step).unwrap_or_else(|| panic!("step {step} is missing"));
            for ((name, want), have) in names.iter().zip(&want.nodes).zip(&have.nodes) {
                let ([a, b], [p, q]) = ([want, have].map(position), [want, have].map(rotation));
                add(&mut errors.position_mm, a.distance(b) * 1e3, || format!("{name} at step {step}"));
                add(&mut errors.angle_deg, p.angle_between(q).to_degrees(), || format!("{name} at step {step}"));
            }
            assert_eq!(want.nodes.len(), have.nodes.len());
            for (name, want) in &want.expressions {
                add(&mut errors.weight, (want - have.expressions[name]).abs(), || format!("{name} at step {step}"));
            }
            for (name, want) in &want.morphs {
                for (want, have) in want.iter().zip(&have.morphs[name]) {
                    add(&mut errors.weight, (want - have).abs(), || format!("morph of {name} at step {step}"));
                }
            }
            for (name, kinds) in &want.materials {
                for (kind, want) in kinds {
                    for (want, have) in want.iter().zip(&have.materials[name][kind]) {
                        add(&mut errors.weight, (want - have).abs(), || format!("{name}.{kind} at step {step}"));
                    }
                }
            }
            if let Some(want) = want.look_at {
                let [a, b] = [want, have.look_at.expect("a gaze")].map(ahead);
                add(&mut errors.angle_deg, a.angle_between(b).to_degrees(), || format!("gaze at step {step}"));
            }
        }
        errors
    }

    fn passes(&self, tolerance: &Tolerance) -> bool {
        self.position_mm.0 <= tolerance.position_mm
            && self.angle_deg.0 <= tolerance.angle_deg
            && self.weight.0 <= tolerance.weight
    }
}

fn position(of: &[f64; 7]) -> DVec3 {
    DVec3::new(of[0], of[1], of[2])
}

fn rotation(of: &[f64; 7]) -> DQuat {
    DQuat::from_xyzw(of[3], of[4], of[5], of[6]).normalize()
}

/// Where yaw and pitch, degrees, point.
fn ahead([yaw, pitch]: [f64; 2]) -> DVec3 {
    let (yaw, pitch) = (yaw.to_radians(), pitch.to_radians());
    DVec3::new(pitch.cos() * yaw.sin(), -pitch.sin(), pitch.cos() * yaw.cos())
}

/// What the program makes of a scenario.
fn replay(scenario: &Path, model: &Model, models: &Path, output: &Path) -> String {
    let beside = scenario.parent().expect("a folder").join("models");
    let folder = if model.generated { &beside } else { models };
    let status = Command::new(env!("CARGO_BIN_EXE_hikage"))
        .arg("pose")
        .arg(folder.join(&model.file))
        .arg("--scenario")
        .arg(scenario)
        .arg("--models")
        .arg(models)
        .arg("-o")
        .arg(output)
        .status()
        .expect("the program runs");
    assert!(status.success(), "{}", scenario.display());
    fs::read_to_string(output).expect("a result")
}

/// Faults of a scenario.
fn faults(scenario: &Path, models: &Path, output: &Path) -> Option<String> {
    let text = fs::read_to_string(scenario).expect("a scenario");
    let reference: Reference = serde_json::from_str(&text).expect("a scenario");
    let result = replay(scenario, &reference.model, models, output);
    let outcome: Outcome = serde_json::from_str(&result).expect("a result");
    if reference.run.iter().any(|stage| stage == "first_person") {
        let differs = |(name, want): &(&String, &Triangles)| outcome.first_person.get(*name) != Some(*want);
        let wrong: Vec<_> = reference.result.first_person.iter().filter(differs).collect();
        return (!wrong.is_empty()).then(|| format!("{}: expected {wrong:?}", reference.name));
    }
    let tolerance = reference.tolerance.expect("a tolerance");
    let accepted = reference.alternatives.iter().filter(|a| a.accepted).map(|a| &a.frames);
    let mut nearest = None;
    for frames in std::iter::once(&reference.result.frames).chain(accepted) {
        let errors = Errors::of(&reference.output.nodes, frames, &outcome.frames);
        if errors.passes(&tolerance) {
            return None;
        }
        nearest.get_or_insert(errors);
    }
    reference.scored.then(|| format!("{}: {nearest:?}", reference.name))
}

/// Scenarios of a folder, in order of their names.
fn scenarios(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").flatten().map(|e| e.path());
    let mut list: Vec<PathBuf> = entries.filter(|p| p.extension().is_some_and(|e| e == "json")).collect();
    list.sort();
    list
}

fn check(folder: &Path, models: &Path, least: usize) {
    let output = Path::new(env!("CARGO_TARGET_TMPDIR")).join("motion");
    fs::create_dir_all(&output).expect("a folder");
    let list = scenarios(folder);
    assert!(list.len() >= least, "{} scenarios in {}", list.len(), folder.display());
    let at = |scenario: &Path| output.join(format!("{least}-{}", scenario.file_name().unwrap_or_default().display()));
    let found: Vec<String> = list.iter().filter_map(|scenario| faults(scenario, models, &at(scenario))).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn motion_is_that_of_the_references_here() {
    let folder = repository().join("tests/oracles/motion");
    check(&folder, &folder.join("models"), 8);
}

#[test]
fn motion_is_that_of_all_references() {
    let shared = repository().join("../shared");
    let folder = std::env::var_os("HIKAGE_MOTION").map_or_else(|| shared.join("motion"), PathBuf::from);
    if !folder.is_dir() {
        eprintln!("skipped: no reference trajectories in {}", folder.display());
        return;
    }
    check(&folder, &shared.join("models"), 56);
}

/// Bytes of what the program writes, by FNV-1a: the same at every level of optimisation, and on every machine.
#[test]
fn motion_has_the_same_bits_everywhere() {
    let folder = repository().join("tests/oracles/motion");
    let output = Path::new(env!("CARGO_TARGET_TMPDIR")).join("motion-bits.json");
    let hash = |text: &str| {
        text.bytes().fold(0xcbf2_9ce4_8422_2325u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
    };
    let of = |name: &str, model: &str| {
        let model = Model { file: model.into(), generated: true };
        format!("{name} {:016x}", hash(&replay(&folder.join(format!("{name}.json")), &model, &folder, &output)))
    };
    assert_eq!([of("order-everything", "everything.vrm"), of("spring-shapes-walk", "springs.vrm")], BITS);
}

const BITS: [&str; 2] = ["order-everything 095864af1b7e1717", "spring-shapes-walk ab0daa552c351d0f"];
