//! Eyes and brows seen through the bangs.

/// How much of eyes and brows is seen through hair that hangs before them: parts of the roles
/// [`Eye`](super::Role::Eye), [`EyeWhite`](super::Role::EyeWhite), [`Lash`](super::Role::Lash) and
/// [`Brow`](super::Role::Brow), through [`HairFront`](super::Role::HairFront) and [`Hair`](super::Role::Hair).
///
/// Hair that does not hang before an eye stays as it is to the bit. Needs a device with
/// `DEPTH32FLOAT_STENCIL8`; without it nothing is seen through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyesThrough {
    /// 0: hair hides them, 1: hair is not seen before them. Range 0..1. Default: 0.5.
    pub opacity: f32,
    /// Hair farther than this before an eye hides it: another character's hair, or the back of the head. Metres.
    /// Default: 0.05.
    pub window_m: f32,
    /// Angles between the view and the front of the face from which it fades, and at which it has gone, radians.
    /// Default: 50 and 80 degrees.
    pub fade_rad: [f32; 2],
}

impl Default for EyesThrough {
    fn default() -> Self {
        Self { opacity: 0.5, window_m: 0.05, fade_rad: [50f32.to_radians(), 80f32.to_radians()] }
    }
}
