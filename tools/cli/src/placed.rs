//! Models of a picture and where they stand.

use std::path::{Path, PathBuf};

use glam::{Mat4, Quat};

use crate::{args, setup};

/// A model and where it stands.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Placed {
    /// The built-in character where there is none.
    pub(crate) path: Option<PathBuf>,
    position: [f32; 3],
    yaw_rad: f32,
}

impl Placed {
    pub(crate) fn name(&self) -> String {
        self.path.as_deref().unwrap_or(Path::new(setup::BUILT_IN)).display().to_string()
    }

    /// `world_from_character`.
    pub(crate) fn world(&self) -> Mat4 {
        Mat4::from_rotation_translation(Quat::from_rotation_y(self.yaw_rad), self.position.into())
    }
}

/// A model with its place behind it.
pub(crate) fn placed(text: &str) -> Result<Placed, String> {
    let (mut rest, mut model) = (text, Placed::default());
    // File names may hold an @ of their own.
    while let Some((before, last)) = rest.rsplit_once('@') {
        if let Some(turn) = last.strip_prefix("yaw=") {
            model.yaw_rad = args::yaw(turn)?.to_radians();
        } else if last.split(',').count() == 3 {
            model.position = args::xyz(last)?;
        } else {
            break;
        }
        rest = before;
    }
    model.path = Some(PathBuf::from(rest));
    Ok(model)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_may_name_its_place() {
        let at = |path: &str, position, yaw_deg: f32| {
            Ok(Placed { path: Some(path.into()), position, yaw_rad: yaw_deg.to_radians() })
        };
        assert_eq!(placed("a.vrm"), at("a.vrm", [0.0; 3], 0.0));
        assert_eq!(placed("b.vrm@1,0,-0.5@yaw=-30"), at("b.vrm", [1.0, 0.0, -0.5], -30.0));
        assert_eq!(placed("b.vrm@yaw=15@0,1,0"), at("b.vrm", [0.0, 1.0, 0.0], 15.0));
        assert_eq!(placed("me@home.vrm"), at("me@home.vrm", [0.0; 3], 0.0));
        assert!(placed("b.vrm@1,x,0").is_err_and(|e| e.contains("X,Y,Z")));
        assert!(placed("b.vrm@yaw=left").is_err());
    }
}
