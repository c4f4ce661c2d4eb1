//! The eyes as stacked planes behind the lids, each a part of its own that can be swapped; lashes and brows before the
//! face.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::expressions::STATES;
use super::face::lid_bulge;
use super::shape::{front, net};
use super::state::{CORNERS, Eye, Face, IRIS, IRIS_RADII};
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// Depth of each layer behind the skin, metres; the back one first.
const SCLERA: f32 = 0.005;
const IRIS_DEPTH: f32 = 0.0042;
const LASH_SHADOW: f32 = 0.0033;
const HIGHLIGHT: [f32; 2] = [0.0029, 0.0026];
/// Height of lashes and brows before the skin.
const BEFORE: f32 = 0.0006;

/// How far the plane eyes go back where the spherical ones take their place.
const AWAY: Vec3 = Vec3::new(0.0, 0.0, -0.03);

/// A part whose vertices are functions of the state of the left eye; mirrored for the right one.
struct Sheet<'a> {
    skeleton: &'a Skeleton,
    part: Part,
}

impl Sheet<'_> {
    /// Adds a grid of vertices, `rows` × `columns`, given by a function of the state, the row and the column (0..1).
    /// Outside is where rows run to her left and the next row lies below.
    fn grid(&mut self, rows: u32, columns: u32, uv: impl Fn(f32, f32) -> Vec2, at: impl Fn(&Face, f32, f32) -> Vec3) {
        let first = self.part.vertices.len();
        let weights = self.skeleton.only("head");
        let place = |i: usize| {
            let (r, c) = (i as u32 / columns, i as u32 % columns);
            (r as f32 / (rows - 1) as f32, c as f32 / (columns - 1) as f32)
        };
        let rest = Face::default();
        for i in 0..(rows * columns) as usize {
            let (r, c) = place(i);
            self.part.vertex(at(&rest, r, c), uv(r, c), weights);
        }
        self.part.quads(first as u32, rows, columns, false);
        for (name, state) in STATES {
            // Sided morphs of the right eye come from mirroring.
            if *name == "blinkRight" {
                continue;
            }
            let state = state();
            for i in 0..(rows * columns) as usize {
                let (r, c) = place(i);
                let offset = at(&state, r, c) - at(&rest, r, c);
                if offset.length() > 2e-6 {
                    self.part.offset(name, (first + i) as u32, offset);
                }
            }
        }
    }
}

/// A layer of the eye, `depth` metres behind the skin in its middle. Layers rise to the lids at both corners like a bowl,
/// so that a view from the side meets the white of the eye and not the wall of the socket.
fn layer(x: f32, y: f32, depth: f32) -> Vec3 {
    let at = super::shape::locate(x.abs(), y);
    let skin = net(at.x, at.y).z + super::shape::features(x, y);
    let s = ((x.abs() - CORNERS[0].x) / (CORNERS[1].x - CORNERS[0].x)).clamp(0.0, 1.0);
    let bowl = 4.0 * s * (1.0 - s);
    // Flatter than the skin in its middle.
    let flat = 0.0742 - 0.42 * (x.abs() - 0.0365);
    let surface = skin + (flat.min(skin + 0.001) - skin) * 0.5 * bowl;
    Vec3::new(x, y, surface - depth * (0.25 + 0.75 * bowl.sqrt()))
}

/// Both sides of an eye part. `make` builds the left one; it is called with -1 for the one that will be mirrored.
fn both(name: &str, material: &'static str, skeleton: &Skeleton, make: impl Fn(&mut Sheet<'_>, f32)) -> Part {
    let [left, right] = [1.0, -1.0].map(|side| {
        let mut sheet = Sheet { skeleton, part: Part::new(name, material) };
        make(&mut sheet, side);
        sheet.part.smooth_normals();
        for v in &mut sheet.part.vertices {
            // Eyes are lit as the plane of the face is.
            v.normal = v.normal.lerp(Vec3::Z, 0.7).normalize();
        }
        sheet.part
    });
    let mut part = left;
    part.append(&right.mirrored(skeleton));
    part
}

/// Lids at `s`, which may lie a little beyond the corners.
fn lid(eye: &Eye, s: f32, lower: bool) -> Vec2 {
    let x = CORNERS[0].x + (CORNERS[1].x - CORNERS[0].x) * s;
    Vec2::new(x, eye.lids(s)[usize::from(lower)])
}

/// Unit normal of a lid, pointing away from the opening of an upper lid.
fn lid_normal(eye: &Eye, s: f32, lower: bool) -> Vec2 {
    let (a, b) = ((s - 0.04).max(0.0), (s + 0.04).min(1.0));
    (lid(eye, b, lower) - lid(eye, a, lower)).perp().normalize_or(Vec2::Y)
}

fn before(face: &Face, p: Vec2, lift: f32) -> Vec3 {
    front(p.x, p.y) + Vec3::new(0.25 * lift, 0.0, lift + lid_bulge(p.x, p.y, face))
}

/// All parts of the plane eyes, the lashes and the brows.
pub(super) fn build(skeleton: &Skeleton) -> Vec<Part> {
    let mut parts = vec![
        both("EyeWhite", "EyeWhite", skeleton, |s, _| sclera(s)),
        both("EyeIris", "EyeIris", skeleton, |s, _| iris(s)),
        both("EyelashShadow", "EyelashShadow", skeleton, |s, _| lash_shadow(s)),
        both("EyeHighlight1", "EyeHighlight", skeleton, |s, side| highlight(s, side, 0)),
        both("EyeHighlight2", "EyeHighlight", skeleton, |s, side| highlight(s, side, 1)),
    ];
    for part in &mut parts {
        for i in 0..part.vertices.len() as u32 {
            part.offset("eyeballs", i, AWAY);
        }
    }
    parts.push(both("EyelashUpper", "Eyelash", skeleton, |s, _| upper_lash(s)));
    parts.push(both("EyelashLower", "Eyelash", skeleton, |s, _| lower_lash(s)));
    parts.push(both("Brow", "Brow", skeleton, |s, _| brow(s)));
    parts
}

fn sclera(sheet: &mut Sheet<'_>) {
    // Follows the open lids and goes on a little behind them.
    let eye = Eye::default();
    sheet.grid(
        9,
        15,
        |r, c| Vec2::new(c, r),
        |_, r, c| {
            let s = -0.04 + 1.08 * c;
            let [upper, lower] = eye.lids(s);
            let x = CORNERS[0].x + (CORNERS[1].x - CORNERS[0].x) * s;
            let (top, bottom) = (upper + 0.0022, lower - 0.0022);
            layer(x, top + (bottom - top) * r, SCLERA)
        },
    );
}

/// Middle of the iris of the left eye.
fn iris_middle(face: &Face) -> Vec2 {
    IRIS + face.eyes[0].gaze
}

fn iris(sheet: &mut Sheet<'_>) {
    // A disc of rings; its normal looks forward.
    disc(sheet, 4, 32, |face, d| {
        let radii = IRIS_RADII * (1.0 + face.eyes[0].iris);
        let p = iris_middle(face) + d * radii;
        // Slightly hollow, so that the iris seems to follow the viewer.
        layer(p.x, p.y, IRIS_DEPTH) - Vec3::Z * 0.0004 * (1.0 - d.length_squared())
    });
}

/// A disc given by a function of the state and a point of the unit disc.
fn disc(sheet: &mut Sheet<'_>, rings: u32, steps: u32, at: impl Fn(&Face, Vec2) -> Vec3) {
    let first = sheet.part.vertices.len();
    let weights = sheet.skeleton.only("head");
    let place = |i: usize| {
        if i == 0 {
            return Vec2::ZERO;
        }
        let (ring, step) = ((i as u32 - 1) / steps + 1, (i as u32 - 1) % steps);
        Vec2::from_angle(step as f32 / steps as f32 * TAU) * (ring as f32 / rings as f32)
    };
    let count = (rings * steps + 1) as usize;
    let rest = Face::default();
    for i in 0..count {
        let d = place(i);
        sheet.part.vertex(at(&rest, d), Vec2::new(0.5 + d.x * 0.49, 0.5 - d.y * 0.49), weights);
    }
    let f = first as u32;
    for s in 0..steps {
        let next = (s + 1) % steps;
        sheet.part.triangles.push([f, f + 1 + s, f + 1 + next]);
        for r in 0..rings - 1 {
            let (inner, outer) = (f + 1 + r * steps, f + 1 + (r + 1) * steps);
            sheet.part.quad(inner + s, outer + s, outer + next, inner + next);
        }
    }
    for (name, state) in STATES.iter().filter(|(name, _)| *name != "blinkRight") {
        let state = state();
        for i in 0..count {
            let offset = at(&state, place(i)) - at(&rest, place(i));
            if offset.length() > 2e-6 {
                sheet.part.offset(name, (first + i) as u32, offset);
            }
        }
    }
}

fn lash_shadow(sheet: &mut Sheet<'_>) {
    let uv = |r: f32, c: f32| Vec2::new(c, r);
    sheet.grid(4, 17, uv, |face, r, c| {
        let eye = &face.eyes[0];
        let s = 0.01 + 0.98 * c;
        let [upper, lower] = eye.lids(s);
        // Falls as the lid falls, and never beyond the lower one.
        let depth = 0.0078f32.min((upper - lower).max(0.0) * 0.6 + 0.0004);
        let x = lid(eye, s, false).x;
        layer(x, upper + 0.003 - (depth + 0.003) * r, LASH_SHADOW)
    });
}

fn highlight(sheet: &mut Sheet<'_>, side: f32, which: usize) {
    // A large one above, a small one below on the other side; on the same side in both eyes, as the light is.
    let (offset, radii) = [
        (Vec2::new(-0.0044, 0.0066), Vec2::new(0.0038, 0.0047)),
        (Vec2::new(0.0052, -0.0078), Vec2::new(0.0021, 0.0025)),
    ][which];
    disc(sheet, 1, 20, |face, d| {
        let p = iris_middle(face) + Vec2::new(offset.x * side, offset.y) + d * radii;
        layer(p.x, p.y, HIGHLIGHT[which])
    });
}

/// Thickness of the upper lash along the lid, metres.
fn lash_width(s: f32) -> f32 {
    let s = s.clamp(0.0, 1.0);
    0.0009 + 0.0034 * s.powf(0.7) * (1.0 - 0.3 * s * s)
}

/// Where the wing of the upper lash ends, from the outer corner.
const WING: Vec2 = Vec2::new(0.0078, 0.0024);

/// Direction in which the upper lash grows at `s`: upwards, more and more outwards.
fn lash_up(s: f32) -> Vec2 {
    Vec2::new(-0.35 + 0.85 * s, 1.0).normalize()
}

fn upper_lash(sheet: &mut Sheet<'_>) {
    let uv = |r: f32, c: f32| Vec2::new(c, r * 0.5);
    // The line along the lid, thin at the inner corner, ending in a wing beyond the outer one.
    const ON_LID: f32 = 0.8;
    sheet.grid(4, 37, uv, |face, r, c| {
        let eye = &face.eyes[0];
        let s = (c / ON_LID).min(1.0);
        let up = lash_up(s);
        // Shut lashes hang down.
        let turn = 1.0 - 0.25 * eye.shut * (1.0 - eye.arch);
        let width = lash_width(s) * (1.0 - 0.2 * eye.shut);
        let inner = 0.15 + 0.85 * (c / 0.08).min(1.0).sqrt();
        let low = lid(eye, s, false) - up * 0.0009;
        let high = low + up * (0.0009 + width * turn) * inner;
        let beyond = ((c - ON_LID) / (1.0 - ON_LID)).max(0.0);
        let tip = CORNERS[1] + WING + Vec2::new(-0.0006, -0.0068) * eye.shut * (1.0 - eye.arch);
        // Both edges run to the tip of the wing; the lower one hollow, the upper one full.
        let low = low.lerp(tip, beyond) + Vec2::new(0.0, 0.0011) * (beyond * (1.0 - beyond)) * 4.0;
        let high = high.lerp(tip + Vec2::new(0.0002, 0.0002), beyond)
            + Vec2::new(0.0004, 0.0006) * (beyond * (1.0 - beyond)) * 4.0;
        before(face, low + (high - low) * (1.0 - r), BEFORE + 0.0006 * (1.0 - r))
    });
    // A second lash beside the wing.
    {
        let (at, length, lean, wide) = (0.84, 0.0054, 0.72f32, 0.1f32);
        sheet.grid(
            4,
            3,
            |r, c| Vec2::new(0.5 + 0.1 * c, r * 0.5),
            |face, r, c| {
                let eye = &face.eyes[0];
                let (t, shut) = (1.0 - r, eye.shut * (1.0 - 0.8 * eye.arch));
                let s = at + wide * (c - 0.5) * (1.0 - 0.94 * t);
                let up = lash_up(s);
                let root = lid(eye, s.min(1.0), false) + up * lash_width(s) * 0.55 * (1.0 - 0.75 * shut);
                let direction = Vec2::from_angle(lean - 1.3 * lean * shut - 0.3 * shut);
                // Swung upwards.
                let p = root + direction * length * t + direction.perp() * length * 0.28 * t * t;
                before(face, p, BEFORE + 0.0004 + 0.001 * t)
            },
        );
    }
    // The crease above the lid.
    sheet.grid(3, 15, uv, |face, r, c| {
        let eye = &face.eyes[0];
        let s = 0.2 + 0.72 * c;
        let open = Eye::default().lids(s)[0];
        let now = eye.lids(s)[0];
        let y = open + (now - open) * 0.62 + 0.0052 + 0.0006 * c;
        let width = 0.00085 * (1.0 - 0.5 * eye.shut) * (4.0 * c * (1.0 - c)).max(0.02).sqrt();
        let x = lid(eye, s, false).x;
        before(face, Vec2::new(x, y + width * (0.5 - r)), BEFORE)
    });
}

fn lower_lash(sheet: &mut Sheet<'_>) {
    let uv = |r: f32, c: f32| Vec2::new(c, 0.5 + r * 0.5);
    sheet.grid(3, 17, uv, |face, r, c| {
        let eye = &face.eyes[0];
        let s = 0.36 + 0.63 * c;
        let base = lid(eye, s, true);
        let down = -lid_normal(eye, s, true);
        let width = 0.0017 * (c.max(0.02) * 1.3).min(1.0) * (1.0 - 0.4 * c.powi(6)) * (1.0 - 0.55 * eye.shut);
        before(face, base - down * 0.0003 + down * width * r, BEFORE)
    });
}

fn brow(sheet: &mut Sheet<'_>) {
    let uv = |r: f32, c: f32| Vec2::new(c, r);
    sheet.grid(4, 19, uv, |face, r, c| {
        let lift = face.brow.lift;
        let (l0, l1, l2) = (2.0 * (c - 0.5) * (c - 1.0), -4.0 * c * (c - 1.0), 2.0 * c * (c - 0.5));
        let x = 0.0156 + 0.0435 * c - face.brow.frown * (1.0 - c);
        let arch = 1.4412 + 0.0094 * (c * 2.1).sin() - 0.0048 * c * c;
        let y = arch + lift[0] * l0 + lift[1] * l1 + lift[2] * l2;
        // Full near the inner end, a long taper to the outer one.
        let width = 0.0046 * (c / 0.12).clamp(0.1, 1.0).sqrt() * (1.0 - c).clamp(0.02, 1.0).powf(0.6);
        before(face, Vec2::new(x, y + width * (0.55 - r)), 0.0014)
    });
}
