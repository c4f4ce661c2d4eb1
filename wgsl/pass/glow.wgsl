// Light of surfaces that bloom, in a picture of half the size; the prepass knows what hides it.
import package::bind::axes::surface_axes;
import package::bind::character::shadow_lit;
import package::bind::emission::emitted;
import package::bind::fire::burning_shape;
import package::bind::frame::{distance_at, frame};
import package::bind::material::material;
import package::bind::options::{SurfaceOptions, surface_options};
import package::bind::shine::{painted_highlight, shaped_highlight, sparks};
import package::bind::surface::SurfaceInput;
import package::bind::texel::{animated_uv, surface_texel};
import package::bind::vanish::{burning, dither_left};
import package::bind::varying::{Varying, surface_input, surface_varying};
import package::bind::vertex::VertexInput;
import package::lib::mtoon::mtoon_shading;

// Alpha is cover.
override GLOW_BLEND: bool = false;

@vertex
fn vs_main(v: VertexInput) -> Varying {
    return surface_varying(surface_options(), v);
}

// Whether something stands before a place. Its pixel covers four of the prepass.
fn hidden(place: vec3f) -> bool {
    let first = vec2i(place.xy) * 2;
    let farthest = max(
        max(distance_at(first), distance_at(first + vec2i(1, 0))),
        max(distance_at(first + vec2i(0, 1)), distance_at(first + vec2i(1, 1)))
    );
    // The surface itself is among them, rounded otherwise.
    return frame.near / max(place.z, 1e-12) > farthest * 1.001;
}

// What of a surface blooms.
fn glow(options: SurfaceOptions, in: SurfaceInput) -> vec3f {
    let uv = animated_uv(options, in.uv);
    var left = 1.0;
    if options.dither_fade {
        left = dither_left(in.world_position);
    }
    if options.fire {
        let shape = burning_shape(options, uv);
        return shape.rgb * shape.a * material.glow * left;
    }
    if options.alpha_mask || GLOW_BLEND {
        let alpha = material.base_color.a * surface_texel(options, in.color, uv).a;
        if options.alpha_mask && alpha < material.alpha_cutoff {
            discard;
        }
        left *= select(1.0, saturate(alpha), GLOW_BLEND);
    }
    var burn = 1.0;
    if options.dissolve {
        burn = burning(in.uv.xy);
        if burn < 0.0 {
            discard;
        }
    }
    var light = emitted(options, uv, burn) * material.glow;
    if options.unlit {
        return light * left;
    }
    let axes = surface_axes(options, in.normal, in.tangent, uv);
    let normal = axes.normal;
    let view = normalize(frame.eye - in.world_position);
    var shading = mtoon_shading(dot(normal, frame.to_light), material.shift, material.toony);
    var own_lit = 1.0;
    if options.cast_shadow {
        own_lit = shadow_lit(in.shadow, shading > 0.0);
        shading *= 1.0 - (1.0 - own_lit) * material.shadow_received;
    }
    var shine = vec3f(0.0);
    if options.highlight {
        let layers = painted_highlight(options, uv, in.highlight.xy);
        let lit = in.highlight.z * mix(material.highlight_in_shade, 1.0, shading);
        shine += material.highlight_color * (layers.x * material.highlight_strength * lit);
        if options.highlight_second {
            shine += material.second_color * (layers.y * material.second_strength * lit);
        }
    }
    if options.shaped_highlight {
        let lit = mix(material.shaped_in_shade, 1.0, shading) * material.shaped_strength;
        let share = shaped_highlight(normal, view, axes.tangent, options.shaped_map, options.shaped_brushed) * lit;
        shine += material.shaped_color * share;
    }
    if options.sparkle {
        let bitangent = cross(normal, axes.tangent) * in.tangent.w;
        shine += material.sparkle_color * (sparks(normal, view, axes.tangent, bitangent, in.uv.xy) * own_lit);
    }
    light += shine * frame.light_color * material.glow_highlight;
    return light * left;
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    let light = glow(surface_options(), surface_input(in, front_facing));
    if hidden(in.clip_position.xyz) {
        discard;
    }
    return vec4f(max(light, vec3f(0.0)), 1.0);
}
