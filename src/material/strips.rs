//! Strips of hair: their order, and how dark they are at the root.

use super::{Section, plain_parts};
use crate::hair::StripSort;

crate::section! {
    /// Takes each part of the material as strips of hair ([`HairStrips`](crate::hair::HairStrips)): draws them in a good order
    /// once for all views, and knows how far along its strip each place lies. Expressions and bones move them as they move
    /// everything. Models of hair read the occlusion and the grayness; of a file that brings vertex colours, red, green and blue
    /// are the three occlusions and alpha is the grayness, and they do not change the lit colour as they do elsewhere. A part
    /// without strips, such as a closed cap, is drawn as it is and without occlusion.
    ///
    /// Source: Hair Renderer of The Blacksmith ("Mode", "Ambient occlusion").
    #[derive(Copy)]
    Strips = "strips" {
        unlit: true,
        channel: Some(("strips", "Strips of hair, a colour each.")),
        more_channels: &[
            ("strip-order", "Order of strips of hair: dark what is drawn first."),
            ("strip-occlusion", "Occlusion of strips of hair: red the first, green the second, blue the third."),
            ("strip-grayness", "Grayness of strips of hair."),
        ],
    }
    {
        /// Which strips are drawn first: `height` the lowest, `radial` those nearest to the middle of the head, `none` as the
        /// file has them. Each part of the material for itself.
        sort: StripSort = StripSort::Height;
        /// Three strengths k of the occlusion exp(-k (1 - t)), where t is 0 at the root and 1 at the tip.
        occlusion: [f32; 3] = [0.7, 1.4, 2.5], in 0.0..=10.0;
        /// How gray the hair is: 0 as its colour, 1 gray.
        grayness: f32 = 0.0, in 0.0..=1.0;
    }
}
plain_parts!(StripSort);

impl Section for Strips {}
