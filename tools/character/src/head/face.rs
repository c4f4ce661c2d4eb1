//! The skin of the head: a closed grid of quads whose lines run round the eyes and the mouth.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::cavities::{pocket, socket};
use super::expressions::STATES;
use super::features::features;
use super::grid::{EYE_FIRST, EYE_LAST, HAIRLINE, HALF, JAW, LID, LID_END, LIP, LIP_END, MOUTH_COLUMNS, ROWS, relaxed};
use super::shape::{self, front, net, proxy_normal};
use super::state::Face;
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::{Skeleton, Weights, blend};

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
pub(super) fn weights(skeleton: &Skeleton, p: Vec3) -> Weights {
    weights_with(skeleton, p, 1.0)
}

/// Most that the head holds of the skin under the jaw. Looks take what does not follow the head for neck, and that is where
/// the shade of the neck begins.
const UNDER_JAW: f32 = 0.83;

/// With a limit to the share of the head.
fn weights_with(skeleton: &Skeleton, p: Vec3, most: f32) -> Weights {
    let [head, neck, chest] = ["head", "neck", "upperChest"].map(|n| skeleton.find(n));
    // The skull tilts as a whole; only the neck bends.
    let axis = p.y + (p.z + 0.022) * 0.12;
    let up = smoothstep(1.262, 1.318, axis).min(most);
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
pub(super) fn moved(p: Vec3, row: usize, face: &Face) -> Vec3 {
    let to = face.skin(p.x, p.y);
    if to == p.truncate() {
        return p;
    }
    // Under the jaw the skin does not slide over the front of the face; the pull fades towards the neck.
    let row = row as f32 - JAW as f32;
    let slide = smoothstep(0.0, -5.0, row);
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
            p.z += features(p.x, p.y) * smoothstep(4.6, 3.6, at.x);
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
            let most = if r > JAW { UNDER_JAW } else { 1.0 };
            skin.vertex(p, at, weights_with(skeleton, p, most));
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

/// Normals of the face follow the proxy, as studios edit them: the border of light and shade stays one calm curve. Those
/// under the jaw and on the neck, down to the collar, look down, so that both lie in the head's shade as a whole.
fn edit_normals(skin: &mut Part, rows: &[(usize, usize)]) {
    for (v, (r, _)) in skin.vertices.iter_mut().zip(rows) {
        let p = v.position;
        let above_jaw = 1.0 - smoothstep(JAW as f32 - 2.0, JAW as f32 + 0.6, *r as f32);
        let share = 0.9 * above_jaw * smoothstep(-0.03, 0.005, p.z);
        v.normal = v.normal.lerp(proxy_normal(p), share).normalize();
        let below = smoothstep(JAW as f32, JAW as f32 + 1.5, *r as f32) * smoothstep(1.24, 1.255, p.y);
        // Down, and inwards as far as that does not gainsay the surface.
        let flat = v.normal.with_y(0.0);
        let outward = ((v.normal.y - 0.035) / flat.length_squared().max(0.05)).max(-0.25);
        v.normal = v.normal.lerp((flat * outward - Vec3::Y).normalize(), below).normalize();
    }
}
