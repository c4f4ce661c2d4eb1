// A toon surface: samples the material's textures and shades. Shared by the opaque, outline and transparent passes.
// Which parts exist is fixed at pipeline creation, so that what a material does not use costs nothing.
import package::bind::character::{BANGS_LAYER, LIDS_LAYER, bangs_lit, shadow_lit};
import package::bind::face::{FaceOptions, face_shading_at};
import package::bind::frame::{distance_at, frame, frame_depth, surface_at};
import package::bind::material::{
    UvTransform, material, base_texture, base_sampler, shade_texture, shade_sampler, shift_texture, shift_sampler,
    normal_texture, normal_sampler, emission_texture, emission_sampler, matcap_texture, matcap_sampler,
    rim_mask_texture, rim_mask_sampler, animation_mask_texture, animation_mask_sampler, highlight_texture, highlight_sampler, face_paint_texture, face_paint_sampler,
    face_sampler, detail_color_texture, detail_sampler, detail_normal_texture, ramp_warm_texture, ramp_cool_texture,
    part_ids_texture, rim_width_texture,
};
import package::bind::overlay::{Painted, with_decals, with_stocking};
import package::bind::shine::{shaped_highlight, sparks};
import package::bind::stone::{Stone, StonePoint, diamond_surface, gem_surface};
import package::bind::vanish::{burning, is_dithered_away};
import package::lib::bangs::bangs_share;
import package::lib::depth_rim::{depth_rim_near, depth_rim_offset, depth_rim_resolved, depth_rim_side, depth_rim_step};
import package::lib::emission::blink;
import package::lib::face_paint::face_paint_factor;
import package::lib::face_shadow::face_shading;
import package::lib::fire::{fire_color, fire_cover, fire_heat, fire_noise, fire_sway};
import package::lib::fur::{fur_color, fur_masks};
import package::lib::highlight::highlight_broken;
import package::lib::inner_lines::line_between;
import package::lib::light::{accumulated_n_dot_l, distance_attenuation, light_response, luminance, spot_attenuation};
import package::lib::mtoon::{
    mtoon_animate_uv, mtoon_direct, mtoon_gi, mtoon_matcap_uv, mtoon_parametric_rim, mtoon_rim, mtoon_shading,
};
import package::lib::normal::{normal_from_map, normalize_or};
import package::lib::shade_ramp::ramp_bands;
import package::lib::transition::transition_tint;

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
    face_stack: bool,
    face_back: bool,
    face_masks: bool,
    transition: bool,
    face_paint: bool,
    bangs_shadow: bool,
    lid_shadow: bool,
    highlight: bool,
    highlight_second: bool,
    highlight_apart: bool,
    highlight_breakup: bool,
    layered: bool,
    cast_shadow: bool,
    shade_ramp: bool,
    ramp_maps: bool,
    ramp_parts: bool,
    shade_shift: bool,
    light_response: bool,
    fur_detail: bool,
    fur_color: bool,
    depth_rim: bool,
    shaped_highlight: bool,
    shaped_map: bool,
    shaped_brushed: bool,
    sparkle: bool,
    gem: bool,
    gem_inclusions: bool,
    diamond: bool,
    fire: bool,
    emission_scroll: bool,
    emission_blink: bool,
    stocking: bool,
    decals: bool,
    dissolve: bool,
    dither_fade: bool,
    rim_width: bool,
    rim_shade: bool,
    inner_lines: bool,
    channel: u32,
}

// Values of `SurfaceOptions.channel`; `Channel::shader_code` in Rust.
const CHANNEL_FACE_SHADOW: u32 = 1u;
const CHANNEL_TRANSITION: u32 = 2u;
const CHANNEL_FACE_PAINT: u32 = 3u;
const CHANNEL_HIGHLIGHT: u32 = 4u;
const CHANNEL_BANGS_SHADOW: u32 = 5u;
const CHANNEL_LAYER: u32 = 6u;
const CHANNEL_DEPTH_RIM: u32 = 7u;
const CHANNEL_EYES_THROUGH: u32 = 8u;
const CHANNEL_SHADE_RAMP: u32 = 9u;
const CHANNEL_FUR: u32 = 10u;
const CHANNEL_SELF_SHADOW: u32 = 11u;
const CHANNEL_STONE: u32 = 12u;
const CHANNEL_SPARKLE: u32 = 13u;
const CHANNEL_FIRE: u32 = 14u;
const CHANNEL_FLUFF: u32 = 15u;
const CHANNEL_DISSOLVE: u32 = 16u;
const CHANNEL_EMISSION: u32 = 17u;
const CHANNEL_OVERLAY: u32 = 18u;
const CHANNEL_INNER_LINES: u32 = 19u;

// Whether shading needs the tangent frame.
fn has_tangents(options: SurfaceOptions) -> bool {
    return options.normal_map || options.fur_detail || options.gem || options.diamond || options.sparkle
        || options.shaped_brushed;
}

struct SurfaceInput {
    // Pixels from the top left, and depth.
    pixel: vec3f,
    world_position: vec3f,
    normal: vec3f,
    tangent: vec4f,
    uv: vec4f,
    color: vec4f,
    // Directional light in the frame of the face: x to the character's left, height (radians), angle over pi, and what
    // thresholds are compared with.
    face_light: vec4f,
    // Place in the map of the bangs' shadow.
    bangs: vec3f,
    // Movement of the highlight, what is left of it, and how far the line of the nose shows.
    highlight: vec4f,
    // Place in the shadow map of the character, and its layer.
    shadow: vec4f,
}

// Input of `surface_texel` where nothing is shaded.
fn texel_input(uv: vec4f, color: vec4f) -> SurfaceInput {
    let none = vec3f(0.0);
    return SurfaceInput(none, none, none, vec4f(0.0), uv, color, vec4f(0.0), none, vec4f(0.0), vec4f(0.0));
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

// Whether nothing of the surface is there: cut out, or burnt.
fn surface_cut(options: SurfaceOptions, in_uv: vec4f, color: vec4f) -> bool {
    if options.dissolve && burning(in_uv.xy) < 0.0 {
        return true;
    }
    let texel = surface_texel(options, texel_input(in_uv, color), animated_uv(options, in_uv));
    return material.base_color.a * texel.a < material.alpha_cutoff;
}

// Ambient radiance on a surface that faces n.
fn ambient(n_y: f32) -> vec3f {
    return mix(frame.ambient_ground, frame.ambient_sky, n_y * 0.5 + 0.5);
}

struct Arriving {
    // Unit.
    to_light: vec3f,
    radiance: vec3f,
}

// Light of a point or spot light at a place.
fn punctual_light(i: u32, position: vec3f) -> Arriving {
    let to_light = frame.punctual[i].position - position;
    let distance_sq = dot(to_light, to_light);
    let l = to_light * inverseSqrt(max(distance_sq, 1e-8));
    let radiance = frame.punctual[i].color
        * distance_attenuation(distance_sq, frame.punctual[i].range)
        * spot_attenuation(
            dot(-l, frame.punctual[i].direction), frame.punctual[i].spot_scale, frame.punctual[i].spot_offset
        );
    return Arriving(l, radiance);
}

// Shaded colour (linear, straight), and alpha or the coverage of a masked surface. `in.normal` need not be unit; it faces
// the viewer.
fn shade_surface(options: SurfaceOptions, in: SurfaceInput) -> vec4f {
    let uv = animated_uv(options, in.uv);
    // What a debug channel shows of the looks below.
    var extra = vec3f(0.0);
    if options.dither_fade && is_dithered_away(in.pixel.xy, in.world_position) {
        discard;
    }
    var burn = 1.0;
    if options.dissolve {
        burn = burning(in.uv.xy);
        if burn < 0.0 {
            discard;
        }
        if options.channel == CHANNEL_DISSOLVE {
            extra = vec3f(saturate(burn), 1.0, 0.0);
        }
    }
    if options.fire {
        return burning_shape(options, uv);
    }
    var texel = surface_texel(options, in, uv);
    var base = material.base_color * texel;
    if options.alpha_coverage {
        // The cut as a ramp one pixel wide, but never so wide that alpha 1 is not whole or alpha 0 not open. 1e-4: where
        // alpha is flat there is no ramp.
        let widest = 2.0 * min(material.alpha_cutoff, 1.0 - material.alpha_cutoff);
        base.a = saturate((base.a - material.alpha_cutoff) / max(min(fwidth(base.a), widest), 1e-4) + 0.5);
    } else if options.alpha_mask && base.a < material.alpha_cutoff {
        discard;
    }
    let emission = emitted(options, uv, burn);
    if options.channel == CHANNEL_EMISSION {
        extra = emission;
    }
    if options.unlit {
        return vec4f(base.rgb + emission, base.a);
    }

    var normal = normalize(in.normal);
    var tangent = vec3f(0.0);
    if has_tangents(options) {
        tangent = normalize_or(in.tangent.xyz - normal * dot(normal, in.tangent.xyz), vec3f(0.0));
    }
    if options.normal_map || options.fur_detail {
        var bent: vec3f;
        var scale = material.normal_scale;
        if options.fur_detail {
            let at = texture_uv(options, uv, material.detail_normal_uv);
            bent = textureSample(detail_normal_texture, detail_sampler, at).xyz;
            scale = material.fur_normal_scale;
        } else {
            bent = textureSample(normal_texture, normal_sampler, texture_uv(options, uv, material.normal_uv)).xyz;
        }
        normal = normal_from_map(bent, scale, normal, tangent, in.tangent.w);
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
            let arriving = punctual_light(i, in.world_position);
            let radiance = arriving.radiance;
            let w = luminance(radiance);
            light += radiance;
            weight += w;
            sum += dot(normal, arriving.to_light) * w;
        }
        n_dot_l = accumulated_n_dot_l(sum, weight);
        directional = luminance(frame.light_color) / max(weight, 1e-6);
    }

    if options.light_response {
        light = light_response(light, material.light_bounds.x, material.light_bounds.y, material.light_monochrome);
    }
    var fur = vec3f(0.0);
    if options.fur_detail {
        fur = fur_masks(n_dot_l, material.fur_terminator, material.fur_softness);
        var flat_color = texel.rgb;
        var detail = texel.rgb;
        if options.fur_color {
            let at = texture_uv(options, uv, material.detail_color_uv);
            detail = textureSample(detail_color_texture, detail_sampler, at).rgb;
            if options.vertex_color {
                detail *= in.color.rgb;
            }
        } else if options.base_texture {
            let at = texture_uv(options, uv, material.base_uv);
            flat_color = textureSampleBias(base_texture, base_sampler, at, material.fur_blur).rgb;
            if options.vertex_color {
                flat_color *= in.color.rgb;
            }
        }
        texel = vec4f(fur_color(fur, material.fur_shares, flat_color, detail), texel.a);
        base = vec4f(material.base_color.rgb * texel.rgb, base.a);
    }
    var shade = surface_shade(options, texel, uv, in.color);
    let view = normalize(frame.eye - in.world_position);
    if options.decals || options.stocking {
        var surface = Painted(base.rgb, shade, 0.0);
        if options.stocking {
            surface = with_stocking(surface, abs(dot(normal, view)));
        }
        if options.decals {
            surface = with_decals(surface, select(in.uv.xy, in.uv.zw, material.decal_set > 0.5));
        }
        base = vec4f(surface.lit, base.a);
        shade = surface.shade;
        if options.channel == CHANNEL_OVERLAY {
            extra = vec3f(surface.cover);
        }
    }
    var shading = mtoon_shading(n_dot_l, shift, material.toony);
    // The same with the border of the transition, or of the ramp.
    let is_soft = options.transition || options.shade_ramp;
    var soft = 1.0;
    if is_soft {
        soft = smoothstep(-material.transition_width, material.transition_width, n_dot_l + shift);
    }
    // Share of the surface that is face: neck and body take no shadow of bangs.
    var of_face = 1.0;
    if options.face_shadow {
        let parts = FaceOptions(options.face_stack, options.face_back, options.face_masks);
        let face = face_shading_at(parts, in.uv.xy, in.face_light);
        of_face = 1.0 - face.region;
        shading = face_shading(shading, face.lit, face.region, face.strength * directional);
        if is_soft {
            soft = face_shading(soft, face.soft, face.region, face.strength * directional);
        }
    }
    var own_lit = 1.0;
    if options.cast_shadow {
        own_lit = shadow_lit(in.shadow, max(shading, soft * f32(options.shade_ramp)) > 0.0);
        // Of the key light alone, and on a face with a map only where that leaves it to normal shading.
        // The map's region fades over the jaw, under which shade must be whole.
        let share = directional * select(1.0, saturate(4.0 - 4.0 * of_face), options.face_shadow);
        let left = 1.0 - (1.0 - own_lit) * material.shadow_received * share;
        shading *= left;
        soft *= left;
    }
    if options.layered {
        shading = max(shading, material.stay_lit);
        soft = max(soft, material.stay_lit);
    }
    let gi = mtoon_gi(ambient(normal.y), frame.ambient_sky, frame.ambient_ground, material.gi_equalization);
    var paint = vec3f(1.0);
    if options.face_paint {
        let drawn = textureSample(
            face_paint_texture, face_paint_sampler, texture_uv(options, uv, material.face_paint_uv)
        ).rgb;
        paint = face_paint_factor(
            drawn, 1.0 - shading, in.highlight.w * material.nose_line_strength, material.blush_color,
            material.blush_strength, material.line_color, material.shadow_line_strength
        );
        base = vec4f(base.rgb * paint, base.a);
        shade *= paint;
    }
    var tint = vec3f(1.0);
    if options.transition {
        tint = transition_tint(soft, material.transition_color, material.transition_strength);
    }
    var bangs = 1.0;
    // Share of shadow that is received.
    var received = 0.0;
    if options.bangs_shadow {
        // What is in shade already gets no darker.
        let share = select(shading, ceil(soft), options.shade_ramp) * directional * of_face;
        bangs = bangs_lit(in.bangs, BANGS_LAYER, share > 0.0);
        if options.lid_shadow {
            bangs = min(bangs, bangs_lit(in.bangs, LIDS_LAYER, share > 0.0));
        }
        received = share * bangs_share(bangs, material.bangs_edges, material.bangs_strength);
    }
    var direct: vec3f;
    if options.shade_ramp {
        var ramped = ramp_color(options, uv, base.rgb, shade, soft);
        if options.bangs_shadow {
            // By its share and not along the ramp, whose terminator is much narrower than the shadow's soft edge.
            ramped = mix(ramped, ramp_color(options, uv, base.rgb, shade, 0.0), received);
            soft *= 1.0 - received;
        }
        direct = ramped * light;
    } else {
        direct = mtoon_direct(base.rgb * tint, shade, shading, light)
            * mix(vec3f(1.0), material.bangs_color, received);
    }
    var shine = 0.0;
    if options.highlight {
        // The map is clamped at its border by its sampler.
        let at = texture_uv(options, uv, material.highlight_uv);
        var layers = textureSample(highlight_texture, highlight_sampler, at + in.highlight.xy).rg;
        if options.highlight_apart {
            let below = at + in.highlight.xy * vec2f(1.0, material.second_motion);
            layers.y = textureSample(highlight_texture, highlight_sampler, below).g;
        }
        if options.highlight_breakup {
            let strand = textureSample(highlight_texture, highlight_sampler, at).b;
            layers = vec2f(
                highlight_broken(layers.x, strand, material.highlight_breakup),
                highlight_broken(layers.y, strand, material.highlight_breakup)
            );
        }
        let left = in.highlight.z * mix(material.highlight_in_shade, 1.0, shading);
        if options.highlight_second {
            let second = layers.y * material.second_strength * left;
            direct = mix(direct, material.second_color * light, second);
            shine = second;
        }
        let first = layers.x * material.highlight_strength * left;
        direct = mix(direct, material.highlight_color * light, first);
        shine = max(shine, first);
    }
    var ambient_part = gi * base.rgb;
    if options.gem || options.diamond {
        let bitangent = cross(normal, tangent) * in.tangent.w;
        // A shadow takes the key light; scattered light stays.
        let arriving = light * mix(0.3, 1.0, own_lit);
        let place = StonePoint(view, normal, tangent, bitangent, in.uv.xy, arriving, gi);
        var stone: Stone;
        if options.gem {
            stone = gem_surface(place, options.gem_inclusions);
        } else {
            stone = diamond_surface(place);
        }
        direct = stone.color;
        ambient_part = vec3f(0.0);
        if options.channel == CHANNEL_STONE {
            extra = stone.parts;
        }
    }
    var matcap = vec3f(0.0);
    if options.matcap {
        // Images begin at the top left; the lookup has v upwards.
        let matcap_uv = mtoon_matcap_uv(normal, view) * vec2f(1.0, -1.0) + vec2f(0.0, 1.0);
        matcap = textureSample(matcap_texture, matcap_sampler, matcap_uv).rgb * material.matcap_color;
    }
    if options.shaped_highlight {
        if options.matcap {
            // Metal tints what it mirrors.
            let tinted = base.rgb / max(max(base.r, base.g), max(base.b, 1e-3));
            direct = mix(direct, matcap * tinted * light * mix(0.6, 1.0, shading), material.matcap_mix);
            matcap *= 1.0 - material.matcap_mix;
        }
        let left = mix(material.shaped_in_shade, 1.0, shading) * material.shaped_strength;
        let share = shaped_highlight(normal, view, tangent, options.shaped_map, options.shaped_brushed) * left;
        direct = mix(direct, material.shaped_color * light, share);
        shine = max(shine, share);
    }
    if options.sparkle {
        let bitangent = cross(normal, tangent) * in.tangent.w;
        let sparkling = sparks(normal, view, tangent, bitangent, in.uv.xy);
        direct += material.sparkle_color * light * sparkling * own_lit;
        if options.channel == CHANNEL_SPARKLE {
            extra = vec3f(sparkling);
        }
    }
    var color = direct + ambient_part + emission;

    if options.rim || options.matcap {
        var parametric = vec3f(0.0);
        if options.rim {
            parametric = material.rim_color
                * mtoon_parametric_rim(dot(normal, view), material.rim_lift, material.rim_fresnel_power);
        }
        var mask = vec3f(1.0);
        if options.rim_mask {
            mask = textureSample(
                rim_mask_texture, rim_mask_sampler, texture_uv(options, uv, material.rim_mask_uv)
            ).rgb;
        }
        color += mtoon_rim(matcap, parametric, mask, light + gi, material.rim_lighting_mix);
    }
    var contour = 0.0;
    if options.depth_rim {
        let seen = (frame.view_from_world * vec4f(normal, 0.0)).xy;
        let height = f32(textureDimensions(frame_depth).y);
        var width = material.depth_rim_width;
        if options.rim_width {
            width *= textureSample(rim_width_texture, base_sampler, texture_uv(options, uv, material.rim_width_uv)).r;
        }
        let offset = depth_rim_offset(seen, width, height);
        let here = frame.near / max(in.pixel.z, 1e-12);
        // Two places a pixel apart soften the inner edge; a little less, since half a pixel lies between two centres.
        let half_px = offset * (0.49 / max(length(offset), 0.5));
        let near_step = distance_at(vec2i(floor(in.pixel.xy + offset - half_px))) - here;
        let far_step = distance_at(vec2i(floor(in.pixel.xy + offset + half_px))) - here;
        let threshold = material.depth_rim_threshold;
        let edge = 0.5 * (depth_rim_step(near_step, threshold) + depth_rim_step(far_step, threshold))
            * depth_rim_resolved(width, height) * depth_rim_near(here, material.depth_rim_fade);
        let lit_side = rim_side(normal, seen, frame.to_light);
        contour = edge * lit_side;
        let own = mix(vec3f(1.0), base.rgb, material.depth_rim_tint);
        var rim = material.depth_rim_color * frame.light_color * contour;
        if options.rim_shade {
            let shaded = edge * (1.0 - lit_side);
            rim += material.depth_rim_shade * (frame.light_color * 0.5 + gi) * shaded;
            contour = max(contour, shaded * 0.5);
        }
        for (var i = 0u; i < frame.punctual_count; i++) {
            let arriving = punctual_light(i, in.world_position);
            let from_there = edge * rim_side(normal, seen, arriving.to_light) * material.depth_rim_punctual;
            rim += material.depth_rim_color * min(arriving.radiance, vec3f(1.0)) * from_there;
            contour = max(contour, from_there * saturate(luminance(arriving.radiance)));
        }
        color += rim * own;
    }
    if options.inner_lines {
        let line = inner_line(in.pixel, normal);
        if options.channel == CHANNEL_INNER_LINES {
            extra = vec3f(line);
        }
        // It darkens what is there: a line never glows.
        color *= mix(vec3f(1.0), material.line_tint, line);
    }
    if options.channel != 0u {
        color = channel_color(options, shading, tint, paint, shine, bangs, contour, soft, fur, own_lit, extra);
    }
    return vec4f(color, base.a);
}

// What of a surface blooms.
fn glow_surface(options: SurfaceOptions, in: SurfaceInput) -> vec3f {
    let uv = animated_uv(options, in.uv);
    if options.fire {
        let shape = burning_shape(options, uv);
        return shape.rgb * shape.a * material.glow;
    }
    if options.alpha_mask && material.base_color.a * surface_texel(options, in, uv).a < material.alpha_cutoff {
        discard;
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
        return light;
    }
    let normal = normalize(in.normal);
    let view = normalize(frame.eye - in.world_position);
    let tangent = normalize_or(in.tangent.xyz - normal * dot(normal, in.tangent.xyz), vec3f(0.0));
    if options.shaped_highlight {
        let share = shaped_highlight(normal, view, tangent, options.shaped_map, options.shaped_brushed);
        light += material.shaped_color * frame.light_color * share * material.shaped_strength * material.glow_highlight;
    }
    if options.highlight {
        let at = texture_uv(options, uv, material.highlight_uv) + in.highlight.xy;
        let layer = textureSample(highlight_texture, highlight_sampler, at).r;
        let left = in.highlight.z * smoothstep(0.0, 0.1, dot(normal, frame.to_light));
        light += material.highlight_color * frame.light_color
            * (layer * left * material.highlight_strength * material.glow_highlight);
    }
    if options.sparkle {
        let bitangent = cross(normal, tangent) * in.tangent.w;
        let sparkling = sparks(normal, view, tangent, bitangent, in.uv.xy);
        light += material.sparkle_color * frame.light_color * sparkling * material.glow_highlight;
    }
    return light;
}

// Light of the surface's own; `burn` is its place in a dissolve.
fn emitted(options: SurfaceOptions, uv: vec4f, burn: f32) -> vec3f {
    var emission = material.emission;
    if options.emission_texture {
        var at = texture_uv(options, uv, material.emission_uv);
        if options.emission_scroll {
            at += fract(material.emission_scroll * frame.time_s);
        }
        emission *= textureSample(emission_texture, emission_sampler, at).rgb;
    }
    if options.emission_blink {
        emission *= blink(fract(frame.time_s / material.blink_period), material.blink_low, material.blink_sharpness);
    }
    if options.dissolve {
        emission += material.dissolve_color * (1.0 - saturate(burn));
    }
    return emission;
}

// Share of a line at a pixel: eight places round it are compared with it.
fn inner_line(pixel: vec3f, normal: vec3f) -> f32 {
    let height = f32(textureDimensions(frame_depth).y);
    // A quarter of a pixel lies between the border and the middle of a pixel on the line, as a mean.
    let radius = max(material.line_width * height / 1024.0 * 0.5, 0.5) + 0.25;
    let own = surface_at(vec2i(pixel.xy));
    let here = frame.near / max(pixel.z, 1e-12);
    var different = 0.0;
    for (var i = 0; i < 8; i++) {
        let angle = f32(i) * 0.78539816;
        let at = vec2i(floor(pixel.xy + vec2f(cos(angle), sin(angle)) * radius));
        let other = surface_at(at);
        let step = abs(distance_at(at) - here);
        different += line_between(
            own.part, other.part, dot(own.normal, other.normal), step, material.line_steps, material.line_parts > 0.5
        );
    }
    // A line of less than a pixel is as much fainter.
    return saturate(different * 0.5) * saturate(material.line_width * height / 1024.0);
}

// Share of a rim by the side of a light; `seen` is the normal as it is seen.
fn rim_side(normal: vec3f, seen: vec2f, to_light: vec3f) -> f32 {
    let light_seen = (frame.view_from_world * vec4f(to_light, 0.0)).xy;
    // 1e-12: a normal or a light towards the viewer has no direction there.
    let outwards = dot(seen, light_seen) * inverseSqrt(max(dot(seen, seen) * dot(light_seen, light_seen), 1e-12));
    return depth_rim_side(dot(normal, to_light), outwards, material.depth_rim_side);
}

// Fire: colour and cover.
fn burning_shape(options: SurfaceOptions, uv: vec4f) -> vec4f {
    var at = texture_uv(options, uv, material.highlight_uv);
    let phase = fract(frame.time_s / material.fire_period);
    let noise = fire_noise(at, phase, material.fire_cells);
    at.x += fire_sway(at, phase, material.fire_cells, material.fire_sway);
    let drawn = textureSample(highlight_texture, highlight_sampler, at).r;
    let heat = fire_heat(drawn, noise, material.fire_turbulence);
    let cover = fire_cover(heat, material.fire_erosion, material.fire_softness);
    if options.channel == CHANNEL_FIRE {
        return vec4f(vec3f(heat), cover);
    }
    if options.channel != 0u {
        return vec4f(vec3f(0.0), cover);
    }
    let color = fire_color(
        heat, material.fire_rim, material.fire_body, material.fire_heart, material.fire_edges, material.fire_softness
    );
    return vec4f(color, cover);
}

// Number of the part at a place, from 0 on; -1 where the map knows none. The texel itself: numbers are not filtered.
fn part_at(options: SurfaceOptions, uv: vec4f) -> i32 {
    let size = vec2f(textureDimensions(part_ids_texture));
    let at = fract(texture_uv(options, uv, material.part_ids_uv));
    let part = i32(textureLoad(part_ids_texture, vec2i(at * size), 0).r * 255.0 + 0.5) - 1;
    return select(-1, part, part < 8);
}

// Colour of the surface in full light or in full shade, unlit: what a line round it is mixed from.
fn line_source(options: SurfaceOptions, in_uv: vec4f, color: vec4f, in_shade: bool) -> vec3f {
    let uv = animated_uv(options, in_uv);
    let texel = surface_texel(options, texel_input(in_uv, color), uv);
    let lit = material.base_color.rgb * texel.rgb;
    if !in_shade || options.unlit {
        return lit;
    }
    let shade = surface_shade(options, texel, uv, color);
    if options.shade_ramp {
        return ramp_color(options, uv, lit, shade, 0.0);
    }
    return shade;
}

// Colour in shade.
fn surface_shade(options: SurfaceOptions, texel: vec4f, uv: vec4f, color: vec4f) -> vec3f {
    var shade = material.shade_color;
    if options.shade_is_base {
        return shade * texel.rgb;
    }
    if options.shade_texture {
        shade *= textureSample(shade_texture, shade_sampler, texture_uv(options, uv, material.shade_uv)).rgb;
    }
    if options.vertex_color {
        shade *= color.rgb;
    }
    return shade;
}

// Light that falls on a place from anywhere, at most 1: a line takes it whole, whatever its own direction.
fn arriving_light(position: vec3f) -> vec3f {
    var light = frame.light_color + 0.5 * (frame.ambient_sky + frame.ambient_ground);
    for (var i = 0u; i < frame.punctual_count; i++) {
        light += punctual_light(i, position).radiance;
    }
    return min(light, vec3f(1.0));
}

// Lit colour at a place of the ramp between full shade (0) and full light (1).
fn ramp_color(options: SurfaceOptions, uv: vec4f, lit: vec3f, shade: vec3f, place: f32) -> vec3f {
    if options.ramp_maps {
        var v = material.ramp_v;
        if options.ramp_parts {
            let part = part_at(options, uv);
            if part >= 0 {
                v = material.ramp_part_v[part / 4][part % 4];
            }
        }
        let at = vec2f(place, v);
        let warm = textureSampleLevel(ramp_warm_texture, face_sampler, at, 0.0).rgb;
        let cool = textureSampleLevel(ramp_cool_texture, face_sampler, at, 0.0).rgb;
        return lit * mix(warm, cool, frame.coolness);
    }
    var dark = shade;
    if options.shade_shift {
        // Colours that a turn takes out of the gamut are cut.
        dark = max(mix(material.shade_shift_warm * shade, material.shade_shift_cool * shade, frame.coolness), vec3f(0.0));
    }
    return ramp_bands(lit, dark, lit * material.ramp_terminator, material.ramp_edges, place);
}

// What one of the debug channels shows.
fn channel_color(
    options: SurfaceOptions, shading: f32, tint: vec3f, paint: vec3f, shine: f32, bangs: f32, contour: f32,
    place: f32, fur: vec3f, own_lit: f32, extra: vec3f
) -> vec3f {
    switch options.channel {
        case CHANNEL_FACE_SHADOW { return vec3f(shading) * select(vec3f(0.25), vec3f(1.0), options.face_shadow); }
        case CHANNEL_TRANSITION { return select(vec3f(0.0), tint, options.transition); }
        case CHANNEL_FACE_PAINT { return select(vec3f(0.0), paint, options.face_paint); }
        case CHANNEL_HIGHLIGHT { return vec3f(shine); }
        case CHANNEL_BANGS_SHADOW { return select(vec3f(0.0), vec3f(bangs), options.bangs_shadow); }
        case CHANNEL_LAYER { return layer_color(options); }
        case CHANNEL_DEPTH_RIM { return vec3f(contour); }
        case CHANNEL_SHADE_RAMP { return select(vec3f(0.0), vec3f(place), options.shade_ramp); }
        case CHANNEL_FUR { return fur; }
        case CHANNEL_SELF_SHADOW { return select(vec3f(0.0), vec3f(own_lit), options.cast_shadow); }
        default { return extra; }
    }
}

// Grey by the index of the layer, lighter above; black where there is none.
fn layer_color(options: SurfaceOptions) -> vec3f {
    if !options.layered {
        return vec3f(0.0);
    }
    return vec3f(0.5 + material.layer_pull * 600.0);
}
