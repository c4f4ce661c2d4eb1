//! Textures of the hair: u runs across a lock, v from root to tip. Four strips stand side by side; the last is the darker
//! one of the lower layers.

use glam::{Vec2, Vec3};

use super::lock::BAND_V;
use crate::picture::{Picture, noise, rgb, smoothstep};

fn mix(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a + (b - a) * t.clamp(0.0, 1.0)
}

/// Strands: streaks across u that change slowly along v; -1..1.
fn strands(uv: Vec2, scale: f32, seed: u32) -> f32 {
    let bend = (noise(Vec2::new(uv.x * 6.0, uv.y * 3.0), [6, 64], seed + 40) - 0.5) * 0.03;
    let n = noise(Vec2::new((uv.x + bend) * scale, uv.y * 5.0), [scale as i32, 64], seed);
    n * 2.0 - 1.0
}

fn paint(stops: [u32; 4], line: u32, dark: f32) -> Picture {
    let [root, upper, lower, tip] = stops.map(rgb);
    let line = rgb(line);
    Picture::from_fn(1024, 1024, move |uv| {
        let across = (uv.x * 4.0).fract();
        let strip = (uv.x * 4.0).floor();
        let v = uv.y + 0.02 * strands(Vec2::new(uv.x, 0.3), 48.0, 3);
        let mut color = mix(root, upper, smoothstep(0.0, 0.24, v));
        color = mix(color, lower, smoothstep(0.35, 0.72, v));
        color = mix(color, tip, smoothstep(0.68, 1.0, v));
        // No two neighbours have quite the same tone.
        color *= [1.0, 0.965, 1.02, 1.0][(strip as usize).min(3)];
        // Where the head is round towards the light, all hair is a little paler.
        let gloss = (-((uv.y + 0.03 * strands(Vec2::new(uv.x, 0.7), 60.0, 8) - BAND_V) / 0.085).powi(2)).exp();
        color = mix(color, Vec3::ONE, 0.2 * gloss);
        // Broad and fine strands.
        let broad = strands(uv, 40.0, 11);
        let fine = strands(uv, 160.0, 12);
        color = mix(color, line, 0.2 * smoothstep(0.1, 0.9, broad) + 0.1 * smoothstep(0.2, 1.0, fine));
        color = mix(color, Vec3::ONE, 0.16 * smoothstep(0.2, 0.95, -broad) * smoothstep(0.05, 0.3, v));
        // A few drawn lines, pressed at root and tip.
        let pen = smoothstep(0.84, 0.96, noise(Vec2::new(uv.x * 96.0, uv.y * 1.5), [96, 64], 23));
        color = mix(color, line, 0.5 * pen * (smoothstep(0.45, 0.95, v) + smoothstep(0.25, 0.0, v) * 0.7));
        // Locks turn away at their edges.
        let edge = (across - 0.5).abs() * 2.0;
        color = mix(color, line, 0.3 * smoothstep(0.62, 1.0, edge));
        if strip > 2.5 {
            color = mix(color, line, dark);
        }
        [color.x, color.y, color.z, 1.0]
    })
}

/// Lit colour.
pub(super) fn lit() -> Picture {
    paint([0xc0bae0, 0xdedaf2, 0xcac7ea, 0x979cd8], 0x8d86c0, 0.3)
}

/// Colour in shade, before the tint of the material.
pub(super) fn shade() -> Picture {
    paint([0xaea6d4, 0xc9c2e4, 0xb6b0de, 0x8b8ecf], 0x7f75b2, 0.3)
}

/// The band of light round the head. Red: a drawn band, jagged below as brushes leave it. Green: a thin broken line under
/// it, with a breath of light round it. Blue: strands. Every lock crosses the same height of the head where v is 0.3; the band stands a little lower, because view
/// and light from the front move it up.
pub(super) fn highlight() -> Picture {
    const MIDDLE: f32 = BAND_V + 0.07;
    Picture::from_fn(2048, 1024, |uv| {
        let jag = 0.022 * strands(Vec2::new(uv.x, 0.2), 72.0, 5) + 0.014 * strands(Vec2::new(uv.x, 0.6), 170.0, 6);
        // Runs up where a lock turns away, so that each has an arc of its own.
        let across = ((uv.x * 4.0).fract() - 0.5) * 2.0;
        let v = uv.y + 0.016 * across * across;
        let top = smoothstep(MIDDLE - 0.024 + jag * 0.4, MIDDLE - 0.02 + jag * 0.4, v);
        let bottom = smoothstep(MIDDLE + 0.014 + jag, MIDDLE + 0.008 + jag, v);
        let line = smoothstep(0.005, 0.003, (v - MIDDLE - 0.034 - jag * 0.7).abs());
        let broken = smoothstep(-0.55, -0.25, strands(uv, 96.0, 7));
        let below = line * smoothstep(-0.1, 0.2, strands(uv, 60.0, 9));
        let glow = 0.35 * smoothstep(0.05, 0.0, (v - MIDDLE - 0.034).abs());
        let strand = strands(uv, 160.0, 10) * 0.5 + 0.5;
        [top * bottom * broken, below.max(glow) * broken, strand, 1.0]
    })
}

/// A soft arc of light above, for renderers that know no band.
pub(super) fn matcap() -> Picture {
    let tint = rgb(0xf2ecff);
    Picture::from_fn(256, 256, |uv| {
        let p = (uv - 0.5) * 2.0;
        let r = p.length();
        // An arc where the surface looks up by about 45 degrees.
        let arc = (-((p.y + 0.60 - 0.25 * p.x * p.x) / 0.085).powi(2)).exp() * smoothstep(0.9, 0.35, p.x.abs());
        let rim = smoothstep(0.9, 1.0, r) * 0.16;
        let value = (arc * 0.55 + rim).min(1.0);
        [tint.x * value, tint.y * value, tint.z * value, 1.0]
    })
}

/// Strands on nothing.
pub(super) fn card() -> Picture {
    let (light, dark) = (rgb(0xe6e2fa), rgb(0x9f98d4));
    Picture::from_fn(512, 512, |uv| {
        let across = (uv.x * 4.0).fract();
        let lines = noise(Vec2::new(uv.x * 72.0, uv.y * 2.0), [72, 64], 61);
        let ends = smoothstep(0.0, 0.2, uv.y)
            * smoothstep(1.0, 0.45, uv.y + 0.25 * noise(Vec2::new(uv.x * 72.0, 0.5), [72, 4], 62));
        let sides = smoothstep(0.0, 0.15, across) * smoothstep(1.0, 0.85, across);
        let alpha = smoothstep(0.66, 0.8, lines) * ends * sides;
        let color = mix(light, dark, noise(Vec2::new(uv.x * 40.0, 1.0), [40, 4], 63));
        [color.x, color.y, color.z, alpha * 0.7]
    })
}
