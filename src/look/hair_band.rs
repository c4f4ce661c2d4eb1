//! A band of light round the hair of any character: which lock lies where, what colour light has on it, and texture
//! coordinates to lay the painted marks over.

use std::collections::{BTreeMap, BTreeSet};
use std::f32::consts::PI;

use glam::{Mat4, Vec3};

use super::BandStyle;
use super::band_marks::{CELLS, LEVELS, RING_CELLS, VARIANTS, paint};
use crate::material::{Highlight, TextureRef};
use crate::scene::painted::Painted;
use crate::scene::{Filter, Image, Primitive, Sampler, Scene, Texture, Warning, Wrap};
use crate::smoothstep::smoothstep;
use crate::tone::{Tone, oklab};

/// Angle from above of the band's middle, radians; light and view from the front move it up from there.
const MIDDLE: f32 = 1.05;
/// Angle over which the marks' picture reaches from its upper to its lower edge, radians: the band is 6 % of the head's height,
/// and there are none beyond.
const REACH: f32 = 0.525;
/// How far the marks move up their picture as light, and as the viewer, comes to the front.
const LIGHT_V: f32 = 0.18;
const VIEW_V: f32 = 0.18;
/// How far the middle of a mark lies at least below where its lock looks up, radians; on a round head that is above the band.
const BELOW_BEND: f32 = 0.06;
/// Widest lock that has one mark, radians round the head; what is wider is a cap of many.
const WIDEST: f32 = 0.9;
/// Angle from the front from which marks fade, and at which they have gone, radians: over the temples.
const FADES: [f32; 2] = [0.8, 2.05];
/// Share of the head's height that a piece of hair must be long: what is smaller ties it.
const LEAST_LOCK: f32 = 0.12;
/// Fewest triangles of hair that is smooth enough for a mark.
const LEAST_TRIANGLES: usize = 400;

/// What lies where.
#[derive(Clone, Copy)]
struct Place {
    /// Angle from the front, to the character's left, and angle from above, radians.
    around: f32,
    from_above: f32,
    /// Distance from the middle of the skull, metres.
    distance: f32,
    /// Whether the surface looks up rather than to the side.
    is_top: bool,
}

/// Share of the hair before and above the ears that a band may cover: more is no highlight.
const MOST_COVERED: f32 = 0.2;

/// Gives these hair materials a band. Parts that already use two sets of texture coordinates, hair of a few facets, and hair
/// of which the band would cover much, are left out with a warning.
pub(super) fn add(scene: &mut Scene, materials: &BTreeSet<usize>, style: BandStyle) {
    let Some((low, high)) = scene.face_box(None) else { return };
    // A little behind and above the middle of the face lies that of the skull.
    let size = high - low;
    let middle = (low + high) * 0.5 + Vec3::new(0.0, 0.1, 0.0) * size.y;
    let parts = || scene.meshes.iter().flat_map(|m| &m.primitives);
    let mut fit = materials.clone();
    let (mut warnings, mut coarse) = (Vec::new(), Vec::new());
    for index in materials {
        let of = || parts().filter(|p| p.material == *index);
        let triangles: usize = of().map(|p| p.indices.len() / 3).sum();
        if of().any(|p| p.uvs.len() > 1) {
            warnings.push((*index, "its second set of texture coordinates is taken".to_owned()));
        } else if triangles < LEAST_TRIANGLES {
            let why = format!("{triangles} triangles are too few for its marks; expected {LEAST_TRIANGLES}");
            coarse.push((*index, why));
        } else {
            continue;
        }
        fit.remove(index);
    }
    let tones: BTreeMap<usize, Light> = fit.iter().map(|index| (*index, light(scene, *index))).collect();
    let marks = if fit.is_empty() { Image::default() } else { paint(style) };
    let mut wrapped = wrap(scene, &fit, middle, size.y, style);
    wrapped.retain(|material| {
        let share = covered(scene, *material, &marks, middle);
        if share > MOST_COVERED {
            warnings.push((*material, format!("it would cover {:.0} % of the hair", share * 100.0)));
        }
        share <= MOST_COVERED
    });
    if wrapped.is_empty() {
        // Beside hair that has a band nobody misses that of a wisp.
        warnings.append(&mut coarse);
    }
    for (material, why) in warnings {
        let message = format!("hair band left out: {why}");
        scene.warnings.push(Warning { pointer: format!("/materials/{material}"), message });
    }
    if wrapped.is_empty() {
        return;
    }
    scene.images.push(marks);
    let clamp = Wrap::Clamp;
    let sampler =
        Sampler { wrap_u: clamp, wrap_v: clamp, mag: Filter::Linear, min: Filter::Linear, mip: Some(Filter::Nearest) };
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler });
    let map = TextureRef { texture: scene.textures.len() - 1, uv_set: 1, ..TextureRef::default() };
    for material in wrapped {
        let Some(Light { color, strength, in_shade }) = tones.get(&material).copied() else { continue };
        scene.materials[material].highlight = Some(Highlight {
            map,
            color,
            strength,
            light_v: LIGHT_V,
            view_v: VIEW_V,
            in_shade,
            ..Highlight::default()
        });
    }
}

/// Share of the hair of a material before and above the ears that the marks cover, for light and view from the front.
fn covered(scene: &mut Scene, material: usize, marks: &Image, middle: Vec3) -> f32 {
    let (mut all, mut covered) = (0.0, 0.0);
    scene.for_each_hair(|part, matrix| {
        let Some(set) = part.uvs.get(1).filter(|_| part.material == material) else { return };
        for t in part.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|i| matrix.transform_point3(Vec3::from(part.positions[t[i] as usize])));
            let at = (a + b + c) / 3.0 - middle;
            let area = (b - a).cross(c - a).length();
            if at.z < 0.0 || at.y < 0.0 || !area.is_finite() {
                continue;
            }
            let [u, v] = [0, 1].map(|k| t.iter().map(|i| set[*i as usize][k]).sum::<f32>() / 3.0);
            let (x, y) = (u * marks.width as f32, (v + LIGHT_V + VIEW_V) * marks.height as f32);
            let place = |c: f32, side: u32| (c.max(0.0) as usize).min(side as usize - 1);
            let texel = place(y, marks.height) * marks.width as usize + place(x, marks.width);
            all += area;
            covered += area * f32::from(marks.pixels[texel * 4]) / 255.0;
        }
    });
    if all > 0.0 { covered / all } else { 0.0 }
}

/// What light makes of a material's hair.
#[derive(Clone, Copy)]
struct Light {
    color: [f32; 3],
    strength: f32,
    in_shade: f32,
}

/// A lighter, less saturated tone of the hair; on black hair a blue sheen, on white hair a faint one, and little where the
/// file paints one itself.
fn light(scene: &Scene, material: usize) -> Light {
    let painted = Painted::new(scene, &scene.materials[material]);
    let parts = scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.material == material);
    let colors: Vec<([f32; 3], f32)> = parts.flat_map(|p| painted.of_triangles(p).collect::<Vec<_>>()).collect();
    let area: f32 = colors.iter().map(|(_, a)| a).sum();
    if area.is_nan() || area <= 0.0 {
        return Light { color: [1.0; 3], strength: 0.0, in_shade: 0.0 };
    }
    let mean = colors.iter().fold(Vec3::ZERO, |sum, (c, a)| sum + Vec3::from(*c) * (*a / area));
    let hair = Tone::of(mean.to_array());
    // A gloss that is painted stands out from most of the hair.
    let mut tones: Vec<(f32, f32)> = colors.iter().map(|(c, a)| (oklab(*c).x, *a)).collect();
    tones.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let at = |share: f32| {
        let mut left = area * share;
        let found = tones.iter().find(|(_, a)| {
            left -= a;
            left <= 0.0
        });
        found.map_or(0.0, |(lightness, _)| *lightness)
    };
    let spread = at(0.95) - at(0.5);
    let is_painted = spread > 0.12;
    let dark = smoothstep(0.42, 0.22, hair.lightness);
    let pale = smoothstep(0.78, 0.95, hair.lightness);
    let colored =
        Tone { lightness: (hair.lightness + 0.17).min(0.985), chroma: hair.chroma * 0.72, ..hair.towards(1.6, 0.12) };
    let sheen = Tone { lightness: (hair.lightness + 0.3).max(0.43), chroma: 0.055, hue_rad: -1.5 };
    let mix = |a: [f32; 3], b: [f32; 3], t: f32| std::array::from_fn(|c| a[c] + (b[c] - a[c]) * t);
    let color = mix(colored.to_linear(), sheen.to_linear(), dark);
    let strength = (0.92 - 0.3 * pale) * if is_painted { 0.3 } else { 1.0 };
    // Black hair in shade is one mass without it.
    Light { color, strength, in_shade: 0.04 + 0.3 * dark }
}

/// Adds the coordinates as the second set. Gives the materials that have them.
fn wrap(
    scene: &mut Scene,
    materials: &BTreeSet<usize>,
    middle: Vec3,
    height: f32,
    style: BandStyle,
) -> BTreeSet<usize> {
    let mut done = BTreeSet::new();
    scene.for_each_hair(|part, matrix| {
        if !materials.contains(&part.material) {
            return;
        }
        let places: Vec<Place> = (0..part.positions.len()).map(|v| place(part, v, matrix, middle)).collect();
        let (locks, count) = part.pieces();
        let mut members = vec![Vec::new(); count];
        for (vertex, lock) in locks.iter().enumerate() {
            members[*lock].push(vertex);
        }
        let cells: Vec<Cell> =
            members.iter().enumerate().map(|(n, m)| cell(part, &places, m, n, height, style)).collect();
        let set = places.iter().zip(&locks).map(|(at, lock)| cells[*lock].uv(*at)).collect();
        if part.uvs.is_empty() {
            part.uvs.push(vec![[0.0; 2]; places.len()]);
        }
        part.uvs.push(set);
        done.insert(part.material);
    });
    done
}

fn place(part: &Primitive, vertex: usize, matrix: Mat4, middle: Vec3) -> Place {
    let out = matrix.transform_point3(Vec3::from(part.positions[vertex])) - middle;
    let normal = part.normals.get(vertex).map_or(Vec3::Z, |n| matrix.transform_vector3(Vec3::from(*n)));
    let direction = out.normalize_or(Vec3::Y);
    Place {
        around: direction.x.atan2(direction.z),
        from_above: direction.y.clamp(-1.0, 1.0).acos(),
        distance: out.length(),
        is_top: normal.normalize_or(Vec3::Z).y > 0.72,
    }
}

/// Where on the marks' picture a lock lies.
#[derive(Clone, Copy)]
enum Cell {
    /// Nowhere.
    Blank,
    /// On a mark of its own, across it from one angle round the head to another, lower than others by an angle.
    Mark { first: f32, middle: f32, low: f32, high: f32, lower: f32 },
    /// On the ring, for what covers more of the head than a lock, lower by an angle.
    Ring { lower: f32 },
}

impl Cell {
    fn uv(self, at: Place) -> [f32; 2] {
        let v = |lower: f32| 0.5 + (at.from_above - lower - MIDDLE) / REACH;
        match self {
            Self::Blank => [0.5, 1.0],
            // Alike on both sides, so that no seam runs down the back.
            Self::Ring { lower } => [at.around.abs() / PI * RING_CELLS as f32 / CELLS as f32, v(lower)],
            Self::Mark { first, middle, low, high, lower } => {
                let across = (turn(at.around - middle) - low) / (high - low);
                [(first + across.clamp(-0.1, 1.1) * 0.8 + 0.1) / CELLS as f32, v(lower)]
            }
        }
    }
}

/// An angle within half a turn of 0.
fn turn(angle: f32) -> f32 {
    (angle + PI).rem_euclid(2.0 * PI) - PI
}

/// The cell of one lock.
fn cell(part: &Primitive, places: &[Place], lock: &[usize], number: usize, height: f32, style: BandStyle) -> Cell {
    // The band lies above its middle, as seen from the front.
    let crosses = |v: &&usize| (MIDDLE - 0.75..MIDDLE + 0.45).contains(&places[**v].from_above);
    let near: Vec<usize> = lock.iter().filter(crosses).copied().collect();
    let (low, high) = lock.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), v| {
        let p = Vec3::from(part.positions[*v]);
        (low.min(p), high.max(p))
    });
    if near.is_empty() || (high - low).max_element() < LEAST_LOCK * height {
        return Cell::Blank;
    }
    // What hangs far from the skull is a tail.
    let distance = near.iter().map(|v| places[*v].distance).sum::<f32>() / near.len() as f32;
    if distance > 1.1 * height {
        return Cell::Blank;
    }
    let direction = near.iter().fold(Vec3::ZERO, |sum, v| {
        let (sin, cos) = places[*v].around.sin_cos();
        sum + Vec3::new(sin, 0.0, cos)
    });
    let middle = direction.x.atan2(direction.z);
    let mut across: Vec<f32> = near.iter().map(|v| turn(places[*v].around - middle)).collect();
    across.sort_by(f32::total_cmp);
    let at = |share: f32| across[((across.len() - 1) as f32 * share) as usize];
    let (low, high) = (at(0.04), at(0.96));
    // Where a lock bends over the forehead, the band lies below the bend: on its top nobody would see it.
    let bend = near.iter().filter(|v| places[**v].is_top).map(|v| places[*v].from_above).fold(0.0, f32::max);
    let lower = (bend + BELOW_BEND - (MIDDLE - (LIGHT_V + VIEW_V) * REACH)).clamp(0.0, REACH);
    if high - low > WIDEST || style == BandStyle::Ring {
        return Cell::Ring { lower };
    }
    let left = smoothstep(FADES[1], FADES[0], middle.abs());
    let level = (left * LEVELS as f32).round() as usize;
    // Narrow ones have fewer points.
    let wide = usize::from(high - low > 0.28);
    if level == 0 || high - low < 0.02 {
        return Cell::Blank;
    }
    let variant = wide * VARIANTS / 2 + number % (VARIANTS / 2);
    let first = (RING_CELLS + (level - 1) * VARIANTS + variant) as f32;
    Cell::Mark { first, middle, low, high, lower }
}
