//! Textures of the face, drawn in metres, seen from the front.

use glam::{Vec2, Vec3};

use super::face::uv;
use super::features::TIP_Y;
use super::paint_eyes::mix;
use super::shape::{JAW_ROW, net};
use super::state::{CORNERS, Eye, MOUTH_Y, Mouth};
use super::{UV_METRES, UV_TOP};
use crate::picture::{Canvas, Picture, curve, ellipse, noise, part_ids, polyline, rgb, smoothstep};

const SIZE: u32 = 2048;

/// Place of the texture where the front of the face has this x and y.
fn at(x: f32, y: f32) -> Vec2 {
    Vec2::new(0.5 + x / UV_METRES, (UV_TOP - y) / UV_METRES)
}

fn radii(x: f32, y: f32) -> Vec2 {
    Vec2::new(x, y) / UV_METRES
}

/// Skin of the face: blush, lips, the line of the mouth, the shade of the neck.
pub(super) fn face() -> Picture {
    const SKIN: u32 = 0xfeeae0;
    let mut c = Canvas::new(SIZE, SIZE, Some(SKIN));
    for side in [-1.0, 1.0] {
        c.glow(at(side * 0.0435, 1.3745), radii(0.021, 0.0115), 0xf58f86, 0.27);
        // A breath of warmth over the lids.
        c.glow(at(side * 0.037, 1.4335), radii(0.024, 0.007), 0xf2b0a4, 0.2);
        ear(&mut c, side);
        // Behind the lids lies the socket: where it shows, it is taken for the white of the eye.
        let socket: Vec<Vec2> = (0..=16)
            .map(|i| lid(i as f32 / 16.0, side, false, -0.0004))
            .chain((1..16).rev().map(|i| lid(i as f32 / 16.0, side, true, -0.0004)))
            .collect();
        c.fill(&polyline(&socket, true), 0xece0ea, 1.0);
        // A breath of strokes on the cheeks, as drawn blush has.
        for i in 0..4 {
            let x = side * (0.0385 + 0.0042 * i as f32);
            let line = polyline(&[at(x, 1.3765), at(x - 0.0022, 1.3725)], false);
            c.stroke(&line, 0xee8078, 0.18, 0.0009 / UV_METRES);
        }
        // The lower rim of the eye is warm.
        let lower: Vec<Vec2> = (3..=17).map(|i| lid(i as f32 / 20.0, side, true, 0.0004)).collect();
        c.stroke(&curve(&lower, false), 0xdf9186, 0.6, 0.001 / UV_METRES);
    }
    // Hairline: the shade that hair lays on the forehead.
    c.linear(
        &ellipse(at(0.0, 1.53), radii(0.16, 0.075)),
        at(0.0, 1.51),
        at(0.0, 1.462),
        &[(0.0, 0xf0b3aa, 0.6), (1.0, 0xf6c8bb, 0.0)],
    );
    nose(&mut c);
    lips(&mut c);
    let mut picture = c.finish();
    let jaw = JawLine::new();
    let neck = rgb(NECK);
    picture.map(|uv, [r, g, b, a]| {
        // A little unevenness, so that large flats do not look like plastic.
        let n = (noise(uv * 24.0, [24, 24], 5) - 0.5) * 0.006;
        let skin = Vec3::new(r + n, g + n * 0.7, b + n * 0.7);
        // Behind the border of light that the jaw makes, so that the two edges are one.
        let color = mix(skin, neck, smoothstep(0.004, 0.009, jaw.below(uv)));
        [color.x, color.y, color.z, a]
    });
    picture
}

/// Colour of the neck, which lies in shade.
const NECK: u32 = 0xe9c8bf;

/// The edge of the jaw in the texture: its height for each place across.
struct JawLine(Vec<Vec2>);

impl JawLine {
    fn new() -> Self {
        Self((0..=160).map(|i| uv(net(i as f32 * 0.05, JAW_ROW), 0.0)).collect())
    }

    /// How far a place lies below the edge, shares of the texture; ears are never below.
    fn below(&self, uv: Vec2) -> f32 {
        let u = 0.5 + (uv.x - 0.5).abs();
        if on_ear(uv) {
            return 0.0;
        }
        let k = self.0.partition_point(|p| p.x < u).clamp(1, self.0.len() - 1);
        let (a, b) = (self.0[k - 1], self.0[k]);
        let t = ((u - a.x) / (b.x - a.x).max(1e-6)).clamp(0.0, 1.0);
        uv.y - (a.y + (b.y - a.y) * t)
    }
}

/// Where the texture has the ears.
const EAR: Vec2 = Vec2::new(0.36, 0.9);
const EAR_RADII: Vec2 = Vec2::new(0.05, 0.08);

fn on_ear(uv: Vec2) -> bool {
    ((Vec2::new((uv.x - 0.5).abs(), uv.y) - EAR) / EAR_RADII).length_squared() < 1.1
}

/// The ear: warm rim, the groove inside the helix, the hollow.
fn ear(c: &mut Canvas, side: f32) {
    // By the angle from the front over the top, degrees, and the share of the outline.
    let place = |degrees: f32, share: f32| {
        let (s, k) = degrees.to_radians().sin_cos();
        Vec2::new(0.5 + side * (EAR.x + EAR_RADII.x * k * share), EAR.y - EAR_RADII.y * s * share)
    };
    c.fill(&ellipse(Vec2::new(0.5 + side * EAR.x, EAR.y), EAR_RADII * 1.04), 0xfbdcd0, 1.0);
    // Tapered crescents: outer edge one way, inner edge back.
    let crescent = |from: f32, to: f32, outer: f32, inner: f32| -> Vec<Vec2> {
        let way = |share: f32, bulge: f32, back: bool| {
            (0..=14).map(move |i| {
                let t = if back { 14 - i } else { i } as f32 / 14.0;
                let hollow = 4.0 * t * (1.0 - t);
                (from + (to - from) * t, share + bulge * hollow)
            })
        };
        let middle = (outer + inner) * 0.5;
        way(middle, (outer - inner) * 0.5, false)
            .chain(way(middle, (inner - outer) * 0.5, true))
            .map(|(degrees, share)| place(degrees, share))
            .collect()
    };
    c.fill(&curve(&crescent(15.0, 240.0, 0.86, 0.66), true), 0xe39a90, 0.9);
    c.fill(&curve(&crescent(-75.0, 150.0, 0.5, 0.04), true), 0xe39a90, 0.9);
    c.fill(&curve(&crescent(-60.0, 100.0, 0.36, 0.06), true), 0xcf7d76, 0.75);
}

fn lid(s: f32, side: f32, lower: bool, away: f32) -> Vec2 {
    let y = Eye::default().lids(s)[usize::from(lower)];
    at(side * (CORNERS[0].x + (CORNERS[1].x - CORNERS[0].x) * s), if lower { y - away } else { y + away })
}

fn nose(c: &mut Canvas) {
    // The small shadow under the tip is all that the front view shows of a nose.
    let y = TIP_Y - 0.0056;
    let shape = [at(-0.0018, y + 0.0005), at(0.0, y), at(0.0018, y + 0.0005), at(0.0, y - 0.0007)];
    c.fill(&curve(&shape, true), 0xd9827a, 0.85);
}

/// A tapered stroke through points: widest in its middle.
fn tapered(c: &mut Canvas, points: &[Vec2], width: f32, hex: u32, alpha: f32) {
    let last = points.len() - 1;
    let edge = |i: usize, sign: f32| {
        let along = (points[(i + 1).min(last)] - points[i.saturating_sub(1)]).normalize_or(Vec2::X);
        let t = 2.0 * i as f32 / last as f32 - 1.0;
        points[i] + along.perp() * sign * 0.5 * width * (1.0 - t * t).max(0.03).powf(0.6)
    };
    let outline: Vec<Vec2> = (0..=last).map(|i| edge(i, 1.0)).chain((0..=last).rev().map(|i| edge(i, -1.0))).collect();
    c.fill(&curve(&outline, true), hex, alpha);
}

fn lips(c: &mut Canvas) {
    let mouth = Mouth::default();
    let line: Vec<Vec2> = (-10..=10)
        .map(|i| {
            let q = i as f32 / 10.0;
            let [x, upper, lower] = mouth.lips(q.abs());
            at(x * q.signum(), (upper + lower) * 0.5)
        })
        .collect();
    c.glow(at(0.0, MOUTH_Y - 0.0034), radii(0.0085, 0.0036), 0xf0938e, 0.16);
    tapered(c, &line, 0.0013 / UV_METRES, 0xa14a50, 1.0);
    // A hint of the lower lip.
    let under: Vec<Vec2> = (-4..=4).map(|i| i as f32 / 4.0).map(|q| at(0.0036 * q, 1.3388 + 0.0005 * q * q)).collect();
    tapered(c, &under, 0.0009 / UV_METRES, 0xe39d92, 0.75);
}

/// Width of the face's outline: none round eyes and mouth, thin on nose and lips.
pub(super) fn outline_mask() -> Picture {
    let mut c = Canvas::new(512, 512, Some(0xffffff));
    for side in [-1.0, 1.0] {
        c.fill(&ellipse(at(side * 0.0395, 1.412), radii(0.0275, 0.02)), 0x000000, 1.0);
    }
    c.fill(&ellipse(at(0.0, MOUTH_Y), radii(0.0145, 0.003)), 0x000000, 1.0);
    // The skin beside the corners folds where the mouth opens.
    for side in [-1.0, 1.0] {
        c.fill(&ellipse(at(side * 0.014, MOUTH_Y + 0.001), radii(0.0085, 0.0085)), 0x000000, 1.0);
    }
    c.finish()
}

/// Painted highlights of nose and lower lip, white on black.
pub(super) fn highlight() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0x000000));
    let nose = [at(-0.0013, 1.3746), at(0.0006, 1.376), at(0.0016, 1.3722), at(0.0003, 1.3706), at(-0.0012, 1.3719)];
    c.fill(&curve(&nose, true), 0xffffff, 1.0);
    c.fill(&ellipse(at(0.0009, 1.342), radii(0.0027, 0.0007)), 0xffffff, 0.9);
    c.finish()
}

/// What looks draw over the face. Red: blush. Green: strokes that show in shade. Blue: the line of the nose in profile.
pub(super) fn face_paint() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0x000000));
    for side in [-1.0, 1.0] {
        c.glow(at(side * 0.043, 1.3755), radii(0.02, 0.0105), 0xff0000, 0.28);
        // The strokes of the blush, drawn again and longer.
        for i in 0..4 {
            let x = side * (0.0385 + 0.0042 * i as f32);
            let line = polyline(&[at(x + 0.0006, 1.3776), at(x - 0.0028, 1.3714)], false);
            c.stroke(&line, 0x00ff00, 0.5, 0.0009 / UV_METRES);
        }
        // Beside the tip alone: the bridge is seen in the contour.
        let ridge = [at(side * 0.0036, 1.389), at(side * 0.0034, 1.382), at(side * 0.0036, 1.3755)];
        c.stroke(&curve(&ridge, false), 0x0000ff, 0.55, 0.0006 / UV_METRES);
    }
    c.finish()
}

/// Numbers of the parts of the face in the red channel: 1 skin, 2 lips, 3 ears.
pub(super) fn part_id() -> Picture {
    let ear = |side: f32| (ellipse(Vec2::new(0.5 + side * EAR.x, EAR.y), EAR_RADII), 3);
    part_ids(&[(ellipse(at(0.0, MOUTH_Y), radii(0.0135, 0.006)), 2), ear(-1.0), ear(1.0)])
}
