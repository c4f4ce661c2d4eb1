// Hair lit as strands, over toon shading as far as wanted.
import package::bind::actor::actors;
import package::bind::environment::{environment_irradiance, environment_radiance};
import package::bind::frame::frame;
import package::bind::lights::punctual_light;
import package::bind::maps::shadow_thickness;
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface};
import package::bind::uv::texture_uv;
import package::lib::bands::banded;
import package::lib::fibre::{TABLE_ANGLES, TABLE_ROWS, fibre_absorption, fibre_around, fibre_longitudinal, fibre_tilted};
import package::lib::kajiya_kay::{shifted_strand, strand_specular, wrapped_lambert};
import package::lib::light::luminance;
import package::look::hair::{strand_direction, strand_shift};
import package::look::strips::{grayness_of_strips, occlusion_of_strips};
import package::material::{base_texture, base_texture_sampler, hair_table, hair_table_sampler, material};
import package::model::standard::physical_light;
import package::model::toon::toon_model;

// What of a strand all lights ask for.
struct Strand {
    // Unit, from root to tip.
    direction: vec3f,
    shift: f32,
    color: vec3f,
    // Share of light that comes through the hair about it.
    occlusion: f32,
    // How gray it is: pigment that has gone.
    gray: f32,
    // Fibres between it and the key light.
    crossed: f32,
    // Of fibres: direction as the shift map tilts their scales, sine and cosine of the view's inclination, row of the table,
    // absorption, and what goes where of the light that meets one.
    tilted: vec3f,
    sin_o: f32,
    cos_o: f32,
    row: f32,
    absorption: vec3f,
    energies: Energies,
}

// What the pictures of a path tracer give (`cargo xtask compare-real hair`), for hair of all colours.
// Light that reaches a strand through others finds it from more sides than straight light does.
const ON: f32 = 1.25;
// Strands of one layer do not hide each other, as grains at all depths would.
const LAYERED: f32 = 1.2;
// Share of light from behind that what is seen of a body gets: less than a layer as deep as one sees into it, which lets 1/e
// through.
const FROM_BEHIND: f32 = 0.12;

// Light of one direction on it: its body, and its highlights.
struct Lit {
    body: vec3f,
    highlights: vec3f,
}

const PI: f32 = 3.14159265;

fn strand_of(s: ptr<function, Surface>) -> Strand {
    var strand: Strand;
    strand.direction = strand_direction(s);
    strand.shift = strand_shift(s);
    strand.color = s.lit;
    strand.occlusion = 1.0;
    @if(strips) {
        let m = &material.hair;
        strand.occlusion = mix(1.0, occlusion_of_strips(s.at)[m.occlusion_strength], m.occlusion);
        strand.gray = grayness_of_strips(s.at);
        strand.color = mix(strand.color, vec3f(luminance(strand.color)), strand.gray);
    }
    @if(hair_fibre) {
        strand.tilted = strand.direction;
        @if(hair_shift_map) strand.tilted = shifted_strand(strand.direction, s.normal, strand.shift);
        strand.sin_o = clamp(dot(strand.tilted, s.view), -1.0, 1.0);
        strand.cos_o = sqrt(max(1.0 - strand.sin_o * strand.sin_o, 1e-6));
        strand.row = inclination_row(strand.cos_o);
        strand.absorption = strand_absorption(s, strand);
        strand.energies = fibre_energies(strand.row, strand.absorption);
    }
    @if(hair_fibre && cast_shadow) strand.crossed =
        shadow_thickness(s.at.actor, s.at.shadow) * material.hair.fibre_density * material.cast_shadow.received;
    return strand;
}

// Where a strand mirrors the viewer to: in the plane of the view and of its normal that faces it.
fn strand_mirrored(s: ptr<function, Surface>, t: vec3f) -> vec3f {
    let across = s.view - t * dot(t, s.view);
    return reflect(-s.view, across * inverseSqrt(max(dot(across, across), 1e-8)));
}

@if(hair_kajiya_kay)
fn strand_lit(s: ptr<function, Surface>, strand: Strand, to_light: vec3f, share: f32) -> Lit {
    let m = &material.hair;
    let h = normalize(s.view + to_light);
    let first = shifted_strand(strand.direction, s.normal, m.kajiya_kay_primary_shift + strand.shift);
    let second = shifted_strand(strand.direction, s.normal, m.kajiya_kay_secondary_shift + strand.shift);
    let n_dot_l = dot(s.normal, to_light);
    let around = wrapped_lambert(n_dot_l, m.wrap) * strand.occlusion;
    // The side that is turned from the light has no highlights.
    let facing = around * smoothstep(-0.2, 0.2, n_dot_l) * share;
    var lit: Lit;
    lit.body = strand.color * (around * share);
    let primary = m.kajiya_kay_primary_color
        * (m.kajiya_kay_direct.x * strand_specular(first, h, m.kajiya_kay_primary_exponent));
    let secondary = m.kajiya_kay_secondary_color * strand.color
        * (m.kajiya_kay_direct.y * strand_specular(second, h, m.kajiya_kay_secondary_exponent));
    lit.highlights = (primary + secondary) * facing;
    @if(hair_blinn) lit.highlights += m.kajiya_kay_primary_color
        * (m.kajiya_kay_direct.z * pow(max(dot(s.normal, h), 1e-4), m.kajiya_kay_primary_exponent) * facing);
    @if(channel_hair_primary) shown += primary * facing;
    @if(channel_hair_secondary) shown += secondary * facing;
    return lit;
}

@if(hair_kajiya_kay)
fn strand_lit_from_around(s: ptr<function, Surface>, strand: Strand) -> Lit {
    let m = &material.hair;
    let left = 1.0 - m.kajiya_kay_gray_scale * luminance(strand.color);
    var lit: Lit;
    lit.body = strand.color * environment_irradiance(s.normal) * strand.occlusion;
    // Both lobes are far wider than they are shifted: one look serves them.
    let mirrored = environment_radiance(strand_mirrored(s, strand.direction), 1.0 - m.kajiya_kay_smoothness);
    lit.highlights = mirrored * (
        m.kajiya_kay_primary_color * m.kajiya_kay_indirect.x
        + m.kajiya_kay_secondary_color * strand.color * m.kajiya_kay_indirect.y
    );
    @if(hair_blinn) lit.highlights += m.kajiya_kay_primary_color * m.kajiya_kay_indirect.z
        * environment_radiance(reflect(-s.view, s.normal), 1.0 - m.kajiya_kay_smoothness);
    lit.highlights *= left * strand.occlusion;
    return lit;
}

// An entry of the table.
@if(hair_fibre)
fn fibre_entry(column: f32, row: f32) -> vec4f {
    let size = vec2f(f32(TABLE_ANGLES + 2u), f32(TABLE_ROWS * 2u));
    return textureSampleLevel(hair_table, hair_table_sampler, vec2f(column, row) / size, 0.0);
}

// Row of an inclination by its cosine. Roots of the cosine lie close where much is reflected, and what depends on an
// inclination is straight over its cosine where it is small.
@if(hair_fibre)
fn inclination_row(cos_o: f32) -> f32 {
    return 0.5 + (1.0 - sqrt(cos_o)) * f32(TABLE_ROWS - 1u);
}

// How much more a strand absorbs than the hair about it, by a texture of strands and by its mean over 16 by 16 texels.
@if(hair_varied)
fn strand_variation(s: ptr<function, Surface>) -> f32 {
    let at = texture_uv(s.uv, material.base.texture_uv);
    let about = luminance(textureSampleLevel(base_texture, base_texture_sampler, at, 4.0).rgb);
    let darker = (about + 0.02) / (luminance(s.texel.rgb) + 0.02);
    // Colours go by the root of the absorption.
    return mix(1.0, clamp(darker * darker, 0.35, 3.0), material.hair.fibre_variation);
}

// Absorption of a strand, by its pigment or by its colour.
@if(hair_fibre)
fn strand_absorption(s: ptr<function, Surface>, strand: Strand) -> vec3f {
    let m = &material.hair;
    var sigma = m.fibre_absorption;
    @if(hair_varied) sigma *= strand_variation(s);
    @if(hair_of_base) sigma = mix(sigma, fibre_absorption(strand.color), m.fibre_of_base);
    return sigma * (1.0 - strand.gray);
}

// What goes backwards by R, and forwards, backwards and many times about by all, for each colour.
struct Energies {
    reflected: f32,
    forwards: vec3f,
    backwards: vec3f,
    around: vec3f,
}

@if(hair_fibre)
fn fibre_energies(row: f32, sigma: vec3f) -> Energies {
    let entry = fibre_entry(f32(TABLE_ANGLES) + 1.0, row);
    // What comes back has gone through twice.
    let once = exp(-entry.w * sigma);
    var e: Energies;
    e.reflected = entry.x;
    e.backwards = entry.x + entry.z * once * once;
    e.forwards = entry.y + (1.0 - entry.x - entry.y - entry.z) * once;
    // What a fibre does not keep goes on to others.
    e.around = fibre_around(e.forwards + e.backwards);
    return e;
}

// Share of light that what is seen of a body of strands gets, each of which lets a share of it on. Through a body from behind
// comes as much as through a layer as deep as it is seen into.
@if(hair_fibre)
fn body_share(forwards: vec3f, n_dot_l: f32, n_dot_v: f32, packing: f32) -> vec3f {
    let before = wrapped_lambert(n_dot_l, material.hair.wrap);
    let kept = min(LAYERED * before / max(before + n_dot_v * (1.0 - forwards), vec3f(1e-3)), vec3f(1.0));
    let behind = 1.0 - smoothstep(-0.6, 0.2, n_dot_l);
    return mix(vec3f(1.0), mix(kept, vec3f(FROM_BEHIND), behind), packing);
}

@if(hair_fibre)
fn strand_lit(s: ptr<function, Surface>, strand: Strand, to_light: vec3f, share: f32) -> Lit {
    let m = &material.hair;
    let sin_o = strand.sin_o;
    let cos_o = strand.cos_o;
    let sin_i = clamp(dot(strand.tilted, to_light), -1.0, 1.0);
    let cos_i = sqrt(max(1.0 - sin_i * sin_i, 1e-6));
    let cos_phi = clamp((dot(s.view, to_light) - sin_o * sin_i) / (cos_o * cos_i), -1.0, 1.0);
    let column = 0.5 + acos(cos_phi) / PI * f32(TABLE_ANGLES - 1u);
    let sigma = strand.absorption;
    let sharp = m.fibre_sharp;
    let to_r = fibre_tilted(sin_o, cos_o, m.fibre_tilt_r);
    let to_tt = fibre_tilted(sin_o, cos_o, m.fibre_tilt_tt);
    let to_trt = fibre_tilted(sin_o, cos_o, m.fibre_tilt_trt);
    let scale = m.fibre_scales;
    let along = vec4f(
        fibre_longitudinal(sharp.x, scale.x, sin_i, cos_i, to_r.x, to_r.y),
        fibre_longitudinal(sharp.y, scale.y, sin_i, cos_i, to_tt.x, to_tt.y),
        fibre_longitudinal(sharp.z, scale.z, sin_i, cos_i, to_trt.x, to_trt.y),
        fibre_longitudinal(sharp.w, scale.w, sin_i, cos_i, sin_o, cos_o),
    );
    let leaving = fibre_entry(column, strand.row) * along;
    let lost = fibre_entry(column, strand.row + f32(TABLE_ROWS));
    let reflected = vec3f(leaving.x);
    let once = exp(-lost.y * sigma);
    let twice = exp(-lost.z * sigma);
    let through = leaving.y * once;
    // The rest goes through thrice and more.
    let inner = twice * (leaving.z + leaving.w * once);
    let e = strand.energies;
    // Light arrives straight as far as no fibre is before it (Poisson), and through those that are. What is seen of a body of
    // strands lies at all depths, from which light of both kinds is lost (Lommel and Seeliger). Strands stand out of the
    // surface that they lie on.
    let n_dot_l = dot(s.normal, to_light);
    let n_dot_v = wrapped_lambert(dot(s.normal, s.view), m.wrap);
    var open = share;
    var ahead = vec3f(share);
    @if(cast_shadow) {
        open *= exp(-strand.crossed);
        ahead *= exp(-strand.crossed * (1.0 - e.forwards));
    }
    let straight = body_share(vec3f(0.0), n_dot_l, n_dot_v, m.fibre_packing).x * open;
    let with_scattered = body_share(e.forwards, n_dot_l, n_dot_v, m.fibre_packing) * ahead;
    let arriving = straight + ON * m.fibre_scatter * max(with_scattered - straight, vec3f(0.0));
    // What has gone about among strands comes from all depths: a soft surface's share of the light. A single layer has but half
    // of them, those beside it.
    let among = mix(0.5, wrapped_lambert(n_dot_l, m.wrap), m.fibre_packing) * open * m.fibre_scatter;
    let about = e.around * ((1.0 + cos_phi) / (2.0 * PI) * along.w * among);
    // A light of strength 1 is an irradiance of pi.
    let occluded = PI * strand.occlusion;
    var lit: Lit;
    lit.highlights = (reflected + inner) * arriving * occluded;
    lit.body = (through * arriving + about) * occluded;
    @if(channel_hair_primary) shown += reflected * arriving * occluded;
    @if(channel_hair_secondary) shown += inner * arriving * occluded;
    return lit;
}

@if(hair_fibre)
fn strand_lit_from_around(s: ptr<function, Surface>, strand: Strand) -> Lit {
    let m = &material.hair;
    let e = strand.energies;
    var lit: Lit;
    // R spreads as a rough mirror does.
    let roughness = saturate(sqrt(2.0 * inverseSqrt(m.fibre_sharp.x)));
    let mirrored = strand_mirrored(s, strand.tilted);
    let n_dot_v = wrapped_lambert(dot(s.normal, s.view), m.wrap);
    let open = body_share(vec3f(0.0), dot(s.normal, mirrored), n_dot_v, m.fibre_packing).x * strand.occlusion;
    lit.highlights = environment_radiance(mirrored, roughness) * (e.reflected * open);
    lit.body = environment_irradiance(s.normal)
        * ((max(e.backwards - e.reflected, vec3f(0.0)) + e.around * m.fibre_scatter) * strand.occlusion);
    return lit;
}

// Highlights in the bands of a painter.
fn strand_highlights(light: vec3f) -> vec3f {
    let m = &material.hair;
    @if(!hair_bands) return light * m.highlight_color;
    @if(hair_bands) {
        let y = luminance(light);
        return light * m.highlight_color * (banded(y, m.steps, m.edge) / max(y, 1e-4));
    }
}

fn hair_model(s: ptr<function, Surface>) -> Shaded {
    let m = &material.hair;
    let strand = strand_of(s);
    @if(channel_strands) shown = strand.direction * 0.5 + 0.5;
    // What light loses on its way through fibres is no matter of lit or not: no map need say so.
    @if(!hair_fibre || !cast_shadow) var l = physical_light(s, true);
    @if(!hair_fibre || !cast_shadow) let share = l.own_lit;
    @if(hair_fibre && cast_shadow) var l = physical_light(s, false);
    @if(hair_fibre && cast_shadow) let share = actors[s.at.actor].key_light;
    @if(hair_fibre && cast_shadow) {
        l.own_lit = exp(-strand.crossed) * share;
        l.shading = l.own_lit;
    }
    var direct = strand_lit(s, strand, frame.to_light, share);
    direct.body *= s.light;
    direct.highlights *= s.light;
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, s.at.world_position);
        var bare = strand;
        bare.crossed = 0.0;
        let lit = strand_lit(s, bare, arriving.to_light, 1.0);
        direct.body += lit.body * arriving.radiance;
        direct.highlights += lit.highlights * arriving.radiance;
    }
    let around = strand_lit_from_around(s, strand);
    @if(channel_hair_indirect) shown = around.body + around.highlights;
    l.direct = direct.body + strand_highlights(direct.highlights);
    l.ambient = around.body + around.highlights;
    @if(hair_toon) {
        let drawn = toon_model(s);
        l.direct = mix(drawn.direct + strand_highlights(direct.highlights), l.direct, m.natural);
        l.ambient = mix(drawn.ambient, l.ambient, m.natural);
        l.lit = drawn.lit;
        l.shading = mix(drawn.shading, l.shading, m.natural);
        l.gi = mix(drawn.gi, l.gi, m.natural);
    }
    return l;
}
