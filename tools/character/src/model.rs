//! Everything that the file will hold, filled part by part.

use std::collections::BTreeMap;

use glam::Vec3;

use crate::mesh::Part;
use crate::picture::Picture;
use crate::skeleton::Skeleton;

/// The character while she is built.
#[derive(Default)]
pub struct Model {
    /// Bones.
    pub skeleton: Skeleton,
    /// Meshes.
    pub parts: Vec<Part>,
    /// Materials; parts name them.
    pub materials: Vec<Material>,
    /// Painters of the textures; materials name them. They run in parallel when the file is written.
    pub textures: Vec<Texture>,
    /// Facial expressions.
    pub expressions: Vec<Expression>,
    /// Swinging chains.
    pub springs: Vec<Spring>,
    /// Shapes that the chains stay out of.
    pub colliders: Vec<Collider>,
}

/// A texture: its name and the function that paints it.
pub struct Texture {
    /// Name; unique.
    pub name: &'static str,
    /// Paints it. Always the same pixels.
    pub paint: fn() -> Picture,
    /// Whether u and v repeat (`true`) or are clamped.
    pub repeat: bool,
}

/// How a material covers what is behind it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Alpha {
    /// Fully.
    #[default]
    Opaque,
    /// Where alpha is at least this.
    Mask(f32),
    /// By alpha; materials with a higher queue offset (-9..=9) are drawn later.
    Blend {
        /// Whether it writes depth.
        depth_write: bool,
        /// Order among blended materials.
        queue: i32,
    },
}

/// An MToon 1.0 material. Colours are linear, as in the file; see [`srgb`].
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name; `hikage` guesses the role of the part by it.
    pub name: &'static str,
    /// Lit colour and alpha.
    pub color: [f32; 4],
    /// Lit texture (sRGB), multiplied by `color`.
    pub texture: Option<&'static str>,
    /// Colour in shade.
    pub shade: [f32; 3],
    /// Texture in shade (sRGB), multiplied by `shade`. Usually the same as `texture`.
    pub shade_texture: Option<&'static str>,
    /// Moves the border of light and shade: -1 all shaded .. 1 all lit.
    pub shift: f32,
    /// 0 soft .. 1 hard border.
    pub toony: f32,
    /// Normal map, OpenGL convention.
    pub normal_map: Option<&'static str>,
    /// Light that it gives off.
    pub emission: [f32; 3],
    /// Texture of the emission (sRGB), multiplied by `emission`.
    pub emission_texture: Option<&'static str>,
    /// Transparency.
    pub alpha: Alpha,
    /// Whether its back faces are seen.
    pub double_sided: bool,
    /// Outline width, metres; 0 for none.
    pub outline: f32,
    /// Outline colour.
    pub outline_color: [f32; 3],
    /// Outline width mask (green channel, linear).
    pub outline_mask: Option<&'static str>,
    /// Matcap (sRGB), added.
    pub matcap: Option<(&'static str, [f32; 3])>,
    /// Parametric rim: colour, fresnel power, lift.
    pub rim: Option<([f32; 3], f32, f32)>,
    /// Scroll of the UVs, 1/s.
    pub scroll: [f32; 2],
    /// Textures that MToon has no place for, by the name of their use. Kept in `extras` for Hikage's own looks.
    pub extras: BTreeMap<&'static str, &'static str>,
    /// Row of the ramps, from above.
    pub ramp_row: usize,
    /// Materials whose row of the ramps each part of its `partId` has, from part 1 on.
    pub part_ramps: &'static [&'static str],
    /// What it is, where Hikage's looks treat it in their own way: `metal`, `amber`, `diamond`, `fire`, `fluff`,
    /// `stocking`.
    pub substance: Option<&'static str>,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: "",
            color: [1.0; 4],
            texture: None,
            shade: [0.7, 0.6, 0.7],
            shade_texture: None,
            shift: -0.05,
            toony: 0.95,
            normal_map: None,
            emission: [0.0; 3],
            emission_texture: None,
            alpha: Alpha::Opaque,
            double_sided: false,
            outline: 0.0,
            outline_color: [0.1, 0.05, 0.08],
            outline_mask: None,
            matcap: None,
            rim: None,
            scroll: [0.0; 2],
            extras: BTreeMap::new(),
            ramp_row: 0,
            part_ramps: &[],
            substance: None,
        }
    }
}

/// A facial expression: morphs of all parts that have one of these names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expression {
    /// Name: a preset of VRM 1.0 or one of our own.
    pub name: &'static str,
    /// Whether it is a preset.
    pub preset: bool,
    /// Names of morphs and their weights.
    pub morphs: Vec<(&'static str, f32)>,
    /// Whether it switches blinking off (its eyes are already shut or shaped).
    pub blocks_blink: bool,
    /// Whether it fades the gaze.
    pub blends_look: bool,
}

/// A sphere or capsule on a bone.
#[derive(Clone, Debug, PartialEq)]
pub struct Collider {
    /// Group that springs refer to (`head`, `body`, `legs`).
    pub group: &'static str,
    /// Bone.
    pub bone: usize,
    /// Centre relative to the bone, metres.
    pub offset: Vec3,
    /// Other end of a capsule relative to the bone; `None` for a sphere.
    pub tail: Option<Vec3>,
    /// Radius, metres.
    pub radius: f32,
}

/// A swinging chain (`VRMC_springBone`).
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Name.
    pub name: String,
    /// Bones from root to tip; the last one only marks the end.
    pub joints: Vec<usize>,
    /// Force back to the rest shape at the root and at the tip, 0..4.
    pub stiffness: [f32; 2],
    /// Loss of speed, 0..1.
    pub drag: f32,
    /// Downward force.
    pub gravity: f32,
    /// Radius of each joint, metres.
    pub radius: f32,
    /// Collider groups that it stays out of.
    pub colliders: Vec<&'static str>,
}

impl Model {
    /// The part of this name.
    #[must_use]
    pub fn part(&self, name: &str) -> Option<&Part> {
        self.parts.iter().find(|p| p.name == name)
    }
}

/// Linear colour of an sRGB colour written `0xRRGGBB`.
#[must_use]
pub fn srgb(hex: u32) -> [f32; 3] {
    [16, 8, 0].map(|shift| {
        let c = ((hex >> shift) & 0xff) as f32 / 255.0;
        if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        }
    })
}

/// [`srgb`] with full alpha.
#[must_use]
pub fn srgba(hex: u32) -> [f32; 4] {
    let [r, g, b] = srgb(hex);
    [r, g, b, 1.0]
}
