// Layers that were summed by weight over the picture, sample by sample: each entry draws one of them.
import package::bind::picture::{PictureVarying, picture_varying};
import package::lib::color::srgb_from_linear;
import package::lib::weighted::weighted_resolved;

@if(multisampled) @group(0) @binding(0) var sums: texture_multisampled_2d<f32>;
@if(multisampled) @group(0) @binding(1) var left: texture_multisampled_2d<f32>;
@if(!multisampled) @group(0) @binding(0) var sums: texture_2d<f32>;
@if(!multisampled) @group(0) @binding(1) var left: texture_2d<f32>;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

// Premultiplied.
fn resolved(position: vec4f, sample: i32) -> vec4f {
    let at = vec2i(position.xy);
    let all = weighted_resolved(textureLoad(sums, at, sample), textureLoad(left, at, sample).r);
    var color = all.rgb;
    // As the target holds it.
    @if(encode_srgb) color = srgb_from_linear(color);
    return vec4f(color * all.a, all.a);
}

@fragment
fn fs_sample_0(in: PictureVarying) -> @location(0) vec4f {
    return resolved(in.position, 0);
}

@if(multisampled)
@fragment
fn fs_sample_1(in: PictureVarying) -> @location(0) vec4f {
    return resolved(in.position, 1);
}

@if(multisampled)
@fragment
fn fs_sample_2(in: PictureVarying) -> @location(0) vec4f {
    return resolved(in.position, 2);
}

@if(multisampled)
@fragment
fn fs_sample_3(in: PictureVarying) -> @location(0) vec4f {
    return resolved(in.position, 3);
}
