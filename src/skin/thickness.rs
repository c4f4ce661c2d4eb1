//! Thickness of a body behind each vertex of its surface.

use std::f32::consts::PI;

use glam::Vec3;
use rayon::prelude::*;

use super::curvature::Surface;

/// Rays that are cast below each place.
const RAYS: usize = 24;

/// Cosine of the angle between the axis and the rim of the cone of rays: 30°.
const RIM: f32 = 0.866_025_4;

/// How far thickness is spread over the surface, m: the standard deviation along each axis.
const SPREAD_M: f64 = 1e-3;

/// Most triangles in a leaf of the tree.
const LEAF: usize = 4;

/// A mesh of a character at rest, in a space that all its meshes share.
pub(crate) struct Body<'a> {
    /// Positions of the vertices, m.
    pub(crate) positions: &'a [Vec3],
    /// Normals of the vertices, out of the body, of any length; as many as positions.
    pub(crate) normals: &'a [Vec3],
    /// Triangle list.
    pub(crate) indices: &'a [u32],
}

/// Thickness of all bodies together below each vertex of each, m, from 0 to `most_m`.
///
/// A fan of rays goes down within 30° of the normal to the first surface of any body. Each depth is measured along the
/// normal, so that a plate has its own thickness. The result is the harmonic mean of the middle half of the depths:
/// single rays that run along a body or into a fold do not count, and where ways differ the thin ones do, as light
/// prefers them. A sphere of diameter d has about 0.87 d. Rays that leave through a hole, and vertices without a
/// normal, have `most_m`; where that is not positive and finite all have 0.
pub(crate) fn thicknesses(bodies: &[Body<'_>], most_m: f32) -> Vec<Vec<f32>> {
    let sound = most_m > 0.0 && most_m.is_finite();
    if !sound {
        return bodies.iter().map(|body| vec![0.0; body.positions.len()]).collect();
    }
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for body in bodies {
        let first = positions.len() as u32;
        let within = |corners: &&[u32; 3]| corners.iter().all(|c| (*c as usize) < body.positions.len());
        let corners = body.indices.as_chunks::<3>().0.iter().filter(within);
        triangles.extend(corners.map(|corners| corners.map(|c| first + c)));
        positions.extend(body.positions.iter().map(Vec3::to_array));
    }
    let surface = Surface::new(&positions, &triangles);
    // Vertices at the same position share one fan: seams stay closed.
    let mut feet = vec![(Vec3::ZERO, Vec3::ZERO); surface.len()];
    let normals =
        bodies.iter().flat_map(|b| (0..b.positions.len()).map(|v| b.normals.get(v).copied().unwrap_or_default()));
    for ((place, position), normal) in surface.places().iter().zip(&positions).zip(normals) {
        let (at, sum) = &mut feet[*place as usize];
        *at = Vec3::from_array(*position);
        *sum += normal.normalize_or_zero();
    }
    let tree = Tree::new(&positions, &triangles);
    let fan = fan();
    let mut depths: Vec<f64> =
        feet.par_iter().map(|(at, normal)| f64::from(depth(&tree, &fan, *at, *normal, most_m))).collect();
    surface.spread(&mut depths, SPREAD_M);
    let depths = surface.to_vertices(&depths);
    let mut rest = depths.as_slice();
    let mut take = |body: &Body<'_>| {
        let (own, others) = rest.split_at(body.positions.len());
        rest = others;
        own.to_vec()
    };
    bodies.iter().map(&mut take).collect()
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

/// Triangles in a tree of boxes, each node cut at the median of its centres.
struct Tree {
    /// A node's first child stands right behind it.
    nodes: Vec<TreeNode>,
    triangles: Vec<Triangle>,
}

struct TreeNode {
    low: Vec3,
    high: Vec3,
    /// Of a leaf the first triangle, else the second child.
    first: u32,
    /// Triangles of a leaf, else 0.
    count: u32,
}

/// A corner and the edges from it to the others.
#[derive(Clone, Copy)]
struct Triangle {
    corner: Vec3,
    edges: [Vec3; 2],
}

impl Triangle {
    fn bounds(&self) -> (Vec3, Vec3) {
        let [b, c] = self.edges.map(|edge| self.corner + edge);
        (self.corner.min(b).min(c), self.corner.max(b).max(c))
    }

    /// Twice the centre of the box.
    fn centre(&self) -> Vec3 {
        let (low, high) = self.bounds();
        low + high
    }

    /// Where along a ray, in lengths of `direction`, the triangle lies (Möller and Trumbore 1997).
    fn meets(&self, at: Vec3, direction: Vec3) -> Option<f32> {
        // Neighbours overlap by this, so that no ray slips between them.
        const SLACK: f32 = 1e-5;
        let [b, c] = self.edges;
        let across = direction.cross(c);
        let volume = b.dot(across);
        let offset = at - self.corner;
        let turned = offset.cross(b);
        let (u, v) = (offset.dot(across) / volume, direction.dot(turned) / volume);
        // A ray in the plane of the triangle gives infinity or NaN, which fail.
        (u >= -SLACK && v >= -SLACK && u + v <= 1.0 + SLACK).then(|| c.dot(turned) / volume)
    }
}

impl Tree {
    /// Triangles without area or not finite are left out.
    fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        let triangle = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|c| positions.get(c as usize).copied().map(Vec3::from_array));
            let (a, b, c) = (a?, b?, c?);
            let area = (b - a).as_dvec3().cross((c - a).as_dvec3()).length_squared();
            (area > 0.0 && area.is_finite()).then_some(Triangle { corner: a, edges: [b - a, c - a] })
        };
        let mut triangles: Vec<Triangle> = triangles.iter().filter_map(triangle).collect();
        let mut nodes = Vec::with_capacity(triangles.len());
        if !triangles.is_empty() {
            grow(&mut nodes, &mut triangles, 0);
        }
        Self { nodes, triangles }
    }

    /// Length of the ray to the first triangle that is nearer than `most`.
    fn first_hit(&self, at: Vec3, direction: Vec3, most: f32) -> Option<f32> {
        // No component is 0, so that none of the box test's numbers is NaN.
        let inverse = direction.to_array().map(|v| 1.0 / if v.abs() < 1e-12 { 1e-12 } else { v });
        let inverse = Vec3::from_array(inverse);
        let mut nearest = most;
        let mut found = None;
        // Halving 2^32 triangles takes fewer levels than this.
        let mut stack = [(0, 0.0); 40];
        let mut height = 0;
        let mut next = self.nodes.first().and_then(|root| root.enters(at, inverse, nearest)).map(|_| 0);
        loop {
            let Some(index) = next.take() else {
                if height == 0 {
                    return found;
                }
                height -= 1;
                let (index, enters) = stack[height];
                next = (enters < nearest).then_some(index);
                continue;
            };
            let node = &self.nodes[index];
            let first = node.first as usize;
            if node.count > 0 {
                for triangle in &self.triangles[first..first + node.count as usize] {
                    if let Some(length) = triangle.meets(at, direction).filter(|l| *l > 0.0 && *l < nearest) {
                        nearest = length;
                        found = Some(length);
                    }
                }
                continue;
            }
            let enters = |child: usize| self.nodes[child].enters(at, inverse, nearest).map(|length| (child, length));
            next = match (enters(index + 1), enters(first)) {
                (Some(a), Some(b)) => {
                    let (near, far) = if b.1 < a.1 { (b, a) } else { (a, b) };
                    stack[height] = far;
                    height += 1;
                    Some(near.0)
                }
                (a, b) => a.or(b).map(|child| child.0),
            };
        }
    }
}

impl TreeNode {
    /// Where a ray enters the box, if nearer than `most`.
    fn enters(&self, at: Vec3, inverse: Vec3, most: f32) -> Option<f32> {
        let (a, b) = ((self.low - at) * inverse, (self.high - at) * inverse);
        let enters = a.min(b).max_element().max(0.0);
        let leaves = a.max(b).min_element().min(most);
        (enters <= leaves).then_some(enters)
    }
}

/// Adds the node of some triangles, and its children, and orders the triangles. `first` is where they begin in the
/// whole list.
fn grow(nodes: &mut Vec<TreeNode>, triangles: &mut [Triangle], first: usize) {
    let far = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let join = |(low, high): (Vec3, Vec3), (l, h): (Vec3, Vec3)| (low.min(l), high.max(h));
    let (low, high) = triangles.iter().map(Triangle::bounds).fold(far, join);
    let own = nodes.len();
    let count = if triangles.len() <= LEAF { triangles.len() } else { 0 };
    // Wider by what rounding may take away.
    let margin = 2.0 * f32::EPSILON * low.abs().max(high.abs());
    let [low, high] = [low - margin, high + margin];
    nodes.push(TreeNode { low, high, first: first as u32, count: count as u32 });
    if count > 0 {
        return;
    }
    let centres = triangles.iter().map(Triangle::centre).map(|c| (c, c));
    let (least, most) = centres.fold(far, join);
    let axis = (most - least).max_position();
    let half = triangles.len() / 2;
    triangles.select_nth_unstable_by(half, |a, b| a.centre()[axis].total_cmp(&b.centre()[axis]));
    let (left, right) = triangles.split_at_mut(half);
    grow(nodes, left, first);
    nodes[own].first = nodes.len() as u32;
    grow(nodes, right, first + half);
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::super::curvature::shapes::{ball, globe, grid, together};
    use super::*;
    use crate::scene::Primitive;

    const MOST: f32 = 0.05;

    /// Positions and smooth normals, also over hard edges.
    fn vertices(mesh: &Primitive) -> (Vec<Vec3>, Vec<Vec3>) {
        let positions: Vec<Vec3> = mesh.positions.iter().copied().map(Vec3::from_array).collect();
        let mut normals = vec![Vec3::ZERO; positions.len()];
        for corners in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| positions[corner as usize]);
            corners.iter().for_each(|corner| normals[*corner as usize] += (b - a).cross(c - a));
        }
        (positions, normals)
    }

    fn measure(mesh: &Primitive) -> Vec<f32> {
        let (positions, normals) = vertices(mesh);
        let body = Body { positions: &positions, normals: &normals, indices: &mesh.indices };
        thicknesses(&[body], MOST).remove(0)
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
        assert_eq!(thicknesses(&parts, MOST).concat(), whole);
    }

    #[test]
    fn what_is_no_body_is_no_trouble() {
        assert!(thicknesses(&[], MOST).is_empty());
        let empty = Body { positions: &[], normals: &[], indices: &[0, 1, 2] };
        assert_eq!(thicknesses(&[empty], MOST), [[0.0; 0]]);
        let mesh = ball(0.01, 2);
        let (mut positions, normals) = vertices(&mesh);
        positions[0] = Vec3::NAN;
        positions[1] = Vec3::splat(f32::MAX);
        let indices = [mesh.indices.as_slice(), &[0, 0, 0, 3, 3, 4, 9999, 1, 2, 3, 4]].concat();
        for count in [0, 7, normals.len()] {
            let body = Body { positions: &positions, normals: &normals[..count], indices: &indices };
            let values = thicknesses(&[body], MOST).remove(0);
            assert_eq!(values.len(), positions.len());
            assert!(values.iter().all(|t| (0.0..=MOST).contains(t)));
        }
        for most in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            let body = Body { positions: &positions, normals: &normals, indices: &indices };
            assert!(thicknesses(&[body], most).concat().into_iter().all(|t| t == 0.0));
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

    #[test]
    fn the_tree_finds_what_a_look_at_all_triangles_finds() {
        let mesh = together(&[slab(0.001, 0.02), ball(0.015, 3), globe(0.03, 24)]);
        let tree = Tree::new(&mesh.positions, mesh.indices.as_chunks::<3>().0);
        let mut hits = 0;
        for ray in 0..3000_u32 {
            // Numbers of no order in [-1, 1).
            let number = |k: u32| ((ray * 6 + k).wrapping_mul(2_654_435_761) >> 8) as f32 / 8_388_608.0 - 1.0;
            let at = 0.03 * Vec3::from_array([0, 1, 2].map(number));
            // Some lie in the planes of boxes.
            let way = Vec3::from_array([3, 4, 5].map(|k| if ray % 5 == 0 && k != 4 { 0.0 } else { number(k) }));
            let Some(way) = way.try_normalize() else { continue };
            let all = tree.triangles.iter().filter_map(|t| t.meets(at, way)).filter(|l| *l > 0.0 && *l < MOST);
            let nearest = all.fold(f32::INFINITY, f32::min);
            let found = tree.first_hit(at, way, MOST).unwrap_or(f32::INFINITY);
            assert_eq!(found, nearest, "from {at} along {way}");
            hits += u32::from(found.is_finite());
        }
        assert!(hits > 1500, "{hits}");
    }
}
