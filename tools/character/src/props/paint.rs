//! Textures of metal, stones and fire.

use glam::{Vec2, Vec3};

use crate::picture::{Canvas, Picture, curve, ellipse, noise, polyline, rgb, smoothstep};

fn mix(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a + (b - a) * t.clamp(0.0, 1.0)
}

fn opaque(c: Vec3) -> [f32; 4] {
    [c.x, c.y, c.z, 1.0]
}

/// Shape of the highlight on metal, white on black: a broad slanting band, a thin one beside it, a star.
pub(super) fn metal_highlight() -> Picture {
    let mut c = Canvas::new(256, 256, Some(0x000000));
    let band = |from: f32, to: f32| {
        polyline(
            &[
                Vec2::new(from + 0.18, 0.02),
                Vec2::new(to + 0.18, 0.02),
                Vec2::new(to - 0.18, 0.98),
                Vec2::new(from - 0.18, 0.98),
            ],
            true,
        )
    };
    c.fill(&band(0.34, 0.52), 0xffffff, 1.0);
    c.fill(&band(0.57, 0.61), 0xffffff, 1.0);
    let star: Vec<Vec2> = (0..8)
        .map(|i| {
            let r = if i % 2 == 0 { 0.11 } else { 0.025 };
            Vec2::new(0.74, 0.26) + Vec2::from_angle(i as f32 * std::f32::consts::FRAC_PI_4) * r
        })
        .collect();
    c.fill(&polyline(&star, true), 0xffffff, 1.0);
    c.finish()
}

/// Amber: dark above, where light enters, bright below, where it gathers; with bubbles and a leaf of another time.
pub(super) fn amber() -> Picture {
    let [dark, body, bright, glow] = [0x8a3410, 0xd0701a, 0xf6a42a, 0xffe08a].map(rgb);
    let mut picture = Picture::from_fn(256, 256, |uv| {
        let cloud = noise(uv * Vec2::new(5.0, 6.0), [64, 64], 91) - 0.5;
        let v = uv.y + 0.22 * cloud + 0.1 * (uv.x - 0.5);
        let mut color = mix(dark, body, smoothstep(0.05, 0.45, v));
        color = mix(color, bright, smoothstep(0.4, 0.75, v));
        let d = (uv - Vec2::new(0.6, 0.76)) / Vec2::new(0.3, 0.2);
        color = mix(color, glow, smoothstep(1.0, 0.1, d.length()));
        let edge = (uv.x - 0.5).abs() * 2.0;
        opaque(mix(color, dark, 0.55 * smoothstep(0.7, 1.0, edge)))
    });
    let mut c = Canvas::new(256, 256, None);
    let leaf = [Vec2::new(0.34, 0.6), Vec2::new(0.42, 0.48), Vec2::new(0.52, 0.44), Vec2::new(0.46, 0.55)];
    c.fill(&curve(&leaf, true), 0x7a2c0e, 0.65);
    c.stroke(&curve(&[Vec2::new(0.33, 0.63), Vec2::new(0.52, 0.44)], false), 0x5e1f0a, 0.7, 0.012);
    for (x, y, r) in [(0.62f32, 0.5f32, 0.03f32), (0.68, 0.42, 0.018), (0.4, 0.74, 0.022)] {
        c.stroke(&ellipse(Vec2::new(x, y), Vec2::splat(r)), 0xffdc90, 0.8, 0.01);
    }
    let over = c.finish();
    let width = picture.width;
    picture.map(|uv, below| {
        let at = (uv.y * width as f32) as usize * width as usize + (uv.x * width as f32) as usize;
        let [r, g, b, a] = over.rgba[at].map(|v| f32::from(v) / 255.0);
        let m = |x: f32, y: f32| x + (y - x) * a;
        [m(below[0], r), m(below[1], g), m(below[2], b), 1.0]
    });
    picture
}

/// Polish of a rounded stone: a window above, light that passed through below. Added, so black where nothing shines.
pub(super) fn amber_matcap() -> Picture {
    Picture::from_fn(128, 128, |uv| {
        let p = (uv - 0.5) * 2.0;
        let window = smoothstep(0.3, 0.22, (p.x + 0.32).abs() + 0.3 * (p.y + 0.42).abs())
            * smoothstep(0.3, 0.24, (p.y + 0.42).abs());
        let back = smoothstep(0.62, 0.78, p.length()) * smoothstep(0.98, 0.85, p.length()) * smoothstep(0.1, 0.6, p.y);
        let color = Vec3::ONE * window + rgb(0xffa040) * back * 0.6;
        opaque(color.min(Vec3::ONE))
    })
}

/// What facets mirror: shards of sky, white and deep blue, with a hint of the spectrum. Added to the stone's colour.
pub(super) fn diamond_matcap() -> Picture {
    Picture::from_fn(128, 128, |uv| {
        let p = (uv - 0.5) * 2.0;
        let angle = p.y.atan2(p.x);
        let shard = noise(Vec2::new((angle / std::f32::consts::TAU + 0.5) * 11.0, p.length() * 3.0), [11, 64], 77);
        let light = smoothstep(0.55, 0.62, shard);
        let tint = mix(rgb(0x9fe0ff), rgb(0xf3c8ff), 0.5 + 0.5 * (angle * 2.0).sin());
        opaque(tint * (0.12 + 0.5 * light) + Vec3::ONE * 0.4 * smoothstep(0.72, 0.78, shard))
    })
}

/// The outline of the flame, foot in the middle below, three tongues.
fn flame_shape(scale: f32, lift: f32) -> Vec<Vec2> {
    [
        [0.0, 0.0],
        [0.26, 0.03],
        [0.37, 0.17],
        [0.33, 0.33],
        [0.36, 0.46],
        [0.27, 0.56],
        [0.25, 0.42],
        [0.17, 0.5],
        [0.17, 0.66],
        [0.08, 0.79],
        [0.02, 1.0],
        [-0.03, 0.78],
        [-0.12, 0.65],
        [-0.1, 0.5],
        [-0.19, 0.56],
        [-0.25, 0.7],
        [-0.29, 0.5],
        [-0.35, 0.36],
        [-0.36, 0.17],
        [-0.25, 0.03],
    ]
    .iter()
    .map(|[x, y]| Vec2::new(0.5 + x * scale * 1.15, 0.965 - lift - y * scale * 0.93))
    .collect()
}

/// A flame as cartoons have it: white heart, yellow body, orange tongues, a red breath round it.
pub(super) fn flame() -> Picture {
    let mut c = Canvas::new(256, 256, None);
    for (i, alpha) in [0.06f32, 0.08, 0.1, 0.14].iter().enumerate() {
        c.fill(&curve(&flame_shape(1.06 - 0.03 * i as f32, 0.0), true), 0xff3a10, *alpha);
    }
    for (scale, lift, hex, alpha) in [
        (0.94, 0.01, 0xf4541a, 0.92),
        (0.8, 0.015, 0xfb8a1e, 1.0),
        (0.62, 0.02, 0xffc93c, 1.0),
        (0.4, 0.03, 0xfff6c8, 1.0),
    ] {
        c.fill(&curve(&flame_shape(scale, lift), true), hex, alpha);
    }
    // Sparks that left the tips.
    for (x, y, r) in [(0.3, 0.24, 0.018), (0.7, 0.34, 0.014), (0.6, 0.12, 0.011)] {
        c.fill(&ellipse(Vec2::new(x, y), Vec2::new(r * 0.8, r * 1.4)), 0xffa030, 1.0);
    }
    c.finish()
}

/// The same flame as heat: 1 in the heart, 0 outside.
pub(super) fn flame_heat() -> Picture {
    const STEPS: u32 = 40;
    let mut c = Canvas::new(256, 256, Some(0x000000));
    for i in 1..=STEPS {
        let t = i as f32 / STEPS as f32;
        let grey = (t.powf(0.8) * 255.0).round() as u32;
        c.fill(&curve(&flame_shape(1.12 - 0.98 * t, 0.04 * t), true), grey * 0x010101, 1.0);
    }
    c.finish()
}

/// What the amber encloses: a leaf of another time, bubbles, dust. It repeats.
pub(super) fn amber_inclusions() -> Picture {
    let mut c = Canvas::new(256, 256, None);
    let leaf = [Vec2::new(0.34, 0.6), Vec2::new(0.42, 0.48), Vec2::new(0.52, 0.44), Vec2::new(0.46, 0.55)];
    c.fill(&curve(&leaf, true), 0x6a2c10, 0.9);
    c.stroke(&curve(&[Vec2::new(0.33, 0.63), Vec2::new(0.52, 0.44)], false), 0x3e1408, 0.9, 0.012);
    for (x, y, r) in [(0.62f32, 0.5f32, 0.03f32), (0.68, 0.4, 0.018), (0.4, 0.76, 0.022), (0.2, 0.24, 0.016)] {
        let at = Vec2::new(x, y);
        c.fill(&ellipse(at, Vec2::splat(r)), 0xffd27a, 0.25);
        c.stroke(&ellipse(at, Vec2::splat(r)), 0xfff0c8, 0.9, 0.008);
        c.fill(&ellipse(at - r * 0.35, Vec2::splat(r * 0.22)), 0xffffff, 0.9);
    }
    for i in 0..26 {
        let random = |k| crate::picture::hash(i, k, 95);
        let at = Vec2::new(0.04 + 0.92 * random(1), 0.04 + 0.92 * random(2));
        c.fill(&ellipse(at, Vec2::splat(0.003 + 0.006 * random(3))), 0x5a2408, 0.35 + 0.4 * random(4));
    }
    c.finish()
}
