// Highlights, painted and with a drawn shape, and sparks.
import package::bind::frame::frame;
import package::bind::material::{material, highlight_texture, highlight_sampler};
import package::bind::options::SurfaceOptions;
import package::bind::texel::texture_uv;
import package::lib::highlight::highlight_broken;
import package::lib::shaped_highlight::{
    highlight_brushed, highlight_distance, highlight_inside, highlight_moved,
};
import package::lib::sparkle::sparkle;

// Shares of both layers of a painted highlight that has moved so far.
fn painted_highlight(options: SurfaceOptions, uv: vec4f, moved: vec2f) -> vec2f {
    // The map is clamped at its border by its sampler.
    let at = texture_uv(options, uv, material.highlight_uv);
    var layers = textureSample(highlight_texture, highlight_sampler, at + moved).rg;
    if options.highlight_apart {
        let below = at + moved * vec2f(1.0, material.second_motion);
        layers.y = textureSample(highlight_texture, highlight_sampler, below).g;
    }
    if options.highlight_breakup {
        let strand = textureSample(highlight_texture, highlight_sampler, at).b;
        layers = vec2f(
            highlight_broken(layers.x, strand, material.highlight_breakup),
            highlight_broken(layers.y, strand, material.highlight_breakup)
        );
    }
    return layers;
}

// Share of the shaped highlight; `along` is the direction of the brush.
fn shaped_highlight(n: vec3f, view: vec3f, along: vec3f, has_map: bool, is_brushed: bool) -> f32 {
    let right = vec3f(frame.view_from_world[0].x, frame.view_from_world[1].x, frame.view_from_world[2].x);
    let axis = select(right, along, is_brushed);
    // 1e-4: an axis along the normal has no direction on the surface.
    let level = normalize(axis - n * dot(n, axis) + vec3f(0.0, 1e-4, 0.0));
    let upright = cross(n, level);
    let x = level * material.shaped_turn.x + upright * material.shaped_turn.y;
    let y = upright * material.shaped_turn.x - level * material.shaped_turn.y;
    let half_way = normalize(frame.to_light + view);
    let h = highlight_moved(
        half_way, x, y, material.shaped_move, material.shaped_squash, material.shaped_split
    );
    var at = vec2f(dot(h, x), dot(h, y));
    if is_brushed {
        at = highlight_brushed(at.x, at.y, material.shaped_anisotropy);
    }
    var share: f32;
    if has_map {
        let uv = 0.5 + at * vec2f(material.shaped_map_scale, -material.shaped_map_scale);
        let drawn = textureSample(highlight_texture, highlight_sampler, uv).r;
        let inside = all(uv > vec2f(0.0)) && all(uv < vec2f(1.0));
        share = select(0.0, drawn, inside);
    } else {
        let away = highlight_distance(at.x, at.y, material.shaped_square);
        share = highlight_inside(away, material.shaped_size, fwidth(away));
    }
    if is_brushed {
        // Where the surface looks along the brush it has no direction.
        share *= smoothstep(0.25, 0.6, length(axis - n * dot(n, axis)));
    }
    return select(0.0, share, dot(h, n) > 0.0);
}

// Light of sparks in the frame of the surface.
fn sparks(n: vec3f, view: vec3f, tangent: vec3f, bitangent: vec3f, uv: vec2f) -> f32 {
    let h = normalize(frame.to_light + view);
    let uv_per_px = max(length(dpdx(uv)), length(dpdy(uv)));
    let of_surface = vec3f(dot(h, tangent), dot(h, bitangent), dot(h, n));
    let shine = sparkle(
        uv, uv_per_px, material.sparkle_px, of_surface, material.sparkle_spread, material.sparkle_cos
    );
    return shine * smoothstep(0.0, 0.2, dot(n, frame.to_light));
}
