//! What lies behind the openings of the face: a socket behind the lids of each eye, a pocket behind the lips.

use glam::{Vec2, Vec3};

use super::face::{add_morphs, moved, uv, weights};
use super::grid::{EYE_FIRST, EYE_LAST, Grid, LID, LID_END, LIP, LIP_END, MOUTH_COLUMNS};
use super::shape::{front, net};
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// The socket behind the lids of one eye: an undercut wall and a floor.
pub(super) fn socket(skeleton: &Skeleton, grid: &Grid, point: &impl Fn(usize, usize) -> Vec3, sign: f32) -> Part {
    let (rows, columns) = (LID_END - LID + 1, EYE_LAST - EYE_FIRST + 1);
    let middle = point((LID + LID_END) / 2, (EYE_FIRST + EYE_LAST) / 2).truncate();
    let mut part = Part::new("Face", "Face");
    let mut edge = Vec::new();
    for r in 0..rows {
        for c in 0..columns {
            let p = point(LID + r, EYE_FIRST + c);
            let border = r == 0 || c == 0 || r == rows - 1 || c == columns - 1;
            let second = !border && (r == 1 || c == 1 || r == rows - 2 || c == columns - 2);
            let back = if border {
                p
            } else if second {
                // Behind the border, a little outwards, so that the lids hide the wall.
                let (br, bc) = (
                    if r == 1 {
                        0
                    } else if r == rows - 2 {
                        rows - 1
                    } else {
                        r
                    },
                    if c == 1 {
                        0
                    } else if c == columns - 2 {
                        columns - 1
                    } else {
                        c
                    },
                );
                let b = point(LID + br, EYE_FIRST + bc);
                let out = (b.truncate() - middle) * 0.06;
                Vec3::new(b.x + out.x, b.y + out.y, b.z - 0.0075)
            } else {
                let at = grid[LID + r][EYE_FIRST + c];
                let q = net(at.x, at.y);
                Vec3::new(q.x, q.y, front(q.x, q.y).z - 0.0105)
            };
            let flip = |q: Vec3| Vec3::new(q.x * sign, q.y, q.z);
            // The wall is painted like the floor: it shows in profile.
            let inward = if second {
                (back.truncate() - middle) * 0.22
            } else {
                Vec2::ZERO
            };
            part.vertex(flip(back), flip_u(uv(back - inward.extend(0.0), 0.0), sign), weights(skeleton, p));
            edge.push(border.then(|| flip(p)));
        }
    }
    let quads = |part: &mut Part, a: u32, b: u32, c: u32, d: u32| {
        if sign > 0.0 {
            part.quad(a, b, c, d)
        } else {
            part.quad(d, c, b, a)
        }
    };
    for r in 0..rows as u32 - 1 {
        for c in 0..columns as u32 - 1 {
            let i = r * columns as u32 + c;
            let below = i + columns as u32;
            quads(&mut part, i, below, below + 1, i + 1);
        }
    }
    part.smooth_normals();
    add_morphs(&mut part, 0, |i, state| edge[i].map(|p| moved(p, LID, state) - p));
    // Makes room for the spherical eyes.
    for i in (0..part.vertices.len()).filter(|i| edge[*i].is_none()) {
        part.offset("eyeballs", i as u32, Vec3::new(0.0, 0.0, -0.024));
    }
    part
}

fn flip_u(uv: Vec2, sign: f32) -> Vec2 {
    Vec2::new(0.5 + (uv.x - 0.5) * sign, uv.y)
}

/// The pocket behind the lips, in the material of the mouth.
pub(super) fn pocket(skeleton: &Skeleton, point: &impl Fn(usize, usize) -> Vec3) -> Part {
    let mut part = Part::new("Mouth", "Mouth");
    let (rows, columns) = (LIP_END - LIP + 1, 2 * MOUTH_COLUMNS + 1);
    // Depth behind the lips and height of each row of the pocket.
    const DEPTH: [f32; 5] = [0.0, 0.007, 0.03, 0.007, 0.0];
    const RISE: [f32; 5] = [0.0, 0.0045, 0.0, -0.0045, 0.0];
    let mut anchors = Vec::new();
    for r in 0..rows {
        for c in 0..columns {
            let (k, sign) = if c < MOUTH_COLUMNS {
                (MOUTH_COLUMNS - c, -1.0)
            } else {
                (c - MOUTH_COLUMNS, 1.0)
            };
            let skin = |row: usize| {
                let p = point(row, k);
                Vec3::new(p.x * sign, p.y, p.z)
            };
            let p = skin(LIP + r);
            let inside = if k == MOUTH_COLUMNS { 0.0 } else { 1.0 };
            let q = Vec3::new(p.x, p.y + RISE[r] * inside, p.z - DEPTH[r] * inside);
            let at = Vec2::new(c as f32 / (columns - 1) as f32, r as f32 / (rows - 1) as f32 * 0.5);
            part.vertex(q, at, weights(skeleton, p));
            anchors.push(match r {
                0 | 1 => [skin(LIP), skin(LIP)],
                3 | 4 => [skin(LIP_END), skin(LIP_END)],
                _ => [skin(LIP), skin(LIP_END)],
            });
        }
    }
    part.quads(0, rows as u32, columns as u32, false);
    part.smooth_normals();
    add_morphs(&mut part, 0, |i, state| {
        let [a, b] = anchors[i];
        Some(((moved(a, LIP, state) - a) + (moved(b, LIP, state) - b)) * 0.5)
    });
    part
}
