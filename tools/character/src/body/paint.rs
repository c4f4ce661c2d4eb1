//! Textures of skin, stockings, boots and metal.

use glam::{Vec2, Vec3};

use crate::picture::{Canvas, Picture, ellipse, noise, polyline, rgb, smoothstep};

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
    // Wrist and palm are warmer; the ring starts on top of the hand.
    c.glow(Vec2::new(0.25, 0.8), Vec2::new(0.13, 0.15), 0xf6b7aa, 0.55);
    // Knuckles and finger tips blush.
    for i in 0..5 {
        let x = 0.52 + 0.092 * i as f32;
        for (y, size) in [(0.63, 0.035), (0.74, 0.03)] {
            c.glow(Vec2::new(x + 0.002, y), Vec2::new(0.028, size), 0xf3a89c, 0.35);
            c.glow(Vec2::new(x + 0.084, y), Vec2::new(0.028, size), 0xf3a89c, 0.35);
        }
        c.linear(
            &square(x, 0.82, x + 0.084, 0.95),
            Vec2::new(0.0, 0.82),
            Vec2::new(0.0, 0.93),
            &[(0.0, 0xf4aa9e, 0.0), (1.0, 0xf29c92, 0.6)],
        );
        // Nails lie on top, where the ring begins and ends.
        for edge in [x, x + 0.084] {
            c.fill(&ellipse(Vec2::new(edge, 0.872), Vec2::new(0.0135, 0.034)), 0xffd3cd, 1.0);
            c.stroke(&ellipse(Vec2::new(edge, 0.872), Vec2::new(0.0135, 0.034)), 0xd98a84, 0.7, 0.0022);
        }
    }
    c.finish()
}

fn square(x0: f32, y0: f32, x1: f32, y1: f32) -> tiny_skia::Path {
    polyline(&[Vec2::new(x0, y0), Vec2::new(x1, y0), Vec2::new(x1, y1), Vec2::new(x0, y1)], true)
}

/// Stockings: a hem with two pale lines, thinner over the knee, darker towards the contour of the legs.
pub(super) fn stocking() -> Picture {
    let [dark, cloth, thin, hem, line] = [0x2a2338, 0x3d3550, 0x594a62, 0x2c2440, 0xd9cfe6].map(rgb);
    Picture::from_fn(512, 1024, |uv| {
        let knee = (-((uv.y - 0.43) / 0.08).powi(2)).exp();
        let front = (-((uv.x - 0.5) / 0.13).powi(2)).exp();
        let mut color = mix(dark, cloth, 0.5 + 0.5 * smoothstep(0.0, 0.25, (uv.x - 0.5).abs()).mul_add(-0.6, 0.6));
        color = mix(color, thin, 0.75 * front * (0.35 + 0.65 * knee) + 0.2 * front);
        // Folds behind the knee and at the ankle.
        let fold = smoothstep(0.75, 0.95, noise(Vec2::new(uv.x * 4.0, uv.y * 60.0), [4, 60], 4));
        color = mix(color, dark, 0.5 * fold * smoothstep(0.9, 1.0, uv.y));
        if uv.y < 0.075 {
            color = hem;
            let lines =
                smoothstep(0.0035, 0.002, (uv.y - 0.022).abs()) + smoothstep(0.0055, 0.004, (uv.y - 0.048).abs());
            color = mix(color, line, lines);
        }
        [color.x, color.y, color.z, 1.0]
    })
}

/// Boots: leather with seams and laces, the sole below.
pub(super) fn boots() -> Picture {
    let mut c = Canvas::new(1024, 1024, Some(0x6a4b40));
    // Light from above: upper parts warmer, the ankle darker.
    c.linear(
        &square(0.0, 0.0, 1.0, 0.84),
        Vec2::new(0.0, 0.0),
        Vec2::new(0.0, 0.84),
        &[(0.0, 0x7a5747, 1.0), (0.42, 0x5d4038, 1.0), (0.62, 0x6f4e41, 1.0), (1.0, 0x59403a, 1.0)],
    );
    // The turned edge.
    c.fill(&square(0.0, 0.0, 1.0, 0.085), 0x4a3233, 1.0);
    c.fill(&square(0.0, 0.082, 1.0, 0.09), 0x33222a, 1.0);
    // Tongue and laces at the front.
    c.fill(
        &polyline(
            &[Vec2::new(0.452, 0.095), Vec2::new(0.548, 0.095), Vec2::new(0.53, 0.62), Vec2::new(0.47, 0.62)],
            true,
        ),
        0x4b3536,
        1.0,
    );
    for i in 0..7 {
        let y = 0.125 + 0.068 * i as f32;
        for side in [-1.0f32, 1.0] {
            let a = Vec2::new(0.5 - side * 0.05, y);
            let b = Vec2::new(0.5 + side * 0.05, y + 0.05);
            c.stroke(&polyline(&[a, b], false), 0x2b1c24, 1.0, 0.0135);
            c.stroke(&polyline(&[a, b], false), 0xe3cda6, 1.0, 0.0085);
            c.fill(&ellipse(Vec2::new(0.5 + side * 0.056, y + 0.052), Vec2::splat(0.0075)), 0xe8bd5c, 1.0);
        }
    }
    for side in [-1.0f32, 1.0] {
        let seam = [
            Vec2::new(0.5 + side * 0.066, 0.095),
            Vec2::new(0.5 + side * 0.06, 0.45),
            Vec2::new(0.5 + side * 0.1, 0.64),
        ];
        c.stroke(&crate::picture::curve(&seam, false), 0x3a2629, 1.0, 0.004);
        let shine = [Vec2::new(0.5 + side * 0.12, 0.16), Vec2::new(0.5 + side * 0.115, 0.4)];
        c.stroke(&polyline(&shine, false), 0x9a7460, 0.55, 0.014);
    }
    // Straps, heel patch, toe cap.
    for y in [0.13, 0.435] {
        c.fill(&square(0.0, y - 0.02, 0.4, y + 0.02), 0x3d2930, 1.0);
        c.fill(&square(0.6, y - 0.02, 1.0, y + 0.02), 0x3d2930, 1.0);
    }
    c.stroke(&polyline(&[Vec2::new(0.0, 0.7), Vec2::new(1.0, 0.7)], false), 0x38262a, 0.9, 0.005);
    c.glow(Vec2::new(0.5, 0.735), Vec2::new(0.16, 0.03), 0xa8816b, 0.6);
    // Sole.
    c.fill(&square(0.0, 0.84, 1.0, 1.0), 0x2c2029, 1.0);
    c.fill(&square(0.0, 0.862, 1.0, 0.872), 0x8a6a55, 1.0);
    let mut picture = c.finish();
    picture.map(|uv, [r, g, b, a]| {
        let n = (noise(uv * 60.0, [60, 60], 8) - 0.5) * 0.022;
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
