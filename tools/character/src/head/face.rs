//! The skin of the head: a closed grid of quads whose lines run round the eyes and the mouth, with sockets behind the
//! lids and a pocket behind the lips.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::expressions::STATES;
use super::shape::{self, HAIRLINE_ROW, JAW_ROW, LAST_ROW, front, locate, net, proxy_normal};
use super::state::{CORNERS, Eye, Face, Mouth};
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::{Skeleton, Weights, blend};

/// Columns of half a head.
const HALF: usize = 38;
/// Columns of the mouth's half, and of the eye.
const MOUTH_COLUMNS: usize = 6;
const EYE_FIRST: usize = 7;
const EYE_LAST: usize = 21;
/// Rows: hairline, upper and lower lid, upper and lower lip, edge of the jaw, last.
const HAIRLINE: usize = 4;
const LID: usize = 11;
const LID_END: usize = LID + 6;
const LIP: usize = LID_END + 8;
const LIP_END: usize = LIP + 4;
const JAW: usize = LIP_END + 6;
const ROWS: usize = JAW + 10;

/// A vertex of the grid's left half: where it stands on the net, and on the face's front projection.
type Grid = Vec<Vec<Vec2>>;

/// Eye openings run from the inner to the outer corner; the sides of the block share a piece at each corner.
const CORNER_SHARE: f32 = 0.07;

fn start() -> Grid {
    let rows = [
        (0, 0.0),
        (HAIRLINE, HAIRLINE_ROW),
        (LID, 6.05),
        (LID_END, 7.6),
        (LIP, 9.85),
        (LIP_END, 10.15),
        (JAW, JAW_ROW),
        (JAW + 3, 14.0),
        (JAW + 6, 16.0),
        (ROWS - 1, LAST_ROW),
    ];
    let columns = [(0, 0.0), (EYE_FIRST, 0.86), (EYE_LAST, 3.2), (EYE_LAST + 4, 4.35), (HALF, 8.0)];
    let at = |table: &[(usize, f32)], i: usize| {
        let k = table.iter().rposition(|(n, _)| *n <= i).unwrap_or(0).min(table.len() - 2);
        let ((a, x), (b, y)) = (table[k], table[k + 1]);
        x + (y - x) * (i - a) as f32 / (b - a) as f32
    };
    (0..ROWS).map(|r| (0..=HALF).map(|c| Vec2::new(at(&columns, c), at(&rows, r))).collect()).collect()
}

/// Places along the lids at which vertices of the grid stand, 0 at the inner and 1 at the outer corner.
pub(super) fn lid_columns() -> impl Iterator<Item = f32> {
    (EYE_FIRST..=EYE_LAST).map(lid_column)
}

fn lid_column(column: usize) -> f32 {
    let across = (column - EYE_FIRST) as f32 / (EYE_LAST - EYE_FIRST) as f32;
    CORNER_SHARE + (1.0 - 2.0 * CORNER_SHARE) * across
}

/// Point of the lids at a place on the border of the eye's block.
fn lid_point(row: usize, column: usize) -> Vec2 {
    let eye = Eye::default();
    let s = lid_column(column);
    let down = (row - LID) as f32 / (LID_END - LID) as f32;
    let on = |s: f32, lower: bool| {
        let x = CORNERS[0].x + (CORNERS[1].x - CORNERS[0].x) * s;
        Vec2::new(x, eye.lids(s)[usize::from(lower)])
    };
    if row == LID || row == LID_END {
        on(s, row == LID_END)
    } else {
        // Through the corner: s falls to 0 (or rises to 1) and comes back on the other lid. Squared, because the lids
        // meet at a round corner.
        let t = (1.0 - 2.0 * down).abs();
        let near = CORNER_SHARE * t * t;
        on(if column == EYE_FIRST { near } else { 1.0 - near }, down > 0.5)
    }
}

fn lip_point(row: usize, column: usize) -> Vec2 {
    // Denser at the corners, where an open mouth is round.
    let q = (column as f32 / MOUTH_COLUMNS as f32 * PI * 0.5).sin();
    let [x, upper, lower] = Mouth::default().lips(q);
    Vec2::new(x, upper + (lower - upper) * (row - LIP) as f32 / (LIP_END - LIP) as f32)
}

fn in_eye(row: usize, column: usize) -> bool {
    (LID..=LID_END).contains(&row) && (EYE_FIRST..=EYE_LAST).contains(&column)
}

fn in_mouth(row: usize, column: usize) -> bool {
    (LIP..=LIP_END).contains(&row) && column <= MOUTH_COLUMNS
}

/// The grid on the net: its lines are drawn to lids and lips, and evened out between them.
fn relaxed() -> Grid {
    let mut grid = start();
    let mut fixed = vec![vec![false; HALF + 1]; ROWS];
    for r in 0..ROWS {
        for c in 0..=HALF {
            fixed[r][c] = r <= HAIRLINE || r >= JAW;
            let border = r == LID || r == LID_END || c == EYE_FIRST || c == EYE_LAST;
            if in_eye(r, c) && border {
                let p = lid_point(r, c);
                grid[r][c] = locate(p.x, p.y);
                fixed[r][c] = true;
            }
            if in_mouth(r, c) {
                let p = lip_point(r, c);
                grid[r][c] = locate(p.x, p.y);
                fixed[r][c] = true;
            }
        }
    }
    for _ in 0..400 {
        for r in HAIRLINE + 1..JAW {
            for c in 0..=HALF {
                if fixed[r][c] {
                    continue;
                }
                let mirror = |p: Vec2, axis: f32| Vec2::new(2.0 * axis - p.x, p.y);
                let left = if c == 0 {
                    mirror(grid[r][1], 0.0)
                } else {
                    grid[r][c - 1]
                };
                let right = if c == HALF {
                    mirror(grid[r][HALF - 1], 8.0)
                } else {
                    grid[r][c + 1]
                };
                let mean = (left + right + grid[r - 1][c] + grid[r + 1][c]) * 0.25;
                let here = grid[r][c];
                grid[r][c] = here + (mean - here) * 1.6;
            }
        }
    }
    grid
}

/// Texture coordinates: seen from the front, u and v are x and y; the sides go on round the head.
#[must_use]
pub fn uv(p: Vec3, below_jaw: f32) -> Vec2 {
    let angle = p.x.abs().atan2(p.z - shape::SKULL_CENTER.z);
    let straight = p.x.abs() / super::UV_METRES;
    let around = 0.22 + (angle - PI / 3.0) / (PI * 2.0 / 3.0) * 0.275;
    let u = straight + (around - straight) * smoothstep(0.55, 1.05, angle);
    Vec2::new(0.5 + u * p.x.signum(), (super::UV_TOP - p.y + below_jaw) / super::UV_METRES)
}

/// Bones of the head and the neck.
fn weights(skeleton: &Skeleton, p: Vec3) -> Weights {
    let [head, neck, chest] = ["head", "neck", "upperChest"].map(|n| skeleton.find(n));
    // The skull tilts as a whole; only the neck bends.
    let axis = p.y + (p.z + 0.022) * 0.12;
    let up = smoothstep(1.262, 1.318, axis);
    let low = 1.0 - smoothstep(1.212, 1.262, p.y);
    blend(&[(head, up), (neck, (1.0 - up) * (1.0 - low)), (chest, (1.0 - up) * low)])
}

/// Height that the shut lid bulges over the eye.
pub(super) fn lid_bulge(x: f32, y: f32, face: &Face) -> f32 {
    let eye = &face.eyes[usize::from(x < 0.0)];
    let (dx, dy) = ((x.abs() - 0.0365) / 0.02, (y - 1.409) / 0.013);
    0.0026 * eye.shut * (-dx * dx - dy * dy).exp()
}

/// Where the skin that rests at `p` is in this state.
fn moved(p: Vec3, row: usize, face: &Face) -> Vec3 {
    let to = face.skin(p.x, p.y);
    if to == p.truncate() {
        return p;
    }
    // Under the jaw the skin does not slide over the front of the face; the pull fades towards the neck.
    let row = row as f32 - JAW as f32;
    let slide = smoothstep(0.0, -3.0, row);
    let rise = if slide > 0.0 {
        front(to.x, to.y).z - front(p.x, p.y).z
    } else {
        0.0
    };
    let pull = (to - p.truncate()) * smoothstep(6.0, 0.0, row);
    Vec3::new(p.x + pull.x, p.y + pull.y, p.z + rise * slide + lid_bulge(to.x, to.y, face))
}

/// Adds the offsets of every state to vertices that move with the skin. `follow` gives the places that they follow.
pub(super) fn add_morphs(part: &mut Part, first: usize, follow: impl Fn(usize, &Face) -> Option<Vec3>) {
    for (name, state) in STATES {
        for i in first..part.vertices.len() {
            let Some(offset) = follow(i, &state()) else { continue };
            if offset.length() > 2e-6 {
                part.offset(name, i as u32, offset);
            }
        }
    }
}

/// Skin, sockets and the pocket of the mouth.
pub(super) fn build(skeleton: &Skeleton) -> [Part; 2] {
    let grid = relaxed();
    let point = |r: usize, c: usize| {
        let at = grid[r][c];
        let mut p = net(at.x, at.y);
        if r > HAIRLINE && r <= JAW + 1 && at.x < 5.0 {
            p.z += shape::features(p.x, p.y) * smoothstep(4.6, 3.6, at.x);
        }
        if c == 0 || c == HALF {
            p.x = 0.0;
        }
        p
    };
    // Length below the edge of the jaw, for the texture: height says little there.
    let below: Vec<Vec<f32>> = (0..ROWS)
        .map(|r| {
            (0..=HALF)
                .map(|c| {
                    let path = |k: usize| point(k - 1, c).distance(point(k, c));
                    let length: f32 = (JAW + 1..=r).map(path).sum();
                    if r > JAW {
                        length * 0.65 + point(r, c).y - point(JAW, c).y
                    } else {
                        0.0
                    }
                })
                .collect()
        })
        .collect();

    let mut skin = Part::new("Face", "Face");
    // Two vertices stand at the middle of the back, where the texture ends on either side.
    let columns = 2 * HALF + 1;
    // From the back over her right side to the front, and over her left to the back.
    let place = |c: usize| {
        let (k, sign) = if c <= HALF { (HALF - c, -1.0) } else { (c - HALF, 1.0) };
        (k, sign)
    };
    for r in 0..ROWS {
        for c in 0..columns {
            let (k, sign) = place(c);
            let p = point(r, k);
            let mut at = uv(p, below[r][k]);
            let flat = Vec2::new(0.5 + (at.x - 0.5) * sign, at.y);
            if k == HALF {
                at = Vec2::new(0.5 + 0.495 * sign, at.y);
            } else {
                at = flat;
            }
            let p = Vec3::new(p.x * sign, p.y, p.z);
            skin.vertex(p, at, weights(skeleton, p));
        }
    }
    let index = |r: usize, c: usize| (r * columns + c) as u32;
    for r in 0..ROWS - 1 {
        for c in 0..columns - 1 {
            let (a, b) = (place(c).0, place(c + 1).0);
            let k = a.min(b);
            let in_block = (LID..LID_END).contains(&r) && (EYE_FIRST..EYE_LAST).contains(&k)
                || (LIP..LIP_END).contains(&r) && k < MOUTH_COLUMNS;
            if !in_block {
                skin.quad(index(r, c), index(r + 1, c), index(r + 1, c + 1), index(r, c + 1));
            }
        }
    }
    close_ends(&mut skin, skeleton, columns);
    let on_face = skin.vertices.len();

    let rows: Vec<(usize, usize)> =
        (0..on_face.min(ROWS * columns)).map(|i| (i / columns, place(i % columns).0)).collect();
    skin.smooth_normals();
    edit_normals(&mut skin, &rows);
    let rest: Vec<Vec3> = skin.vertices.iter().map(|v| v.position).collect();
    add_morphs(&mut skin, 0, |i, state| {
        let (r, k) = *rows.get(i)?;
        (r > HAIRLINE && r < JAW + 6 && k < EYE_LAST + 5).then(|| moved(rest[i], r, state) - rest[i])
    });

    for sign in [1.0, -1.0] {
        let socket = socket(skeleton, &grid, &point, sign);
        skin.append(&socket);
    }
    [skin, pocket(skeleton, &point)]
}

/// Caps the crown and the bottom of the neck.
fn close_ends(skin: &mut Part, skeleton: &Skeleton, columns: usize) {
    let ring = |r: usize| -> Vec<u32> { (0..columns - 1).map(|c| (r * columns + c) as u32).collect() };
    let crown = Vec3::new(0.0, 1.55, -0.012);
    let top = skin.vertex(crown, Vec2::new(0.5, 0.01), weights(skeleton, crown));
    let bottom = Vec3::new(0.0, 1.205, -0.0225);
    let low = skin.vertex(bottom, Vec2::new(0.5, 0.995), weights(skeleton, bottom));
    let (first, last) = (ring(0), ring(ROWS - 1));
    for i in 0..first.len() {
        let next = (i + 1) % first.len();
        skin.triangles.push([first[i], first[next], top]);
        skin.triangles.push([last[next], last[i], low]);
    }
}

/// Normals of the face follow the proxy, as studios edit them: the border of light and shade stays one calm curve.
fn edit_normals(skin: &mut Part, rows: &[(usize, usize)]) {
    for (v, (r, _)) in skin.vertices.iter_mut().zip(rows) {
        let p = v.position;
        let above_jaw = 1.0 - smoothstep(JAW as f32 - 2.5, JAW as f32 + 0.6, *r as f32);
        let share = 0.9 * above_jaw * smoothstep(-0.03, 0.005, p.z);
        v.normal = v.normal.lerp(proxy_normal(p), share).normalize();
    }
}

/// The socket behind the lids of one eye: an undercut wall and a floor.
fn socket(skeleton: &Skeleton, grid: &Grid, point: &impl Fn(usize, usize) -> Vec3, sign: f32) -> Part {
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
fn pocket(skeleton: &Skeleton, point: &impl Fn(usize, usize) -> Vec3) -> Part {
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
