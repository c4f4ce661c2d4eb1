//! `hikage pose`: what becomes of a model in a scenario of motion, as numbers. Replays reference trajectories.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use hikage::glam::{Mat4, Quat, Vec3};
use hikage::material::{Material, Shading};
use hikage::motion::{Animator, Clip, GazeTarget, Layer, Mask, Play, Pose, Skeleton};
use hikage::scene::Scene;
use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::failure::Failure;

/// Bytes of the largest scenario.
const MAX_BYTES: u64 = 64 << 20;

/// Arguments of `hikage pose`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Model: .vrm, .glb or .gltf.
    model: PathBuf,
    /// Scenario: clips, gaze, expressions, place and springs of each step (schema "hikage-motion/1").
    #[arg(long, value_name = "FILE.json")]
    scenario: PathBuf,
    /// Folder of the clips that the scenario names [default: the folder of the model, else the one above it].
    #[arg(long, value_name = "DIR")]
    models: Option<PathBuf>,
    /// File to write.
    #[arg(short, long, value_name = "OUT.json")]
    output: PathBuf,
}

#[derive(Deserialize)]
struct Scenario {
    time: Time,
    run: Vec<String>,
    root: Option<Root>,
    root_scale: Option<f32>,
    #[serde(default)]
    clips: Vec<ClipUse>,
    drive: Option<Drive>,
    look_at: Option<LookAt>,
    expressions: Option<Vec<BTreeMap<String, f32>>>,
    springs: Option<SpringUse>,
    output: Output,
}

#[derive(Deserialize)]
struct Time {
    hz: f64,
    steps: usize,
    record: Vec<usize>,
}

#[derive(Deserialize)]
struct Root {
    samples: Vec<[f32; 7]>,
}

#[derive(Deserialize)]
struct ClipUse {
    file: PathBuf,
    #[serde(default)]
    generated: bool,
    animation: Option<Value>,
    #[serde(default, rename = "loop")]
    looped: bool,
    speed: Option<f64>,
    start: Option<f64>,
    weight: Option<PerStep>,
    mask: Option<Vec<String>>,
    mode: Option<String>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum PerStep {
    Always(f32),
    Each(Vec<f32>),
}

#[derive(Deserialize)]
struct Drive {
    nodes: BTreeMap<String, Vec<[f32; 4]>>,
}

#[derive(Deserialize)]
struct LookAt {
    target: Option<Vec<[f32; 3]>>,
    yaw_pitch_deg: Option<Vec<[f32; 2]>>,
}

#[derive(Deserialize)]
struct SpringUse {
    dt: f64,
    #[serde(default)]
    reset_at: Vec<usize>,
    #[serde(default)]
    warp_at: Vec<usize>,
}

#[derive(Deserialize)]
struct Output {
    #[serde(default)]
    nodes: Vec<String>,
    #[serde(default)]
    morphs: Vec<String>,
    #[serde(default)]
    materials: bool,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let scenario: Scenario = read(&args.scenario)?;
    let scene = hikage::import::load(&args.model)?;
    let value = if scenario.run.iter().any(|stage| stage == "first_person") {
        first_person(&scene)
    } else {
        Replay::new(args, &scenario, &scene)?.run()
    };
    let text = serde_json::to_string(&value).map_err(|e| Failure::input(format!("JSON: {e}")))?;
    std::fs::write(&args.output, text + "\n").map_err(|e| Failure::input(format!("{}: {e}", args.output.display())))
}

fn read(path: &Path) -> Result<Scenario, Failure> {
    let fail = |what: &dyn std::fmt::Display| Failure::input(format!("{}: {what}", path.display()));
    let size = std::fs::metadata(path).map_err(|e| fail(&e))?.len();
    if size > MAX_BYTES {
        return Err(fail(&format!("is over the limit of {MAX_BYTES} bytes")));
    }
    let bytes = std::fs::read(path).map_err(|e| fail(&e))?;
    let scenario: Scenario = serde_json::from_slice(&bytes).map_err(|e| fail(&e))?;
    if !(scenario.time.hz > 0.0 && scenario.time.steps <= 1_000_000) {
        return Err(fail(&"time: expected hz above 0 and at most 1000000 steps"));
    }
    Ok(scenario)
}

fn first_person(scene: &Scene) -> Value {
    let mut nodes = Map::new();
    for (node, _) in scene.mesh_nodes() {
        let [own, others] = scene.triangles_in_sight(node);
        let counts = json!({ "first_person_triangles": own, "third_person_triangles": others });
        nodes.insert(scene.nodes[node].name.clone(), counts);
    }
    json!({ "first_person": nodes })
}

/// A scenario that is being replayed.
struct Replay<'a> {
    scenario: &'a Scenario,
    scene: &'a Scene,
    skeleton: Skeleton,
    animator: Animator,
    /// Layer and place there of each clip.
    plays: Vec<(usize, usize)>,
    /// Nodes that are turned by hand.
    driven: Vec<(usize, &'a [[f32; 4]])>,
    /// Nodes that are written.
    nodes: Vec<usize>,
}

impl<'a> Replay<'a> {
    fn new(args: &Args, scenario: &'a Scenario, scene: &'a Scene) -> Result<Self, Failure> {
        let fail = |what: String| Failure::input(format!("{}: {what}", args.scenario.display()));
        let find = |name: &String| {
            let found = scene.nodes.iter().position(|n| n.name == *name);
            found.ok_or_else(|| fail(format!("node {name:?}: the model has none")))
        };
        let skeleton = Skeleton::of(scene);
        let mut animator = Animator::default();
        animator.player.layers.push(Layer::default());
        let mut plays = Vec::new();
        for of in &scenario.clips {
            let file = locate(args, of).ok_or_else(|| fail(format!("clip {}: not found", of.file.display())))?;
            let source = hikage::import::load(&file)?;
            let name = match &of.animation {
                Some(Value::String(name)) => name.clone(),
                Some(Value::Number(index)) => index.to_string(),
                _ => String::new(),
            };
            let mut play = Play { looped: of.looped, ..Play::new(&Arc::new(Clip::named(&source, &name, scene)?)) };
            if let Some(names) = &of.mask {
                let share = |name: &String| f32::from(u8::from(names.contains(name)));
                let nodes = scene.nodes.iter().map(|n| share(&n.name)).collect();
                play.mask = Some(Arc::new(Mask { nodes }));
            }
            let layers = &mut animator.player.layers;
            let layer = if of.mode.as_deref() == Some("additive") {
                layers.push(Layer::additive());
                layers.len() - 1
            } else {
                0
            };
            plays.push((layer, layers[layer].plays.len()));
            layers[layer].plays.push(play);
        }
        let driven = scenario.drive.iter().flat_map(|drive| &drive.nodes);
        Ok(Self {
            driven: driven.map(|(name, list)| Ok((find(name)?, &**list))).collect::<Result<_, Failure>>()?,
            nodes: scenario.output.nodes.iter().map(find).collect::<Result<_, Failure>>()?,
            scenario,
            scene,
            skeleton,
            animator,
            plays,
        })
    }

    fn run(mut self) -> Value {
        let mut frames = Vec::new();
        let mut pose = Pose::rest(self.scene);
        let mut before = self.world(0);
        for step in 0..=self.scenario.time.steps {
            let world = self.world(step);
            self.step(step, &before, &world, &mut pose);
            before = world;
            if self.scenario.time.record.contains(&step) {
                frames.push(self.frame(step, &world, &pose));
            }
        }
        json!({ "frames": frames })
    }

    fn has(&self, stage: &str) -> bool {
        self.scenario.run.iter().any(|s| s == stage)
    }

    fn world(&self, step: usize) -> Mat4 {
        let samples = self.scenario.root.as_ref().map_or(&[][..], |root| &root.samples);
        let Some([x, y, z, qx, qy, qz, qw]) = at(samples, step) else { return Mat4::IDENTITY };
        let scale = Vec3::splat(self.scenario.root_scale.unwrap_or(1.0));
        let rotation = Quat::from_xyzw(qx, qy, qz, qw).normalize();
        Mat4::from_scale_rotation_translation(scale, rotation, Vec3::new(x, y, z))
    }

    fn step(&mut self, step: usize, before: &Mat4, world: &Mat4, pose: &mut Pose) {
        let Scenario { time, clips, look_at, expressions, springs, .. } = self.scenario;
        let seconds = step as f64 / time.hz;
        for (of, (layer, index)) in clips.iter().zip(&self.plays) {
            let play = &mut self.animator.player.layers[*layer].plays[*index];
            play.time_s = of.start.unwrap_or(0.0) + of.speed.unwrap_or(1.0) * seconds;
            play.weight = match &of.weight {
                None => 1.0,
                Some(PerStep::Always(weight)) => *weight,
                Some(PerStep::Each(list)) => at(list, step).unwrap_or(0.0),
            };
        }
        self.animator.play(&self.skeleton, pose);
        for (node, rotations) in &self.driven {
            if let Some(rotation) = at(rotations, step) {
                pose.locals[*node].rotation = Quat::from_array(rotation).normalize();
            }
        }
        if self.has("look_at") {
            let target = look_at.as_ref().and_then(|of| {
                let point = of.target.as_ref().and_then(|list| at(list, step));
                let angles = of.yaw_pitch_deg.as_ref().and_then(|list| at(list, step));
                point.map(|p| GazeTarget::Point(p.into())).or(angles.map(|[yaw, pitch]| GazeTarget::Angles {
                    yaw_rad: yaw.to_radians(),
                    pitch_rad: pitch.to_radians(),
                }))
            });
            self.animator.gaze.target = target;
            self.animator.look(&self.skeleton, world, pose, 0.0);
        }
        if self.has("expressions") {
            let asked = expressions.as_ref().and_then(|list| list.get(step.min(list.len().saturating_sub(1))));
            for expression in self.scene.character.iter().flat_map(|c| &c.expressions) {
                let weight = asked.and_then(|a| a.get(&expression.name)).copied().unwrap_or(0.0);
                // Its own name is known.
                let _ = self.animator.set_expression(&self.skeleton, &expression.name, weight);
            }
            self.animator.express(&self.skeleton, pose);
        }
        if self.has("constraints") {
            self.animator.constrain(&self.skeleton, pose);
        }
        if self.has("springs") {
            let each_frame = SpringUse { dt: 1.0 / time.hz, reset_at: Vec::new(), warp_at: Vec::new() };
            let springs = springs.as_ref().unwrap_or(&each_frame);
            if springs.warp_at.contains(&step) {
                self.animator.warp(&self.skeleton, before, world);
            }
            if springs.reset_at.contains(&step) {
                self.animator.springs.reset();
            }
            self.animator.swing_once(&self.skeleton, world, pose, springs.dt as f32);
        }
    }

    fn frame(&self, step: usize, world: &Mat4, pose: &Pose) -> Value {
        let places = self.skeleton.places(pose, world);
        let place = |node: &usize| {
            let (t, q) = places[*node];
            json!([t.x, t.y, t.z, q.x, q.y, q.z, q.w])
        };
        let mut frame = Map::new();
        frame.insert("step".into(), json!(step));
        frame.insert("nodes".into(), self.nodes.iter().map(place).collect());
        if self.has("expressions") {
            let shown = self.animator.shown(&self.skeleton).map(|(name, weight)| (name.to_owned(), json!(weight)));
            frame.insert("expressions".into(), Value::Object(shown.collect()));
        }
        let node = |name: &String| self.scene.nodes.iter().position(|n| n.name == *name);
        let morphs = |name: &String| Some((name.clone(), json!(pose.morph_weights.get(node(name)?)?)));
        frame.insert("morphs".into(), Value::Object(self.scenario.output.morphs.iter().filter_map(morphs).collect()));
        if self.scenario.output.materials {
            let shifted = self.scene.materials.iter().enumerate();
            let materials = shifted.map(|(i, m)| (m.name.clone(), material(&pose.shifts.applied(i, m))));
            frame.insert("materials".into(), Value::Object(materials.collect()));
        }
        if let Some([yaw, pitch]) = self.animator.gaze_angles() {
            frame.insert("look_at".into(), json!([yaw.to_degrees(), pitch.to_degrees()]));
        }
        Value::Object(frame)
    }
}

fn material(material: &Material) -> Value {
    let uv = material.base.texture.map_or([1.0, 1.0, 0.0, 0.0], |t| {
        let ([x, y], [u, v]) = (t.transform.scale, t.transform.offset);
        [x, y, u, v]
    });
    let shade = match &material.shading {
        Shading::Toon(toon) => toon.shade_color,
        Shading::Standard(_) | Shading::Unlit => [0.0; 3],
    };
    json!({ "color": material.base.color, "emissionColor": material.emission.color, "shadeColor": shade, "uv": uv })
}

/// That of a step; the last one goes on.
fn at<T: Copy>(list: &[T], step: usize) -> Option<T> {
    list.get(step).or(list.last()).copied()
}

/// Where a clip is: generated ones beside the scenario, others by the models.
fn locate(args: &Args, of: &ClipUse) -> Option<PathBuf> {
    let beside = |path: &Path| path.parent().map(Path::to_owned).unwrap_or_default();
    let folder = beside(&args.model);
    let folders = if of.generated {
        vec![beside(&args.scenario).join("models")]
    } else {
        args.models.iter().cloned().chain([folder.clone(), beside(&folder)]).collect()
    };
    folders.into_iter().map(|folder| folder.join(&of.file)).find(|file| file.is_file())
}
