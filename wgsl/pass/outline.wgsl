// Outlines: back faces pushed outwards along smoothed normals.
import package::bind::frame::{frame, in_target};
import package::bind::lights::arriving_light;
import package::bind::pixel::{Pixel, pixel};
import package::bind::surface::{drawn, encoded, surface_of};
import package::bind::uv::texture_uv;
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of, world_direction, world_position};
import package::lib::eyes_through::pulled_depth;
import package::lib::mtoon::mtoon_outline;
import package::lib::outline::{outline_bounded, outline_clip, outline_px_per_m, outline_resolved, outline_tinted};
import package::lib::shade_ramp::part_number;
import package::look::shade_ramp::ramp_color;
import package::material::{
    material, outline_part_ids, outline_width_mask, outline_width_mask_sampler, stage_line, stage_samples, stage_vanish,
    stage_vertex_uv,
};

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    let m = &material.outline;
    var out = surface_varying(v);
    var width = m.width;
    @if(outline_width_mask) width *= textureSampleLevel(
        outline_width_mask, outline_width_mask_sampler, texture_uv(stage_vertex_uv(v.uv), m.width_mask_uv), 0.0
    ).g;
    @if(outline_vertex_width) width *= v.color.r;
    width = stage_line(width);
    let normal = world_direction(v, v.frame.z);
    let row = vec3f(frame.clip_from_world[0].y, frame.clip_from_world[1].y, frame.clip_from_world[2].y);
    // Pixels over the unit of the width.
    @if(outline_screen) let per_unit = frame.size_px.y;
    @if(!outline_screen) let per_unit = outline_px_per_m(length(row), out.clip_position.w, frame.size_px.y);
    @if(outline_bounds) width = outline_bounded(width * per_unit, frame.size_px.y, m.clamp_px) / per_unit;
    let resolved = outline_resolved(width * per_unit);
    width *= resolved.x;
    out.line_cover = resolved.y;
    @if(outline_screen) {
        // The width is a share of the picture's height instead of metres.
        let normal_clip = (frame.clip_from_world * vec4f(normal, 0.0)).xy;
        out.clip_position = outline_clip(out.clip_position, normal_clip, width, frame.aspect);
    }
    @if(!outline_screen) {
        let position = world_position(v, v.position) + normal * width;
        out.clip_position = frame.clip_from_world * vec4f(position, 1.0);
    }
    // 1e-5 of the distance behind the surface, so that a hull of width 0 stays hidden (depth is near / distance).
    out.clip_position.z *= 1.0 - 1e-5;
    @if(outline_push) out.clip_position.z = pulled_depth(out.clip_position.z, out.clip_position.w, -m.push_m);
    out.clip_position = in_target(out.clip_position);
    @if(at_vertices) out.line_color = tinted(out, world_position(v, v.position)).rgb;
    return out;
}

@fragment
fn fs_main(in: Varying) -> Pixel {
    return pixel(line(in), stage_samples(in));
}

fn line(in: Varying) -> vec4f {
    let m = &material.outline;
    // The colour of the surface or of the line, and the surface's alpha.
    var given = vec4f(1.0);
    @if(at_vertices) given = vec4f(in.line_color, 1.0);
    @if(outline_tint && !at_vertices) {
        stage_vanish(in);
        given = tinted(in, in.world_position);
    }
    @if(!outline_tint && shaded) {
        let d = drawn(in, true);
        given = vec4f(d.color, d.alpha);
    }
    var color = given.rgb;
    @if(!outline_tint) color = mtoon_outline(m.color, given.rgb, m.lighting_mix);
    // 1 between vertices of 1, whatever rounding makes of it: nothing behind a whole line shows.
    var cover = saturate(in.line_cover * 1.0001);
    @if(blend) cover *= given.a;
    return vec4f(encoded(color) * cover, cover);
}

// The colour of the surface in full light or in full shade, darkened and turned; and its alpha.
@if(outline_tint)
fn tinted(in: Varying, position: vec3f) -> vec4f {
    let m = &material.outline;
    let s = surface_of(in, true);
    var source = s.lit;
    @if(toon && !shade_ramp) source = mix(s.lit, s.shade, m.tint_from_shade);
    @if(toon && shade_ramp) source = mix(s.lit, ramp_color(s.uv, s.lit, s.shade, 0.0), m.tint_from_shade);
    var color = outline_tinted(source, m.tint_gamma, m.shift, m.tint_factor);
    @if(outline_part_ids) {
        // The texel itself: numbers are not filtered.
        let size = vec2f(textureDimensions(outline_part_ids));
        let at = fract(texture_uv(s.uv, m.part_ids_uv));
        let part = part_number(textureLoad(outline_part_ids, vec2i(at * size), 0).r);
        if part >= 0 {
            color = m.parts[part].rgb;
        }
    }
    return vec4f(color * arriving_light(position), s.alpha);
}
