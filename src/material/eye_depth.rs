//! A drawn iris that has depth without a vertex more.

use serde::{Deserialize, Serialize};

use super::{Options, Section, Surroundings, TextureRef, walk::plain_parts};
use crate::render::layout::Block;

/// Shape of a pupil.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PupilShape {
    /// As it is painted.
    #[default]
    Painted,
    /// A disc.
    Round,
    /// Upright, as a cat's.
    Slit,
    /// A heart.
    Heart,
    /// A star of five points.
    Star,
}

impl PupilShape {
    /// As the shader counts them.
    fn number(self) -> f32 {
        f32::from(self as u8)
    }
}

plain_parts!(PupilShape);

crate::section! {
    /// A drawn iris that lies hollow behind a cornea: its picture moves as a bowl behind a lens would be seen, so that it stays round
    /// and deep from the side and its rim keeps its place. The mesh is the flat part that the iris is drawn on; where each iris is and
    /// how its picture lies is found at the upload. Works with every texture of the material.
    ///
    /// Source: Snell's law at a bulging surface, into a paraboloid.
    #[derive(Copy)]
    EyeDepth = "eye_depth" {
        needs: &["actor", "eye_vertex"],
        channel: Some(("eye-depth", "How far the view moves drawn irises: right in red, up in green, half is not at all.")),
    }
    {
        /// Depth of the middle of the iris behind its rim, share of its half width; 0 leaves it flat.
        depth: f32 = 0.3, in 0.0..=2.0;
        /// Slope of the cornea at the rim.
        bulge: f32 = 0.5, in 0.0..=2.0;
        /// Index of refraction; 1 refracts nothing.
        ior: f32 = 1.376, in 1.0..=3.0;
        /// Where the painted iris ends, share of half of the part's width and height.
        rim: f32 = 1.0, in 0.05..=2.0;
        /// Radius of the painted pupil, share of the rim's; 0 where none is painted, or it must not change. Under a pupil that is laid
        /// over it, it is drawn together to nothing.
        pupil_drawn: f32 = 0.0, in 0.0..=0.95;
        /// What its size is multiplied by; light and expressions change it further where the scene has `pupils`.
        pupil_scale: f32 = 1.0, in 0.1..=3.0;
        /// Shape of a pupil that is laid over what is painted: `painted` (none), `round`, `slit`, `heart` or `star`.
        pupil_shape: PupilShape = PupilShape::Painted;
        /// The same as a picture, red, linear, whose square reaches over the iris to its rim.
        pupil_map: Option<TextureRef> = None, read LINEAR;
        /// Radius of a pupil that is laid over it, share of the rim's.
        pupil_radius: f32 = 0.36, in 0.0..=1.0;
        /// Its colour, linear, and how far it covers.
        pupil_color: [f32; 4] = [0.012, 0.006, 0.02, 1.0], in 0.0..=1.0;
        /// Light that gathers at the lower rim, as it is painted: what the colour is multiplied by there grows by this.
        from_below: f32 = 0.0, in 0.0..=4.0;
        /// Colour of that light, linear.
        below_color: [f32; 3] = [1.0; 3], in 0.0..=1.0;
        /// How far it lies opposite of the light rather than below: 0 not at all, 1 wholly.
        follow_light: f32 = 0.35, in 0.0..=1.0;
    }
    presets {
        /// Deep and lit from below.
        deep { depth: 0.4, from_below: 0.6 }
        /// A cat's.
        slit { pupil_shape: PupilShape::Slit }
        /// In love.
        heart { pupil_shape: PupilShape::Heart, pupil_color: [0.85, 0.06, 0.22, 1.0], pupil_radius: 0.5 }
        /// Delighted.
        star { pupil_shape: PupilShape::Star, pupil_color: [1.0, 0.82, 0.25, 1.0], pupil_radius: 0.55 }
    }
}

impl Section for EyeDepth {
    fn put(&self, gpu: &mut Block<'_>, of: &Surroundings<'_>) {
        let mut rows = [[0.0; 4]; 2 * crate::eye::MOST_EYES];
        for (row, eye) in rows.as_chunks_mut::<2>().0.iter_mut().zip(of.eyes) {
            let [u, v] = eye.uv;
            *row = [[u[0], u[1], u[2], eye.aspect], [v[0], v[1], v[2], 0.0]];
        }
        gpu.put("rows", rows);
        gpu.put("shape", self.pupil_shape.number());
    }

    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        on.set("eye_depth_pupil", self.pupil_shape != PupilShape::Painted && self.pupil_map.is_none());
        on.set("eye_depth_below", self.from_below > 0.0);
    }

    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        // Of an eye behind its cornea the same is done as it is.
        of.material.eye.is_none()
    }
}
