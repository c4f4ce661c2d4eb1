//! An eye behind its cornea.

use super::{Generated, Options, Section, SkinTable, Surroundings, TextureRef};
use crate::eye::{EyeDimensions, EyeRow, MOST_EYES};
use crate::render::layout::Block;
use crate::skin::DiffusionProfile;

crate::part! {
    /// A light that is painted into an eye: where the cornea would mirror its direction, as large and as round from wherever it is
    /// seen; from 45 degrees to the side on it shrinks with the iris.
    #[derive(Copy)]
    CatchLight {
        /// Strength, in light of strength 1; 0 for none.
        strength: f32 = 0.0, in 0.0..=20.0;
        /// Half of its width and of its height, shares of the iris' radius.
        half: [f32; 2] = [0.16, 0.2], in 0.0..=1.0;
        /// 1 is an ellipse, 0 a window with corners.
        round: f32 = 1.0, in 0.0..=1.0;
        /// Direction that it comes from as the viewer sees it: to the right and up, radians.
        from_rad: [f32; 2] = [-0.6, 0.7], in -1.6..=1.6;
        /// How far the directional light turns that: 0 it stays with the viewer, 1 it stands where the light does.
        follow: f32 = 0.3, in 0.0..=1.0;
        /// Farthest from the middle of the cornea, share of the iris' radius: it never leaves the eye.
        within: f32 = 0.6, in 0.0..=1.0;
    }
}

crate::section! {
    /// An eye behind a refracting cornea: iris and pupil where Snell's law has them, light gathered on the iris opposite of the
    /// lamp, dark limbus, sclera that scatters light as skin does, lights on the cornea.
    ///
    /// The mesh may be one ball, a ball with a bulge, or cornea, iris and sclera apart; all materials of it have the section, and
    /// where they are several, they share their `dimensions`. Where each eye is, which way it looks and how large it is, is found of
    /// the mesh and of the eye bones at the upload; it is no matter of the mesh where the cornea stands. What is opaque in front is
    /// what shows the iris: of an eye in parts that is the cornea, with the picture of the iris as `iris_map`.
    ///
    /// Sources: Snell's law and Fresnel's equations; HDRP's eye (measures, pupil, limbus); Christensen and Burley 2015 (sclera).
    #[derive(Copy)]
    Eye = "eye" {
        is_model: true, needs: &["actor", "eye_vertex"],
        channel: Some(("eye-place", "Where the view meets the iris: right in red, up in green, half is the middle; blue outside.")),
        more_channels: &[
            ("eye-caustic", "Light of the key light on irises, half of what falls on it straight is grey."),
            ("eye-limbus", "What the limbus leaves of the colour of eyes."),
            ("eye-lids", "What lids and lashes leave of the light on eyes."),
        ],
    }
    {
        /// Measures of the eye.
        dimensions: EyeDimensions = EyeDimensions::default(), part EyeDimensions;
        /// Picture of the iris where it is not the base texture's. Where a part of the same eye wears it, it lies on the iris as it
        /// does there; else its square is drawn round the iris.
        iris_map: Option<TextureRef> = None, read SRGB;
        /// What the colour of the iris is multiplied by, linear.
        iris_color: [f32; 3] = [1.0; 3], in 0.0..=4.0;
        /// Diameter of the pupil, mm. Where the scene has `pupils`, as in the natural look, light says it instead as far as their
        /// `reflex`, and expressions multiply it.
        pupil_mm: f32 = 4.0, in 0.2..=10.0;
        /// Radius of the pupil as it is painted, share of the iris' radius; 0 where none is painted and none is wanted.
        pupil_drawn: f32 = 0.35, in 0.0..=0.95;
        /// Colour of a pupil that is laid over what is painted, with the share of it as the fourth number.
        pupil_color: [f32; 4] = [0.0, 0.0, 0.0, 0.0], in 0.0..=1.0;
        /// Width of the dark ring where iris and white meet, share of the iris' radius, to either side.
        limbus_width: f32 = 0.14, in 0.0..=1.0;
        /// How dark that is: 0 not at all, 1 black.
        limbus_strength: f32 = 0.65, in 0.0..=1.0;
        /// How hollow the iris is: its slope at the rim.
        hollow: f32 = 0.25, in 0.0..=2.0;
        /// How far light gathers on the iris as it does behind a cornea: 0 falls evenly, 1 as refraction has it.
        caustic: f32 = 1.0, in 0.0..=1.0;
        /// Roughness of the cornea.
        cornea_roughness: f32 = 0.04, in 0.02..=1.0;
        /// Roughness of the white.
        sclera_roughness: f32 = 0.22, in 0.02..=1.0;
        /// Share of what is mirrored.
        specular_strength: f32 = 1.0, in 0.0..=4.0;
        /// How light scatters in the white.
        profile: DiffusionProfile = DiffusionProfile::default(), part DiffusionProfile;
        /// How far it does: 0 Lambert, 1 as the profile has it.
        scatter: f32 = 1.0, in 0.0..=1.0;
        /// Share of veins in the white, more of them towards the corners; 0 for none.
        veins: f32 = 0.0, in 0.0..=1.0;
        /// Colour that they multiply the white by, linear.
        vein_color: [f32; 3] = [0.72, 0.2, 0.16], in 0.0..=1.0;
        /// How dark the shade of the lids is, 0 to 1. Their edges are found at the upload, of the pose at rest.
        lid_shadow: f32 = 0.3, in 0.0..=1.0;
        /// How far it reaches over the ball, radians.
        lid_reach_rad: f32 = 0.35, in 0.01..=1.6;
        /// The same of lashes, below the upper lid alone.
        lash_shadow: f32 = 0.15, in 0.0..=1.0;
        /// Width of the wet line along the lower lid, radians over the ball; 0 for none.
        wet_line_rad: f32 = 0.05, in 0.0..=0.5;
        /// Painted lights.
        key_catch: CatchLight = CatchLight::default(), part CatchLight;
        /// A second one.
        fill_catch: CatchLight = CatchLight::default(), part CatchLight;
    }
    presets {
        /// An eye of a grown human in its own light.
        human { veins: 0.3 }
        /// The same with two painted lights, as portraits have them.
        portrait { key_catch: WINDOW, fill_catch: BELOW }
        /// Glass: no veins, sharp, a wide limbus.
        doll { veins: 0.0, scatter: 0.0, cornea_roughness: 0.02, limbus_width: 0.2, key_catch: WINDOW }
    }
}

const WINDOW: CatchLight = CatchLight {
    strength: 0.8,
    half: [0.17, 0.21],
    round: 0.7,
    from_rad: [-0.6, 0.7],
    follow: 0.3,
    within: 0.6,
};
const BELOW: CatchLight =
    CatchLight { strength: 0.25, half: [0.07, 0.07], round: 1.0, from_rad: [0.7, -0.7], follow: 0.1, within: 0.6 };

impl Section for Eye {
    fn put(&self, gpu: &mut Block<'_>, of: &Surroundings<'_>) {
        let mut rows = [[0.0; 4]; 3 * MOST_EYES];
        for (row, eye) in rows.as_chunks_mut::<3>().0.iter_mut().zip(of.eyes) {
            *row = eye.rows();
        }
        gpu.put("rows", rows);
        gpu.put("cornea_centre_z_mm", self.dimensions.cornea_centre_z_mm());
        gpu.put("limbus_z_mm", self.dimensions.limbus_z_mm());
        gpu.put("iris_z_mm", self.dimensions.iris_z_mm());
    }

    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        on.set("eye_veins", self.veins > 0.0);
        on.set("eye_catch", self.key_catch.strength > 0.0 || self.fill_catch.strength > 0.0);
        on.set("eye_lids", of.eyes.iter().any(EyeRow::has_lids));
    }

    fn generated(&self, _: &Surroundings<'_>) -> Option<(&'static str, Generated)> {
        (self.scatter > 0.0).then(|| ("table", Generated::Skin(SkinTable::of_diffusion(&self.profile))))
    }
}
