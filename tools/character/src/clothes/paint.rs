//! Textures of the clothes.

use glam::{Vec2, Vec3};

use super::skirt::PLEATS;
use super::{sleeve, tuft};
use crate::picture::{Canvas, Picture, curve, ellipse, noise, part_ids, polyline, rgb, smoothstep};

fn mix(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a + (b - a) * t.clamp(0.0, 1.0)
}

fn square(x0: f32, y0: f32, x1: f32, y1: f32) -> tiny_skia::Path {
    polyline(&[Vec2::new(x0, y0), Vec2::new(x1, y0), Vec2::new(x1, y1), Vec2::new(x0, y1)], true)
}

/// White blouse: placket with buttons, soft folds, a dark ribbon at the collar.
pub(super) fn blouse() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0xfaf7fb));
    for i in 0..9 {
        let x = 0.36 + 0.035 * i as f32;
        let fold = [Vec2::new(x, 0.08), Vec2::new(x + 0.004, 0.55), Vec2::new(0.5 + (x - 0.5) * 0.8, 0.98)];
        c.stroke(&curve(&fold, false), 0xd7d2ec, 0.7, 0.003);
    }
    c.fill(&square(0.488, 0.07, 0.512, 1.0), 0xefeaf6, 1.0);
    c.stroke(&polyline(&[Vec2::new(0.488, 0.07), Vec2::new(0.488, 1.0)], false), 0xb9b3d8, 0.9, 0.0025);
    for i in 0..7 {
        c.fill(&ellipse(Vec2::new(0.5, 0.17 + 0.12 * i as f32), Vec2::new(0.0055, 0.009)), 0xe8a33d, 1.0);
    }
    // What jacket and bust lay in shade, with drawn edges.
    for side in [-1.0f32, 1.0] {
        let at = |x: f32, y: f32| Vec2::new(0.5 + side * x, y);
        let lapel = [
            at(0.2, 0.07),
            at(0.08, 0.07),
            at(0.055, 0.2),
            at(0.062, 0.36),
            at(0.066, 0.5),
            at(0.061, 0.62),
            at(0.064, 1.0),
            at(0.2, 1.0),
        ];
        c.fill(&polyline(&lapel, true), 0xcdc6e6, 0.85);
    }
    // The ribbon round the collar.
    c.fill(&square(0.0, 0.042, 1.0, 0.064), 0x2b2f55, 1.0);
    c.linear(
        &square(0.0, 0.07, 1.0, 0.2),
        Vec2::new(0.0, 0.07),
        Vec2::new(0.0, 0.2),
        &[(0.0, 0xc4bce2, 0.8), (1.0, 0xe4def2, 0.0)],
    );
    c.finish()
}

/// Piping of the jacket: front edge and hem.
fn piping() -> [tiny_skia::Path; 2] {
    [square(0.607, 0.0, 0.63, 1.0), square(0.0, 0.957, 0.63, 0.975)]
}

/// Buttons of the jacket.
const BUTTONS: [Vec2; 3] = [Vec2::new(0.57, 0.62), Vec2::new(0.57, 0.74), Vec2::new(0.57, 0.86)];

/// Numbers of the parts of the jacket in the red channel: 1 cloth, 2 piping, 3 buttons.
pub(super) fn jacket_part_id() -> Picture {
    let buttons = BUTTONS.map(|at| (ellipse(at, Vec2::new(0.012, 0.015)), 3));
    let shapes: Vec<_> = piping().map(|path| (path, 2)).into_iter().chain(buttons).collect();
    part_ids(&shapes)
}

/// Jacket: torso on the left from the back seam to the front edge, sleeve on the right.
pub(super) fn jacket() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0x414c78));
    c.linear(
        &square(0.0, 0.0, 0.63, 1.0),
        Vec2::new(0.0, 0.0),
        Vec2::new(0.0, 1.0),
        &[(0.0, 0x4b5788, 1.0), (0.5, 0x3d4670, 1.0), (1.0, 0x363b62, 1.0)],
    );
    c.linear(
        &square(0.645, 0.0, 1.0, 1.0),
        Vec2::new(0.0, 0.0),
        Vec2::new(0.0, 1.0),
        &[(0.0, 0x465284, 1.0), (0.45, 0x3c456f, 1.0), (0.9, 0x323860, 1.0), (1.0, 0x2a2c50, 1.0)],
    );
    // Seams: back, side, waist.
    for x in [0.2, 0.47] {
        c.stroke(
            &curve(&[Vec2::new(x, 0.3), Vec2::new(x + 0.01, 0.65), Vec2::new(x - 0.01, 1.0)], false),
            0x252a4c,
            0.9,
            0.003,
        );
    }
    // Folds at the waist, that fan out from it: a line thin at its ends, and its shade.
    for (x, lean, long) in
        [(0.05, 0.012, 0.16), (0.13, -0.014, 0.12), (0.27, 0.02, 0.2), (0.34, 0.03, 0.13), (0.43, -0.02, 0.15)]
    {
        let at = |t: f32, wide: f32| Vec2::new(x + lean * t * t + wide * (1.0 - t) * t * 4.0, 0.73 - long * t);
        let shape = |wide: f32| {
            let up = (0..=8).map(|i| at(i as f32 / 8.0, 0.0));
            let down = (0..=8).rev().map(|i| at(i as f32 / 8.0, wide));
            polyline(&up.chain(down).collect::<Vec<_>>(), true)
        };
        c.fill(&shape(0.02), 0x2c3263, 0.85);
        c.fill(&shape(0.0052), 0x20254a, 1.0);
    }
    // Below each crease of the sleeve lies its shade.
    for line in sleeve::creases() {
        let lower = line.iter().rev().map(|(p, deep)| *p + Vec2::Y * 0.03 * deep.max(0.0));
        let shape: Vec<Vec2> = line.iter().map(|(p, _)| *p).chain(lower).collect();
        c.fill(&polyline(&shape, true), 0x2b3162, 1.0);
    }
    // Over it the crest catches light.
    for line in sleeve::creases() {
        for pair in line.windows(2) {
            let deep = 0.5 * (pair[0].1 + pair[1].1) - 0.35;
            if deep > 0.0 {
                let up = Vec2::Y * 0.022;
                c.stroke(&polyline(&[pair[0].0 - up, pair[1].0 - up], false), 0x4a588e, 1.0, 0.009 * deep);
            }
        }
    }
    // The creases themselves: drawn where the mesh folds, thin at their ends.
    for line in sleeve::creases() {
        for pair in line.windows(2) {
            let deep = 0.5 * (pair[0].1 + pair[1].1);
            if deep > 0.08 {
                c.stroke(&polyline(&[pair[0].0, pair[1].0], false), 0x20254a, 1.0, 0.0012 + 0.0062 * deep);
            }
        }
    }
    // Piping along the front edge and the hem.
    for piping in piping() {
        c.fill(&piping, 0xe8a33d, 1.0);
    }
    c.fill(&square(0.6, 0.0, 0.607, 1.0), 0x252a4c, 1.0);
    c.fill(&square(0.0, 0.95, 0.63, 0.957), 0x252a4c, 1.0);
    for at in BUTTONS {
        c.fill(&ellipse(at, Vec2::new(0.012, 0.015)), 0x7a4a1c, 1.0);
        c.fill(&ellipse(at - Vec2::splat(0.002), Vec2::new(0.009, 0.0115)), 0xe2b04a, 1.0);
        c.fill(&ellipse(at - Vec2::splat(0.005), Vec2::new(0.003, 0.004)), 0xfff0c0, 1.0);
    }
    let mut picture = c.finish();
    picture.map(|uv, [r, g, b, a]| {
        let n = (noise(uv * 160.0, [160, 160], 2) - 0.5) * 0.02;
        [r + n, g + n, b + n, a]
    });
    picture
}

/// Place in the painted fur: across the columns, and along a tuft from root (0) to tip (1).
fn along_tuft(uv: Vec2) -> Vec2 {
    Vec2::new(uv.x, (uv.y / tuft::UV[1]).min(1.0))
}

/// Strokes of fur: they run along a tuft.
fn strokes(at: Vec2, count: f32, seed: u32) -> f32 {
    noise(Vec2::new(at.x * count, at.y * 2.5), [count as i32, 64], seed)
}

/// Height of the painted fur, 0..1: its strands.
fn fur_height(uv: Vec2) -> f32 {
    let at = along_tuft(uv);
    0.6 * strokes(at, 48.0, 21) + 0.4 * strokes(at, 112.0, 22)
}

/// Fur: v runs along a tuft from its root, in the shade of its neighbours, to its light tips.
pub(super) fn fur() -> Picture {
    let [root, body, light, line] = [0x9f8fc6, 0xf5f0f9, 0xffffff, 0xcabddf].map(rgb);
    Picture::from_fn(1024, 512, |uv| {
        let at = along_tuft(uv);
        let v = at.y + (strokes(at, 48.0, 21) - 0.5) * 0.22;
        let mut color = mix(root, body, smoothstep(0.08, 0.32, v));
        color = mix(color, light, smoothstep(0.36, 0.65, v));
        let pen = smoothstep(0.8, 0.93, strokes(at, 72.0, 22));
        color = mix(color, line, 0.35 * pen * smoothstep(0.8, 0.4, at.y));
        [color.x, color.y, color.z, 1.0]
    })
}

/// Normals of the painted fur, for looks that light its strands one by one.
pub(super) fn fur_normal() -> Picture {
    const STEP: f32 = 1.0 / 1024.0;
    Picture::from_fn(1024, 512, |uv| {
        let slope = |d: Vec2| (fur_height(uv + d) - fur_height(uv - d)) / (2.0 * STEP);
        // Slopes of the texture, softened: the tufts have a form of their own.
        let n = Vec3::new(-slope(Vec2::X * STEP) / 130.0, slope(Vec2::Y * STEP) / 300.0, 1.0).normalize();
        [n.x * 0.5 + 0.5, n.y * 0.5 + 0.5, n.z * 0.5 + 0.5, 1.0]
    })
}

/// Place within a box pleat: u, and whether it is the gap between two faces.
fn pleat(uv: Vec2) -> (f32, bool) {
    let x = (uv.x * PLEATS as f32).fract();
    (x, x > 0.83 && x < 0.99)
}

/// Bands above the hem of the skirt, navy and gold: middle and half height.
const BANDS: [(f32, f32, u32); 3] = [(0.835, 0.026, 0x333c6e), (0.878, 0.0045, 0xd9a441), (0.9, 0.006, 0x333c6e)];

/// Width of the skirt's outline: none in the folds, which it would fill, and none inside.
pub(super) fn skirt_outline() -> Picture {
    Picture::from_fn(1024, 64, |uv| {
        let value = if uv.y > 0.95 || pleat(uv).1 { 0.0 } else { 1.0 };
        [value, value, value, 1.0]
    })
}

/// Numbers of the parts of the skirt: 1 pale cloth, 2 the navy of bands and folds.
pub(super) fn skirt_part_id() -> Picture {
    let strip = |k: usize| {
        let at = |x: f32| (k as f32 + x) / PLEATS as f32;
        (square(at(0.83), 0.0, at(0.99), 1.0), 2)
    };
    let bands = BANDS.map(|(y, half, _)| (square(0.0, y - half, 1.0, y + half), 2));
    let shapes: Vec<_> = (0..PLEATS).map(strip).chain(bands).chain([(square(0.0, 0.945, 1.0, 1.0), 2)]).collect();
    part_ids(&shapes)
}

/// Skirt: cream box pleats over navy, with bands above the hem.
pub(super) fn skirt() -> Picture {
    let [light, cloth, fold, line] = [0xfdf7ee, 0xf3e9e0, 0xd9c9d8, 0x8f7da4].map(rgb);
    let [navy, deep] = [0x39406e, 0x232747].map(rgb);
    Picture::from_fn(2048, 512, |uv| {
        let (x, gap) = pleat(uv);
        let soft = 1.0 / 128.0;
        let mut color;
        if uv.y > 0.945 {
            color = deep;
        } else if gap {
            color = mix(deep, navy, 0.55 * smoothstep(0.3, 1.0, uv.y));
        } else {
            color = mix(cloth, light, smoothstep(0.2, 0.9, uv.y));
            // The ironed edge on her right, the shade before the edge on her left.
            color = mix(color, fold, 0.75 * smoothstep(0.7, 0.7 + soft, x) * smoothstep(0.02, 0.5, uv.y));
            // Sewn down above: two short seams.
            let seam = smoothstep(soft, 0.4 * soft, (x - 0.03).abs().min((x - 0.79).abs()));
            color = mix(color, fold, seam * smoothstep(0.24, 0.22, uv.y));
            for (y, half, hex) in BANDS {
                let band = smoothstep(half + 0.002, half, (uv.y - y).abs());
                color = mix(color, rgb(hex) * if x > 0.7 { 0.86 } else { 1.0 }, band);
            }
            color = mix(color, line, 0.8 * smoothstep(1.6 * soft, 0.6 * soft, x.min((0.826 - x).max(0.0))));
        }
        color = mix(color, line, 0.55 * smoothstep(0.09, 0.0, uv.y));
        [color.x, color.y, color.z, 1.0]
    })
}
