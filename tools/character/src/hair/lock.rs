//! A lock of hair: a lens-shaped tube lofted along a guide curve, wide in its middle and sharp at its tip.

use glam::{Vec2, Vec3};

use super::chains::Chain;
use crate::head::shape::SKULL_CENTER;
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// Vertices of a cross-section.
const RING: u32 = 6;
/// Texture coordinate v at which every lock crosses the ring of light on the head.
pub(super) const BAND_V: f32 = 0.3;
/// Height of that ring at the front of the head and at its back, metres.
const BAND_Y: [f32; 2] = [1.503, 1.492];

/// A lock.
#[derive(Clone, Debug)]
pub(super) struct Lock {
    /// Points that the lock runs through, from the root to the tip.
    pub(super) guide: Vec<Vec3>,
    /// Half width where it is widest, metres.
    pub(super) width: f32,
    /// Height of its ridge, metres.
    pub(super) thickness: f32,
    /// Half width at the root as a share.
    pub(super) root: f32,
    /// Where it is widest, 0 root .. 1 tip.
    pub(super) belly: f32,
    /// Turn about its own axis from root to tip, radians.
    pub(super) twist: f32,
    /// Strip of the texture: 0..=2, or 3 for the dark one of lower layers.
    pub(super) strip: u32,
}

impl Default for Lock {
    fn default() -> Self {
        Self { guide: Vec::new(), width: 0.014, thickness: 0.006, root: 0.55, belly: 0.4, twist: 0.0, strip: 0 }
    }
}

/// Point of a centripetal-like Catmull-Rom curve through the guide, `t` in 0..1.
fn along(guide: &[Vec3], t: f32) -> Vec3 {
    let last = guide.len() as isize - 1;
    let at = t.clamp(0.0, 1.0) * last as f32;
    let i = (at.floor() as isize).clamp(0, last - 1);
    let get = |k: isize| {
        if k < 0 {
            guide[0] * 2.0 - guide[1]
        } else if k > last {
            guide[last as usize] * 2.0 - guide[last as usize - 1]
        } else {
            guide[k as usize]
        }
    };
    let (a, b, c, d, t) = (get(i - 1), get(i), get(i + 1), get(i + 2), at - i as f32);
    0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t + (3.0 * b - a - 3.0 * c + d) * t * t * t)
}

/// Away from the head, and below it away from the neck.
fn outward(p: Vec3) -> Vec3 {
    let from = if p.y > SKULL_CENTER.y {
        SKULL_CENTER
    } else {
        Vec3::new(0.0, p.y, -0.02)
    };
    (p - from).normalize_or(Vec3::Z)
}

impl Lock {
    /// Share of the full width at `t`.
    fn profile(&self, t: f32) -> f32 {
        let rise = (t / self.belly).min(1.0);
        let rise = self.root + (1.0 - self.root) * rise * rise * (3.0 - 2.0 * rise);
        let fall = ((t - self.belly) / (1.0 - self.belly)).max(0.0);
        rise * (1.0 - fall.powf(1.55)).max(0.0).powf(0.9)
    }

    /// Adds the lock; `chain` moves its free end.
    pub(super) fn build(&self, part: &mut Part, skeleton: &Skeleton, chain: Option<&Chain>) {
        const SAMPLES: usize = 64;
        let dense: Vec<Vec3> = (0..=SAMPLES).map(|i| along(&self.guide, i as f32 / SAMPLES as f32)).collect();
        let mut lengths = vec![0.0];
        for pair in dense.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
        }
        let total = lengths[SAMPLES];
        // The last crossing of the ring, as a share of the length.
        let band = (0..SAMPLES)
            .rfind(|i| {
                let ring = |p: Vec3| p.y - (BAND_Y[1] + (BAND_Y[0] - BAND_Y[1]) * ((p.z + 0.11) / 0.2).clamp(0.0, 1.0));
                ring(dense[*i]) >= 0.0 && ring(dense[i + 1]) < 0.0
            })
            .map_or(BAND_V, |i| (lengths[i] / total).clamp(0.05, 0.9));
        let at_length = |share: f32| {
            let want = share * total;
            let i = lengths.iter().rposition(|l| *l <= want).unwrap_or(0).min(SAMPLES - 1);
            let t = (want - lengths[i]) / (lengths[i + 1] - lengths[i]).max(1e-9);
            dense[i] + (dense[i + 1] - dense[i]) * t
        };

        let stations = ((total / 0.024).ceil() as u32).clamp(14, 22);
        let first = part.vertices.len() as u32;
        let (u0, u1) = (self.strip as f32 * 0.25 + 0.006, self.strip as f32 * 0.25 + 0.244);
        // Stations stand denser where the lock bends, and towards its tip.
        let mut effort = vec![0.0];
        for i in 0..SAMPLES {
            let (a, b) = (dense[i + 1] - dense[i], dense[(i + 2).min(SAMPLES)] - dense[(i + 1).min(SAMPLES - 1)]);
            let bend = if a.length_squared() > 0.0 && b.length_squared() > 0.0 {
                a.angle_between(b)
            } else {
                0.0
            };
            effort.push(effort[i] + a.length() * (1.0 + 0.35 * lengths[i] / total) + 0.12 * bend);
        }
        for s in 0..stations {
            let want = effort[SAMPLES] * s as f32 / (stations - 1) as f32;
            let i = effort.iter().rposition(|e| *e <= want).unwrap_or(0).min(SAMPLES - 1);
            let part_way = (want - effort[i]) / (effort[i + 1] - effort[i]).max(1e-9);
            let t = 0.965 * (lengths[i] + (lengths[i + 1] - lengths[i]) * part_way.min(1.0)) / total;
            let p = at_length(t);
            let tangent = (at_length((t + 0.02).min(1.0)) - at_length((t - 0.02).max(0.0))).normalize();
            let out = outward(p);
            let out = (out - tangent * out.dot(tangent)).normalize_or(Vec3::Z);
            let side = out.cross(tangent);
            let (sin, cos) = (self.twist * t).sin_cos();
            let (side, out) = (side * cos + out * sin, out * cos - side * sin);
            let share = self.profile(t);
            let (w, h) = (self.width * share, self.thickness * share.powf(0.7) * (0.55 + 0.45 * (t / 0.2).min(1.0)));
            // Edges bend towards the head.
            let sag = (w * w / 0.16).min(0.006);
            let ring = [
                (-w, -sag, 0.0),
                (-0.56 * w, 0.62 * h - 0.3 * sag, 0.2),
                (0.06 * w, h, 0.52),
                (0.6 * w, 0.58 * h - 0.3 * sag, 0.8),
                (w, -sag, 1.0),
                (0.0, -0.22 * h - 0.35 * sag, 0.5),
            ];
            let v = if t < band {
                BAND_V * t / band
            } else {
                BAND_V + (1.0 - BAND_V) * (t - band) / (1.0 - band)
            };
            for (x, y, u) in ring {
                let q = p + side * x + out * y;
                part.vertex(q, Vec2::new(u0 + (u1 - u0) * u, v), super::chains::weights(skeleton, chain, q));
                part.tangents.push(tangent.extend(1.0));
            }
        }
        part.quads(first, stations, RING, true);

        let end = at_length(1.0);
        let tangent = (end - at_length(0.97)).normalize();
        let tip = part.vertex(end, Vec2::new((u0 + u1) * 0.5, 1.0), super::chains::weights(skeleton, chain, end));
        part.tangents.push(tangent.extend(1.0));
        let last = first + (stations - 1) * RING;
        for i in 0..RING {
            part.triangles.push([last + i, tip, last + (i + 1) % RING]);
        }
        // The root is closed too; its middle lies a hair before the first ring, so that v grows from it.
        let start = at_length(0.0);
        let tangent = (at_length(0.02) - start).normalize();
        let root = part.vertex(
            start - tangent * 0.001,
            Vec2::new((u0 + u1) * 0.5, -0.002),
            super::chains::weights(skeleton, chain, start),
        );
        part.tangents.push(tangent.extend(1.0));
        for i in 0..RING {
            part.triangles.push([first + (i + 1) % RING, root, first + i]);
        }
        debug_assert_eq!(part.tangents.len(), part.vertices.len(), "one tangent a vertex");
    }
}
