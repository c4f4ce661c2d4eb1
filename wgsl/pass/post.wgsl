// The finished picture: bloom, tone curve, background, and smooth edges where there is one sample a pixel.
import package::bind::picture::{PictureVarying, picture_varying};
import package::lib::color::srgb_from_linear;
import package::lib::tone::toned;

struct PostNumbers {
    // Linear, straight.
    background: vec4f,
    bloom: f32,
    // What light is multiplied by.
    exposure: f32,
    tone: u32,
}

@group(0) @binding(0) var<uniform> post: PostNumbers;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var spread: texture_2d<f32>;
@group(0) @binding(3) var post_sampler: sampler;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

// Premultiplied colour of a place, toned.
fn finished(uv: vec2f) -> vec4f {
    var drawn = textureSampleLevel(picture, post_sampler, uv, 0.0);
    drawn = vec4f(drawn.rgb * post.exposure, drawn.a);
    let light = textureSampleLevel(spread, post_sampler, uv, 0.0).rgb * (post.bloom * post.exposure);
    // Light in the air covers what is behind the character as far as it is bright.
    let alpha = 1.0 - (1.0 - drawn.a) * (1.0 - saturate(max(light.r, max(light.g, light.b))));
    let straight = (drawn.rgb + light) / max(alpha, 1e-4);
    let color = saturate(toned(straight, post.tone)) * alpha;
    let behind = post.background * (1.0 - alpha);
    return vec4f(color + behind.rgb * post.background.a, alpha + behind.a);
}

fn luma(c: vec4f) -> f32 {
    // Perceived brightness, and cover: edges against nothing are edges.
    return sqrt(saturate(dot(c.rgb, vec3f(0.299, 0.587, 0.114)))) + c.a;
}

// Blends along edges (Lottes 2009, "FXAA", the short form).
fn smoothed(uv: vec2f, here: vec4f) -> vec4f {
    let texel = 1.0 / vec2f(textureDimensions(picture));
    let nw = luma(finished(uv + vec2f(-0.5, -0.5) * texel));
    let ne = luma(finished(uv + vec2f(0.5, -0.5) * texel));
    let sw = luma(finished(uv + vec2f(-0.5, 0.5) * texel));
    let se = luma(finished(uv + vec2f(0.5, 0.5) * texel));
    let m = luma(here);
    let low = min(m, min(min(nw, ne), min(sw, se)));
    let high = max(m, max(max(nw, ne), max(sw, se)));
    if high - low < max(0.03, high * 0.06) {
        return here;
    }
    var along = vec2f((sw + se) - (nw + ne), (nw + sw) - (ne + se));
    let reduce = max((nw + ne + sw + se) * 0.03, 1.0 / 128.0);
    along = clamp(along / (min(abs(along.x), abs(along.y)) + reduce), vec2f(-8.0), vec2f(8.0)) * texel;
    let near = 0.5 * (finished(uv - along / 6.0) + finished(uv + along / 6.0));
    let far = 0.5 * near + 0.25 * (finished(uv - along * 0.5) + finished(uv + along * 0.5));
    let found = luma(far);
    return select(far, near, found < low || found > high);
}

@fragment
fn fs_main(in: PictureVarying) -> @location(0) vec4f {
    var color = finished(in.uv);
    @if(antialias) color = smoothed(in.uv, color);
    @if(encode_srgb) color = vec4f(srgb_from_linear(color.rgb), color.a);
    return color;
}
