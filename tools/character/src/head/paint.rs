//! Textures of the head. Those of the face are drawn in metres, seen from the front.

use glam::{Vec2, Vec3};

use super::face::uv;
use super::shape::{JAW_ROW, net};
use super::state::{CORNERS, Eye, MOUTH_Y, Mouth};
use super::{UV_METRES, UV_TOP};
use crate::picture::{Canvas, Picture, curve, ellipse, hash, noise, part_ids, polyline, rgb, smoothstep};

const SIZE: u32 = 2048;

/// Place of the texture where the front of the face has this x and y.
fn at(x: f32, y: f32) -> Vec2 {
    Vec2::new(0.5 + x / UV_METRES, (UV_TOP - y) / UV_METRES)
}

fn radii(x: f32, y: f32) -> Vec2 {
    Vec2::new(x, y) / UV_METRES
}

/// Skin of the face: blush, lips, the line of the mouth, soft warmth in the hollows.
pub(super) fn face() -> Picture {
    const SKIN: u32 = 0xfeeae0;
    let mut c = Canvas::new(SIZE, SIZE, Some(SKIN));
    for side in [-1.0, 1.0] {
        // Cheeks, ears, the hollow over the eyes.
        c.glow(at(side * 0.0435, 1.3745), radii(0.021, 0.0115), 0xf58f86, 0.42);
        c.glow(at(side * 0.036, 1.4325), radii(0.027, 0.0085), 0xf2b0a4, 0.34);
        c.glow(at(side * 0.0145, 1.408), radii(0.008, 0.014), 0xf4b4a8, 0.34);
        // Temples and the sides of the jaw turn away from the light.
        c.glow(at(side * 0.078, 1.375), radii(0.026, 0.05), 0xf5c0b4, 0.5);
        let ear = Vec2::new(0.5 + side * 0.36, 0.9);
        c.glow(ear, Vec2::new(0.05, 0.08), 0xf2a89e, 0.6);
        c.glow(ear, Vec2::new(0.03, 0.052), 0xe58f88, 0.7);
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
            c.stroke(&line, 0xee8078, 0.26, 0.0009 / UV_METRES);
        }
        // The lower rim of the eye is warm.
        let lower: Vec<Vec2> = (2..=18).map(|i| lid(i as f32 / 20.0, side, true, 0.0006)).collect();
        c.stroke(&curve(&lower, false), 0xe79c92, 0.55, 0.0014 / UV_METRES);
    }
    // Hairline: the shade that hair lays on the forehead.
    c.linear(
        &ellipse(at(0.0, 1.53), radii(0.16, 0.075)),
        at(0.0, 1.51),
        at(0.0, 1.462),
        &[(0.0, 0xf0b3aa, 0.75), (1.0, 0xf6c8bb, 0.0)],
    );
    nose(&mut c);
    lips(&mut c);
    // Under the chin and on the neck.
    c.fill(&jaw_shadow(), 0xf3c3b7, 0.95);
    for side in [-1.0, 1.0] {
        let line: Vec<Vec2> = (1..=17).map(|i| jaw_point(side, i as f32 * 0.3)).collect();
        c.stroke(&curve(&line, false), 0xa4564e, 0.9, 0.0011 / UV_METRES);
    }
    let mut picture = c.finish();
    picture.map(|uv, [r, g, b, a]| {
        // A little unevenness, so that large flats do not look like plastic.
        let n = (noise(uv * 24.0, [24, 24], 5) - 0.5) * 0.006;
        [r + n, g + n * 0.7, b + n * 0.7, a]
    });
    picture
}

fn lid(s: f32, side: f32, lower: bool, away: f32) -> Vec2 {
    let y = Eye::default().lids(s)[usize::from(lower)];
    at(side * (CORNERS[0].x + (CORNERS[1].x - CORNERS[0].x) * s), if lower { y - away } else { y + away })
}

/// Point of the texture on the edge of the jaw, by column of the net.
fn jaw_point(side: f32, column: f32) -> Vec2 {
    let to = uv(net(column, JAW_ROW), 0.0);
    Vec2::new(0.5 + (to.x - 0.5) * side, to.y)
}

/// The shadow that the jaw lays on the neck, with a drawn edge.
fn jaw_shadow() -> tiny_skia::Path {
    let jaw = |i: i32| jaw_point(i.signum() as f32, i.abs() as f32 * 0.3) + Vec2::new(0.0, 0.004);
    let low = |i: i32| {
        let x = i as f32 / 20.0;
        Vec2::new(0.5 - 0.5 * x, 0.875 - 0.36 * (x * x).min(0.36))
    };
    let outline: Vec<Vec2> = (-20..=20).map(jaw).chain((-20..=20).map(low)).collect();
    polyline(&outline, true)
}

fn nose(c: &mut Canvas) {
    c.glow(at(0.0, 1.372), radii(0.008, 0.008), 0xf5a79c, 0.32);
    // The small shadow under the tip, drawn to one side, is all that the front view shows of a nose.
    let shape = [at(-0.0026, 1.3645), at(0.0004, 1.3637), at(0.0026, 1.3649), at(0.0003, 1.3629)];
    c.fill(&curve(&shape, true), 0xd9827a, 0.85);
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
    c.glow(at(0.0, MOUTH_Y - 0.0036), radii(0.0098, 0.0044), 0xf0938e, 0.16);
    c.glow(at(0.0, MOUTH_Y + 0.002), radii(0.0105, 0.0032), 0xf0a09a, 0.1);
    c.stroke(&curve(&line, false), 0xb4585c, 0.95, 0.00085 / UV_METRES);
    c.stroke(&curve(&line[6..15], false), 0x8f3d46, 0.9, 0.00105 / UV_METRES);
    for end in [line[0], line[20]] {
        c.fill(&ellipse(end, radii(0.0007, 0.0006)), 0xb4585c, 0.8);
    }
    // The shade under the lower lip.
    let under = [at(-0.0055, 1.3374), at(0.0, 1.3364), at(0.0055, 1.3374), at(0.0, 1.3355)];
    c.fill(&curve(&under, true), 0xeaa096, 0.6);
}

/// Width of the face's outline: none round eyes and mouth, thin on nose and lips.
pub(super) fn outline_mask() -> Picture {
    let mut c = Canvas::new(512, 512, Some(0xffffff));
    for side in [-1.0, 1.0] {
        c.fill(&ellipse(at(side * 0.0365, 1.413), radii(0.0225, 0.0165)), 0x000000, 1.0);
    }
    c.fill(&ellipse(at(0.0, MOUTH_Y), radii(0.0145, 0.003)), 0x000000, 1.0);
    c.finish()
}

/// Painted highlights of nose and lower lip, white on black.
pub(super) fn highlight() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0x000000));
    let nose = [at(-0.0013, 1.3746), at(0.0006, 1.376), at(0.0016, 1.3722), at(0.0003, 1.3702), at(-0.0012, 1.3719)];
    c.fill(&curve(&nose, true), 0xffffff, 1.0);
    c.fill(&ellipse(at(0.0009, 1.342), radii(0.0027, 0.0007)), 0xffffff, 0.9);
    c.finish()
}

/// What looks draw over the face. Red: blush. Green: strokes that show in shade. Blue: the line of the nose in profile.
pub(super) fn face_paint() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0x000000));
    for side in [-1.0, 1.0] {
        c.glow(at(side * 0.043, 1.3755), radii(0.02, 0.0105), 0xff0000, 0.4);
        // The strokes of the blush, drawn again and longer.
        for i in 0..4 {
            let x = side * (0.0385 + 0.0042 * i as f32);
            let line = polyline(&[at(x + 0.0006, 1.3776), at(x - 0.0028, 1.3714)], false);
            c.stroke(&line, 0x00ff00, 0.75, 0.0009 / UV_METRES);
        }
        // From between the eyes down to the tip.
        let ridge =
            [at(side * 0.0042, 1.4), at(side * 0.0031, 1.39), at(side * 0.0026, 1.381), at(side * 0.003, 1.3745)];
        c.stroke(&curve(&ridge, false), 0x0000ff, 0.9, 0.0008 / UV_METRES);
    }
    c.finish()
}

/// Numbers of the parts of the face in the red channel: 1 skin, 2 lips, 3 ears.
pub(super) fn part_id() -> Picture {
    let ear = |side: f32| (ellipse(Vec2::new(0.5 + side * 0.36, 0.9), Vec2::new(0.05, 0.08)), 3);
    part_ids(&[(ellipse(at(0.0, MOUTH_Y), radii(0.0135, 0.006)), 2), ear(-1.0), ear(1.0)])
}

fn mix(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a + (b - a) * t.clamp(0.0, 1.0)
}

/// The iris: amber, dark above, bright below, with pupil, rays and rim.
pub(super) fn iris() -> Picture {
    let [dark, middle, bright, glow] = [0x4e1a24, 0xb8651d, 0xf2a531, 0xffe9a0].map(rgb);
    let (rim, pupil) = (rgb(0x43190f), rgb(0x2c0f14));
    Picture::from_fn(512, 512, |uv| {
        let d = (uv - 0.5) / 0.49;
        let r = d.length();
        let angle = d.y.atan2(d.x);
        // Dark from above, as under the lid, to a bright bowl below.
        let v = d.y * 0.5 + 0.5;
        let mut color = mix(dark, middle, smoothstep(0.1, 0.52, v));
        color = mix(color, bright, smoothstep(0.45, 0.86, v));
        // Rays from the pupil, of uneven length.
        let ray = noise(Vec2::new((angle / std::f32::consts::TAU + 0.5) * 44.0, r * 1.5), [44, 64], 3);
        let rays = (ray - 0.5) * smoothstep(0.28, 0.6, r) * smoothstep(1.0, 0.8, r);
        color = mix(color, if rays > 0.0 { bright } else { dark }, rays.abs() * 0.62);
        // A bowl of light below the pupil.
        let bowl = Vec2::new(d.x / 0.72, (d.y - 0.52) / 0.36).length();
        color = mix(color, glow, 0.85 * smoothstep(1.0, 0.25, bowl));
        // A thin bright ring inside the rim.
        let ring = smoothstep(0.70, 0.78, r) * smoothstep(0.88, 0.8, r);
        color = mix(color, bright, ring * 0.4 * smoothstep(0.3, 0.8, v));
        // Pupil, an upright ellipse with a soft edge and a hot border.
        let p = Vec2::new(d.x / 0.34, (d.y + 0.02) / 0.4).length();
        color = mix(color, dark, 0.75 * smoothstep(1.35, 1.0, p));
        color = mix(color, pupil, smoothstep(1.0, 0.9, p));
        color =
            mix(color, rgb(0x8a3d22), 0.55 * smoothstep(0.75, 0.1, Vec2::new(d.x / 0.26, (d.y - 0.2) / 0.18).length()));
        // Shade of the lid.
        color = mix(color, rim, 0.72 * smoothstep(0.32, 0.0, v));
        color = mix(color, rim, smoothstep(0.86, 0.95, r));
        let speck = hash((uv.x * 512.0) as u32, (uv.y * 512.0) as u32, 9) * 0.012;
        [color.x + speck, color.y + speck, color.z + speck, 1.0]
    })
}

/// White of the eye: lavender under the lid, warm at the corners.
pub(super) fn eye_white() -> Picture {
    let (white, shade, warm) = (rgb(0xfdfbfb), rgb(0xc9bedd), rgb(0xf3d2cf));
    Picture::from_fn(256, 256, |uv| {
        let mut color = mix(shade, white, smoothstep(0.14, 0.5, uv.y));
        let side = (uv.x - 0.5).abs() * 2.0;
        color = mix(color, warm, 0.55 * smoothstep(0.6, 1.0, side));
        [color.x, color.y, color.z, 1.0]
    })
}

/// Shadow of the lash on the eye: full under the lid, soft below.
pub(super) fn lash_shadow() -> Picture {
    let color = rgb(0x5b3a63);
    Picture::from_fn(64, 64, |uv| [color.x, color.y, color.z, 0.5 * smoothstep(1.0, 0.55, uv.y)])
}

/// Pocket of the mouth (upper half), teeth, tongue.
pub(super) fn mouth() -> Picture {
    let [deep, flesh, teeth, gap, tongue, tip] = [0x6e2233, 0xb9505a, 0xfffaf6, 0xe6cfd2, 0xe27f86, 0xf2a09c].map(rgb);
    Picture::from_fn(256, 256, |uv| {
        let color = if uv.y < 0.52 {
            let t = (uv.y * 2.0 - 0.5).abs() * 2.0;
            mix(deep, flesh, smoothstep(0.7, 1.0, t))
        } else if uv.y < 0.75 {
            mix(teeth, gap, smoothstep(0.7, 1.0, (uv.x - 0.5).abs() * 2.0))
        } else {
            let t = (uv.y - 0.75) * 4.0;
            mix(mix(tongue, tip, t), deep, 0.35 * smoothstep(0.08, 0.0, (uv.x - 0.5).abs()))
        };
        [color.x, color.y, color.z, 1.0]
    })
}
