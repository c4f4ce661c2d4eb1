//! Textures of the clothes.

use glam::{Vec2, Vec3};

use crate::picture::{Canvas, Picture, curve, ellipse, hash, noise, part_ids, polyline, rgb, smoothstep};

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
    // Folds at the waist and in the elbow.
    for i in 0..6 {
        let x = 0.08 + 0.09 * i as f32;
        let fold = [Vec2::new(x, 0.62), Vec2::new(x + 0.02, 0.72), Vec2::new(x + 0.012, 0.83)];
        c.stroke(&curve(&fold, false), 0x2b3058, 0.55, 0.009);
    }
    for (x, y, long) in [(0.7, 0.45, 0.2), (0.8, 0.5, 0.14), (0.69, 0.545, 0.16), (0.83, 0.6, 0.12)] {
        let [a, b] = [Vec2::new(x, y), Vec2::new(x + long, y - 0.012)];
        let sag = |depth: f32| (a + b) * 0.5 + Vec2::new(0.01, depth);
        c.fill(&curve(&[a, sag(0.008), b, sag(0.026)], true), 0x2b3058, 0.5);
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

/// Strokes of fur: they run along v and lean together at the tip.
fn strokes(uv: Vec2, count: f32, seed: u32) -> f32 {
    let (tuft, u) = ((uv.x * 4.0).floor(), (uv.x * 4.0).fract() - 0.5);
    let spread = u * (0.55 + 0.45 * uv.y);
    noise(Vec2::new((tuft + 0.5 + spread) * count * 0.25, uv.y * 2.5), [count as i32, 64], seed)
}

/// Height of the painted fur, 0..1: the strands of a tuft, higher in its middle.
fn fur_height(uv: Vec2) -> f32 {
    let u = ((uv.x * 4.0).fract() - 0.5).abs() * 2.0;
    let dome = (1.0 - u * u).max(0.0).sqrt();
    0.6 * dome + 0.25 * strokes(uv, 48.0, 21) + 0.15 * strokes(uv, 112.0, 22)
}

/// How far inside a strand of its tuft a point lies, in widths of a tuft: below 0 outside. Each tuft ends in five strands
/// of their own lengths, which part where the tuft is half as long.
fn inside_strands(uv: Vec2) -> f32 {
    let (tuft, u) = ((uv.x * 4.0).floor() as u32, (uv.x * 4.0).fract());
    (0..5u32)
        .map(|k| {
            let vary = |seed| hash(tuft * 5 + k, 7, seed) - 0.5;
            let end = 0.9 - 0.28 * (k as f32 - 2.0).abs() / 2.0 + 0.16 * vary(1);
            let root = 0.14 + 0.18 * k as f32;
            let tip = root + 0.1 * vary(2) + 0.05 * (2.0 - k as f32);
            let t = uv.y / end;
            let bend = smoothstep(0.3, 1.0, t);
            0.125 * (1.0 - smoothstep(0.42, 1.0, t)).powf(0.8) - (u - root - (tip - root) * bend).abs()
        })
        .fold(f32::MIN, f32::max)
}

/// Fur: v runs along a tuft from its root, in the shade of its neighbours, to its light tips.
pub(super) fn fur() -> Picture {
    let [root, body, light, line] = [0xdccde2, 0xf1e9f1, 0xfffdfb, 0xc4b0d2].map(rgb);
    Picture::from_fn(1024, 512, |uv| {
        let broad = strokes(uv, 40.0, 21) - 0.5;
        let v = uv.y + broad * 0.3;
        let mut color = mix(root, body, smoothstep(0.1, 0.4, v));
        color = mix(color, light, smoothstep(0.36, 0.66, v));
        let pen = smoothstep(0.8, 0.93, strokes(uv, 72.0, 22));
        color = mix(color, line, 0.5 * pen * smoothstep(0.75, 0.35, uv.y));
        let inside = inside_strands(uv);
        // A thin line along the strands, so that one is told from those below.
        color = mix(color, line, 0.7 * smoothstep(0.05, 0.015, inside) * smoothstep(0.35, 0.55, uv.y));
        let alpha = (0.5 + inside * 20.0).clamp(0.0, 1.0).max(smoothstep(0.3, 0.26, uv.y));
        [color.x, color.y, color.z, alpha]
    })
}

/// Normals of the painted fur, for looks that light its strands one by one.
pub(super) fn fur_normal() -> Picture {
    const STEP: f32 = 1.0 / 1024.0;
    Picture::from_fn(1024, 512, |uv| {
        let slope = |d: Vec2| (fur_height(uv + d) - fur_height(uv - d)) / (2.0 * STEP);
        // Slopes of the texture, as if a tuft were as high as a quarter of its width.
        let n = Vec3::new(-slope(Vec2::X * STEP) / 60.0, slope(Vec2::Y * STEP) / 60.0, 1.0).normalize();
        [n.x * 0.5 + 0.5, n.y * 0.5 + 0.5, n.z * 0.5 + 0.5, 1.0]
    })
}

/// Width of the skirt's outline: none in the folds, which it would fill, and none inside.
pub(super) fn skirt_outline() -> Picture {
    Picture::from_fn(1024, 64, |uv| {
        let x = (uv.x * 22.0).fract();
        let value = if uv.y > 0.95 {
            0.0
        } else {
            smoothstep(0.0, 0.1, x) * smoothstep(0.64, 0.54, x)
        };
        [value, value, value, 1.0]
    })
}

/// Skirt: 22 pleats side by side; the fold of each is dark, a pale stripe runs above the hem.
pub(super) fn skirt() -> Picture {
    let [light, cloth, deep, stripe] = [0x5d5378, 0x4a4163, 0x3c3459, 0xd9cfe6].map(rgb);
    Picture::from_fn(2048, 512, |uv| {
        let x = (uv.x * 22.0).fract();
        if uv.y > 0.945 {
            return [deep.x, deep.y, deep.z, 1.0];
        }
        let mut color = mix(cloth, light, smoothstep(0.6, 0.15, x) * (0.35 + 0.5 * uv.y));
        let line = smoothstep(0.012, 0.008, (uv.y - 0.85).abs()) + smoothstep(0.005, 0.003, (uv.y - 0.885).abs());
        color = mix(color, stripe, line.min(1.0));
        color = mix(color, deep, smoothstep(0.64, 0.72, x) * 0.9);
        color = mix(color, deep, 0.6 * smoothstep(0.04, 0.0, x) + 0.5 * smoothstep(0.12, 0.0, uv.y));
        [color.x, color.y, color.z, 1.0]
    })
}
