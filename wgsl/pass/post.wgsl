// The finished picture: bloom, tone curve, background, and smooth edges where there is one sample a pixel.
import package::bind::picture::{PictureVarying, picture_varying};
import package::lib::backdrop::{backdrop_discs, backdrop_dither, backdrop_gradient, linear_from_seen, screened};
import package::lib::color::srgb_from_linear;
import package::lib::tone::toned;

struct PostNumbers {
    // Linear, straight.
    background: vec4f,
    bloom: f32,
    // What light is multiplied by.
    exposure: f32,
    tone: u32,
    has_backdrop: u32,
    // sRGB-encoded.
    backdrop_top: vec3f,
    backdrop_middle: vec3f,
    backdrop_bottom: vec3f,
    backdrop_lit: vec3f,
    backdrop_discs: vec3f,
    // From the top left, share of the picture.
    backdrop_glow: vec2f,
    // Shares of the height.
    backdrop_glow_radius: f32,
    backdrop_disc_radius: f32,
    backdrop_disc_count: u32,
    backdrop_seed: u32,
}

@group(0) @binding(0) var<uniform> post: PostNumbers;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var spread: texture_2d<f32>;
@group(0) @binding(3) var post_sampler: sampler;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

// What is behind everything, straight.
fn behind_all(uv: vec2f) -> vec4f {
    if post.has_backdrop == 0u {
        return post.background;
    }
    let size = vec2f(textureDimensions(picture));
    let wide = vec2f(size.x / size.y, 1.0);
    var color = backdrop_gradient(post.backdrop_top, post.backdrop_middle, post.backdrop_bottom, uv.y);
    let away = distance(uv * wide, post.backdrop_glow * wide) / max(post.backdrop_glow_radius, 1e-4);
    let near = 1.0 - smoothstep(0.0, 1.0, away);
    color = screened(color, post.backdrop_lit * near * near);
    let discs = backdrop_discs(
        uv * wide, wide.x, post.backdrop_discs, post.backdrop_disc_count, post.backdrop_disc_radius, post.backdrop_seed);
    color = screened(color, saturate(discs)) + backdrop_dither(vec2i(uv * size));
    return vec4f(linear_from_seen(color), 1.0);
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
    let background = behind_all(uv);
    let behind = background * (1.0 - alpha);
    return vec4f(color + behind.rgb * background.a, alpha + behind.a);
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
