//! Curvature of a mesh at its vertices, and the smoothing over a mesh that it shares with the thickness.

use std::collections::HashMap;

use glam::DVec3;

/// Greatest curvature either way, 1/m: a radius of 1 mm.
const MOST: f64 = 1000.0;

/// How far curvature is spread over the surface, m: the standard deviation along each axis. A step takes 2.3 mm from a
/// tenth to nine tenths.
const SPREAD_M: f64 = 1e-3;

/// Most rounds of the solver that spreads: enough for edges of a tenth of the spread, a bound for finer ones.
const MOST_ROUNDS: usize = 40;

/// Smoothed mean curvature at each vertex, 1/m in units of the mesh, within ±1000; positive where the surface bulges,
/// negative where it is hollow. A sphere of radius r has 1/r, a cylinder 1/(2 r), a vertex without triangles 0.
///
/// Only the triangles' winding says which side is outside.
pub(super) fn curvatures(surface: &Surface) -> Vec<f32> {
    let mut values = surface.curvatures();
    surface.spread(&mut values, SPREAD_M);
    surface.to_vertices(&values)
}

/// A triangle mesh without seams: its places, and how strongly they hang together.
pub(super) struct Surface {
    /// Place of each vertex; vertices at the same position share one.
    places: Vec<u32>,
    /// Position of each place.
    points: Vec<DVec3>,
    /// Normal of each place out of the body, unit; zero where it has none.
    normals: Vec<DVec3>,
    /// Pairs of places that share an edge, each pair once.
    edges: Vec<Edge>,
    /// The part of the surface that belongs to each place, square units; zero where it has no triangle.
    areas: Vec<f64>,
}

/// An edge between two places.
struct Edge {
    ends: [u32; 2],
    /// Weight of the Laplace operator: half the cotangents of the angles that face the edge, without unit, positive.
    weight: f64,
}

impl Surface {
    /// Vertices at the same position count as one. Triangles with a corner out of range, without area or not finite are left
    /// out.
    pub(super) fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        let (places, points) = weld(positions);
        let mut normals = vec![DVec3::ZERO; points.len()];
        let mut sides = Vec::with_capacity(triangles.len() * 3);
        for triangle in triangles {
            let [Some(a), Some(b), Some(c)] = triangle.map(|corner| places.get(corner as usize).copied()) else {
                continue;
            };
            let corners = [a, b, c];
            let [a, b, c] = corners.map(|place| points[place as usize]);
            let cross = (b - a).cross(c - a);
            let double = cross.length();
            let squares = [(c - b).length_squared(), (a - c).length_squared(), (b - a).length_squared()];
            let [bc, ca, ab] = squares;
            // Slivers have no normal to speak of; written so that NaN is left out too.
            let sound = double > 1e-7 * (ab + bc + ca) && double.is_finite();
            if !sound {
                continue;
            }
            for corner in 0..3 {
                let [facing, left, right] = [0, 1, 2].map(|k| squares[(corner + k) % 3]);
                // These weights give exact normals wherever the mesh is inscribed in a sphere (Max 1999).
                normals[corners[corner] as usize] += cross / (left * right);
                // The law of cosines.
                let cotangent = (left + right - facing) / (2.0 * double);
                let [p, q] = [corners[(corner + 1) % 3], corners[(corner + 2) % 3]];
                sides.push((u64::from(p.min(q)) << 32 | u64::from(p.max(q)), cotangent));
            }
        }
        for normal in &mut normals {
            *normal = normal.normalize_or_zero();
        }
        let edges = edges(sides);
        let mut areas = vec![0.0; points.len()];
        for Edge { ends: [p, q], weight } in &edges {
            // A quarter for each end is the cell nearest to it, in the sum over its edges.
            let area = 0.25 * weight * points[*p as usize].distance_squared(points[*q as usize]);
            areas[*p as usize] += area;
            areas[*q as usize] += area;
        }
        Self { places, points, normals, edges, areas }
    }

    /// Place of each vertex.
    pub(super) fn places(&self) -> &[u32] {
        &self.places
    }

    /// Normal of each place out of the body, unit; zero where it has none.
    pub(super) fn normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// Number of places.
    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    /// Values of the places at the vertices.
    pub(super) fn to_vertices(&self, values: &[f64]) -> Vec<f32> {
        self.places.iter().map(|place| values[*place as usize] as f32).collect()
    }

    /// Mean curvature at each place, 1/unit, within ±[`MOST`].
    ///
    /// The mean of the normal curvatures along the edges. Weighted as the area is made up of them it is the mean over
    /// all directions, and as the weights are positive nothing explodes at borders or in slivers.
    fn curvatures(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.len()];
        for Edge { ends: [p, q], weight } in &self.edges {
            let [p, q] = [*p as usize, *q as usize];
            let turn = (self.normals[q] - self.normals[p]).dot(self.points[q] - self.points[p]);
            sums[p] += 0.25 * weight * turn;
            sums[q] += 0.25 * weight * turn;
        }
        let bounded = |(sum, area): (f64, &f64)| (*area > 0.0).then(|| (sum / area).clamp(-MOST, MOST));
        sums.into_iter().zip(&self.areas).map(|part| bounded(part).unwrap_or(0.0)).collect()
    }

    /// Spreads values of the places over the surface by `deviation` units, as one implicit step of heat flow: it keeps
    /// the integral, stays within the range of the values, and does not ask for short steps where edges are short.
    ///
    /// Conjugate gradients with the diagonal as preconditioner, one thread: the sums have one order.
    pub(super) fn spread(&self, values: &mut [f64], deviation: f64) {
        // Heat has the variance 2 t along each axis.
        let time = 0.5 * deviation * deviation;
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // The matrix times `x`, less its area part where that is not wanted.
        let flow = |x: &[f64], out: &mut [f64]| {
            for Edge { ends: [p, q], weight } in &self.edges {
                let [p, q] = [*p as usize, *q as usize];
                let part = time * weight * (x[p] - x[q]);
                out[p] += part;
                out[q] -= part;
            }
        };
        let mut diagonal = self.areas.clone();
        for Edge { ends, weight } in &self.edges {
            for end in ends {
                diagonal[*end as usize] += time * weight;
            }
        }
        // Places without triangles have an empty row, and a residual of 0.
        let inverse: Vec<f64> = diagonal.iter().map(|d| if *d > 0.0 { d.recip() } else { 0.0 }).collect();
        let square = |x: &[f64], weights: &[f64]| x.iter().zip(weights).map(|(x, w)| x * x * w).sum::<f64>();
        let enough = 1e-8 * square(values, &self.areas);

        let mut residual = vec![0.0; self.len()];
        flow(values, &mut residual);
        residual.iter_mut().for_each(|r| *r = -*r);
        let mut way: Vec<f64> = residual.iter().zip(&inverse).map(|(r, i)| r * i).collect();
        let mut left = square(&residual, &inverse);
        let mut image = vec![0.0; self.len()];
        for _ in 0..MOST_ROUNDS {
            // Written so that NaN ends it too.
            let goes_on = left > enough;
            if !goes_on {
                break;
            }
            for ((image, way), area) in image.iter_mut().zip(&way).zip(&self.areas) {
                *image = way * area;
            }
            flow(&way, &mut image);
            let along: f64 = way.iter().zip(&image).map(|(w, i)| w * i).sum();
            let step = left / along;
            if !step.is_finite() {
                break;
            }
            for (((value, residual), way), image) in values.iter_mut().zip(&mut residual).zip(&way).zip(&image) {
                *value += step * way;
                *residual -= step * image;
            }
            let now = square(&residual, &inverse);
            let keep = now / left;
            left = now;
            for ((way, residual), inverse) in way.iter_mut().zip(&residual).zip(&inverse) {
                *way = residual * inverse + keep * *way;
            }
        }
        // What the solver has not yet settled must not leave the range.
        for value in values {
            *value = value.max(least).min(most);
        }
    }
}

/// Place of each vertex and the position of each place.
///
/// Positions that are equal but for rounding are one: a seam is often closed by the sine of 2 π.
fn weld(positions: &[[f32; 3]]) -> (Vec<u32>, Vec<DVec3>) {
    let positions = positions.iter().map(|position| DVec3::from_array(position.map(f64::from)));
    let sound = || positions.clone().filter(|p| p.is_finite());
    // Medians, as a stray vertex must not count more than others.
    let middle = DVec3::from_array([0, 1, 2].map(|axis| median(sound().map(|p| p[axis]))));
    let apart = 1e-6 * median(sound().map(|p| p.distance(middle)));
    let cell = |point: DVec3| (point / (8.0 * apart)).floor().to_array().map(|v| v as i64);

    // Places of a cell are a chain: the latest one, and for each the one before. They are apart, so chains are short.
    let mut latest: HashMap<[i64; 3], u32> = HashMap::with_capacity(positions.len());
    let mut before: Vec<Option<u32>> = Vec::new();
    let mut points: Vec<DVec3> = Vec::new();
    let places = positions.clone().map(|point| {
        let [low, high] = [cell(point - middle - apart), cell(point - middle + apart)];
        let near = (0..8).map(|corner| std::array::from_fn(|k| if corner >> k & 1 == 0 { low[k] } else { high[k] }));
        // In most cases all of them are the same cell.
        let near = near.take(if low == high { 1 } else { 8 });
        let known = near.filter_map(|cell| {
            let chain = std::iter::successors(latest.get(&cell).copied(), |place| before[*place as usize]);
            chain.filter(|place| points[*place as usize].distance(point) <= apart).last()
        });
        known.min().unwrap_or_else(|| {
            let place = points.len() as u32;
            points.push(point);
            // What is not finite is no neighbour of anything.
            let other = point.is_finite().then(|| latest.insert(cell(point - middle), place));
            before.push(other.flatten());
            place
        })
    });
    (places.collect(), points)
}

/// The median; 0 of nothing.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    let half = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    *values.select_nth_unstable_by(half, f64::total_cmp).1
}

/// Joins the sides of triangles, ends and cotangent of the angle that faces it, to edges.
fn edges(mut sides: Vec<(u64, f64)>) -> Vec<Edge> {
    sides.sort_unstable_by_key(|side| side.0);
    let edge = |same: &[(u64, f64)]| {
        let ends = same[0].0;
        let cotangents: f64 = same.iter().map(|side| side.1).sum();
        // An edge that a better triangulation would flip has a negative weight: it hardly counts.
        Edge { ends: [(ends >> 32) as u32, ends as u32], weight: (0.5 * cotangents).clamp(1e-3, 1e3) }
    };
    sides.chunk_by(|a, b| a.0 == b.0).map(edge).collect()
}

/// Meshes with curvature and thickness that are known.
#[cfg(test)]
pub(super) mod shapes {
    use std::collections::HashMap;
    use std::f32::consts::{PI, TAU};

    use glam::Vec3;

    use crate::scene::Primitive;

    /// A grid of cells over [0, 1]²: u × v faces outside. Its borders are not joined, even where they meet.
    pub(in crate::skin) fn grid(columns: u32, rows: u32, at: impl Fn(f32, f32) -> Vec3) -> Primitive {
        let mut out = Primitive::default();
        for row in 0..=rows {
            for column in 0..=columns {
                out.positions.push(at(column as f32 / columns as f32, row as f32 / rows as f32).to_array());
                if column < columns && row < rows {
                    let [a, b] = [row * (columns + 1) + column, (row + 1) * (columns + 1) + column];
                    out.indices.extend([a, a + 1, b, a + 1, b + 1, b]);
                }
            }
        }
        out
    }

    /// Positions and smooth normals, also over hard edges.
    pub(in crate::skin) fn vertices(mesh: &Primitive) -> (Vec<Vec3>, Vec<Vec3>) {
        let positions: Vec<Vec3> = mesh.positions.iter().copied().map(Vec3::from_array).collect();
        let mut normals = vec![Vec3::ZERO; positions.len()];
        for corners in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| positions[corner as usize]);
            corners.iter().for_each(|corner| normals[*corner as usize] += (b - a).cross(c - a));
        }
        (positions, normals)
    }

    /// All triangles, each primitive with vertices of its own.
    pub(in crate::skin) fn together(parts: &[Primitive]) -> Primitive {
        let mut out = Primitive::default();
        for part in parts {
            let first = out.positions.len() as u32;
            out.positions.extend(&part.positions);
            out.indices.extend(part.indices.iter().map(|index| first + index));
        }
        out
    }

    /// A sphere of meridians and parallels: its seam is closed but for rounding, and each pole is many vertices.
    pub(in crate::skin) fn globe(radius: f32, meridians: u32) -> Primitive {
        grid(meridians, meridians / 2, |u, v| {
            let ((sin, cos), (ring, height)) = ((TAU * u).sin_cos(), (PI * (1.0 - v)).sin_cos());
            radius * Vec3::new(ring * cos, height, -ring * sin)
        })
    }

    /// An octahedron whose triangles are cut in four `times` times, blown up to a sphere.
    pub(in crate::skin) fn ball(radius: f32, times: u32) -> Primitive {
        let mut points = vec![Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
        let mut triangles =
            vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5_u32]];
        for _ in 0..times {
            let mut middles = HashMap::new();
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    points.push((points[a as usize] + points[b as usize]).normalize());
                    points.len() as u32 - 1
                })
            };
            let cut = triangles.iter().flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            });
            triangles = cut.collect();
        }
        let positions = points.into_iter().map(|p| (radius * p).to_array()).collect();
        Primitive { positions, indices: triangles.into_flattened(), ..Primitive::default() }
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::TAU;

    use glam::{Quat, Vec3};

    use super::shapes::{ball, globe, grid};
    use super::*;
    use crate::scene::Primitive;

    fn curvatures(mesh: &Primitive) -> Vec<f32> {
        super::curvatures(&Surface::new(&mesh.positions, mesh.indices.as_chunks().0))
    }

    /// The greatest relative error.
    fn worst(values: &[f32], wanted: f32) -> f32 {
        values.iter().map(|k| (k / wanted - 1.0).abs()).fold(0.0, f32::max)
    }

    fn scaled(mesh: &Primitive, by: f32) -> Primitive {
        let positions = mesh.positions.iter().map(|p| p.map(|v| v * by)).collect();
        Primitive { positions, ..mesh.clone() }
    }

    /// A ring of tube, and its mean curvature at each vertex.
    fn torus(ring: f32, tube: f32) -> (Primitive, Vec<f32>) {
        let (columns, rows) = (96, 48);
        let mesh = grid(columns, rows, |u, v| {
            let (around, along) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
            let radius = ring + tube * along.1;
            Vec3::new(radius * around.1, radius * around.0, tube * along.0)
        });
        let known = (0..=rows).flat_map(|row| {
            let cos = (TAU * row as f32 / rows as f32).cos();
            let k = (ring + 2.0 * tube * cos) / (2.0 * tube * (ring + tube * cos));
            std::iter::repeat_n(k, columns as usize + 1)
        });
        (mesh, known.collect())
    }

    #[test]
    fn spheres_have_one_over_their_radius_everywhere() {
        for radius in [0.010, 0.025] {
            for mesh in [globe(radius, 24), globe(radius, 96), ball(radius, 2), ball(radius, 5)] {
                let error = worst(&curvatures(&mesh), 1.0 / radius);
                assert!(error < 0.01, "{} vertices of radius {radius}: {error}", mesh.positions.len());
            }
        }
    }

    #[test]
    fn inward_spheres_are_hollow() {
        let mut mesh = globe(0.01, 48);
        mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|corners| corners.swap(1, 2));
        assert!(worst(&curvatures(&mesh), -100.0) < 0.01);
    }

    #[test]
    fn planes_have_none() {
        // Cells of many shapes, in no plane of the axes.
        let turn = Quat::from_rotation_x(0.5);
        for (turn, most) in [(Quat::IDENTITY, 1e-3), (turn, 0.02)] {
            let mesh = grid(40, 30, |u, v| turn * Vec3::new(0.1 * u + 0.02 * v * v, 0.1 * v * v, 0.0));
            let greatest = curvatures(&mesh).into_iter().map(f32::abs).fold(0.0, f32::max);
            assert!(greatest < most, "{greatest}");
        }
    }

    #[test]
    fn cylinders_have_half_of_one_over_their_radius() {
        let (radius, length) = (0.02, 0.1);
        for rows in [10, 100] {
            let mesh = grid(64, rows, |u, v| {
                let (sin, cos) = (TAU * u).sin_cos();
                Vec3::new(radius * cos, radius * sin, length * v)
            });
            for (k, position) in curvatures(&mesh).into_iter().zip(&mesh.positions) {
                assert!((0.0..=1.01 / radius).contains(&k), "a border explodes: {k}");
                if (0.01..length - 0.01).contains(&position[2]) {
                    assert!((k * 2.0 * radius - 1.0).abs() < 0.01, "{k} at {position:?}");
                }
            }
        }
    }

    #[test]
    fn a_torus_bulges_outside_and_is_hollow_inside() {
        let (mesh, known) = torus(0.03, 0.018);
        let greatest = known.iter().copied().fold(0.0, f32::max);
        for (k, known) in curvatures(&mesh).into_iter().zip(known) {
            assert!((k - known).abs() < 0.03 * greatest, "{k} for {known}");
        }
    }

    #[test]
    fn curvature_is_inverse_to_size() {
        for by in [0.5, 3.0] {
            let mesh = globe(0.02, 48);
            let pairs = curvatures(&mesh).into_iter().zip(curvatures(&scaled(&mesh, by)));
            pairs.for_each(|(k, scaled)| assert!((scaled * by / k - 1.0).abs() < 1e-3, "{k} {scaled}"));
        }
        // No more than the radius of a millimetre allows.
        assert_eq!(curvatures(&globe(1e-4, 16)).into_iter().fold(0.0, f32::max), 1000.0);
    }

    #[test]
    fn the_order_of_vertices_and_triangles_is_all_the_same() {
        let (mesh, _) = torus(0.03, 0.012);
        let count = mesh.positions.len();
        // 1009 is prime to the number of vertices, so that each is met once.
        let moved = |vertex: usize| vertex * 1009 % count;
        let mut other = mesh.clone();
        for (vertex, position) in mesh.positions.iter().enumerate() {
            other.positions[moved(vertex)] = *position;
        }
        other.indices.iter_mut().for_each(|index| *index = moved(*index as usize) as u32);
        other.indices.as_chunks_mut::<3>().0.reverse();
        let (values, others) = (curvatures(&mesh), curvatures(&other));
        for (vertex, k) in values.iter().enumerate() {
            let other = others[moved(vertex)];
            assert!((k - other).abs() < 0.01, "{k} {other}");
        }
        assert_eq!(values, curvatures(&mesh));
    }

    #[test]
    fn a_step_is_spread_over_millimetres_and_not_over_rings() {
        for cells in [40, 80, 160] {
            let mesh = grid(cells, 20, |u, v| Vec3::new(0.02 * u, 0.005 * v, 0.0));
            let surface = Surface::new(&mesh.positions, mesh.indices.as_chunks::<3>().0);
            let mut values: Vec<f64> = surface.points.iter().map(|p| f64::from(u8::from(p.x > 0.0101))).collect();
            surface.spread(&mut values, SPREAD_M);
            let between = surface.points.iter().zip(&values).filter(|(_, v)| (0.1..0.9).contains(*v));
            let (least, most) =
                between.fold((1.0_f64, 0.0_f64), |(least, most), (p, _)| (least.min(p.x), most.max(p.x)));
            assert!((0.0015..0.003).contains(&(most - least)), "{cells} cells: {}", most - least);
        }
    }

    #[test]
    fn spreading_keeps_integral_and_range() {
        let mesh = globe(0.01, 64);
        let surface = Surface::new(&mesh.positions, mesh.indices.as_chunks::<3>().0);
        let mut values: Vec<f64> = (0..surface.len()).map(|place| f64::from(u8::from(place % 97 == 0))).collect();
        let integral = |values: &[f64]| values.iter().zip(&surface.areas).map(|(v, a)| v * a).sum::<f64>();
        let before = integral(&values);
        surface.spread(&mut values, SPREAD_M);
        assert!((integral(&values) / before - 1.0).abs() < 0.01);
        assert!(values.iter().all(|v| (0.0..=1.0).contains(v)));
    }

    #[test]
    fn what_is_no_surface_has_none() {
        assert!(curvatures(&Primitive::default()).is_empty());
        let point = [0.1, 0.2, 0.3];
        let line: Vec<[f32; 3]> = (0..9).map(|k| [k as f32, 0.0, 0.0]).collect();
        for positions in [vec![point; 9], line, vec![[f32::NAN; 3]; 9], vec![[f32::INFINITY, 0.0, 0.0]; 9]] {
            for indices in [vec![], vec![0, 1, 2, 3, 4, 5], vec![0, 0, 1, 1, 1, 1, 7], vec![0, 1, 90]] {
                let mesh = Primitive { positions: positions.clone(), indices, ..Primitive::default() };
                assert_eq!(curvatures(&mesh), [0.0; 9]);
            }
        }
    }

    #[test]
    fn broken_parts_leave_the_rest_as_it_is() {
        let mut mesh = ball(0.01, 3);
        let count = mesh.positions.len() as u32;
        mesh.positions.extend([[f32::NAN; 3], [f32::MAX, 0.0, 0.0], [0.0, 0.01, 0.0]]);
        // No triangle, and triangles with vertices that are not finite, not there or at one place.
        mesh.indices.extend([0, 0, 2, 0, 1, count, 0, 1, count + 9, 0, 2, count + 2]);
        let values = curvatures(&mesh);
        assert!(values.iter().all(|k| k.is_finite()));
        assert!(worst(&values[..count as usize], 100.0) < 0.01);
    }
}
