//! Eyes and brows seen through the bangs.

/// How much of eyes and brows is seen through hair that hangs before them: parts of the roles
/// [`Eye`](super::Role::Eye), [`EyeHighlight`](super::Role::EyeHighlight), [`EyeWhite`](super::Role::EyeWhite), [`Lash`](super::Role::Lash) and
/// [`Brow`](super::Role::Brow), through [`HairFront`](super::Role::HairFront) and [`Hair`](super::Role::Hair).
///
/// Hair that does not hang before an eye stays as it is to the bit. Needs a device with
/// `DEPTH32FLOAT_STENCIL8`; without it nothing is seen through.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EyesThrough {
    /// 0: hair hides them, 1: hair is not seen before them. Range 0..1. Default: 0.5.
    pub opacity: f32,
    /// Hair farther than this before an eye hides it: another character's hair, or the back of the head. Metres.
    /// Default: 0.05.
    pub window_m: f32,
    /// Angles of the view to the side of the face from which it fades, and at which it has gone, radians.
    /// Default: 50 and 80 degrees.
    pub fade_yaw_rad: [f32; 2],
    /// The same for views from above and below. Default: 40 and 70 degrees.
    pub fade_pitch_rad: [f32; 2],
}

impl Default for EyesThrough {
    fn default() -> Self {
        Self {
            opacity: 0.5,
            window_m: 0.05,
            fade_yaw_rad: [50f32.to_radians(), 80f32.to_radians()],
            fade_pitch_rad: [40f32.to_radians(), 70f32.to_radians()],
        }
    }
}
