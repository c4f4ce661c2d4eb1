// A toon surface: samples the material's textures and shades. Shared by the opaque, outline and transparent passes.
// Which parts exist is fixed at pipeline creation, so that what a material does not use costs nothing.
import package::bind::axes::surface_axes;
import package::bind::character::{BANGS_LAYER, LIDS_LAYER, bangs_lit, shadow_lit};
import package::bind::contour::{depth_rim, inner_line};
import package::bind::emission::emitted;
import package::bind::face::{FaceOptions, face_shading_at};
import package::bind::fire::burning_shape;
import package::bind::frame::frame;
import package::bind::lights::{ambient, punctual_light};
import package::bind::material::{
    material, base_texture, base_sampler, shade_texture, shade_sampler, shift_texture, shift_sampler, matcap_texture,
    matcap_sampler, rim_mask_texture, rim_mask_sampler, face_paint_texture, face_paint_sampler, detail_color_texture,
    detail_sampler,
};
import package::bind::options::{
    CHANNEL_FACE_SHADOW, CHANNEL_TRANSITION, CHANNEL_FACE_PAINT, CHANNEL_HIGHLIGHT, CHANNEL_BANGS_SHADOW, CHANNEL_LAYER,
    CHANNEL_DEPTH_RIM, CHANNEL_SHADE_RAMP, CHANNEL_FUR, CHANNEL_SELF_SHADOW, CHANNEL_STONE, CHANNEL_SPARKLE,
    CHANNEL_DISSOLVE, CHANNEL_EMISSION, CHANNEL_OVERLAY, CHANNEL_INNER_LINES, SurfaceOptions,
};
import package::bind::overlay::{Painted, with_decals, with_stocking};
import package::bind::ramp::ramp_color;
import package::bind::shine::{shaped_highlight, sparks, painted_highlight};
import package::bind::stone::{Stone, StonePoint, diamond_surface, gem_surface};
import package::bind::texel::{animated_uv, surface_texel, texture_uv};
import package::bind::vanish::{burning, is_dithered_away};
import package::lib::bangs::bangs_share;
import package::lib::face_paint::face_paint_factor;
import package::lib::face_shadow::face_shading;
import package::lib::fur::{fur_color, fur_masks};
import package::lib::light::{accumulated_n_dot_l, light_response, luminance};
import package::lib::mtoon::{mtoon_direct, mtoon_gi, mtoon_matcap_uv, mtoon_parametric_rim, mtoon_rim, mtoon_shading};
import package::lib::transition::transition_tint;

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

// Shaded colour (linear, straight), and alpha or the coverage of a masked surface. `in.normal` need not be unit; it faces
// the viewer.
fn shade_surface(options: SurfaceOptions, in: SurfaceInput) -> vec4f {
    let uv = animated_uv(options, in.uv);
    // What a debug channel shows of the looks below.
    var extra = vec3f(0.0);
    if options.dither_fade && !options.dither_samples && is_dithered_away(in.pixel.xy, in.world_position) {
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
    var texel = surface_texel(options, in.color, uv);
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

    let axes = surface_axes(options, in.normal, in.tangent, uv);
    let normal = axes.normal;
    let tangent = axes.tangent;

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
        let layers = painted_highlight(options, uv, in.highlight.xy);
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
        let rim = depth_rim(options, in.pixel, in.world_position, normal, uv, gi);
        contour = rim.share;
        color += rim.light * mix(vec3f(1.0), base.rgb, material.depth_rim_tint);
    }
    if options.inner_lines {
        let line = inner_line(in.pixel);
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

// Colour of the surface in full light or in full shade, unlit: what a line round it is mixed from.
fn line_source(options: SurfaceOptions, in_uv: vec4f, color: vec4f, in_shade: bool) -> vec3f {
    let uv = animated_uv(options, in_uv);
    let texel = surface_texel(options, color, uv);
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
