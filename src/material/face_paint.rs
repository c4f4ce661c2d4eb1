//! Drawn over a face: blush, lines in its shadow, and the line of the nose in profile.

use super::{Section, TextureRef};

crate::section! {
    /// Three drawings in one map that multiply the colour of the face.
    #[derive(Copy)]
    FacePaint = "face_paint" {
        needs: &["nose"], channel: Some(("face-paint", "Blush and lines, as what they multiply.")),
    }
    {
        /// Linear. Red: blush. Green: lines that show where the face is in shade. Blue: the line of the nose, which shows
        /// near profile.
        map: TextureRef = TextureRef::default(), read LINEAR;
        /// What the colour is multiplied by in full blush, linear.
        blush_color: [f32; 3] = [0.96, 0.62, 0.58], in 0.0..=1.0;
        /// Strength of the blush.
        blush_strength: f32 = 0.6, in 0.0..=1.0;
        /// What the colour is multiplied by on lines, linear.
        line_color: [f32; 3] = [0.72, 0.34, 0.31], in 0.0..=1.0;
        /// Strength of the lines in shade.
        shadow_line_strength: f32 = 0.6, in 0.0..=1.0;
        /// Strength of the line of the nose.
        nose_line_strength: f32 = 0.8, in 0.0..=1.0;
        /// Angles between the view and the front of the face, to the side, at which the line of the nose begins to show and
        /// shows in full, radians, growing: 40 and 65 degrees.
        nose_line_yaw_rad: [f32; 2] = [40f32.to_radians(), 65f32.to_radians()], in 0.0..=3.15;
    }
}

impl Section for FacePaint {}
