// The nearest depth round each block of the map of the bangs: where nothing hangs before a receiver, no tap need be taken.
import package::bind::picture::{PictureVarying, picture_varying};
import package::lib::bangs::BANGS_BLOCK;

@group(0) @binding(0) var map: texture_2d<f32>;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

@fragment
fn fs_main(in: PictureVarying) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(map)) - 1;
    // The taps of a place in this block reach two texels before it and two behind.
    let first = vec2i(in.position.xy) * BANGS_BLOCK - 2;
    var nearest = 1.0;
    for (var y = 0; y < BANGS_BLOCK + 4; y++) {
        for (var x = 0; x < BANGS_BLOCK + 4; x++) {
            nearest = min(nearest, textureLoad(map, clamp(first + vec2i(x, y), vec2i(0), last), 0).r);
        }
    }
    return vec4f(nearest, 0.0, 0.0, 1.0);
}
