//! Fading without blending.

use super::Section;

crate::section! {
    /// Leaves out samples of pixels in an even pattern, or whole pixels where each has one sample: a surface fades without
    /// being sorted, as when the camera comes too near, and nothing behind its own front is seen. Blended materials
    /// fade by their alpha. A fading surface goes on casting its whole shadow.
    #[derive(Copy)]
    DitherFade = "dither_fade" { unlit: true, on_line: true, needs: &["world"] }
    {
        /// Share that is left.
        opacity: f32 = 1.0, in 0.0..=1.0;
        /// Distances from the camera at which it is gone and at which it is whole, metres, growing.
        near_m: [f32; 2] = [0.0; 2], in 0.0..=1000000.0;
    }
}

impl Section for DitherFade {}
