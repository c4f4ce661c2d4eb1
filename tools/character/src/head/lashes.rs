//! Lashes and brows: drawn shapes before the skin that follow lids and forehead.

use glam::{Vec2, Vec3};

use super::eyes::{Sheet, both};
use super::face::lid_bulge;
use super::shape::front;
use super::state::{CORNERS, Eye, Face};
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// Height before the skin.
const BEFORE: f32 = 0.0006;
/// What is added to it with shut eyes, whose skin is stretched over few vertices.
const SHUT: f32 = 0.0009;
/// Thickness of the upper lash at the inner end, metres, and how many times that it is at the outer end.
const THIN: f32 = 0.0018;
const HEAVY: f32 = 2.5;
/// Where the wing of the upper lash leaves the lid, and where it ends, from the outer corner.
const LEAVES: f32 = 0.85;
const WING: Vec2 = Vec2::new(0.0062, 0.0034);

/// Lids at `s`, which may lie a little beyond the corners.
fn lid(eye: &Eye, s: f32, lower: bool) -> Vec2 {
    let x = CORNERS[0].x + (CORNERS[1].x - CORNERS[0].x) * s;
    Vec2::new(x, eye.lids(s)[usize::from(lower)])
}

fn before(face: &Face, p: Vec2, lift: f32) -> Vec3 {
    front(p.x, p.y) + Vec3::new(0.25 * lift, 0.0, lift + lid_bulge(p.x, p.y, face) + SHUT * face.eyes[0].shut)
}

/// Thickness of the upper lash along the lid.
fn lash_width(s: f32) -> f32 {
    let s = s.clamp(0.0, 1.0);
    THIN * (1.0 + (HEAVY - 1.0) * s * s * (3.0 - 2.0 * s))
}

/// Direction in which the upper lash grows at `s`: upwards, more and more outwards.
fn lash_up(s: f32) -> Vec2 {
    Vec2::new(-0.35 + 0.85 * s, 1.0).normalize()
}

/// Point of a quadratic curve.
fn bend(a: Vec2, b: Vec2, c: Vec2, t: f32) -> Vec2 {
    a.lerp(b, t).lerp(b.lerp(c, t), t)
}

/// Lower and upper edge of the upper lash at `c`, 0 at its inner end and 1 at the tip of the wing.
fn upper_edges(face: &Face, c: f32) -> [Vec2; 2] {
    /// Shares of the lash along which its upper and its lower edge follow the lid.
    const UPPER: f32 = 0.68;
    const LOWER: f32 = 0.84;
    let eye = &face.eyes[0];
    let asleep = eye.shut * (1.0 - eye.arch);
    let tip = CORNERS[1] + WING + Vec2::new(-0.0008, -0.0085) * asleep;
    let low = |s: f32| lid(eye, s, false) - lash_up(s) * 0.0009;
    // Shut lashes hang down and are thinner.
    let width = |s: f32| 0.0009 + lash_width(s) * (1.0 - 0.25 * asleep) * (1.0 - 0.2 * eye.shut);
    let inner = 0.1 + 0.9 * (c / 0.12).min(1.0).sqrt();
    let high = |s: f32| low(s) + lash_up(s) * width(s) * inner;
    let upper = if c < UPPER {
        high(c / UPPER * LEAVES)
    } else {
        // Runs on in its own direction, then hollow to the tip.
        let (a, b) = (high(LEAVES), high(LEAVES - 0.04));
        let along = (a - b).normalize() * a.distance(tip) * 0.45;
        bend(a, a + along, tip + Vec2::new(0.0002, 0.0003), (c - UPPER) / (1.0 - UPPER))
    };
    let lower = if c < LOWER {
        low(c / LOWER)
    } else {
        let corner = low(1.0);
        bend(corner, corner.lerp(tip, 0.5) + Vec2::new(0.0006, -0.0006), tip, (c - LOWER) / (1.0 - LOWER))
    };
    [lower, upper]
}

fn upper_lash(sheet: &mut Sheet<'_>) {
    sheet.grid(
        4,
        41,
        |r, c| Vec2::new(c, 0.02 + r * 0.36),
        |face, r, c| {
            let [low, high] = upper_edges(face, c);
            before(face, low + (high - low) * (1.0 - r), BEFORE + 0.0006 * (1.0 - r))
        },
    );
    // The crease above the lid.
    sheet.grid(
        3,
        19,
        |r, c| Vec2::new(c, 0.8 + r * 0.18),
        |face, r, c| {
            let eye = &face.eyes[0];
            let s = 0.16 + 0.7 * c;
            let open = Eye::default().lids(s)[0];
            let now = eye.lids(s)[0];
            let y = open + (now - open) * 0.62 + 0.0062 + 0.0014 * c;
            let width = 0.001 * (1.0 - 0.5 * eye.shut) * (4.0 * c * (1.0 - c)).max(0.01).powf(0.7);
            before(face, Vec2::new(lid(eye, s, false).x, y + width * (0.5 - r)), BEFORE)
        },
    );
}

/// On the outer third only, joined to the corner.
fn lower_lash(sheet: &mut Sheet<'_>) {
    sheet.grid(
        3,
        15,
        |r, c| Vec2::new(c, 0.44 + r * 0.26),
        |face, r, c| {
            let eye = &face.eyes[0];
            let s = 0.6 + 0.4 * c;
            let base = lid(eye, s, true);
            let width = 0.0019 * c.max(0.02).powf(0.8) * (1.0 - 0.55 * eye.shut);
            let down = Vec2::new(0.3 * c, -1.0).normalize();
            before(face, base - down * 0.0004 * c + down * width * r, BEFORE)
        },
    );
}

fn brow(sheet: &mut Sheet<'_>) {
    sheet.grid(
        4,
        21,
        |r, c| Vec2::new(c, r),
        |face, r, c| {
            let lift = face.brow.lift;
            let (l0, l1, l2) = (2.0 * (c - 0.5) * (c - 1.0), -4.0 * c * (c - 1.0), 2.0 * c * (c - 0.5));
            let x = 0.0152 + 0.0435 * c - face.brow.frown * (1.0 - c);
            let arch = 1.4425 + 0.009 * (c * 2.05).sin() - 0.0046 * c * c;
            let y = arch + lift[0] * l0 + lift[1] * l1 + lift[2] * l2;
            // Full at the inner end, which is cut round, and one long taper.
            let width = 0.0048
                * (1.0 - (1.0 - (c / 0.11).min(1.0)).powi(2)).max(0.02).sqrt()
                * (1.0 - c).clamp(0.01, 1.0).powf(0.75);
            before(face, Vec2::new(x, y + width * (0.5 - r)), 0.0009)
        },
    );
}

/// Lashes and brows.
pub(super) fn build(skeleton: &Skeleton) -> [Part; 3] {
    [
        both("EyelashUpper", "Eyelash", skeleton, |s, _| upper_lash(s)),
        both("EyelashLower", "Eyelash", skeleton, |s, _| lower_lash(s)),
        both("Brow", "Brow", skeleton, |s, _| brow(s)),
    ]
}
