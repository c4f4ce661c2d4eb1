// Outlines: back faces pushed outwards along smoothed normals.
import package::bind::frame::frame;
import package::bind::lights::arriving_light;
import package::bind::material::{
    material, animation_mask_texture, animation_mask_sampler, outline_mask_texture, outline_mask_sampler,
};
import package::bind::options::surface_options;
import package::bind::ramp::part_at;
import package::bind::surface::{line_source, shade_surface};
import package::bind::texel::{moved_uv, texture_uv};
import package::bind::vanish::dithered_samples;
import package::bind::varying::{Varying, surface_varying, surface_input};
import package::bind::vertex::{VertexInput, world_direction, world_position};
import package::lib::color::srgb_from_linear;
import package::lib::eyes_through::pulled_depth;
import package::lib::mtoon::mtoon_outline;
import package::lib::outline::{outline_bounded, outline_clip, outline_tinted};

override ENCODE_SRGB: bool = false;
// The width is a share of the picture's height instead of metres.
override SCREEN_WIDTH: bool = false;
override WIDTH_MASK: bool = false;
// The surface's shading is needed: for its colour, its alpha or its cut-outs.
override OUTLINE_SHADED: bool = false;
// The colour comes from the surface: that in shade instead of that in light; of parts that a map tells apart.
override OUTLINE_TINT: bool = false;
override OUTLINE_FROM_SHADE: bool = false;
override OUTLINE_PARTS: bool = false;
// The width follows the red channel of the vertex colour; it has bounds; the hull stands farther away.
override VERTEX_WIDTH: bool = false;
override WIDTH_BOUNDS: bool = false;
override OUTLINE_PUSH: bool = false;
// Blended with what is behind it.
override OUTLINE_BLEND: bool = false;

@vertex
fn vs_main(v: VertexInput) -> Varying {
    var out = surface_varying(surface_options(), v);
    var width = material.outline_width;
    if WIDTH_MASK {
        let options = surface_options();
        var uv = v.uv;
        if options.uv_animation {
            var mask = 1.0;
            if options.uv_animation_mask {
                mask = textureSampleLevel(
                    animation_mask_texture, animation_mask_sampler,
                    texture_uv(options, v.uv, material.animation_mask_uv), 0.0
                ).b;
            }
            uv = moved_uv(v.uv, mask);
        }
        width *= textureSampleLevel(
            outline_mask_texture, outline_mask_sampler, texture_uv(options, uv, material.outline_mask_uv), 0.0
        ).g;
    }
    if VERTEX_WIDTH {
        width *= v.color.r;
    }
    if surface_options().dissolve {
        width *= 1.0 - saturate(material.dissolve_amount * 10.0);
    }
    let normal = world_direction(v, v.frame.z);
    if SCREEN_WIDTH {
        let normal_clip = (frame.clip_from_world * vec4f(normal, 0.0)).xy;
        out.clip_position = outline_clip(out.clip_position, normal_clip, width, frame.aspect);
    } else {
        if WIDTH_BOUNDS {
            let row = vec3f(frame.clip_from_world[0].y, frame.clip_from_world[1].y, frame.clip_from_world[2].y);
            width = outline_bounded(width, length(row), out.clip_position.w, material.outline_bounds);
        }
        let position = out.world_position + normal * width;
        out.clip_position = frame.clip_from_world * vec4f(position, 1.0);
    }
    // 1e-5 of the distance behind the surface, so that a hull of width 0 stays hidden (depth is near / distance).
    out.clip_position.z *= 1.0 - 1e-5;
    if OUTLINE_PUSH {
        out.clip_position.z = pulled_depth(out.clip_position.z, out.clip_position.w, -material.outline_push);
    }
    return out;
}

struct DitheredOutput {
    @location(0) color: vec4f,
    @builtin(sample_mask) samples: u32,
}

@fragment
fn fs_main(in: Varying) -> @location(0) vec4f {
    return line(in);
}

// For DITHER_SAMPLES.
@fragment
fn fs_dithered(in: Varying) -> DitheredOutput {
    return DitheredOutput(line(in), dithered_samples(in.clip_position.xy, in.world_position));
}

fn line(in: Varying) -> vec4f {
    var surface = vec4f(1.0);
    if surface_options().dissolve && material.dissolve_amount > 0.1 {
        // Through holes the hull of the far side would be seen.
        discard;
    }
    if OUTLINE_SHADED {
        surface = shade_surface(surface_options(), surface_input(in, true));
    }
    var color: vec3f;
    if OUTLINE_TINT {
        let source = line_source(surface_options(), in.uv, in.color, OUTLINE_FROM_SHADE);
        color = outline_tinted(source, material.outline_gamma, material.outline_shift, material.outline_tint);
        if OUTLINE_PARTS {
            let part = part_at(surface_options(), in.uv);
            if part >= 0 {
                color = material.outline_parts[part].rgb;
            }
        }
        color *= arriving_light(in.world_position);
    } else {
        color = mtoon_outline(material.outline_color, surface.rgb, material.outline_lighting_mix);
    }
    if ENCODE_SRGB {
        color = srgb_from_linear(color);
    }
    if OUTLINE_BLEND {
        return vec4f(color * surface.a, surface.a);
    }
    return vec4f(color, 1.0);
}
