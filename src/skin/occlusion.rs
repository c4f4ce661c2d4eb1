//! How far other surfaces hide the world from each vertex of a surface.

use std::f32::consts::PI;

use glam::Vec3;
use rayon::prelude::*;

use super::shape::Shape;
use super::tree::Tree;

/// Rays that are cast from each place.
const RAYS: usize = 16;

/// How far occlusion is spread over the surface, m: the standard deviation along each axis. It hides where single rays
/// begin to meet something.
const SPREAD_M: f64 = 2e-3;

/// Share of light from all around that does not arrive at each vertex of a shape, 0 to 1: what is hidden of the
/// hemisphere over the surface, weighted by the cosine. What is a distance d away hides 1 - (d / reach)² of what lies
/// behind it, as farther surfaces send light of their own. `others` hide it too.
///
/// Nothing is hidden from a convex body, from vertices without a normal, and where the reach is not positive and finite.
/// Within a hollow sphere of radius r it is 1 - 2 (r / reach)², where that is less than half of the reach.
pub(super) fn occlusions(shape: &Shape, others: &Tree, reach_m: f32) -> Vec<f32> {
    let sound = reach_m > 0.0 && reach_m.is_finite();
    if !sound {
        return vec![0.0; shape.surface.places().len()];
    }
    let fan = fan();
    let feet = shape.feet.par_iter().zip(shape.surface.normals());
    let mut hidden: Vec<f64> = feet
        .map(|((at, shaded), normal)| {
            // Normals of a drawn face are often bent, and would look into it.
            let out = normal.as_vec3().try_normalize().or_else(|| shaded.try_normalize());
            out.map_or(0.0, |out| f64::from(hidden(&[&shape.tree, others], &fan, *at, out, reach_m)))
        })
        .collect();
    shape.surface.spread(&mut hidden, SPREAD_M);
    shape.surface.to_vertices(&hidden)
}

/// Directions of the rays round +Z, as dense as the cosine: a sunflower's spiral over the disc below them.
fn fan() -> [Vec3; RAYS] {
    let golden = PI * (3.0 - 5.0_f32.sqrt());
    std::array::from_fn(|ray| {
        let square = (ray as f32 + 0.5) / RAYS as f32;
        let (sin, cos) = (golden * ray as f32).sin_cos();
        let radius = square.sqrt();
        Vec3::new(radius * cos, radius * sin, (1.0 - square).sqrt())
    })
}

/// Share that is hidden from a place, 0 to 1.
fn hidden(trees: &[&Tree], fan: &[Vec3; RAYS], at: Vec3, out: Vec3, reach: f32) -> f32 {
    if !at.is_finite() {
        return 0.0;
    }
    let (x, y) = out.any_orthonormal_pair();
    // Rays start outside, by more than positions are rounded.
    let start = at + out * (1e-3 * reach).max(4.0 * f32::EPSILON * at.abs().max_element());
    let hides = |ray: &Vec3| {
        let direction = x * ray.x + y * ray.y + out * ray.z;
        let way = trees.iter().fold(reach, |way, tree| tree.first_hit(start, direction, way).unwrap_or(way)) / reach;
        1.0 - way * way
    };
    fan.iter().map(hides).sum::<f32>() / RAYS as f32
}

#[cfg(test)]
mod tests {
    use super::super::curvature::shapes::{ball, globe, grid, together, vertices};
    use super::super::shape::Body;
    use super::*;
    use crate::scene::Primitive;

    const REACH: f32 = 0.1;

    fn nothing() -> Tree {
        Tree::new(&[], &[])
    }

    fn tree(mesh: &Primitive) -> Tree {
        Tree::new(&mesh.positions, mesh.indices.as_chunks().0)
    }

    fn measure(mesh: &Primitive, others: &Tree) -> Vec<f32> {
        let (positions, normals) = vertices(mesh);
        let body = Body { positions: &positions, normals: &normals, indices: &mesh.indices };
        occlusions(&Shape::new(&[body]), others, REACH)
    }

    /// A square of 1 m at a height, seen from above where `turned` is 1 and from below where it is -1.
    fn plate(height: f32, turned: f32) -> Primitive {
        grid(20, 20, |u, v| Vec3::new(turned * (u - 0.5), v - 0.5, height))
    }

    #[test]
    fn nothing_is_hidden_from_a_convex_body() {
        for radius in [0.002, 0.02, 0.2] {
            for mesh in [globe(radius, 48), ball(radius, 4)] {
                assert!(measure(&mesh, &nothing()).into_iter().all(|hidden| hidden == 0.0), "{radius}");
            }
        }
    }

    #[test]
    fn a_hollow_sphere_hides_all_but_what_is_far() {
        for radius in [0.005f32, 0.01, 0.04] {
            let mut mesh = globe(radius, 48);
            mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|corners| corners.swap(1, 2));
            let known = 1.0 - 2.0 * (radius / REACH).powi(2);
            for hidden in measure(&mesh, &nothing()) {
                assert!((hidden - known).abs() < 0.02, "{hidden} for {known}");
            }
        }
    }

    #[test]
    fn a_plate_hides_another_by_their_distance() {
        for height in [0.01f32, 0.03, 0.05, 0.08, 0.11] {
            let [below, above] = [plate(0.0, 1.0), plate(height, -1.0)];
            // Of cosines over q = height / reach, with u = cosine²: the integral of 1 - q² / u from q² to 1.
            let square = (height / REACH).powi(2).min(1.0);
            let known = 1.0 - square + square * square.ln();
            // As one body, and as one body and another thing.
            let both = measure(&together(&[below.clone(), above.clone()]), &nothing());
            let apart = measure(&below, &tree(&above));
            for (vertex, position) in below.positions.iter().enumerate() {
                if position[..2].iter().all(|v| v.abs() < 0.35) {
                    let hidden = both[vertex];
                    assert!((hidden - known).abs() < 0.03, "{hidden} for {known} at {height}");
                    assert!((hidden - apart[vertex]).abs() < 1e-6, "{hidden} {}", apart[vertex]);
                }
            }
        }
    }

    #[test]
    fn what_is_no_body_is_no_trouble() {
        assert!(occlusions(&Shape::new(&[]), &nothing(), REACH).is_empty());
        let mesh = ball(0.01, 2);
        let (mut positions, normals) = vertices(&mesh);
        positions[0] = Vec3::NAN;
        positions[1] = Vec3::splat(f32::MAX);
        let body = Body { positions: &positions, normals: &normals[..7], indices: &mesh.indices };
        let shape = Shape::new(&[body]);
        for reach in [REACH, 0.0, -1.0, f32::NAN, f32::INFINITY] {
            let values = occlusions(&shape, &tree(&mesh), reach);
            assert_eq!(values.len(), positions.len());
            assert!(values.iter().all(|hidden| (0.0..=1.0).contains(hidden)));
        }
    }

    #[test]
    fn each_run_gives_the_same_bits() {
        let mesh = together(&[plate(0.0, 1.0), ball(0.05, 3)]);
        let bits = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| measure(&mesh, &nothing()).into_iter().map(f32::to_bits).collect::<Vec<_>>())
        };
        let first = bits(1);
        assert!(first == bits(1) && first == bits(3));
    }
}
