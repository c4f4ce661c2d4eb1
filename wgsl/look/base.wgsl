// Lit colour and alpha.
import package::bind::frame::frame;
import package::bind::surface::Surface;
import package::bind::uv::{UvTransform, surface_texel, texture_uv};
import package::bind::varying::Varying;
import package::lib::hashed_alpha::{hashed_count, hashed_threshold};
import package::material::{base_texture, base_texture_sampler, material, stage_uv};

struct Base {
    color: vec4f,
    // Alpha below which the surface is cut.
    alpha_cutoff: f32,
    // Size of the texture coordinates, metres.
    hash_m: vec2f,
    // Alpha below which nothing is blended.
    least_alpha: f32,
    texture_uv: UvTransform,
}

// What base colour and alpha are multiplied with.
fn base_texel(in: Varying, uv: vec4f) -> vec4f {
    var texel = vec4f(1.0);
    @if(base_texture) texel = surface_texel(
        base_texture, base_texture_sampler, texture_uv(uv, material.base.texture_uv)
    );
    @if(vertex_color) texel *= in.color;
    return texel;
}

fn base_surface(s: ptr<function, Surface>) {
    s.texel = base_texel(s.at, s.uv);
    let base = material.base.color * s.texel;
    s.lit = base.rgb;
    s.alpha = base.a;
    @if(alpha_coverage && alpha_hashed) s.alpha = 0.25 * hashed_count(s.alpha, base_hash(s.at));
    @if(alpha_coverage && !alpha_hashed) {
        // The cut as a ramp one pixel wide, but never so wide that alpha 1 is not whole or alpha 0 not open. 1e-4: where
        // alpha is flat there is no ramp.
        let cutoff = material.base.alpha_cutoff;
        let widest = 2.0 * min(cutoff, 1.0 - cutoff);
        s.alpha = saturate((s.alpha - cutoff) / max(min(fwidth(s.alpha), widest), 1e-4) + 0.5);
    }
    @if(alpha_mask && !alpha_coverage && alpha_hashed) if s.alpha < base_hash(s.at) {
        discard;
    }
    @if(alpha_mask && !alpha_coverage && !alpha_hashed) if s.alpha < material.base.alpha_cutoff {
        discard;
    }
}

// Threshold of the noise that cuts it.
fn base_hash(in: Varying) -> f32 {
    return hashed_threshold(in.uv.xy * material.base.hash_m, in.clip_position.xy, frame.number);
}

// Whether it is cut out. What casts a shadow is cut without noise, which would be another one in each picture.
fn base_gone(in: Varying) -> bool {
    var cutoff = material.base.alpha_cutoff;
    @if(alpha_hashed && seen) cutoff = base_hash(in);
    return material.base.color.a * base_texel(in, stage_uv(in.uv)).a < cutoff;
}
