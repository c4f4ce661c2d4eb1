//! Steps that several commands share: read files, load a model, pose it.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use glam::Vec3;
use hikage::import::load_radiance;
use hikage::motion::{Pose, Stance};
use hikage::scene::{Environment, Scene, Warning};
use hikage::sdf::{Project, Sides};
use hikage::{Anime, Gpu, Look, LookFile};
use hikage_character::head::sdf;

use crate::args::{EnvironmentName, LookName};
use crate::deadline;
use crate::failure::{Failure, warn};

/// Warnings that are shown before the rest is only counted.
const SHOWN_WARNINGS: usize = 5;

/// Bytes of the largest text file that is read: shots and shaders.
const MAX_TEXT_BYTES: u64 = 1 << 20;

/// Reads a file of at most a MiB.
pub(crate) fn read_small(path: &Path) -> Result<Vec<u8>, Failure> {
    let fail = |what: &dyn std::fmt::Display| Failure::input(format!("{}: {what}", path.display()));
    let metadata = std::fs::metadata(path).map_err(|e| fail(&e))?;
    if !metadata.is_file() {
        return Err(fail(&"is not a regular file"));
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|e| fail(&e))?;
    file.take(MAX_TEXT_BYTES + 1).read_to_end(&mut bytes).map_err(|e| fail(&e))?;
    if bytes.len() as u64 > MAX_TEXT_BYTES {
        return Err(fail(&format!("is over the limit of {MAX_TEXT_BYTES} bytes")));
    }
    Ok(bytes)
}

/// Opens the adapter of this name, or the best one.
pub(crate) fn gpu(adapter: Option<&str>) -> Result<Gpu, Failure> {
    deadline::enter_gpu();
    Ok(Gpu::headless(adapter)?)
}

/// Loads a model; without a name the built-in character.
pub(crate) fn load(model: Option<&Path>) -> Result<Scene, Failure> {
    match model {
        Some(path) => Ok(hikage::import::load(path)?),
        None => {
            let limits = hikage::import::Limits::default();
            Ok(hikage::import::load_bytes(BUILT_IN, &hikage_character::file(), None, &limits)?)
        }
    }
}

/// Name of the built-in character's file.
pub(crate) const BUILT_IN: &str = "hikage.vrm";

/// Gives a model its look: the named one, else the one that it brings.
pub(crate) fn apply_look(name: Option<&LookName>, model: Option<&Path>, scene: &mut Scene) -> Result<(), Failure> {
    apply_look_or(name, LookName::Plain, model, scene)
}

/// The same, where a model that brings none gets `other`.
pub(crate) fn apply_look_or(
    name: Option<&LookName>,
    other: LookName,
    model: Option<&Path>,
    scene: &mut Scene,
) -> Result<(), Failure> {
    let before = scene.warnings.len();
    match name.cloned().or_else(|| own_look(model)).unwrap_or(other) {
        LookName::Plain => {}
        LookName::Natural => Look::Natural.apply(scene),
        LookName::Anime => Look::Anime(Anime { face: painted(model)?, ..Anime::default() }).apply(scene),
        LookName::File(file) => LookFile::read(file)?.apply(scene, painted(model)?.as_ref())?,
    }
    show_warnings(scene.warnings.get(before..).unwrap_or_default());
    Ok(())
}

/// The environment of this name.
pub(crate) fn environment(name: &EnvironmentName) -> Result<Option<Environment>, Failure> {
    Ok(match name {
        EnvironmentName::None => None,
        EnvironmentName::Studio => Some(Environment::studio()),
        EnvironmentName::Sky => Some(Environment::sky()),
        EnvironmentName::File(file) => Some(Environment::new(load_radiance(file)?)),
    })
}

/// The look that a model brings: that of the built-in character, or the look file beside a file.
fn own_look(model: Option<&Path>) -> Option<LookName> {
    let Some(model) = model else { return Some(LookName::Anime) };
    Some(LookFile::beside(model)).filter(|file| file.is_file()).map(LookName::File)
}

/// Thresholds of the face of the built-in character, which has painted keys.
fn painted(model: Option<&Path>) -> Result<Option<Sides>, Failure> {
    if model.is_some() {
        return Ok(None);
    }
    Ok(Some(built_in_project()?.bake(false)?.into_sides()))
}

/// The drawings of the built-in character's face.
pub(crate) fn built_in_project() -> Result<Project, Failure> {
    Ok(Project::parse("face.sdf.toml", sdf::SOURCE)?)
}

/// The model in a stance with these expressions.
pub(crate) fn pose(scene: &Scene, stance: Stance, expressions: &[(String, f32)]) -> Result<Pose, Failure> {
    let mut pose = Pose::rest(scene);
    pose.set_stance(scene, stance);
    pose.set_expressions(scene, expressions)?;
    Ok(pose)
}

/// Says early what would otherwise come after a long rendering.
pub(crate) fn check_writable(path: &Path) -> Result<(), Failure> {
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(Failure::input(format!("{}: the folder {} does not exist", path.display(), folder.display())));
    }
    if path.exists() && !path.is_file() {
        return Err(Failure::input(format!("{}: is not a regular file", path.display())));
    }
    Ok(())
}

/// Prints the first warnings of a model.
pub(crate) fn show_warnings(warnings: &[Warning]) {
    for warning in warnings.iter().take(SHOWN_WARNINGS) {
        warn(&format!("{}: {}", warning.pointer, warning.message));
    }
    if let Some(more @ 1..) = warnings.len().checked_sub(SHOWN_WARNINGS) {
        warn(&format!("{more} more; `hikage inspect` lists them"));
    }
}

/// Direction to a light of these angles, degrees: yaw to the character's left, pitch from above.
pub(crate) fn to_light(degrees: [f32; 2]) -> Vec3 {
    let [yaw, pitch] = degrees.map(f32::to_radians);
    Vec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos())
}
