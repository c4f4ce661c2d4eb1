//! A card in a stack, as flat eyes are built.

use super::{Section, Surroundings};
use crate::render::layout::Block;

/// Distance between two cards of a stack, metres.
const STEP_M: f32 = 1e-4;

crate::section! {
    /// Place in a stack of cards that lie on one another: white of the eye, iris, lights.
    #[derive(Copy)]
    Layer = "layer" {
        unlit: true, on_line: true,
        channel: Some(("layer", "Index of cards in a stack, lighter above; black elsewhere.")),
    }
    {
        /// Higher ones lie over lower ones wherever they coincide. Each stands 0.1 mm nearer to the viewer than the one below,
        /// which no picture shows but the depth test sees at any distance up to 20 m.
        index: i32 = 0, in -8..=8;
        /// 1: lit colour in any shade, as lights of eyes are drawn.
        stay_lit: f32 = 0.0, in 0.0..=1.0;
    }
}

impl Section for Layer {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        gpu.put("pull", self.index as f32 * STEP_M);
    }
}
