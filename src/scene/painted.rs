//! What a file paints: the lit colour of a material at any place of its textures.

use std::sync::LazyLock;

use super::{Image, Primitive, Scene};
use crate::color::linear_from_srgb;
use crate::material::{Material, UvTransform};

/// Most triangles of a part whose colours are read.
const MOST_READ: usize = 4096;

/// Linear values of the codes of a channel.
static DECODED: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|code| linear_from_srgb(code as f32 / 255.0)));

/// The lit colours of a material.
pub(crate) struct Painted<'a> {
    image: Option<&'a Image>,
    /// Its rotation is below.
    transform: UvTransform,
    sin_cos: (f32, f32),
    uv_set: usize,
    factor: [f32; 4],
}

impl<'a> Painted<'a> {
    pub(crate) fn new(scene: &'a Scene, material: &Material) -> Self {
        let base = &material.base;
        let texture = base.texture.and_then(|t| Some((t, scene.textures.get(t.texture)?)));
        let image = texture.and_then(|(_, texture)| scene.images.get(texture.image));
        let transform = texture.map(|(t, _)| t.transform).unwrap_or_default();
        Self {
            image: image.filter(|i| i.pixels.len() == i.width as usize * i.height as usize * 4 && i.width > 0),
            transform,
            sin_cos: transform.rotation_rad.sin_cos(),
            uv_set: texture.map_or(0, |(t, _)| t.uv_set as usize),
            factor: base.color,
        }
    }

    /// Linear colour and alpha at texture coordinates, of the nearest texel; textures repeat.
    pub(crate) fn at(&self, [u, v]: [f32; 2]) -> [f32; 4] {
        let Some(image) = self.image else { return self.factor };
        let UvTransform { offset, scale, .. } = self.transform;
        let (sin, cos) = self.sin_cos;
        let (u, v) = (u * scale[0], v * scale[1]);
        let place = |c: f32, side: u32| {
            // Hostile coordinates are not finite.
            (((c - c.floor()) * side as f32) as u32).min(side - 1) as usize
        };
        let x = place(u * cos + v * sin + offset[0], image.width);
        let y = place(v * cos - u * sin + offset[1], image.height);
        let at = (y * image.width as usize + x) * 4;
        let linear = |c: usize| DECODED[usize::from(image.pixels[at + c])] * self.factor[c];
        [linear(0), linear(1), linear(2), f32::from(image.pixels[at + 3]) / 255.0 * self.factor[3]]
    }

    /// Texture coordinates of a vertex of a part.
    pub(crate) fn uv(&self, part: &Primitive, vertex: usize) -> [f32; 2] {
        part.uvs.get(self.uv_set).and_then(|set| set.get(vertex)).copied().unwrap_or_default()
    }

    /// Colours in the middle of triangles of a part, and the area of each, at most some thousand of them spread over the part.
    pub(crate) fn of_triangles(&self, part: &'a Primitive) -> impl Iterator<Item = ([f32; 3], f32)> {
        let step = part.indices.len().div_ceil(3).div_ceil(MOST_READ).max(1);
        part.indices.chunks_exact(3).step_by(step).filter_map(|t| {
            let corner = |i: usize| Some(glam::Vec3::from(*part.positions.get(t[i] as usize)?));
            let (a, b, c) = (corner(0)?, corner(1)?, corner(2)?);
            let area = (b - a).cross(c - a).length() * 0.5;
            let set = part.uvs.get(self.uv_set);
            let uv = |i: usize| set.and_then(|s| s.get(t[i] as usize)).copied().unwrap_or_default();
            let middle = std::array::from_fn(|k| (uv(0)[k] + uv(1)[k] + uv(2)[k]) / 3.0);
            let [r, g, b, alpha] = self.at(middle);
            (area.is_finite() && alpha > 0.5).then_some(([r, g, b], area))
        })
    }
}
