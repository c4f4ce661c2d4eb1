//! What expressions change of materials: shifts towards a colour, and of textures over the surface.

use crate::material::{Material, Shading};
use crate::scene::{ColorBind, ColorTarget, UvBind};

/// What expressions change of materials, each with its weight. They add to whatever an actor's materials are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shifts {
    /// Colours, and how far they move towards the target: 0..1.
    pub colors: Vec<(ColorBind, f32)>,
    /// Transforms of textures, and how far they move.
    pub uvs: Vec<(UvBind, f32)>,
}

impl Shifts {
    pub(crate) fn clear(&mut self) {
        self.colors.clear();
        self.uvs.clear();
    }

    /// Materials that are touched.
    pub(crate) fn materials(&self) -> impl Iterator<Item = usize> {
        let colors = self.colors.iter().map(|(bind, _)| bind.material);
        colors.chain(self.uvs.iter().map(|(bind, _)| bind.material))
    }

    /// A material as it is shifted.
    #[must_use]
    pub fn applied(&self, index: usize, rest: &Material) -> Material {
        let mut material = rest.clone();
        for (bind, weight) in self.colors.iter().filter(|(bind, _)| bind.material == index) {
            let (from, to) = (color_of(rest, bind.target), bind.value);
            add_color(&mut material, bind.target, std::array::from_fn(|i| (to[i] - from[i]) * weight));
        }
        if self.uvs.iter().any(|(bind, _)| bind.material == index) {
            material.each_texture(&mut |_, read, texture| {
                // All but those that do not lie on the surface: the matcap and ramps.
                let rest = texture.transform;
                let moved = self.uvs.iter().filter(|(bind, _)| bind.material == index && read.by_uv);
                for (bind, weight) in moved {
                    for axis in 0..2 {
                        texture.transform.scale[axis] += (bind.scale[axis] - rest.scale[axis]) * weight;
                        texture.transform.offset[axis] += (bind.offset[axis] - rest.offset[axis]) * weight;
                    }
                }
            });
        }
        material
    }
}

fn color_of(material: &Material, target: ColorTarget) -> [f32; 4] {
    let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
    match target {
        ColorTarget::Color => material.base.color,
        ColorTarget::EmissionColor => opaque(material.emission.color),
        ColorTarget::ShadeColor => match &material.shading {
            Shading::Toon(toon) => opaque(toon.shade_color),
            Shading::Standard(_) | Shading::Unlit => [0.0; 4],
        },
        ColorTarget::MatcapColor => opaque(material.matcap.map_or([0.0; 3], |m| m.color)),
        ColorTarget::RimColor => opaque(material.rim.color),
        ColorTarget::OutlineColor => opaque(material.outline.map_or([0.0; 3], |o| o.color)),
    }
}

fn add_color(material: &mut Material, target: ColorTarget, shift: [f32; 4]) {
    let color: &mut [f32] = match target {
        ColorTarget::Color => &mut material.base.color,
        ColorTarget::EmissionColor => &mut material.emission.color,
        ColorTarget::ShadeColor => match &mut material.shading {
            Shading::Toon(toon) => &mut toon.shade_color,
            Shading::Standard(_) | Shading::Unlit => return,
        },
        ColorTarget::MatcapColor => match &mut material.matcap {
            Some(matcap) => &mut matcap.color,
            None => return,
        },
        ColorTarget::RimColor => &mut material.rim.color,
        ColorTarget::OutlineColor => match &mut material.outline {
            Some(outline) => &mut outline.color,
            None => return,
        },
    };
    for (channel, shift) in color.iter_mut().zip(shift) {
        *channel += shift;
    }
}
