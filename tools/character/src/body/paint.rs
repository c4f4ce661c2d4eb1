//! Textures of skin, stockings, boots and metal.

use glam::{Vec2, Vec3};

use crate::picture::{Canvas, Picture, curve, ellipse, noise, polyline, rgb, smoothstep};

fn mix(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a + (b - a) * t.clamp(0.0, 1.0)
}

/// Skin: thighs in the upper half, hands in the lower one.
pub(super) fn skin() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0xfeeae0));
    // The swell over the stocking, and the shade of the skirt.
    c.linear(
        &square(0.0, 0.0, 1.0, 0.26),
        Vec2::new(0.0, 0.14),
        Vec2::new(0.0, 0.255),
        &[(0.0, 0xf1beb2, 0.8), (1.0, 0xf4c9be, 0.0)],
    );
    c.linear(
        &square(0.0, 0.34, 1.0, 0.47),
        Vec2::new(0.0, 0.36),
        Vec2::new(0.0, 0.41),
        &[(0.0, 0xf3b6aa, 0.0), (1.0, 0xf0a89e, 0.55)],
    );
    // Palm: warmer, with its lines; the ring starts on the back of the hand.
    c.glow(Vec2::new(0.25, 0.8), Vec2::new(0.12, 0.13), 0xf9c3b6, 0.45);
    for line in [
        [Vec2::new(0.17, 0.82), Vec2::new(0.23, 0.8), Vec2::new(0.3, 0.83)],
        [Vec2::new(0.19, 0.72), Vec2::new(0.2, 0.78), Vec2::new(0.17, 0.83)],
    ] {
        c.stroke(&curve(&line, false), 0xe0958a, 0.5, 0.0022);
    }
    for i in 0..5 {
        let x = 0.52 + 0.092 * i as f32;
        for y in JOINTS {
            // Knuckles blush on the back; on the palm a short crease.
            for edge in [x, x + 0.084] {
                c.glow(Vec2::new(edge, y), Vec2::new(0.02, 0.016), 0xf5ab9f, 0.45);
            }
            let crease = [Vec2::new(x + 0.03, y), Vec2::new(x + 0.042, y + 0.004), Vec2::new(x + 0.054, y)];
            c.stroke(&curve(&crease, false), 0xe0958a, 0.4, 0.002);
        }
        // Tips are rosy all round; nails lie on the back, where the ring begins and ends.
        c.linear(
            &square(x, 0.84, x + 0.084, 0.95),
            Vec2::new(0.0, 0.85),
            Vec2::new(0.0, 0.93),
            &[(0.0, 0xf9c0b4, 0.0), (1.0, 0xf6b4a8, 0.22)],
        );
        for (edge, side) in [(x, 1.0), (x + 0.084, -1.0f32)] {
            let half: Vec<Vec2> = (0..=16)
                .map(|k| {
                    let (s, c) = (k as f32 / 16.0 * std::f32::consts::PI).sin_cos();
                    Vec2::new(edge + side * (0.0108 * s - 0.002), 0.888 - 0.0235 * c)
                })
                .collect();
            c.fill(&polyline(&half, true), 0xffd0cb, 1.0);
            c.stroke(&polyline(&half[2..15], false), 0xd98a84, 0.8, 0.0018);
        }
        c.fill(&ellipse(Vec2::new(x + 0.0045, 0.88), Vec2::new(0.0022, 0.008)), 0xfff4f0, 0.9);
    }
    c.finish()
}

/// Where the two outer joints of the fingers lie in the texture.
const JOINTS: [f32; 2] = [0.748, 0.833];

fn square(x0: f32, y0: f32, x1: f32, y1: f32) -> tiny_skia::Path {
    polyline(&[Vec2::new(x0, y0), Vec2::new(x1, y0), Vec2::new(x1, y1), Vec2::new(x0, y1)], true)
}

/// Stockings: a knit band with two pale lines, thinner over the knee, darker towards the contour of the legs.
pub(super) fn stocking() -> Picture {
    let [dark, cloth, thin, band, rib, line] = [0x282242, 0x39325a, 0x564a72, 0x4a4470, 0x2b2548, 0xf0e8f2].map(rgb);
    Picture::from_fn(1024, 1024, |uv| {
        let knee = (-((uv.y - 0.43) / 0.08).powi(2)).exp();
        let front = (-((uv.x - 0.5) / 0.13).powi(2)).exp();
        let mut color = mix(dark, cloth, 0.5 + 0.5 * smoothstep(0.0, 0.25, (uv.x - 0.5).abs()).mul_add(-0.6, 0.6));
        color = mix(color, thin, 0.75 * front * (0.35 + 0.65 * knee) + 0.2 * front);
        // Folds at the ankle.
        let fold = smoothstep(0.75, 0.95, noise(Vec2::new(uv.x * 4.0, uv.y * 60.0), [4, 60], 4));
        color = mix(color, dark, 0.5 * fold * smoothstep(0.9, 1.0, uv.y));
        if uv.y < BAND {
            // Ribs of the knit, rounded off above.
            let across = ((uv.x * 72.0).fract() - 0.5).abs();
            color = mix(band, rib, smoothstep(0.24, 0.4, across) * smoothstep(0.008, 0.014, uv.y));
            let lines =
                smoothstep(0.0105, 0.0095, (uv.y - 0.028).abs()) + smoothstep(0.004, 0.003, (uv.y - 0.05).abs());
            color = mix(color, line * if across > 0.32 { 0.86 } else { 1.0 }, lines);
        }
        color = mix(color, rib, smoothstep(0.0025, 0.0015, (uv.y - BAND).abs()));
        [color.x, color.y, color.z, 1.0]
    })
}

/// Lower edge of the knit band of a stocking in its texture.
const BAND: f32 = 0.069;

/// Boots: leather with seams, straps and laces, the sole below.
pub(super) fn boots() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0x4c3432));
    // Light from above: upper parts warmer, the ankle darker.
    c.linear(
        &square(0.0, 0.0, 1.0, 0.84),
        Vec2::new(0.0, 0.0),
        Vec2::new(0.0, 0.84),
        &[(0.0, 0x5a3f38, 1.0), (0.42, 0x452f2f, 1.0), (0.62, 0x543a35, 1.0), (1.0, 0x402c2c, 1.0)],
    );
    // The turned edge.
    c.fill(&square(0.0, 0.0, 1.0, 0.085), 0x6e4d41, 1.0);
    c.fill(&square(0.0, 0.082, 1.0, 0.09), 0x241820, 1.0);
    // The tongue under the laces, eyelets beside it.
    let tongue = [Vec2::new(0.447, 0.092), Vec2::new(0.553, 0.092), Vec2::new(0.538, 0.575), Vec2::new(0.462, 0.575)];
    c.fill(&polyline(&tongue, true), 0x33222a, 1.0);
    for side in [-1.0f32, 1.0] {
        let edge = [Vec2::new(0.5 + side * 0.053, 0.092), Vec2::new(0.5 + side * 0.038, 0.575)];
        c.stroke(&polyline(&edge, false), 0x7a5747, 1.0, 0.005);
        let seam = [
            Vec2::new(0.5 + side * 0.09, 0.095),
            Vec2::new(0.5 + side * 0.082, 0.45),
            Vec2::new(0.5 + side * 0.12, 0.66),
        ];
        c.stroke(&curve(&seam, false), 0x281a20, 1.0, 0.004);
        let shine = [
            Vec2::new(0.5 + side * 0.15, 0.16),
            Vec2::new(0.5 + side * 0.148, 0.28),
            Vec2::new(0.5 + side * 0.14, 0.4),
        ];
        c.stroke(&curve(&shine, false), 0x7d5c50, 0.8, 0.012);
    }
    // Toe cap and heel patch.
    c.stroke(&polyline(&[Vec2::new(0.0, 0.7), Vec2::new(1.0, 0.7)], false), 0x281a20, 0.9, 0.005);
    c.glow(Vec2::new(0.5, 0.735), Vec2::new(0.13, 0.022), 0x8a6556, 0.75);
    // Sole: a pale welt, dark below; straps; laces.
    c.fill(&square(0.0, 0.84, 1.0, 1.0), 0x241a22, 1.0);
    c.fill(&square(0.0, 0.85, 1.0, 0.874), 0x8a6750, 1.0);
    c.fill(&square(0.0, 0.93, 0.45, 0.96), 0x2a1c24, 1.0);
    c.fill(&square(0.55, 0.93, 1.0, 0.96), 0xe6d3ad, 1.0);
    let mut picture = c.finish();
    picture.map(|uv, [r, g, b, a]| {
        let n = (noise(uv * 60.0, [60, 60], 8) - 0.5) * 0.018;
        [r + n, g + n, b + n, a]
    });
    picture
}

/// Gold as painters see it: crisp bands of light, warm reflections from below.
pub(super) fn metal_matcap() -> Picture {
    let [dark, deep, body, light, glow] = [0x3c2414, 0x7a4a1c, 0xc9902f, 0xffe6a0, 0xf0a860].map(rgb);
    Picture::from_fn(256, 256, |uv| {
        let p = (uv - 0.5) * 2.0;
        let slope = p.y + 0.18 * p.x;
        let mut color = mix(body, deep, smoothstep(-0.2, 0.25, slope));
        color = mix(color, dark, smoothstep(0.1, 0.32, slope) * smoothstep(0.62, 0.4, slope));
        color = mix(color, glow, smoothstep(0.5, 0.72, slope));
        color = mix(color, light, smoothstep(-0.28, -0.36, slope) * smoothstep(-0.72, -0.6, slope));
        [color.x, color.y, color.z, 1.0]
    })
}
