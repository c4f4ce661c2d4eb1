//! Eyes and brows seen through the bangs.

crate::part! {
    /// How much of eyes and brows is seen through hair that hangs before them: parts of the roles
    /// [`Eye`](super::Role::Eye), [`EyeHighlight`](super::Role::EyeHighlight), [`EyeWhite`](super::Role::EyeWhite), [`Lash`](super::Role::Lash) and
    /// [`Brow`](super::Role::Brow), through [`HairFront`](super::Role::HairFront) and [`Hair`](super::Role::Hair).
    ///
    /// Hair that does not hang before an eye stays as it is to the bit. Needs a device with
    /// `DEPTH32FLOAT_STENCIL8`; without it nothing is seen through.
    #[derive(Copy)]
    EyesThrough {
        /// 0: hair hides them, 1: hair is not seen before them.
        opacity: f32 = 0.5, in 0.0..=1.0;
        /// Hair farther than this before an eye hides it: another character's hair, or the back of the head. Metres.
        window_m: f32 = 0.05, in 0.0..=10.0;
        /// Angles of the view to the side of the face from which it fades, and at which it has gone, radians, growing: 50 and
        /// 80 degrees.
        fade_yaw_rad: [f32; 2] = [50f32.to_radians(), 80f32.to_radians()], in 0.0..=3.15;
        /// The same for views from above and below: 40 and 70 degrees.
        fade_pitch_rad: [f32; 2] = [40f32.to_radians(), 70f32.to_radians()], in 0.0..=3.15;
    }
}
