//! Threshold maps from a face's own mesh: a clean border on any character, without painting.

use std::collections::BTreeSet;
use std::f32::consts::PI;

use glam::{Mat4, Vec2, Vec3};
use rayon::prelude::*;
use tiny_skia::{Paint, PathBuilder, Pixmap, Stroke, Transform};

use super::{FaceMap, Texels};
use crate::scene::{HumanBone, Image, Primitive, Role, Scene};

/// Side of a map, texels.
const SIDE: usize = 512;
/// Share of the mesh's own normals; the rest is the proxy's.
const OWN: f32 = 0.25;
/// Texels that the map is grown beyond the triangles: over the holes of eyes and mouth, and so far that the end bends no
/// distance on the face.
const GROWN: usize = 40;
/// Texels that the triangles' boxes may cover in all, in maps: those of an unwrapped face cover it about twice, and a
/// hostile file must not keep us busy.
const MOST: usize = 64;

/// One texel: threshold for light from the right and from the left, share of normal shading, and whether it is covered.
#[derive(Clone, Copy)]
struct Texel {
    value: Vec3,
    covered: bool,
}

/// A vertex of the face.
struct Corner {
    uv: Vec2,
    value: Vec3,
}

/// The map of the parts of a material that are a face, in the layout of [`FaceShadow`](crate::material::FaceShadow):
/// light is measured against normals smoothed towards an ellipsoid round the head. What does not follow the head bone, or
/// looks backwards, is left to normal shading. `None` where the material has no face with texture coordinates, or where
/// both sides of the face share them: one texel cannot hold the angles of two.
#[must_use]
pub fn face_map(scene: &Scene, material: usize) -> Option<FaceMap> {
    let head = scene.bone_node(HumanBone::Head)?;
    let world = scene.rest_world_from_nodes();
    let below = scene.descendants(head);
    let faces: Vec<(usize, &Primitive)> = scene
        .mesh_nodes()
        .flat_map(|(node, mesh)| mesh.primitives.iter().map(move |p| (node, p)))
        .filter(|(_, p)| p.material == material && p.role == Role::Face && !p.uvs.first().is_none_or(Vec::is_empty))
        .collect();
    let placed: Vec<(Mat4, Vec<f32>)> =
        faces.iter().map(|(node, p)| (scene.rest_placement(&world, *node), scene.shares(*node, p, &below))).collect();

    // The proxy: an ellipsoid round what follows the head.
    let (low, high) = scene.face_box(Some(material))?;
    let (middle, half) = ((low + high) * 0.5, (high - low) * 0.5);
    let (mut shared, mut covered) = (0usize, 0usize);
    let mut texels = vec![Texel { value: Vec3::Z, covered: false }; SIDE * SIDE];
    for ((_, primitive), (matrix, shares)) in faces.iter().zip(&placed) {
        let corners: Vec<Corner> =
            (0..primitive.positions.len()).map(|v| corner(primitive, v, matrix, shares[v], middle, half)).collect();
        for t in primitive.indices.chunks_exact(3) {
            let corner = |i: usize| corners.get(t[i] as usize);
            if let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) {
                covered += boxed(&[a, b, c]);
                if covered > MOST * SIDE * SIDE {
                    return None;
                }
                shared += fill(&mut texels, [a, b, c]);
            }
        }
    }
    if shared * 20 > texels.iter().filter(|t| t.covered).count() {
        return None;
    }
    grow(&mut texels);
    let code = |x: f32| (x.clamp(0.0, 1.0) * 65535.0).round() as u16;
    let rgba = texels.par_iter().map(|t| [code(t.value.x), code(t.value.y), code(t.value.z), u16::MAX]).collect();
    let side = SIDE as u32;
    Some(FaceMap::single("from the mesh", Texels { width: side, height: side, rgba, is_8_bit: true }))
}

fn corner(primitive: &Primitive, v: usize, matrix: &Mat4, share: f32, middle: Vec3, half: Vec3) -> Corner {
    let position = matrix.transform_point3(Vec3::from(primitive.positions[v]));
    let own = primitive.normals.get(v).map_or(Vec3::Z, |n| matrix.transform_vector3(Vec3::from(*n)));
    let proxy = ((position - middle) / (half * half)).normalize_or(Vec3::Z);
    let normal = proxy.lerp(own.normalize_or(proxy), OWN);
    // Light from the left reaches this far: 90 degrees beyond the normal's own direction.
    let angle = normal.x.atan2(normal.z);
    let from = |side: f32| ((0.5 * PI + side * angle) / PI).clamp(0.0, 1.0);
    let smooth = |from: f32, to: f32, x: f32| {
        let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let behind = smooth(1.35, 1.75, angle.abs());
    let below = smooth(0.98, 0.75, share);
    let uv = primitive.uvs[0].get(v).copied().unwrap_or_default();
    Corner { uv: Vec2::from(uv), value: Vec3::new(from(-1.0), from(1.0), behind.max(below)) }
}

/// First and last column and row of a triangle's box.
fn bounds(corners: &[&Corner; 3]) -> [usize; 4] {
    let [p, q, r] = corners.map(|corner| corner.uv * SIDE as f32 - 0.5);
    let bound = |x: f32| x.clamp(0.0, SIDE as f32 - 1.0) as usize;
    let (low, high) = (p.min(q).min(r).ceil(), p.max(q).max(r).floor());
    [bound(low.x), bound(high.x), bound(low.y), bound(high.y)]
}

/// Texels in that box.
fn boxed(corners: &[&Corner; 3]) -> usize {
    let [left, right, top, bottom] = bounds(corners);
    (right + 1).saturating_sub(left) * (bottom + 1).saturating_sub(top)
}

/// Writes a triangle, with its values between those of its corners; gives the number of texels that held quite another
/// angle before.
fn fill(texels: &mut [Texel], [a, b, c]: [&Corner; 3]) -> usize {
    let [p, q, r] = [a, b, c].map(|corner| corner.uv * SIDE as f32 - 0.5);
    let area = (q - p).perp_dot(r - p);
    if area.abs() < 1e-9 || !area.is_finite() {
        return 0;
    }
    let mut shared = 0;
    let [left, right, top, bottom] = bounds(&[a, b, c]);
    for y in top..=bottom {
        for x in left..=right {
            let at = Vec2::new(x as f32, y as f32);
            let (u, v, w) =
                ((r - q).perp_dot(at - q) / area, (p - r).perp_dot(at - r) / area, (q - p).perp_dot(at - p) / area);
            if u.min(v).min(w) >= -1e-4 {
                let texel = &mut texels[y * SIDE + x];
                let value = a.value * u + b.value * v + c.value * w;
                shared += usize::from(texel.covered && (texel.value.x - value.x).abs() > 0.25 && value.z < 0.5);
                *texel = Texel { value, covered: true };
            }
        }
    }
    shared
}

/// Covers what lies round the triangles, ring by ring, with the mean of what is covered beside it.
fn grow(texels: &mut [Texel]) {
    let beside = |i: usize| {
        let (x, y) = (i % SIDE, i / SIDE);
        let rows = y.saturating_sub(1)..(y + 2).min(SIDE);
        rows.flat_map(move |y| (x.saturating_sub(1)..(x + 2).min(SIDE)).map(move |x| y * SIDE + x))
    };
    let mut ring: Vec<usize> =
        (0..texels.len()).filter(|i| !texels[*i].covered && beside(*i).any(|n| texels[n].covered)).collect();
    let mut is_queued = vec![false; texels.len()];
    for _ in 0..GROWN {
        let mean = |i: &usize| {
            let (sum, count) = beside(*i)
                .filter(|n| texels[*n].covered)
                .fold((Vec3::ZERO, 0.0), |(sum, count), n| (sum + texels[n].value, count + 1.0));
            Texel { value: sum / f32::max(count, 1.0), covered: true }
        };
        let means: Vec<Texel> = ring.iter().map(mean).collect();
        ring.iter().zip(means).for_each(|(i, mean)| texels[*i] = mean);
        let mut next = Vec::new();
        for n in ring.iter().flat_map(|i| beside(*i)) {
            if !texels[n].covered && !std::mem::replace(&mut is_queued[n], true) {
                next.push(n);
            }
        }
        ring = next;
    }
}

/// The edges of a material's face in its texture coordinates, as thin lines over nothing: an overlay for whoever paints
/// masks. `None` where the material has no face with texture coordinates. Sides at most 8192 texels.
#[must_use]
pub fn wireframe(scene: &Scene, material: usize, size: [u32; 2]) -> Option<Image> {
    let [width, height] = size.map(|side| side.clamp(1, 8192));
    let mut edges = BTreeSet::new();
    let parts =
        scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.material == material && p.role == Role::Face);
    for part in parts {
        let point = |i: u32| {
            let uv = part.uvs[0].get(i as usize)?;
            let near = uv.iter().all(|c| (-4.0..=4.0).contains(c));
            near.then(|| [(uv[0] * width as f32 * 8.0) as i32, (uv[1] * height as f32 * 8.0) as i32])
        };
        for t in part.indices.chunks_exact(3) {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                if let (Some(a), Some(b)) = (point(a), point(b)) {
                    edges.insert(if a < b { (a, b) } else { (b, a) });
                }
            }
        }
    }
    let mut path = PathBuilder::new();
    for ([ax, ay], [bx, by]) in edges {
        path.move_to(ax as f32 / 8.0, ay as f32 / 8.0);
        path.line_to(bx as f32 / 8.0, by as f32 / 8.0);
    }
    let (path, mut pixmap) = (path.finish()?, Pixmap::new(width, height)?);
    let mut paint = Paint::default();
    paint.set_color_rgba8(40, 110, 200, 200);
    paint.anti_alias = true;
    pixmap.stroke_path(&path, &paint, &Stroke { width: 1.0, ..Stroke::default() }, Transform::identity(), None);
    let pixels = pixmap.pixels().iter().flat_map(|p| {
        let p = p.demultiply();
        [p.red(), p.green(), p.blue(), p.alpha()]
    });
    Some(Image { width, height, pixels: pixels.collect(), format: "png", source_bits: 8, ..Image::default() })
}
