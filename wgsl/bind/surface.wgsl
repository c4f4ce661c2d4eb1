// A toon surface: samples the material's textures and shades. Shared by the opaque, outline and transparent passes.
// Which parts exist is fixed at pipeline creation, so that what a material does not use costs nothing.
import package::bind::character::bangs_lit;
import package::bind::frame::frame;
import package::bind::material::{
    UvTransform, material, base_texture, base_sampler, shade_texture, shade_sampler, shift_texture, shift_sampler,
    normal_texture, normal_sampler, emission_texture, emission_sampler, matcap_texture, matcap_sampler,
    rim_mask_texture, rim_mask_sampler, animation_mask_texture, animation_mask_sampler, face_texture, face_sampler,
    highlight_texture, highlight_sampler,
};
import package::lib::bangs::bangs_factor;
import package::lib::face_shadow::{face_lit, face_shading};
import package::lib::light::{accumulated_n_dot_l, distance_attenuation, luminance, spot_attenuation};
import package::lib::mtoon::{
    mtoon_animate_uv, mtoon_direct, mtoon_gi, mtoon_matcap_uv, mtoon_parametric_rim, mtoon_rim, mtoon_shading,
};
import package::lib::normal::{normal_from_map, normalize_or};

// Parts of a surface; the entry files fill it from their overrides.
struct SurfaceOptions {
    unlit: bool,
    base_texture: bool,
    shade_texture: bool,
    shade_is_base: bool,
    shift_texture: bool,
    normal_map: bool,
    emission_texture: bool,
    matcap: bool,
    rim: bool,
    rim_mask: bool,
    uv_transforms: bool,
    uv_animation: bool,
    uv_animation_mask: bool,
    vertex_color: bool,
    alpha_mask: bool,
    alpha_coverage: bool,
    face_shadow: bool,
    bangs_shadow: bool,
    highlight: bool,
}

struct SurfaceInput {
    world_position: vec3f,
    normal: vec3f,
    tangent: vec4f,
    uv: vec4f,
    color: vec4f,
    // Direction to the directional light in the frame of the face.
    face_light: vec3f,
    // Place in the map of the bangs' shadow.
    bangs: vec3f,
    // Movement of the highlight, and what is left of it.
    highlight: vec3f,
}

// UVs of one texture: animation first, then KHR_texture_transform (MToon, "Compatibility with KHR_texture_transform").
fn texture_uv(options: SurfaceOptions, uv: vec4f, transform: UvTransform) -> vec2f {
    if !options.uv_transforms {
        return uv.xy;
    }
    let p = vec3f(select(uv.xy, uv.zw, transform.row_u.w > 0.5), 1.0);
    return vec2f(dot(transform.row_u.xyz, p), dot(transform.row_v.xyz, p));
}

// Both UV sets after the material's animation at the frame's time.
fn animated_uv(options: SurfaceOptions, uv: vec4f) -> vec4f {
    if !options.uv_animation {
        return uv;
    }
    var mask = 1.0;
    if options.uv_animation_mask {
        mask = textureSample(
            animation_mask_texture, animation_mask_sampler, texture_uv(options, uv, material.animation_mask_uv)
        ).b;
    }
    return moved_uv(uv, mask);
}

// Both UV sets moved by as much of the material's animation as `mask` says.
fn moved_uv(uv: vec4f, mask: f32) -> vec4f {
    let scroll = material.scroll_per_s * frame.time_s;
    let rotation = material.rotation_rad_per_s * frame.time_s;
    return vec4f(
        mtoon_animate_uv(uv.xy, scroll, rotation, mask), mtoon_animate_uv(uv.zw, scroll, rotation, mask)
    );
}

// What base colour and alpha are multiplied with: texture and vertex colour.
fn surface_texel(options: SurfaceOptions, in: SurfaceInput, uv: vec4f) -> vec4f {
    var texel = vec4f(1.0);
    if options.base_texture {
        texel = textureSample(base_texture, base_sampler, texture_uv(options, uv, material.base_uv));
    }
    if options.vertex_color {
        texel *= in.color;
    }
    return texel;
}

// Ambient radiance on a surface that faces n.
fn ambient(n_y: f32) -> vec3f {
    return mix(frame.ambient_ground, frame.ambient_sky, n_y * 0.5 + 0.5);
}

// Shaded colour (linear, straight), and alpha or the coverage of a masked surface. `in.normal` need not be unit; it faces
// the viewer.
fn shade_surface(options: SurfaceOptions, in: SurfaceInput) -> vec4f {
    let uv = animated_uv(options, in.uv);
    let texel = surface_texel(options, in, uv);
    var base = material.base_color * texel;
    if options.alpha_coverage {
        // The cut as a ramp one pixel wide, but never so wide that alpha 1 is not whole or alpha 0 not open. 1e-4: where
        // alpha is flat there is no ramp.
        let widest = 2.0 * min(material.alpha_cutoff, 1.0 - material.alpha_cutoff);
        base.a = saturate((base.a - material.alpha_cutoff) / max(min(fwidth(base.a), widest), 1e-4) + 0.5);
    } else if options.alpha_mask && base.a < material.alpha_cutoff {
        discard;
    }
    var emission = material.emission;
    if options.emission_texture {
        emission *= textureSample(
            emission_texture, emission_sampler, texture_uv(options, uv, material.emission_uv)
        ).rgb;
    }
    if options.unlit {
        return vec4f(base.rgb + emission, base.a);
    }

    var normal = normalize(in.normal);
    if options.normal_map {
        let texel = textureSample(
            normal_texture, normal_sampler, texture_uv(options, uv, material.normal_uv)
        ).xyz;
        let tangent = normalize_or(in.tangent.xyz - normal * dot(normal, in.tangent.xyz), vec3f(0.0));
        normal = normal_from_map(texel, material.normal_scale, normal, tangent, in.tangent.w);
    }

    var shade = material.shade_color;
    if options.shade_is_base {
        shade *= texel.rgb;
    } else {
        if options.shade_texture {
            shade *= textureSample(shade_texture, shade_sampler, texture_uv(options, uv, material.shade_uv)).rgb;
        }
        if options.vertex_color {
            shade *= in.color.rgb;
        }
    }
    var shift = material.shift;
    if options.shift_texture {
        shift += material.shift_texture_scale * textureSample(
            shift_texture, shift_sampler, texture_uv(options, uv, material.shift_uv)
        ).r;
    }

    var light = frame.light_color;
    var n_dot_l = dot(normal, frame.to_light);
    // Share of the directional light in all of them.
    var directional = 1.0;
    if frame.punctual_count > 0u {
        var weight = luminance(light);
        var sum = n_dot_l * weight;
        for (var i = 0u; i < frame.punctual_count; i++) {
            let to_light = frame.punctual[i].position - in.world_position;
            let distance_sq = dot(to_light, to_light);
            let l = to_light * inverseSqrt(max(distance_sq, 1e-8));
            let radiance = frame.punctual[i].color
                * distance_attenuation(distance_sq, frame.punctual[i].range)
                * spot_attenuation(
                    dot(-l, frame.punctual[i].direction),
                    frame.punctual[i].spot_scale,
                    frame.punctual[i].spot_offset
                );
            let w = luminance(radiance);
            light += radiance;
            weight += w;
            sum += dot(normal, l) * w;
        }
        n_dot_l = accumulated_n_dot_l(sum, weight);
        directional = luminance(frame.light_color) / max(weight, 1e-6);
    }

    var shading = mtoon_shading(n_dot_l, shift, material.toony);
    if options.face_shadow {
        let map = textureSample(face_texture, face_sampler, texture_uv(options, uv, material.face_uv));
        let lit = face_lit(map.rg, in.face_light, material.face_softness, material.face_overhead_fade);
        shading = face_shading(shading, lit, map.b, map.a * directional);
    }
    let gi = mtoon_gi(ambient(normal.y), frame.ambient_sky, frame.ambient_ground, material.gi_equalization);
    var direct = mtoon_direct(base.rgb, shade, shading, light);
    if options.bangs_shadow {
        // What is in shade already gets no darker.
        let share = shading * directional;
        if share > 0.0 {
            let lit = bangs_lit(in.bangs);
            let factor = bangs_factor(lit, material.bangs_edges, material.bangs_strength, material.bangs_color);
            direct *= mix(vec3f(1.0), factor, share);
        }
    }
    if options.highlight {
        // The map is clamped at its border by its sampler.
        let at = texture_uv(options, uv, material.highlight_uv) + in.highlight.xy;
        let mask = textureSample(highlight_texture, highlight_sampler, at).r;
        let share = mask * material.highlight_strength * in.highlight.z * mix(material.highlight_in_shade, 1.0, shading);
        direct = mix(direct, material.highlight_color * light, share);
    }
    var color = direct + gi * base.rgb + emission;

    if options.rim || options.matcap {
        let v = normalize(frame.eye - in.world_position);
        var matcap = vec3f(0.0);
        if options.matcap {
            // Images begin at the top left; the lookup has v upwards.
            let matcap_uv = mtoon_matcap_uv(normal, v) * vec2f(1.0, -1.0) + vec2f(0.0, 1.0);
            matcap = textureSample(matcap_texture, matcap_sampler, matcap_uv).rgb * material.matcap_color;
        }
        var parametric = vec3f(0.0);
        if options.rim {
            parametric = material.rim_color
                * mtoon_parametric_rim(dot(normal, v), material.rim_lift, material.rim_fresnel_power);
        }
        var mask = vec3f(1.0);
        if options.rim_mask {
            mask = textureSample(
                rim_mask_texture, rim_mask_sampler, texture_uv(options, uv, material.rim_mask_uv)
            ).rgb;
        }
        color += mtoon_rim(matcap, parametric, mask, light + gi, material.rim_lighting_mix);
    }
    return vec4f(color, base.a);
}
