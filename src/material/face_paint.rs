//! Drawn over a face: blush, lines in its shadow, and the line of the nose in profile.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Three drawings in one map that multiply the colour of the face.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FacePaint {
    /// Linear. Red: blush. Green: lines that show where the face is in shade. Blue: the line of the nose, which shows
    /// near profile. Default: texture 0.
    pub map: TextureRef,
    /// What the colour is multiplied by in full blush, linear. Range 0..1. Default: (0.96, 0.62, 0.58).
    pub blush_color: [f32; 3],
    /// Strength of the blush. Range 0..1. Default: 0.6.
    pub blush_strength: f32,
    /// What the colour is multiplied by on lines, linear. Range 0..1. Default: (0.72, 0.34, 0.31).
    pub line_color: [f32; 3],
    /// Strength of the lines in shade. Range 0..1. Default: 0.6.
    pub shadow_line_strength: f32,
    /// Strength of the line of the nose. Range 0..1. Default: 0.8.
    pub nose_line_strength: f32,
    /// Angles between the view and the front of the face, to the side, at which the line of the nose begins to show and
    /// shows in full, radians. Default: 40 and 65 degrees.
    pub nose_line_yaw_rad: [f32; 2],
}

impl Default for FacePaint {
    fn default() -> Self {
        Self {
            map: TextureRef::default(),
            blush_color: [0.96, 0.62, 0.58],
            blush_strength: 0.6,
            line_color: [0.72, 0.34, 0.31],
            shadow_line_strength: 0.6,
            nose_line_strength: 0.8,
            nose_line_yaw_rad: [40f32.to_radians(), 65f32.to_radians()],
        }
    }
}
