//! How far along a strip each of its places lies.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{Vec2, Vec3};

/// Least correlation of a texture axis with the way along the strip for it to straighten that way.
const FOLLOWS: f32 = 0.8;

/// Steps in which the length of a strip is measured along its texture axis.
const STEPS: usize = 64;

/// One strip: its triangles as indices of its own places.
pub(super) struct Patch {
    pub triangles: Vec<[usize; 3]>,
    /// Mesh space.
    pub places: Vec<Vec3>,
    /// Texture coordinates of the corners of each triangle, where there are any.
    pub uvs: Option<Vec<[Vec2; 3]>>,
}

impl Patch {
    /// How far along the strip each place lies, 0 to 1, growing evenly with its length; which end is the root is settled later.
    /// `None` where it has no length.
    pub fn along(&self) -> Option<Vec<f32>> {
        let walked = self.walked()?;
        let follows = (0..2).filter_map(|axis| {
            let (values, strength) = self.texture_axis(axis, &walked)?;
            (strength >= FOLLOWS).then_some((strength, values))
        });
        // On a wide card the farthest corners lie across; its texture runs straight.
        let straight = follows.max_by(|a, b| a.0.total_cmp(&b.0)).and_then(|(_, values)| self.even(&values));
        straight.or(Some(walked))
    }

    /// Unit directions in which the way grows, by place; where it does not, that from its low to its high end.
    pub fn directions(&self, along: &[f32]) -> Vec<Vec3> {
        let mut sums = vec![Vec3::ZERO; self.places.len()];
        for corners in &self.triangles {
            if let Some((gradient, area)) = self.gradient(corners, corners.map(|c| along[c])) {
                // By area: the gradient of a sliver is noise.
                corners.iter().for_each(|c| sums[*c] += gradient * area);
            }
        }
        let (mut low, mut high) = ((Vec3::ZERO, 0.0), (Vec3::ZERO, 0.0));
        for (place, t) in self.places.iter().zip(along) {
            low = (low.0 + *place * (1.0 - t), low.1 + (1.0 - t));
            high = (high.0 + *place * *t, high.1 + t);
        }
        let whole = (high.0 / f32::max(high.1, 1e-9) - low.0 / f32::max(low.1, 1e-9)).normalize_or(Vec3::NEG_Y);
        sums.into_iter().map(|sum| sum.try_normalize().unwrap_or(whole)).collect()
    }

    /// Mean height and the like: the mean of a function of places over the surface.
    pub fn mean(&self, of: impl Fn(Vec3) -> f32) -> f32 {
        let (mut sum, mut area) = (0.0, 0.0);
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|c| self.places[c]);
            // What has no area still stands somewhere.
            let weight = (b - a).cross(c - a).length() + 1e-12;
            sum += of((a + b + c) / 3.0) * weight;
            area += weight;
        }
        sum / f32::max(area, 1e-12)
    }

    /// Gradient of a linear function over a triangle, and twice the triangle's area.
    fn gradient(&self, corners: &[usize; 3], values: [f32; 3]) -> Option<(Vec3, f32)> {
        let [a, b, c] = corners.map(|c| self.places[c]);
        let (e1, e2) = (b - a, c - a);
        let normal = e1.cross(e2);
        let squared = normal.length_squared();
        if squared <= 1e-24 {
            return None;
        }
        let (d1, d2) = (values[1] - values[0], values[2] - values[0]);
        Some(((e2.cross(normal) * d1 + normal.cross(e1) * d2) / squared, squared.sqrt()))
    }

    /// Geodesic way between the two places that are farthest apart.
    fn walked(&self) -> Option<Vec<f32>> {
        let around = self.around();
        let farthest = |of: &[f32]| (0..of.len()).max_by(|a, b| of[*a].total_cmp(&of[*b]));
        let first = farthest(&self.distances(&around, 0))?;
        let from_first = self.distances(&around, first);
        let second = farthest(&from_first)?;
        let from_second = self.distances(&around, second);
        let way = from_first.iter().zip(&from_second).map(|(a, b)| a / (a + b));
        (from_first[second] > 0.0).then(|| way.collect())
    }

    /// Whether it is about as long as it is wide: the square of its length over its area, which is 0.8 of a ball.
    pub fn is_round(&self) -> bool {
        let around = self.around();
        let first = self.distances(&around, 0);
        let first = (0..first.len()).max_by(|a, b| first[*a].total_cmp(&first[*b])).unwrap_or(0);
        let length = self.distances(&around, first).into_iter().fold(0.0, f32::max);
        let area = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).length() * 0.5;
        let area: f32 = self.triangles.iter().map(|t| area(t.map(|c| self.places[c]))).sum();
        length * length < 2.0 * area
    }

    /// Triangles at each place.
    fn around(&self) -> Vec<Vec<usize>> {
        let mut around = vec![Vec::new(); self.places.len()];
        for (triangle, corners) in self.triangles.iter().enumerate() {
            corners.iter().for_each(|c| around[*c].push(triangle));
        }
        around
    }

    /// Lengths of the shortest ways over the surface (Kimmel and Sethian 1998, with straight ways inside of a triangle).
    fn distances(&self, around: &[Vec<usize>], from: usize) -> Vec<f32> {
        let mut reached = vec![f32::INFINITY; self.places.len()];
        reached[from] = 0.0;
        // Lengths are not negative, and the bits of such numbers grow as they do.
        let mut queue = BinaryHeap::from([Reverse((0u32, from))]);
        while let Some(Reverse((bits, at))) = queue.pop() {
            if f32::from_bits(bits) > reached[at] {
                continue;
            }
            for triangle in &around[at] {
                let [a, b, c] = self.triangles[*triangle];
                let others = if a == at {
                    [b, c]
                } else if b == at {
                    [c, a]
                } else {
                    [a, b]
                };
                for [to, other] in [others, [others[1], others[0]]] {
                    let along_edge = reached[at] + self.places[at].distance(self.places[to]);
                    let there = along_edge.min(self.across(at, other, to, &reached));
                    // What rounding gains is no shorter way.
                    if there < reached[to] * (1.0 - 1e-6) {
                        reached[to] = there;
                        queue.push(Reverse((there.to_bits(), to)));
                    }
                }
            }
        }
        // Places that only corners join have no way; they count as near.
        reached.into_iter().map(|d| if d.is_finite() { d } else { 0.0 }).collect()
    }

    /// Length of the way to a corner that crosses the edge between the two others, as if it came straight from where both
    /// have theirs from.
    fn across(&self, a: usize, b: usize, to: usize, reached: &[f32]) -> f32 {
        let (from_a, from_b) = (reached[a], reached[b]);
        let edge = self.places[b] - self.places[a];
        let length = edge.length();
        if !from_b.is_finite() || length <= 0.0 {
            return f32::INFINITY;
        }
        let axis = edge / length;
        let to = self.places[to] - self.places[a];
        let corner = Vec2::new(to.dot(axis), (to - axis * to.dot(axis)).length());
        let x = (from_a * from_a - from_b * from_b + length * length) / (2.0 * length);
        let below = from_a * from_a - x * x;
        if below < 0.0 {
            return f32::INFINITY;
        }
        let source = Vec2::new(x, -below.sqrt());
        let crossing = source.x + (corner.x - source.x) * -source.y / (corner.y - source.y).max(1e-12);
        if (0.0..=length).contains(&crossing) {
            source.distance(corner)
        } else {
            f32::INFINITY
        }
    }

    /// A texture axis by place, and how it correlates with a way along the strip.
    fn texture_axis(&self, axis: usize, walked: &[f32]) -> Option<(Vec<f32>, f32)> {
        let uvs = self.uvs.as_ref()?;
        let mut sums = vec![(0.0, 0u32); self.places.len()];
        for (corners, uvs) in self.triangles.iter().zip(uvs) {
            for (corner, uv) in corners.iter().zip(uvs) {
                sums[*corner] = (sums[*corner].0 + uv[axis], sums[*corner].1 + 1);
            }
        }
        let values: Vec<f32> = sums.into_iter().map(|(sum, count)| sum / count.max(1) as f32).collect();
        let strength = correlation(&values, walked)?;
        Some((
            if strength < 0.0 {
                values.iter().map(|v| -v).collect()
            } else {
                values
            },
            strength.abs(),
        ))
    }

    /// The same order, evenly by length: how far the surface reaches for a step along an axis differs from step to step.
    fn even(&self, values: &[f32]) -> Option<Vec<f32>> {
        let (low, high) = values.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        let step = (high - low) / STEPS as f32;
        if !(step.is_finite() && step > 0.0) {
            return None;
        }
        let mut lengths = [(0.0f32, 0.0f32); STEPS];
        for corners in &self.triangles {
            let of = corners.map(|c| values[c]);
            let Some((gradient, area)) = self.gradient(corners, of) else { continue };
            let slope = gradient.length();
            if slope <= 1e-9 {
                continue;
            }
            let at = |v: f32| (((v - low) / step) as usize).min(STEPS - 1);
            let span = at(of[0].min(of[1]).min(of[2]))..=at(of[0].max(of[1]).max(of[2]));
            let weight = area / (span.end() - span.start() + 1) as f32;
            for (length, sum) in &mut lengths[span] {
                *length += weight / slope;
                *sum += weight;
            }
        }
        let known: Vec<f32> = lengths.iter().filter(|l| l.1 > 0.0).map(|l| l.0 / l.1).collect();
        let mean = known.iter().sum::<f32>() / known.len().max(1) as f32;
        let mut reached = [0.0; STEPS + 1];
        for (i, (length, sum)) in lengths.iter().enumerate() {
            reached[i + 1] = reached[i] + if *sum > 0.0 { length / sum } else { mean };
        }
        let whole = reached[STEPS];
        let even = |v: &f32| {
            let x = ((v - low) / step).clamp(0.0, STEPS as f32);
            let i = (x as usize).min(STEPS - 1);
            ((reached[i] + (reached[i + 1] - reached[i]) * (x - i as f32)) / whole).clamp(0.0, 1.0)
        };
        (whole.is_finite() && whole > 0.0).then(|| values.iter().map(even).collect())
    }
}

/// Pearson's correlation; `None` where one of them does not change.
fn correlation(a: &[f32], b: &[f32]) -> Option<f32> {
    let mean = |of: &[f32]| of.iter().map(|x| f64::from(*x)).sum::<f64>() / of.len().max(1) as f64;
    let (ma, mb) = (mean(a), mean(b));
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (x, y) in a.iter().zip(b) {
        let (x, y) = (f64::from(*x) - ma, f64::from(*y) - mb);
        ab += x * y;
        aa += x * x;
        bb += y * y;
    }
    let of = ab / (aa * bb).sqrt();
    of.is_finite().then_some(of as f32)
}
