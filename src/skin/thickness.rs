//! Thickness of a body behind each vertex of its surface.

use std::f32::consts::PI;

use glam::Vec3;
use rayon::prelude::*;

use super::shape::Shape;
use super::tree::Tree;

/// Rays that are cast below each place.
const RAYS: usize = 24;

/// Cosine of the angle between the axis and the rim of the cone of rays: 30°.
const RIM: f32 = 0.866_025_4;

/// How far thickness is spread over the surface, m: the standard deviation along each axis.
const SPREAD_M: f64 = 1e-3;

/// Thickness of all bodies together below each vertex of each, m, from 0 to `most_m`.
///
/// A fan of rays goes down within 30° of the normal to the first surface of any body. Each depth is measured along the
/// normal, so that a plate has its own thickness. The result is the harmonic mean of the middle half of the depths:
/// single rays that run along a body or into a fold do not count, and where ways differ the thin ones do, as light
/// prefers them. A sphere of diameter d has about 0.87 d. Rays that leave through a hole, and vertices without a
/// normal, have `most_m`; where that is not positive and finite all have 0.
pub(super) fn thicknesses(shape: &Shape, most_m: f32) -> Vec<f32> {
    let sound = most_m > 0.0 && most_m.is_finite();
    if !sound {
        return vec![0.0; shape.surface.places().len()];
    }
    let fan = fan();
    let depth = |(at, normal): &(Vec3, Vec3)| f64::from(depth(&shape.tree, &fan, *at, *normal, most_m));
    let mut depths: Vec<f64> = shape.feet.par_iter().map(depth).collect();
    shape.surface.spread(&mut depths, SPREAD_M);
    shape.surface.to_vertices(&depths)
}

/// Directions of the rays round +Z: a sunflower's spiral, even in solid angle.
fn fan() -> [Vec3; RAYS] {
    let golden = PI * (3.0 - 5.0_f32.sqrt());
    std::array::from_fn(|ray| {
        let z = 1.0 - (1.0 - RIM) * (ray as f32 + 0.5) / RAYS as f32;
        let (sin, cos) = (golden * ray as f32).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Vec3::new(radius * cos, radius * sin, z)
    })
}

/// Thickness below a place, m.
fn depth(tree: &Tree, fan: &[Vec3; RAYS], at: Vec3, normal: Vec3, most: f32) -> f32 {
    let Some(down) = (-normal).try_normalize() else { return most };
    if !at.is_finite() {
        return most;
    }
    let (x, y) = down.any_orthonormal_pair();
    // Rays start inside, by more than positions are rounded: from a sharp edge they would else miss the body.
    let start = (1e-3 * most).max(4.0 * f32::EPSILON * at.abs().max_element());
    let mut depths = fan.map(|ray| {
        let direction = x * ray.x + y * ray.y + down * ray.z;
        let length = tree.first_hit(at + down * start, direction, (most - start) / ray.z);
        length.map_or(most, |length| (start + length * ray.z).min(most))
    });
    depths.sort_unstable_by(f32::total_cmp);
    let middle = &depths[RAYS / 4..RAYS - RAYS / 4];
    (middle.len() as f64 / middle.iter().map(|depth| f64::from(*depth).recip()).sum::<f64>()) as f32
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::super::curvature::shapes::{ball, globe, grid, together, vertices};
    use super::super::shape::Body;
    use super::*;
    use crate::scene::Primitive;

    const MOST: f32 = 0.05;

    fn thicknesses(bodies: &[Body<'_>], most: f32) -> Vec<f32> {
        super::thicknesses(&Shape::new(bodies), most)
    }

    fn measure(mesh: &Primitive) -> Vec<f32> {
        let (positions, normals) = vertices(mesh);
        let body = Body { positions: &positions, normals: &normals, indices: &mesh.indices };
        thicknesses(&[body], MOST)
    }

    /// A square of 40 mm, seen from above; at its left edge as thick as `left`, at its right edge as thick as `right`.
    fn slab(left: f32, right: f32) -> Primitive {
        const SIDE: f32 = 0.04;
        let bottom = move |u: f32| -(left + (right - left) * u);
        let at = |u: f32, v: f32, z: f32| Vec3::new(SIDE * u, SIDE * v, z);
        together(&[
            grid(40, 40, |u, v| at(u, v, 0.0)),
            grid(40, 40, |u, v| at(1.0 - u, v, bottom(1.0 - u))),
            grid(40, 4, |u, v| at(u, 0.0, (1.0 - v) * bottom(u))),
            grid(40, 4, |u, v| at(u, 1.0, v * bottom(u))),
            grid(4, 40, |u, v| at(0.0, v, (1.0 - u) * bottom(0.0))),
            grid(4, 40, |u, v| at(1.0, v, u * bottom(1.0))),
        ])
    }

    /// The vertices that are no nearer than 8 mm to the rim of a slab: its thickness there, and the place across it.
    fn inner(mesh: &Primitive) -> Vec<(f32, f32)> {
        let inside = |v: f32| (0.008..0.032).contains(&v);
        let all = mesh.positions.iter().zip(measure(mesh));
        let inner: Vec<_> = all.filter(|(p, _)| inside(p[0]) && inside(p[1])).map(|(p, t)| (p[0], t)).collect();
        assert!(inner.len() > 1000);
        inner
    }

    #[test]
    fn a_plate_has_its_thickness() {
        let mesh = slab(0.003, 0.003);
        for (_, thickness) in inner(&mesh) {
            assert!((thickness / 0.003 - 1.0).abs() < 0.02, "{thickness}");
        }
        // Its rim too is made of it.
        assert!(measure(&mesh).into_iter().all(|t| (0.0..=0.04).contains(&t)));
        // However it lies.
        let turn = Quat::from_rotation_x(0.7) * Quat::from_rotation_y(2.0);
        let lift = Vec3::new(0.1, 1.6, 0.2);
        let place = |p: &[f32; 3]| (lift + turn * Vec3::from_array(*p)).to_array();
        let turned = Primitive { positions: mesh.positions.iter().map(place).collect(), ..mesh.clone() };
        for (position, thickness) in mesh.positions.iter().zip(measure(&turned)) {
            if position[..2].iter().all(|v| (0.008..0.032).contains(v)) {
                assert!((thickness / 0.003 - 1.0).abs() < 0.02, "{thickness}");
            }
        }
    }

    #[test]
    fn a_wedge_grows_thicker() {
        for (x, thickness) in inner(&slab(0.0002, 0.012)) {
            let known = 0.0002 + 0.0118 * x / 0.04;
            assert!((thickness / known - 1.0).abs() < 0.15, "{thickness} for {known}");
        }
    }

    #[test]
    fn a_sharp_edge_is_thin() {
        // 17°: most rays would start outside of it.
        let mesh = slab(0.0, 0.012);
        for (position, thickness) in mesh.positions.iter().zip(measure(&mesh)) {
            if position[0] == 0.0 && (0.008..0.032).contains(&position[1]) {
                assert!(thickness < 0.001, "{thickness}");
            }
        }
    }

    #[test]
    fn a_sphere_has_most_of_its_diameter() {
        for radius in [0.005, 0.010, 0.020] {
            for mesh in [globe(radius, 64), ball(radius, 4)] {
                for thickness in measure(&mesh) {
                    let share = thickness / (2.0 * radius);
                    assert!((0.83..0.91).contains(&share), "{share}");
                }
            }
        }
    }

    #[test]
    fn what_leaves_a_body_has_the_greatest_thickness() {
        let sheet = grid(20, 20, |u, v| Vec3::new(0.04 * u, 0.04 * v, 0.0));
        assert!(measure(&sheet).into_iter().all(|t| t == MOST));
        // A bowl, of a sphere that is too large to be seen through.
        let mut bowl = globe(0.04, 64);
        bowl.indices.truncate(bowl.indices.len() / 2);
        for (position, thickness) in bowl.positions.iter().zip(measure(&bowl)) {
            assert!((0.0..=MOST).contains(&thickness));
            if position[1] < -0.035 {
                assert_eq!(thickness, MOST);
            }
        }
    }

    #[test]
    fn a_hole_counts_for_its_rays_only() {
        // A quarter of the plate's underside is gone; the top sees it where it lies below.
        let mut mesh = slab(0.003, 0.003);
        let hidden = |corners: &[u32; 3]| {
            corners.iter().any(|c| {
                let [x, y, z] = mesh.positions[*c as usize];
                z == -0.003 && x < 0.02 && y < 0.02
            })
        };
        let kept = mesh.indices.as_chunks::<3>().0.iter().filter(|corners| !hidden(corners)).flatten().copied();
        mesh.indices = kept.collect();
        for (position, thickness) in mesh.positions.iter().zip(measure(&mesh)) {
            let [x, y, z] = *position;
            if z == 0.0 && (0.025..0.032).contains(&x) && (0.025..0.032).contains(&y) {
                assert!((thickness / 0.003 - 1.0).abs() < 0.02, "{thickness} at {position:?}");
            }
            if z == 0.0 && (0.008..0.012).contains(&x) && (0.008..0.012).contains(&y) {
                assert!(thickness > 0.9 * MOST, "{thickness} at {position:?}");
            }
        }
    }

    #[test]
    fn bodies_end_each_others_rays() {
        let mesh = slab(0.003, 0.003);
        let (positions, normals) = vertices(&mesh);
        let whole = measure(&mesh);
        // The first part of the vertices is the upper side, with all its triangles.
        let [upper, faces] = [41 * 41, 40 * 40 * 6];
        let lower: Vec<u32> = mesh.indices[faces..].iter().map(|index| index - upper as u32).collect();
        let parts = [
            Body { positions: &positions[..upper], normals: &normals[..upper], indices: &mesh.indices[..faces] },
            Body { positions: &positions[upper..], normals: &normals[upper..], indices: &lower },
        ];
        assert_eq!(thicknesses(&parts, MOST), whole);
    }

    #[test]
    fn what_is_no_body_is_no_trouble() {
        assert!(thicknesses(&[], MOST).is_empty());
        let empty = Body { positions: &[], normals: &[], indices: &[0, 1, 2] };
        assert!(thicknesses(&[empty], MOST).is_empty());
        let mesh = ball(0.01, 2);
        let (mut positions, normals) = vertices(&mesh);
        positions[0] = Vec3::NAN;
        positions[1] = Vec3::splat(f32::MAX);
        let indices = [mesh.indices.as_slice(), &[0, 0, 0, 3, 3, 4, 9999, 1, 2, 3, 4]].concat();
        for count in [0, 7, normals.len()] {
            let body = Body { positions: &positions, normals: &normals[..count], indices: &indices };
            let values = thicknesses(&[body], MOST);
            assert_eq!(values.len(), positions.len());
            assert!(values.iter().all(|t| (0.0..=MOST).contains(t)));
        }
        for most in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            let body = Body { positions: &positions, normals: &normals, indices: &indices };
            assert!(thicknesses(&[body], most).into_iter().all(|t| t == 0.0));
        }
    }

    #[test]
    fn each_run_gives_the_same_bits() {
        let mesh = slab(0.001, 0.012);
        let bits = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| measure(&mesh).into_iter().map(f32::to_bits).collect::<Vec<_>>())
        };
        let first = bits(1);
        assert!(first == bits(1) && first == bits(3));
    }
}
