//! Shade ramps, warm and cool: a row for each kind of surface, from full shade (left) to full light (right), as factors of
//! the lit colour. Looks of Hikage choose between the two sets by the light; MToon knows none of this.

use glam::Vec3;

use crate::model::{Model, Texture};
use crate::picture::{Picture, rgb, smoothstep};

/// Rows of the ramps from above: materials by the start of their names, tint in shade and at the terminator, warm and
/// cool.
const ROWS: &[(&[&str], [[u32; 2]; 2])] = &[
    (&["Face", "Mouth", "Body_Skin"], [[0xf7c9b6, 0xffb8a2], [0xf0c8cc, 0xf8b8b2]]),
    (&["Hair"], [[0xcfbdd8, 0xe2bcc8], [0xb7b4e6, 0xb9a4dc]]),
    (&["Jacket", "Skirt", "Stocking", "Cloth_Bow", "Cloth_Shorts"], [[0xa88aa6, 0xb8706e], [0x8a86cc, 0x7a6bb8]]),
    (&["Cloth_Blouse", "Jacket_Fur", "Jacket_Cuff"], [[0xe4cdd2, 0xf2d0c2], [0xc2bfe8, 0xc9b4e0]]),
    (&["Boots", "Cloth_Belt", "Jacket_Lining"], [[0xb8856e, 0xcc7a4e], [0x9a86b4, 0x9c6c8c]]),
    (&["Metal"], [[0x8a4e2a, 0xb06a30], [0x6e5a7c, 0x8c6a6a]]),
    (&["Accessory"], [[0xd89a78, 0xe8a070], [0xa8a4d8, 0xc0a0d0]]),
    (&["Eye", "Brow"], [[0xe8cfc6, 0xe8bcae], [0xcfc6e6, 0xc4b0dc]]),
];

/// Rows of a ramp.
pub(crate) const fn row_count() -> usize {
    ROWS.len()
}

/// Row of a material; the longest matching name wins.
pub(crate) fn row(name: &str) -> usize {
    let longest = |(index, (starts, _)): (usize, &(&[&str], _))| {
        starts.iter().filter(|s| name.starts_with(**s)).map(|s| (s.len(), index)).max()
    };
    ROWS.iter().enumerate().filter_map(longest).max().unwrap_or_else(|| panic!("material {name} has no ramp")).1
}

/// Adds both ramps and points every material to its row.
pub(crate) fn add(model: &mut Model) {
    model.textures.extend([
        Texture { name: "ramp_warm", paint: || paint(0), repeat: false },
        Texture { name: "ramp_cool", paint: || paint(1), repeat: false },
    ]);
    for material in &mut model.materials {
        material.extras.extend([("rampWarm", "ramp_warm"), ("rampCool", "ramp_cool")]);
        material.ramp_row = row(material.name);
    }
}

fn paint(set: usize) -> Picture {
    Picture::from_fn(256, 4 * ROWS.len() as u32, move |uv| {
        let (_, tints) = &ROWS[((uv.y * ROWS.len() as f32) as usize).min(ROWS.len() - 1)];
        let [shade, terminator] = tints[set].map(rgb);
        // Shade, then a narrow saturated band before the light.
        let mut color = shade.lerp(terminator, smoothstep(0.4, 0.485, uv.x));
        color = color.lerp(Vec3::ONE, smoothstep(0.5, 0.56, uv.x));
        [color.x, color.y, color.z, 1.0]
    })
}
