// What passes that spread light on skin over the picture read.
import package::lib::skin_light::{SkinLight, skin_light_of};

@group(0) @binding(1) var skin_light: texture_2d<u32>;
// How far light of each colour goes, mm.
@group(0) @binding(2) var scattering_distance: texture_2d<f32>;

fn skin_light_at(at: vec2i) -> SkinLight {
    return skin_light_of(textureLoad(skin_light, at, 0));
}

// Of a texel whose light goes on at all: mm of the surface that a pixel is, and how far the light goes at most.
struct Reach {
    mm_per_px: f32,
    distance: vec3f,
    far: f32,
}

// `mm_per_px` at a distance of a metre.
fn reach_at(at: vec2i, here: SkinLight, mm_per_px: f32) -> Reach {
    let d = textureLoad(scattering_distance, at, 0).rgb;
    return Reach(max(mm_per_px * here.distance, 1e-6), d, max(d.r, max(d.g, d.b)));
}

// Which of two by two pixels this is.
fn phase_of(at: vec2i) -> u32 {
    return u32((at.x & 1) + (at.y & 1) * 2);
}
