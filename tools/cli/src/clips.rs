//! What moves characters in pictures, as `render` and `animate` name it: clips, gaze, wind.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::Vec3;
use hikage::import::{Limits, load, load_bytes};
use hikage::motion::Clip;
use hikage::scene::Scene;
use hikage_character::{clips as built_in, vrma};

use crate::args;
use crate::failure::{Failure, warn};

/// Bones that a warning names before it counts the rest.
const SHOWN_NAMES: usize = 6;

/// Options of movement.
#[derive(Clone, clap::Args)]
pub(crate) struct MotionArgs {
    /// Clip to play: FILE is a .vrma, .glb or .vrm, or idle, walk, run, wave or turn, which every humanoid can play. NAME is
    /// that of one of its animations, or its number from 0; #NAME alone is one of the model. Several share by their weights.
    #[arg(long, value_name = "FILE[#NAME][=WEIGHT]", value_parser = clip)]
    pub(crate) clip: Vec<ClipName>,
    /// Lets clips move the character over the ground; else it walks on the spot.
    #[arg(long)]
    pub(crate) travel: bool,
    /// What is looked at: a point in the world (metres), or the camera. The head turns by 0.6 of the way.
    #[arg(long, value_name = "X,Y,Z|camera", allow_hyphen_values = true, value_parser = look_at)]
    pub(crate) look_at: Option<LookAt>,
    /// Wind on hair and clothes: direction times strength, of which 0.1 stirs and 1 carries hair away.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = args::xyz)]
    pub(crate) wind: Option<[f32; 3]>,
}

/// `--clip`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClipName {
    /// A file or a built-in clip; empty for the model itself.
    file: String,
    /// Name or number of the animation; empty for the first one.
    animation: String,
    /// Range 0..1.
    weight: f32,
}

/// `--look-at`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LookAt {
    /// Wherever the camera is.
    Camera,
    /// World space, metres.
    Point(Vec3),
}

/// `FILE[#NAME][=WEIGHT]`: files may have `#` and `=` in their own names.
pub(crate) fn clip(text: &str) -> Result<ClipName, String> {
    let weighted = text.rsplit_once('=').and_then(|(name, weight)| Some((name, weight.parse::<f32>().ok()?)));
    let (name, weight) = weighted.unwrap_or((text, 1.0));
    if !(0.0..=1.0).contains(&weight) {
        return Err("weight: expected a number from 0 to 1".into());
    }
    let (file, animation) = if is_file_name(name) {
        (name, "")
    } else {
        name.rsplit_once('#').unwrap_or((name, ""))
    };
    if file.is_empty() && animation.is_empty() {
        return Err("expected FILE, FILE#NAME or #NAME, as walk or moves.glb#Jump=0.5".into());
    }
    Ok(ClipName { file: file.to_owned(), animation: animation.to_owned(), weight })
}

fn is_file_name(text: &str) -> bool {
    let ending = Path::new(text).extension().and_then(|e| e.to_str()).unwrap_or("");
    ["vrma", "vrm", "glb", "gltf"].iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// `camera` or `X,Y,Z`.
pub(crate) fn look_at(text: &str) -> Result<LookAt, String> {
    if text == "camera" {
        return Ok(LookAt::Camera);
    }
    args::xyz(text).map(|point| LookAt::Point(point.into())).map_err(|e| format!("{e}, nor camera"))
}

impl ClipName {
    /// A clip that is built in, by its name.
    pub(crate) fn built_in(name: &str) -> Self {
        Self { file: name.to_owned(), animation: String::new(), weight: 1.0 }
    }

    /// The name as it was given, without the weight.
    pub(crate) fn shown(&self) -> String {
        let Self { file, animation, .. } = self;
        if animation.is_empty() {
            file.clone()
        } else {
            format!("{file}#{animation}")
        }
    }

    /// The file, or a file of the built-in clip; `None` for the model itself.
    fn load(&self) -> Result<Option<Scene>, Failure> {
        if self.file.is_empty() {
            return Ok(None);
        }
        let path = PathBuf::from(&self.file);
        if path.exists() || is_file_name(&self.file) {
            return Ok(Some(load(path)?));
        }
        let Some(clip) = built_in::build(&self.file) else {
            let names = built_in::NAMES.join(", ");
            return Err(Failure::input(format!(
                "--clip {}: is no file, and none of the built-in clips: {names}",
                self.file
            )));
        };
        let file = format!("{}.vrma", self.file);
        Ok(Some(load_bytes(&file, &vrma::write(&clip), None, &Limits::default())?))
    }
}

/// Files of clips, read once for all models.
pub(crate) struct Sources<'a>(Vec<(&'a ClipName, Option<Scene>)>);

impl<'a> Sources<'a> {
    pub(crate) fn load(names: &'a [ClipName]) -> Result<Self, Failure> {
        names.iter().map(|name| Ok((name, name.load()?))).collect::<Result<_, _>>().map(Self)
    }

    /// The clips for a model; warns of what of them it cannot do.
    pub(crate) fn fit(&self, target: &Scene) -> Result<Vec<(Arc<Clip>, f32)>, Failure> {
        let fit = |(name, source): &(&ClipName, Option<Scene>)| {
            let clip = Clip::named(source.as_ref().unwrap_or(target), &name.animation, target)
                .map_err(|e| Failure::input(format!("--clip {}: {e}", name.shown())))?;
            for warning in &clip.warnings {
                warn(&format!("--clip {}: {}", name.shown(), shortened(warning)));
            }
            Ok((Arc::new(clip), name.weight))
        };
        self.0.iter().map(fit).collect()
    }
}

/// A built-in clip for a model; `None` where it has no humanoid bones.
pub(crate) fn built_in_for(name: &str, target: &Scene) -> Result<Option<Arc<Clip>>, Failure> {
    let name = ClipName::built_in(name);
    let clip = name.load()?.and_then(|source| Clip::of(&source, 0, target).ok());
    Ok(clip.map(Arc::new))
}

/// A list of names, the first ones of many.
fn shortened(list: &str) -> String {
    let mut names: Vec<&str> = list.split(", ").collect();
    let more = names.len().saturating_sub(SHOWN_NAMES);
    names.truncate(SHOWN_NAMES);
    let names = names.join(", ");
    if more > 0 {
        format!("{names} and {more} more")
    } else {
        names
    }
}

impl MotionArgs {
    /// Whether anything of it is asked for.
    pub(crate) fn is_some(&self) -> bool {
        !self.clip.is_empty() || self.look_at.is_some() || self.wind.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clip_is_a_file_an_animation_and_a_weight() {
        let name = |file: &str, animation: &str, weight| {
            Ok(ClipName { file: file.into(), animation: animation.into(), weight })
        };
        assert_eq!(clip("walk"), name("walk", "", 1.0));
        assert_eq!(clip("walk=0.25"), name("walk", "", 0.25));
        assert_eq!(clip("a b.glb#Jump.001=1"), name("a b.glb", "Jump.001", 1.0));
        assert_eq!(clip("#2"), name("", "2", 1.0));
        assert_eq!(clip("take#3=b.vrma"), name("take#3=b.vrma", "", 1.0));
        for (text, said) in
            [("walk=2", "weight"), ("walk=-1", "weight"), ("walk=nan", "weight"), ("", "FILE"), ("=1", "FILE")]
        {
            assert!(clip(text).is_err_and(|e| e.contains(said)), "{text}");
        }
        assert_eq!(look_at("camera"), Ok(LookAt::Camera));
        assert_eq!(look_at("-1, 2,0.5"), Ok(LookAt::Point(Vec3::new(-1.0, 2.0, 0.5))));
        assert!(look_at("left").is_err_and(|e| e.contains("camera")));
    }

    #[test]
    fn long_lists_are_counted() {
        assert_eq!(shortened("no bones: a, b"), "no bones: a, b");
        assert_eq!(shortened("lacks: a, b, c, d, e, f, g, h"), "lacks: a, b, c, d, e, f and 2 more");
    }
}
