//! Lights of a drawn eye that move.

use super::Section;

crate::section! {
    /// Lights of an eye that are drawn on cards of their own: they follow the viewer and the directional light within bounds, each as
    /// a whole, so that it keeps its shape. Directions are those from the head, by the axes of the face.
    ///
    /// Source: a mirrored light on a ball stands half way between the viewer and the light.
    #[derive(Copy)]
    EyeCard = "eye_card" { unlit: true, needs: &["actor"], channel: None }
    {
        /// How far they go to the side and up with the viewer, metres for a viewer straight at that side.
        by_view_m: [f32; 2] = [0.0025, 0.0015], in -0.1..=0.1;
        /// The same with the light.
        by_light_m: [f32; 2] = [0.0015, 0.001], in -0.1..=0.1;
        /// Farthest that they go, metres.
        within_m: f32 = 0.002, in 0.0..=0.1;
    }
}

impl Section for EyeCard {}
