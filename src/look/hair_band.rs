//! A band of light round the hair of any character: texture coordinates by the direction from the head, and a painted band
//! to lay over them.

use std::collections::BTreeSet;
use std::f32::consts::PI;

use glam::Vec3;

use crate::material::{Highlight, TextureRef};
use crate::scene::{Filter, Image, Sampler, Scene, Texture, Wrap};

/// Size of the painted band, texels: round half the head, and from pole to pole.
const SIZE: [u32; 2] = [1024, 512];
/// Middle of the band, v: 0 over the head, 1/2 at its middle. Light and view from the front move it up from there.
const MIDDLE: f32 = 0.33;
/// How much the normals of locks bend the band, so that each has an arc of its own.
const OF_NORMAL: f32 = 0.3;

/// Gives these hair materials a band. Parts that already use two sets of texture coordinates are left out.
pub(super) fn add(scene: &mut Scene, materials: &BTreeSet<usize>) {
    let Some((low, high)) = scene.face_box(None) else { return };
    // A little behind and above the middle of the face lies that of the skull.
    let size = high - low;
    let middle = (low + high) * 0.5 + Vec3::new(0.0, 0.1, 0.0) * size.y;
    let parts = scene.meshes.iter().flat_map(|m| &m.primitives);
    let taken: BTreeSet<usize> = parts.filter(|p| p.uvs.len() > 1).map(|p| p.material).collect();
    let wrapped = wrap(scene, &(materials - &taken), middle);
    if wrapped.is_empty() {
        return;
    }
    scene.images.push(paint());
    let clamp = Wrap::Clamp;
    let sampler =
        Sampler { wrap_u: clamp, wrap_v: clamp, mag: Filter::Linear, min: Filter::Linear, mip: Some(Filter::Nearest) };
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler });
    let map = TextureRef { texture: scene.textures.len() - 1, uv_set: 1, ..TextureRef::default() };
    for material in wrapped {
        let base = scene.materials[material].base.color;
        // The thin line below is of a paler tone of the hair.
        let tone = |c: f32| 0.45 + 0.55 * c.clamp(0.0, 1.0);
        scene.materials[material].highlight = Some(Highlight {
            map,
            color: [1.0, 0.98, 0.97],
            strength: 0.5,
            second_color: [tone(base[0]), tone(base[1]), tone(base[2])],
            second_strength: 0.3,
            second_motion: 1.0,
            light_v: 0.03,
            view_v: 0.03,
            ..Highlight::default()
        });
    }
}

/// Adds the coordinates as the second set: u is the angle from the front over π, alike on both sides so that no seam runs
/// down the back, v that from above. Gives the materials that have them.
fn wrap(scene: &mut Scene, materials: &BTreeSet<usize>, middle: Vec3) -> BTreeSet<usize> {
    let mut done = BTreeSet::new();
    scene.for_each_hair(|part, matrix| {
        if !materials.contains(&part.material) {
            return;
        }
        let at = |(position, normal): (&[f32; 3], &[f32; 3])| {
            let out = (matrix.transform_point3(Vec3::from(*position)) - middle).normalize_or(Vec3::Y);
            let normal = matrix.transform_vector3(Vec3::from(*normal)).normalize_or(out);
            let bent = out.lerp(normal, OF_NORMAL).normalize_or(out);
            [out.x.abs().atan2(out.z) / PI, bent.y.clamp(-1.0, 1.0).acos() / PI]
        };
        let set: Vec<[f32; 2]> = part.positions.iter().zip(&part.normals).map(at).collect();
        if part.uvs.is_empty() {
            part.uvs.push(vec![[0.0; 2]; set.len()]);
        }
        part.uvs.push(set);
        done.insert(part.material);
    });
    done
}

/// Smooth noise of one number, 0..1.
fn noise(x: f32, seed: u32) -> f32 {
    let hash = |i: i32| {
        let mut h = (i as u32).wrapping_mul(0x9e37_79b1) ^ seed.wrapping_mul(0x85eb_ca6b);
        h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
        h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
        (h ^ (h >> 15)) as f32 / u32::MAX as f32
    };
    let (cell, t) = (x.floor(), x.fract());
    let t = t * t * (3.0 - 2.0 * t);
    hash(cell as i32) * (1.0 - t) + hash(cell as i32 + 1) * t
}

/// Red: a band, jagged below as brushes leave it. Green: a thin broken line under it.
fn paint() -> Image {
    let [width, height] = SIZE;
    let smooth = |from: f32, to: f32, x: f32| {
        let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let mut pixels = Vec::with_capacity((width * height * 4) as usize);
    for y in 0..height {
        let v = (y as f32 + 0.5) / height as f32;
        for x in 0..width {
            let u = (x as f32 + 0.5) / width as f32;
            // Brushes run out in points of uneven length.
            let spike = noise(u * 90.0, 2).powi(2);
            let wave = noise(u * 14.0, 1) - 0.5;
            let top = MIDDLE - 0.012 + 0.012 * wave - 0.01 * noise(u * 70.0, 5);
            let bottom = MIDDLE + 0.004 + 0.012 * wave + 0.03 * spike;
            let band = smooth(top - 0.003, top + 0.003, v) * smooth(bottom + 0.006, bottom - 0.004, v);
            let middle = MIDDLE + 0.042 + 0.014 * wave + 0.012 * spike;
            let thin = 0.002 + 0.006 * noise(u * 40.0, 6);
            let below = smooth(thin + 0.004, thin, (v - middle).abs()) * smooth(0.3, 0.55, noise(u * 34.0, 7));
            // Strands between which no light lies.
            let strand = smooth(0.12, 0.3, 0.6 * noise(u * 150.0, 3) + 0.4 * noise(u * 330.0, 4));
            let code = |c: f32| (c.clamp(0.0, 1.0) * 255.0).round() as u8;
            pixels.extend([code(band * strand), code(below * strand), 0, 255]);
        }
    }
    Image { name: "hair band".to_owned(), width, height, pixels, source_bits: 8, ..Image::default() }
}
