//! What must hold for every picture, on the adapter.

mod geometry;
mod light;
mod outlines;
mod output;
mod transparency;

use hikage::color::LinearRgb;

fn srgb(linear: [f32; 3]) -> [u8; 3] {
    LinearRgb(linear).to_srgb().0
}

fn close(found: &[u8], expected: &[u8], tolerance: u8, what: &str) {
    let off = found.iter().zip(expected).any(|(f, e)| f.abs_diff(*e) > tolerance);
    assert!(!off, "{what}: {found:?}, expected {expected:?} ± {tolerance}");
}
