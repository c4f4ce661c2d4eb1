//! What casts the shadow of the bangs.

crate::part! {
    /// The light of the bangs' shadow: what casts on the face drawn from an orthographic camera that is fitted to the head.
    ///
    /// Casters are the parts of the roles [`HairFront`](super::Role::HairFront), [`Skin`](super::Role::Skin) (hands),
    /// [`Cloth`](super::Role::Cloth) and [`Accessory`](super::Role::Accessory), and all of other characters (the first 16 of a
    /// crowd); materials with a [`BangsShadow`](crate::material::BangsShadow) receive it. The texels of its map have a fixed
    /// size in metres, so that neither zoom nor field of view changes the edge. Where this light only grazes a surface, what
    /// lies on it casts none: its shadow would be a smear.
    #[derive(Copy)]
    Bangs {
        /// Where the shadow's light stands, in the frame of the head: angle to the character's left, and height over the
        /// front, radians. `None`: where the directional light stands, held within 25 degrees to the sides and between 25
        /// and 40 degrees of height, so that the shadow has the shape of its strands and stays off the cheeks.
        direction_rad: Option<[f32; 2]> = None, in -3.15..=3.15;
        /// Width of the soft edge, metres.
        soft_width_m: f32 = 0.0045, in 0.0005..=0.05;
        /// Sharpness c of the exponential test, for each unit of the depth range, which is twice the width of the camera's
        /// picture: of a caster `gap` before the receiver, `exp(-c gap)` leaks.
        hardness: f32 = 1500.0, in 100.0..=5000.0;
        /// Distance by which a caster must lie before the receiver, metres.
        bias_m: f32 = 0.001, in 0.0..=0.01;
    }
}
