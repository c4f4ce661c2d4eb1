//! The scorer of a folder of references: a Python program that prints figures as JSON.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::failure::Failure;

/// How it is run.
pub(super) struct Scorer {
    python: &'static str,
    program: PathBuf,
}

impl Scorer {
    /// That of a folder, with a Python that has what it needs.
    pub(super) fn find(dir: &Path) -> Result<Self, Failure> {
        let program = dir.join("compare_real.py");
        if !program.is_file() {
            return Err(Failure::input(format!(
                "{}: is not there; expected the scorer of the references",
                program.display()
            )));
        }
        let serves = |python: &&str| {
            let asked = Command::new(python).args(["-c", "import numpy, scipy, PIL"]).output();
            asked.is_ok_and(|done| done.status.success())
        };
        match ["python3", "/usr/bin/python3"].into_iter().find(serves) {
            Some(python) => Ok(Self { python, program }),
            None => Err(Failure::input(
                "no python3 with numpy, scipy and pillow; on Debian and Ubuntu: apt install python3-numpy python3-scipy python3-pil",
            )),
        }
    }

    /// Figures of a picture of hair.
    pub(super) fn hair(&self, reference: &Path, picture: &Path) -> Result<Value, Failure> {
        self.figures(&["hair".as_ref(), reference.as_os_str(), picture.as_os_str()])
    }

    /// Figures of a picture of skin; `lambert`, the same view without scattering, shows where light ends.
    pub(super) fn skin(&self, reference: &Path, picture: &Path, lambert: Option<&Path>) -> Result<Value, Failure> {
        let lambert = lambert.map(|path| {
            let mut option = OsString::from("--lambert=");
            option.push(path);
            option
        });
        let mut args = vec!["skin".as_ref(), reference.as_os_str(), picture.as_os_str()];
        args.extend(lambert.as_deref());
        self.figures(&args)
    }

    /// Figures of a picture of an eye with dots on its iris.
    pub(super) fn eye(&self, reference: &Path, picture: &Path) -> Result<Value, Failure> {
        self.figures(&["eye".as_ref(), reference.as_os_str(), picture.as_os_str()])
    }

    fn figures(&self, args: &[&OsStr]) -> Result<Value, Failure> {
        let done = Command::new(self.python)
            .arg("-B")
            .arg(&self.program)
            .args(args)
            .output()
            .map_err(|e| Failure::input(format!("{}: {e}", self.python)))?;
        if !done.status.success() {
            let text = String::from_utf8_lossy(&done.stderr);
            let last = text.lines().last().unwrap_or("no figures").to_owned();
            return Err(Failure::input(format!("{}: {last}", self.program.display())));
        }
        // Means of nothing and shares of no light, which JSON has no words for.
        let mut text = String::from_utf8_lossy(&done.stdout).into_owned();
        for word in ["NaN", "-Infinity", "Infinity"] {
            text = text.replace(word, "null");
        }
        serde_json::from_str(&text).map_err(|e| Failure::input(format!("{}: {e}", self.program.display())))
    }
}

/// A figure as lines show it.
fn number(v: &Value) -> String {
    v.as_f64().map_or("-".to_owned(), |x| format!("{x:.3}"))
}

fn list(v: &Value) -> String {
    v.as_array().into_iter().flatten().map(number).collect::<Vec<_>>().join(" ")
}

/// The figures of a picture of hair in a line.
pub(super) fn hair_line(name: &str, figures: &Value) -> String {
    let mut text = format!(
        "{name}: energy {}  dE mean {} p95 {}  chroma {}",
        list(&figures["energyRatioCandOverRef"]),
        number(&figures["blur8"]["dE2000mean"]),
        number(&figures["blur8"]["dE2000p95"]),
        number(&figures["chroma"]["maxAbsDiff"]),
    );
    for (color, lobe) in figures["lobes"].as_object().into_iter().flatten() {
        let step =
            |key: &str| lobe["cand"][key].as_f64().zip(lobe["ref"][key].as_f64()).map(|(ours, theirs)| ours - theirs);
        if let (Some(middle), Some(width)) = (step("centroidTopHalfDeg"), step("fwhmDeg")) {
            text += &format!("  {color} {middle:+.2} deg, width {width:+.2}");
        }
    }
    text + "\n"
}

/// The figures of a picture of skin in a line.
pub(super) fn skin_line(name: &str, figures: &Value) -> String {
    let mut text = format!("{name}: scale {}  rmse {}", list(&figures["scale"]), number(&figures["rmse"]));
    let edge = &figures["terminator"];
    if edge.is_object() {
        let bleed = |whose: &str| number(&edge["bleedIntegralMm"][whose][0]);
        text += &format!("  edge rmse {}", edge["profileRmse"].as_f64().map_or("-".to_owned(), |x| format!("{x:.5}")));
        text += &format!("  red bleed {} of {} mm", bleed("cand"), bleed("ref"));
    }
    if figures["band6mm"].is_object() {
        text += &format!("  band dE p95 {}", number(&figures["band6mm"]["dE2000p95"]));
    }
    if figures["sphere"].is_object() {
        let sphere = number(&figures["sphere"]["profileRmse"]);
        text += &format!("  sphere dE p95 {}, rmse {sphere}", number(&figures["dE2000p95"]));
    }
    text + "\n"
}

/// The figures of a picture of an eye in a line.
pub(super) fn eye_line(name: &str, figures: &Value) -> String {
    let (same, ratio) = (number(&figures["correlation"]), number(&figures["ratioOfMeans"]));
    let text = match figures["kind"].as_str() {
        Some("caustic") => format!("correlation {same}  mean of ours over theirs {ratio}"),
        Some("lit") => {
            let off = number(&figures["meanAbsDifference"]);
            format!("correlation {same}  mean of ours over theirs {ratio}  off by {off}")
        }
        _ => {
            let off = |from: &str| ["mean", "p95", "max"].map(|key| number(&figures[from][key])).join(" ");
            let (found, visible) = (&figures["candFound"], &figures["visibleDots"]);
            format!(
                "{found} of {visible} dots  px off where they are, mean p95 max {}  off the reference's {}",
                off("candVsAnalytic"),
                off("candVsRefRender"),
            )
        }
    };
    format!("{name}: {text}\n")
}
