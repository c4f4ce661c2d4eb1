//! Textures of the hair: u runs across a lock, v from root to tip. Strips of several widths stand side by side; the last is the
//! dark one of the inside.

use glam::{Vec2, Vec3};

use super::lock::{BAND_V, INNER, STRIPS, UNDER};
use crate::picture::{Picture, hash, noise, rgb, smoothstep};

fn mix(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a + (b - a) * t.clamp(0.0, 1.0)
}

/// Strands: streaks across u that change slowly along v; -1..1.
fn strands(uv: Vec2, scale: f32, seed: u32) -> f32 {
    let bend = (noise(Vec2::new(uv.x * 6.0, uv.y * 3.0), [6, 64], seed + 40) - 0.5) * 0.03;
    let n = noise(Vec2::new((uv.x + bend) * scale, uv.y * 5.0), [scale as i32, 64], seed);
    n * 2.0 - 1.0
}

/// Strip of the texture at u, and the place across it, 0..1.
fn strip(u: f32) -> (usize, f32) {
    let i = STRIPS.iter().position(|[_, to]| u < *to).unwrap_or(STRIPS.len() - 1);
    let [from, to] = STRIPS[i];
    (i, (u - from) / (to - from))
}

/// Colours of root, middle, tip and the inside, and of drawn lines.
struct Tones {
    root: u32,
    middle: u32,
    tip: u32,
    inner: u32,
    line: u32,
}

fn paint(tones: &Tones) -> Picture {
    let [root, middle, tip, inner, line] = [tones.root, tones.middle, tones.tip, tones.inner, tones.line].map(rgb);
    Picture::from_fn(2048, 1024, move |uv| {
        let (strip, across) = strip(uv.x);
        let v = uv.y + 0.03 * strands(Vec2::new(uv.x, 0.3), 48.0, 3);
        let mut color = mix(root, middle, smoothstep(-0.02, 0.25, v));
        color = mix(color, tip, smoothstep(0.56, 1.0, v));
        match strip {
            UNDER => color = mix(color, inner, 0.28),
            INNER => color = mix(inner, color, 0.12),
            _ => {}
        }
        // No two neighbours have quite the same tone.
        color *= [1.0, 0.97, 1.01, 0.96, 1.0, 1.0, 1.0][strip];
        // Broad strands, some paler and some darker.
        let broad = strands(uv, 36.0, 11);
        let fine = strands(uv, 120.0, 12);
        color = mix(color, line, 0.13 * smoothstep(0.15, 0.9, broad) + 0.05 * smoothstep(0.2, 1.0, fine));
        color = mix(color, Vec3::ONE, 0.12 * smoothstep(0.2, 0.95, -broad) * smoothstep(0.08, 0.3, v));
        // A few drawn lines, pressed at root and tip.
        let pen = smoothstep(0.8, 0.92, noise(Vec2::new(uv.x * 110.0, uv.y * 1.6), [110, 64], 23));
        let press = 0.4 + smoothstep(0.5, 0.95, v) + smoothstep(0.25, 0.0, v);
        color = mix(color, line, 0.5 * pen * press.min(1.0));
        // Locks turn away at their edges, and have a paler back.
        let edge = (across - 0.5).abs() * 2.0;
        color = mix(color, line, 0.5 * smoothstep(0.74, 1.0, edge));
        color = mix(color, Vec3::ONE, 0.1 * smoothstep(0.45, 0.0, (across - 0.42).abs() * 2.0));
        [color.x, color.y, color.z, 1.0]
    })
}

/// Lit colour.
pub(super) fn lit() -> Picture {
    paint(&Tones { root: 0x968ccd, middle: 0xcdc8f0, tip: 0x828ce1, inner: 0x7869af, line: 0x8078be })
}

/// Colour in shade, before the tint of the material.
pub(super) fn shade() -> Picture {
    paint(&Tones { root: 0x887ec2, middle: 0xbab2e2, tip: 0x7880d4, inner: 0x6a5ca2, line: 0x7268ae })
}

/// Half height of a mark of the band of light at full size, in v.
const MARK: f32 = 0.036;

/// The band of light round the head: marks along the strands that taper to both ends, shorter towards the borders of a lock.
/// Red: their core. Green: a breath round them. Every lock crosses the same height of the head where v is
/// 0.3; the band stands a little lower, because view and light from the front move it up.
pub(super) fn highlight() -> Picture {
    Picture::from_fn(2048, 1024, |uv| {
        let (strip, across) = strip(uv.x);
        let edge = (across - 0.5) * 2.0;
        // One lens for each lock, of marks that taper along the strands.
        let lens = MARK * [1.0, 0.85, 0.85, 0.65, 0.3, 0.0, 0.0][strip] * (1.0 - edge.abs().powf(2.2)).max(0.0);
        let low = noise(Vec2::new(uv.x * 20.0, 0.5), [20, 4], 5);
        let point = |cells: f32, seed: u32| {
            let cell = (uv.x * cells).floor();
            let x = (uv.x * cells - cell - 0.5).abs() * 2.0;
            hash(cell as u32, 3, seed).powf(1.5) * (1.0 - x * x)
        };
        let [above, below] = [8, 9].map(|seed| point(58.0, seed).max(0.7 * point(89.0, seed + 4)));
        // It runs up where a lock turns away, so that each has an arc of its own.
        let off = uv.y - (BAND_V + 0.07 - 0.03 * edge * edge + 0.01 * (low - 0.5));
        let long = |points: f32| lens * (0.2 + 0.35 * low + 0.75 * points);
        let half = if off > 0.0 {
            long(below) * 1.25
        } else {
            long(above) * 0.8
        };
        let inside = off.abs() / half.max(1e-4);
        let core = smoothstep(1.0, 0.8, inside) * smoothstep(0.001, 0.006, lens);
        let breath = smoothstep(2.2, 0.4, off.abs() / (lens * 0.7).max(1e-4));
        [0.46 * core, 0.7 * breath, 0.0, 1.0]
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
    let (light, dark) = (rgb(0xdcd8f6), rgb(0x968fd0));
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
