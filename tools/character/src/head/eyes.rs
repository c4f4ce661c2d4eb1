//! The eyes as stacked planes behind the lids, each a part of its own that can be swapped.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::expressions::STATES;
use super::features::features;
use super::lashes;
use super::shape::{locate, net};
use super::state::{CORNERS, Eye, Face, IRIS, IRIS_RADII};
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// Depth of each layer behind the skin, metres; the back one first.
const SCLERA: f32 = 0.005;
const IRIS_DEPTH: f32 = 0.0042;
const LASH_SHADOW: f32 = 0.0033;
const HIGHLIGHT: [f32; 2] = [0.0029, 0.0026];

/// How far the plane eyes go back where the spherical ones take their place.
const AWAY: Vec3 = Vec3::new(0.0, 0.0, -0.03);

/// A part whose vertices are functions of the state of the left eye; mirrored for the right one.
pub(super) struct Sheet<'a> {
    skeleton: &'a Skeleton,
    part: Part,
}

impl Sheet<'_> {
    /// Adds a grid of vertices, `rows` × `columns`, given by a function of the state, the row and the column (0..1).
    /// Outside is where rows run to her left and the next row lies below.
    pub(super) fn grid(
        &mut self,
        rows: u32,
        columns: u32,
        uv: impl Fn(f32, f32) -> Vec2,
        at: impl Fn(&Face, f32, f32) -> Vec3,
    ) {
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
    let at = locate(x.abs(), y);
    let skin = net(at.x, at.y).z + features(x, y);
    let s = ((x.abs() - CORNERS[0].x) / (CORNERS[1].x - CORNERS[0].x)).clamp(0.0, 1.0);
    let bowl = 4.0 * s * (1.0 - s);
    // Flatter than the skin in its middle.
    let flat = 0.0704 - 0.38 * (x.abs() - 0.0365);
    let surface = skin + (flat.min(skin + 0.001) - skin) * 0.5 * bowl;
    Vec3::new(x, y, surface - depth * (0.25 + 0.75 * bowl.sqrt()))
}

/// Both sides of an eye part. `make` builds the left one; it is called with -1 for the one that will be mirrored.
pub(super) fn both(
    name: &str,
    material: &'static str,
    skeleton: &Skeleton,
    make: impl Fn(&mut Sheet<'_>, f32),
) -> Part {
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
    parts.extend(lashes::build(skeleton));
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
        // Falls as the lid falls, and never beyond the lower one; deeper towards the nose, where the lid overhangs.
        let full = 0.0078 - 0.0022 * c;
        let depth = full.min((upper - lower).max(0.0) * 0.6 + 0.0004);
        let x = CORNERS[0].x + (CORNERS[1].x - CORNERS[0].x) * s;
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
