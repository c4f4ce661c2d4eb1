// Light that spreads: halved down a chain of pictures and added up again (the dual filter, Bjorge 2015).
import package::bind::picture::{PictureVarying, picture_varying};

@group(0) @binding(0) var below: texture_2d<f32>;
@group(0) @binding(1) var bloom_sampler: sampler;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

fn tap(uv: vec2f) -> vec3f {
    return textureSampleLevel(below, bloom_sampler, uv, 0.0).rgb;
}

// To half the size.
@fragment
fn fs_down(in: PictureVarying) -> @location(0) vec4f {
    let h = 0.5 / vec2f(textureDimensions(below));
    let sum = tap(in.uv) * 4.0 + tap(in.uv - h) + tap(in.uv + h) + tap(in.uv + vec2f(h.x, -h.y))
        + tap(in.uv + vec2f(-h.x, h.y));
    return vec4f(sum / 8.0, 1.0);
}

// To twice the size; what is there already is kept.
@fragment
fn fs_up(in: PictureVarying) -> @location(0) vec4f {
    let h = 0.5 / vec2f(textureDimensions(below));
    let straight = tap(in.uv + vec2f(-2.0 * h.x, 0.0)) + tap(in.uv + vec2f(2.0 * h.x, 0.0))
        + tap(in.uv + vec2f(0.0, -2.0 * h.y)) + tap(in.uv + vec2f(0.0, 2.0 * h.y));
    let slanted = tap(in.uv - h) + tap(in.uv + h) + tap(in.uv + vec2f(h.x, -h.y)) + tap(in.uv + vec2f(-h.x, h.y));
    return vec4f((straight + slanted * 2.0) / 12.0, 1.0);
}
