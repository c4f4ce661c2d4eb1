//! Textures of eyes, lashes and mouth.

use glam::{Vec2, Vec3};

use crate::picture::{Picture, hash, noise, rgb, smoothstep};

pub(super) fn mix(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a + (b - a) * t.clamp(0.0, 1.0)
}

/// The iris: amber, dark above, bright below, with pupil, rays, a crescent of light and a rim.
pub(super) fn iris() -> Picture {
    let [dark, middle, bright, glow] = [0x45141f, 0xa8541c, 0xf0a02c, 0xffeaa2].map(rgb);
    let (rim, pupil) = (rgb(0x3d1512), rgb(0x270b12));
    Picture::from_fn(512, 512, |uv| {
        let d = (uv - 0.5) / 0.49;
        let r = d.length();
        let angle = d.y.atan2(d.x);
        // Dark from above, as under the lid, to a bright bowl below.
        let v = d.y * 0.5 + 0.5;
        let mut color = mix(dark, middle, smoothstep(0.14, 0.55, v));
        color = mix(color, bright, smoothstep(0.48, 0.88, v));
        // Rays from the pupil, of uneven length.
        let ray = noise(Vec2::new((angle / std::f32::consts::TAU + 0.5) * 44.0, r * 1.5), [44, 64], 3);
        let rays = (ray - 0.5) * smoothstep(0.28, 0.6, r) * smoothstep(1.0, 0.8, r);
        color = mix(color, if rays > 0.0 { bright } else { dark }, rays.abs() * 0.62);
        // A crescent of light along the lower rim: inside a large circle, outside one that stands higher.
        let outer = smoothstep(0.84, 0.76, r);
        let inner = smoothstep(0.66, 0.78, (d - Vec2::new(0.0, -0.16)).length());
        color = mix(color, glow, 0.92 * outer * inner * smoothstep(0.1, 0.45, d.y));
        // A softer bowl of light between it and the pupil.
        let bowl = Vec2::new(d.x / 0.6, (d.y - 0.46) / 0.3).length();
        color = mix(color, glow, 0.45 * smoothstep(1.0, 0.2, bowl));
        // Pupil, an upright ellipse with a soft edge and a hot border.
        let p = Vec2::new(d.x / 0.32, (d.y + 0.0) / 0.38).length();
        color = mix(color, dark, 0.75 * smoothstep(1.4, 1.0, p));
        color = mix(color, pupil, smoothstep(1.0, 0.92, p));
        let hint = Vec2::new(d.x / 0.22, (d.y - 0.2) / 0.14).length();
        color = mix(color, rgb(0x8a3d22), 0.5 * smoothstep(0.9, 0.2, hint));
        // Shade of the lid.
        color = mix(color, rim, 0.72 * smoothstep(0.36, 0.08, v));
        color = mix(color, rim, smoothstep(0.87, 0.94, r));
        let speck = hash((uv.x * 512.0) as u32, (uv.y * 512.0) as u32, 9) * 0.012;
        [color.x + speck, color.y + speck, color.z + speck, 1.0]
    })
}

/// White of the eye: a little shade above, warm at the corners.
pub(super) fn eye_white() -> Picture {
    let (white, shade, warm) = (rgb(0xfdfbfb), rgb(0xdcd4ea), rgb(0xf3d2cf));
    Picture::from_fn(256, 256, |uv| {
        let mut color = mix(shade, white, smoothstep(0.2, 0.6, uv.y));
        let side = (uv.x - 0.5).abs() * 2.0;
        color = mix(color, warm, 0.55 * smoothstep(0.6, 1.0, side));
        [color.x, color.y, color.z, 1.0]
    })
}

/// Shadow of the lid on white and iris, with a drawn edge.
pub(super) fn lash_shadow() -> Picture {
    let color = rgb(0x6a559c);
    Picture::from_fn(64, 64, |uv| {
        let whole = smoothstep(0.97, 0.86, uv.y) * (0.36 + 0.24 * smoothstep(0.8, 0.3, uv.y));
        [color.x, color.y, color.z, whole]
    })
}

/// Lashes: plum, red-brown towards both ends (upper lash, then lower); last the crease of the lid.
pub(super) fn lash() -> Picture {
    let [plum, brown, thin, crease] = [0x2f1330, 0x7c382f, 0x5e2a36, 0xc07a74].map(rgb);
    Picture::from_fn(256, 64, |uv| {
        let color = if uv.y < 0.41 {
            let ends = smoothstep(0.2, 0.0, uv.x) * 0.8 + smoothstep(0.72, 1.0, uv.x);
            mix(mix(plum, brown, ends), brown, 0.35 * smoothstep(0.16, 0.02, uv.y))
        } else if uv.y < 0.75 {
            mix(brown, thin, smoothstep(0.2, 0.8, uv.x))
        } else {
            crease
        };
        [color.x, color.y, color.z, 1.0]
    })
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
