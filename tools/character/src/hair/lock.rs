//! A lock of hair: a tube of lens-shaped sections lofted along a guide curve, wide in its middle and sharp at its tip.

use glam::{Vec2, Vec3};

use super::chains::{Chain, weights};
use super::course::Course;
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::Skeleton;

/// Texture coordinate v at which every lock crosses the ring of light on the head.
pub(super) const BAND_V: f32 = 0.3;
/// How fast v grows below the ring, 1/m, and how far: there the light is as wide on every lock.
const BAND_PACE: f32 = 3.0;
const BAND_REACH: f32 = 0.07;
/// Texture coordinate v of the root of a lock that starts below the ring.
const LOW_V: f32 = 0.58;
/// Strips of the texture: where each starts and ends in u. Two for large locks, two for middle ones, one for thin ones, one
/// for the lower layer of the bangs, one for what lies inside.
pub(super) const STRIPS: [[f32; 2]; 7] =
    [[0.0, 0.2], [0.2, 0.4], [0.4, 0.53], [0.53, 0.66], [0.66, 0.72], [0.72, 0.87], [0.87, 1.0]];
/// The strip of thin locks.
pub(super) const THIN: usize = 4;
/// The strip of lower layers.
pub(super) const UNDER: usize = 5;
/// The dark strip.
pub(super) const INNER: usize = 6;
/// Radius of the body of hair that sections bend round, metres.
const ROUND: f32 = 0.1;

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
    /// Turn about its own axis at the root, and more of it up to the tip, radians.
    pub(super) roll: [f32; 2],
    /// Strip of the texture.
    pub(super) strip: usize,
}

impl Default for Lock {
    fn default() -> Self {
        Self { guide: Vec::new(), width: 0.014, thickness: 0.006, root: 0.5, belly: 0.45, roll: [0.0; 2], strip: 2 }
    }
}

/// A vertex of a section: place across (-1..1), height over the guide, both as shares.
type Corner = [f32; 2];

/// The outer side of a section from edge to edge, and the inner one back. Thin locks are one ring.
fn section(width: f32, strip: usize) -> (Vec<Corner>, Vec<Corner>) {
    let arc = |columns: usize| {
        (0..columns)
            .map(|i| {
                let x = -(std::f32::consts::PI * i as f32 / (columns - 1) as f32).cos();
                [x, (1.0 - x * x).max(0.0).powf(0.62)]
            })
            .collect::<Vec<_>>()
    };
    let inner = vec![[1.0, 0.0], [0.0, -0.3], [-1.0, 0.0]];
    match width {
        w if strip == INNER || strip == THIN && w > 0.006 => ([arc(5), vec![[0.0, -0.4]]].concat(), Vec::new()),
        w if w > 0.0135 => (arc(8), inner),
        w if w > 0.0065 => (arc(6), inner),
        _ => (vec![[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.0, -0.5]], Vec::new()),
    }
}

impl Lock {
    /// Share of the full width at `t`.
    fn profile(&self, t: f32) -> f32 {
        let rise = (t / self.belly).min(1.0);
        let rise = self.root + (1.0 - self.root) * rise * rise * (3.0 - 2.0 * rise);
        let fall = ((t - self.belly) / (1.0 - self.belly)).max(0.0);
        rise * (1.0 - fall.powf(1.7)).max(0.0)
    }

    /// Point of the section at `t`.
    fn place(&self, course: &Course, t: f32, [x, height]: Corner) -> Vec3 {
        let [p, _, side, out] = course.frame(t, self.roll[0] + self.roll[1] * t);
        let share = self.profile(t);
        let w = self.width * share * x;
        // Roots are flat, so that they come out of the cap without a step.
        let h = self.thickness * share.powf(0.75) * (0.15 + 0.85 * smoothstep(0.01, 0.13, t * course.total())) * height;
        p + side * w + out * (h - (w * w / (2.0 * ROUND)).min(0.008))
    }

    /// A lock that leaves this one: `from` where on it, to which `side` (-1..1, across), `spread` metres away at its tip,
    /// which lies `reach` of the length from the root.
    pub(super) fn fork(&self, from: f32, side: f32, spread: f32, reach: f32, width: f32) -> Self {
        const POINTS: usize = 6;
        let course = Course::new(&self.guide);
        let guide = (0..POINTS)
            .map(|i| {
                let s = i as f32 / (POINTS - 1) as f32;
                let t = from + (reach - from) * s;
                let [p, along, across, out] = course.frame(t.min(1.0), self.roll[0] + self.roll[1] * t.min(1.0));
                let beyond = along * (t - 1.0).max(0.0) * course.total();
                // It starts inside the parent and comes out beside its ridge.
                let offset =
                    side * self.width * self.profile(t.min(0.8)) * (0.3 + 0.5 * s) + side.signum() * spread * s * s;
                p + beyond + across * offset + out * self.thickness * (0.25 * s.min(0.5) - 0.1)
            })
            .collect();
        Self {
            guide,
            width,
            thickness: (self.thickness * 0.8).min(width * 0.6),
            root: 0.3,
            belly: 0.5,
            roll: [self.roll[0] + self.roll[1] * from + side * 0.25, self.roll[1] * 0.5],
            strip: if width > 0.0065 { 2 + self.strip % 2 } else { THIN },
        }
    }

    /// Adds the lock; `chain` moves its free end.
    pub(super) fn build(&self, part: &mut Part, skeleton: &Skeleton, chain: Option<&Chain>) {
        let course = Course::new(&self.guide);
        let v = wrap(&course);
        let (outer, inner) = section(self.width, self.strip);
        let (spacing, least, most) = match self.width {
            w if w > 0.0135 => (0.022, 18, 28),
            w if w > 0.0065 => (0.025, 14, 26),
            _ => (0.03, 14, 20),
        };
        let stations = course.stations(((course.total() / spacing).ceil() as usize).clamp(least, most));
        let mut add = |p: Vec3, u: f32, t: f32, tangent: Vec3| {
            let i = part.vertex(p, Vec2::new(u, v(t)), weights(skeleton, chain, p));
            part.tangents.push(tangent.extend(1.0));
            i
        };
        // u by the place across, a little inside of the strip.
        let u = |strip: usize, x: f32| {
            let [from, to] = STRIPS[strip];
            from + (to - from) * (0.5 + 0.48 * x)
        };
        let [start, end] = [0.0, 1.0].map(|t| course.frame(t, 0.0));
        // The root is closed before the first section, so that v grows from it.
        let root = add(start[0] - start[1] * 0.001, u(self.strip, 0.0), -0.01, start[1]);
        let mut fans = Vec::new();
        for (corners, strip, closed) in [(&outer, self.strip, inner.is_empty()), (&inner, INNER, false)] {
            if corners.is_empty() {
                continue;
            }
            let columns = corners.len() as u32;
            let mut first = None;
            for t in &stations {
                let tangent = course.frame(*t, 0.0)[1];
                for corner in corners {
                    let i = add(self.place(&course, *t, *corner), u(strip, corner[0]), *t, tangent);
                    first.get_or_insert(i);
                }
            }
            let tip = add(end[0], u(strip, 0.0), 1.0, end[1]);
            fans.push((first.unwrap_or_default(), tip, columns, closed));
        }
        for (first, tip, columns, closed) in fans {
            let rows = stations.len() as u32;
            part.quads(first, rows, columns, closed);
            let last = first + (rows - 1) * columns;
            for i in 0..if closed { columns } else { columns - 1 } {
                let next = (i + 1) % columns;
                part.triangles.push([last + i, tip, last + next]);
                part.triangles.push([first + next, root, first + i]);
            }
        }
    }
}

/// Texture coordinate v along a lock, by the share of its length.
fn wrap(course: &Course) -> impl Fn(f32) -> f32 {
    let total = course.total();
    let ring = course.ring();
    move |t: f32| {
        let Some(ring) = ring else { return LOW_V + (1.0 - LOW_V) * t };
        if t < ring {
            return BAND_V * t / ring;
        }
        let (below, rest) = ((t - ring) * total, (1.0 - ring) * total);
        let reach = BAND_REACH.min(0.35 * rest);
        let v = BAND_V + BAND_PACE * reach;
        if below < reach {
            BAND_V + BAND_PACE * below
        } else {
            v + (1.0 - v) * (below - reach) / (rest - reach)
        }
    }
}
