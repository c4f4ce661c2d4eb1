// The nearest depth round each block of the map of the bangs: where nothing hangs before a receiver, no tap need be taken.
import package::lib::bangs::BANGS_BLOCK;

@group(0) @binding(0) var map: texture_2d<f32>;

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    // One triangle that covers everything.
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fs_main(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(map)) - 1;
    // The taps of a place in this block reach two texels before it and two behind.
    let first = vec2i(position.xy) * BANGS_BLOCK - 2;
    var nearest = 1.0;
    for (var y = 0; y < BANGS_BLOCK + 4; y++) {
        for (var x = 0; x < BANGS_BLOCK + 4; x++) {
            nearest = min(nearest, textureLoad(map, clamp(first + vec2i(x, y), vec2i(0), last), 0).r);
        }
    }
    return vec4f(nearest, 0.0, 0.0, 1.0);
}
