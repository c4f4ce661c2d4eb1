// Skin: light that scatters below its surface, and what is mirrored on it.
import package::bind::actor::actors;
import package::bind::environment::{environment_brdf, environment_irradiance, environment_radiance};
import package::bind::frame::{distance_here, environment_sampler, frame, frame_scattered, frame_skin};
import package::bind::lights::punctual_light;
import package::bind::maps::shadow_depth;
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface};
import package::bind::uv::texture_uv;
import package::lib::brdf::{f0_of_ior, filtered_alpha2, ggx_distribution, schlick, smith_visibility};
import package::lib::occlusion::{occluded_diffuse, occluded_specular};
import package::lib::skin::{
    albedo_place, detail_smoothing, diffused_place, penumbra_place, transmittance_place, wrapped_diffuse,
    wrapped_diffuse_as_written,
};
import package::lib::skin_specular::{blinn_phong_lobe, dual_ggx_lobe, kelemen_lobe};
import package::lib::strips::strip_hue;
import package::look::normal_map::normal_map_smooth;
import package::material::{
    material, skin_curvature_map, skin_curvature_map_sampler, skin_table, skin_table_sampler, skin_thickness_map,
    skin_thickness_map_sampler,
};
import package::model::standard::physical_light;
import package::model::toon::toon_model;

const PI: f32 = 3.14159265;

// What of skin all lights ask for.
struct Skinned {
    // Real, 1/mm; and mm.
    curvature: f32,
    thickness: f32,
    // Without what is finer than light scatters.
    smooth_normal: vec3f,
    n_dot_v: f32,
    // Share of light that the surface mirrors to the viewer's side; and reflectance at normal incidence.
    mirrored: f32,
    f0: vec3f,
    // Of the lobe, or of the sharp and of the wide one; over the pixel.
    alpha: vec2f,
    // Share of light from all around that nothing hides.
    open: f32,
}

// Light of one direction: what scatters, and what is mirrored; over the light.
struct Lit {
    scattered: vec3f,
    mirrored: vec3f,
}

fn skin_entry(place: vec2f) -> vec3f {
    return textureSampleLevel(skin_table, skin_table_sampler, place, 0.0).rgb;
}

// Share of light from a direction that is mirrored.
fn skin_albedo(n_dot: f32) -> f32 {
    return skin_entry(albedo_place(n_dot)).r * material.skin.specular_strength;
}

fn skin_of(s: ptr<function, Surface>) -> Skinned {
    let m = &material.skin;
    var skin: Skinned;
    let mm = 1000.0 * m.profile_world_scale;
    skin.curvature = s.at.skin.x / mm;
    @if(skin_curvature_map) skin.curvature = textureSample(
        skin_curvature_map, skin_curvature_map_sampler, texture_uv(s.uv, m.curvature_map_uv)
    ).r;
    skin.curvature *= m.curvature_scale;
    skin.thickness = s.at.skin.y * mm;
    @if(skin_thickness_map) skin.thickness = mix(
        m.profile_thickness_remap_mm.x, m.profile_thickness_remap_mm.y,
        textureSample(skin_thickness_map, skin_thickness_map_sampler, texture_uv(s.uv, m.thickness_map_uv)).r
    );
    skin.smooth_normal = s.normal;
    @if(normal_map && skin_pre_integrated) skin.smooth_normal = mix(s.normal, normal_map_smooth(s, m.metres_per_uv), m.detail);
    skin.n_dot_v = max(dot(s.normal, s.view), 1e-3);
    skin.mirrored = skin_albedo(skin.n_dot_v);
    skin.f0 = vec3f(f0_of_ior(m.profile_ior));
    var rough = vec2f(m.roughness);
    @if(skin_dual_ggx) rough = clamp(m.roughness * m.lobes, vec2f(0.02), vec2f(1.0));
    let along_x = dpdx(s.normal);
    let along_y = dpdy(s.normal);
    skin.alpha = sqrt(vec2f(
        filtered_alpha2(pow(rough.x, 4.0), along_x, along_y), filtered_alpha2(pow(rough.y, 4.0), along_x, along_y)
    ));
    skin.open = 1.0 - saturate(s.at.skin.z) * m.occlusion;
    return skin;
}

// What the surface lets in of a light, and scatters to where it comes out: over the light's strength.
fn skin_diffused(s: ptr<function, Surface>, skin: Skinned, to_light: vec3f) -> vec3f {
    let m = &material.skin;
    let n_dot_l = dot(s.normal, to_light);
    @if(skin_lambert || skin_screen_space || skin_texture_space) return vec3f(saturate(n_dot_l));
    @if(skin_wrapped && skin_wrap_as_written) return vec3f(wrapped_diffuse_as_written(n_dot_l, m.wrap));
    @if(skin_wrapped && !skin_wrap_as_written) return vec3f(wrapped_diffuse(n_dot_l, m.wrap));
    @if(skin_pre_integrated && !normal_map) return skin_entry(diffused_place(n_dot_l, abs(skin.curvature)));
    @if(skin_pre_integrated && normal_map) {
        // What scatters farther is bent less by bumps. Light of a normal between two is taken to lie as far between theirs.
        let low_dot_l = dot(skin.smooth_normal, to_light);
        let k = abs(skin.curvature);
        let smooth_light = skin_entry(diffused_place(low_dot_l, k));
        let sharp_light = skin_entry(diffused_place(n_dot_l, k));
        return mix(sharp_light, smooth_light, vec3f(1.0, detail_smoothing(low_dot_l)));
    }
}

// Density of what is mirrored times pi, without Fresnel's factor: a light of strength 1 is an irradiance of pi.
fn skin_lobe(s: ptr<function, Surface>, skin: Skinned, h: vec3f, to_light: vec3f) -> f32 {
    let m = &material.skin;
    let n_dot_l = max(dot(s.normal, to_light), 1e-4);
    let n_dot_h = saturate(dot(s.normal, h));
    let l_dot_h = saturate(dot(to_light, h));
    let alpha = skin.alpha.x;
    @if(skin_blinn_phong) return PI * blinn_phong_lobe(n_dot_h, l_dot_h, alpha);
    @if(skin_kelemen) return PI * kelemen_lobe(n_dot_h, l_dot_h, alpha);
    @if(skin_ggx) return PI * ggx_distribution(n_dot_h, alpha) * smith_visibility(n_dot_l, skin.n_dot_v, alpha);
    @if(skin_dual_ggx) return PI * dual_ggx_lobe(n_dot_h, n_dot_l, skin.n_dot_v, alpha, skin.alpha.y, m.lobe_mix);
}

// Light of one direction, of which a share of each colour arrives, and a share at the surface itself.
fn skin_lit(s: ptr<function, Surface>, skin: Skinned, to_light: vec3f, spread: vec3f, share: f32) -> Lit {
    let n_dot_l = saturate(dot(s.normal, to_light));
    let h = normalize(s.view + to_light);
    var lit: Lit;
    let fresnel = schlick(skin.f0, dot(to_light, h));
    lit.mirrored = fresnel * (material.skin.specular_strength * skin_lobe(s, skin, h, to_light) * n_dot_l * share);
    // Of what the surface mirrors nothing scatters.
    @if(!skin_screen_space) lit.scattered = skin_diffused(s, skin, to_light) * spread * (1.0 - skin_albedo(n_dot_l));
    return lit;
}

// Light that comes through from behind, over the light's strength: that of a slab whose far side faces the light. `way` in mm.
fn skin_through(skin: Skinned, n_dot_l: f32, way: f32) -> vec3f {
    let m = &material.skin;
    let through = skin_entry(transmittance_place(way, m.thickness_range_mm, SKIN_OF_VOLUME));
    return through * m.profile_transmission_tint * (m.transmission * saturate(-n_dot_l));
}

@if(skin_of_volume) const SKIN_OF_VOLUME: bool = true;
@if(!skin_of_volume) const SKIN_OF_VOLUME: bool = false;

// Share of the key light that arrives at a place for each colour, with shadows' edges as soft as it scatters, and at the surface
// itself. `l` has it as the looks of toon surfaces do.
struct Share {
    spread: vec3f,
    own: f32,
}

// The place in the shadow map from which light that scatters comes: round the edge of light the body itself does not hide it.
fn skin_receiver(s: ptr<function, Surface>, skin: Skinned) -> Surface {
    var moved = *s;
    @if(cast_shadow && (skin_pre_integrated || skin_wrapped)) {
        // The way in the dark along a bulge, mm; light has come twice as far through it.
        let dark = max(-s.n_dot_l, 0.0) / max(abs(skin.curvature), 1e-3);
        let way = min(2.2 * dark, 3.0 * material.skin.reach_mm) / (1000.0 * material.skin.profile_world_scale);
        moved.at.shadow.z -= way * actors[s.at.actor].shadow_scale;
    }
    return moved;
}

fn skin_share(s: ptr<function, Surface>, skin: Skinned, lit: f32) -> Share {
    var share = Share(vec3f(lit), lit);
    @if(cast_shadow && skin_penumbra) {
        let a = &actors[s.at.actor];
        let width = 1000.0 * material.skin.profile_world_scale * (*a).shadow_spread / max((*a).shadow_scale, 1e-6);
        // Beyond a narrow edge nothing is known of it: there the table is stretched to no light and to all of it. A count rather
        // than a branch, of which software rasterizers walk both sides.
        for (var i = 0; i < select(0, 1, lit > 0.0 && lit < 1.0); i++) {
            let dark = skin_entry(penumbra_place(0.0, width));
            let all = skin_entry(penumbra_place(1.0, width));
            let soft = (skin_entry(penumbra_place(lit, width)) - dark) / max(all - dark, vec3f(1e-3));
            share.spread = mix(share.spread, soft, material.skin.penumbra);
        }
    }
    return share;
}

// Way of the key light through the body, mm.
fn skin_way(s: ptr<function, Surface>, skin: Skinned) -> f32 {
    var way = skin.thickness;
    @if(cast_shadow) {
        let mm = 1000.0 * material.skin.profile_world_scale;
        let dark = shadow_depth(s.at.actor, s.at.shadow) * mm;
        // At the border of light the map knows no way; there the light comes through at a slant.
        @if(skin_thick) way = max(dark, way * saturate(-s.n_dot_l));
        // What stands apart before it takes its light.
        @if(!skin_thick) way += max(dark - 2.0 * way - 10.0, 0.0);
    }
    return way;
}

// Irradiance over pi of all lights, before it scatters.
fn skin_irradiance(s: ptr<function, Surface>) -> vec3f {
    let skin = skin_of(s);
    let l = physical_light(s, s.n_dot_l > 0.0);
    var sum = skin_diffused(s, skin, frame.to_light) * s.light * (l.own_lit * (1.0 - skin_albedo(saturate(s.n_dot_l))));
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, s.at.world_position);
        let n_dot_l = saturate(dot(s.normal, arriving.to_light));
        sum += arriving.radiance * (n_dot_l * (1.0 - skin_albedo(n_dot_l)));
    }
    sum += environment_irradiance(s.normal) * occluded_diffuse(skin.open, s.lit);
    @if(skin_pre_scatter) sum *= sqrt(s.lit);
    return sum;
}

// Light that has scattered, where the picture has it: at borders, that of pixels beside.
@if(skin_screen_space)
fn skin_scattered(s: ptr<function, Surface>) -> vec3f {
    let at = vec2i(s.at.clip_position.xy);
    let last = vec2i(textureDimensions(frame_scattered)) - 1;
    let here = distance_here(s.at.clip_position);
    var sum = vec4f(0.0);
    for (var i = 0; i < 4; i++) {
        let there = textureLoad(frame_scattered, min(at + vec2i(i % 2, i / 2), last), 0);
        // Not of what lies before or behind.
        sum += vec4f(there.rgb, 1.0) * f32(abs(there.a - here) < 0.01 * here);
    }
    // At borders that of any skin beside.
    let others = select(9, 0, sum.a > 0.0);
    for (var i = 0; i < others; i++) {
        let beside = textureLoad(frame_scattered, clamp(at + vec2i(i % 3 - 1, i / 3 - 1), vec2i(0), last), 0);
        sum += vec4f(beside.rgb, 1.0) * f32(beside.a > 0.0);
    }
    return sum.rgb / max(sum.a, 1.0);
}

// The same where the texture coordinates have it; `unspread` where the actor has no layer.
@if(skin_texture_space)
fn skin_of_layer(s: ptr<function, Surface>, unspread: vec3f) -> vec3f {
    let m = &material.skin;
    let first = actors[s.at.actor].skin_layer;
    let at = s.at.uv.xy * m.layer_uv.xy + m.layer_uv.zw;
    let half = 0.5 / vec2f(textureDimensions(frame_skin));
    var sum = vec4f(0.0);
    for (var i = 0; i < 4; i++) {
        let beside = at + half * vec2f(vec2i(i % 2, i / 2) * 2 - 1);
        sum += textureSampleLevel(frame_skin, environment_sampler, beside, i32(max(first, 0.0) + m.layer), 0.0);
    }
    return select(unspread, sum.rgb / max(sum.a, 1e-6), first >= 0.0 && sum.a > 0.0);
}

// Drawn alone.
@if(skin_drawn)
fn skin_model(s: ptr<function, Surface>) -> Shaded {
    return toon_model(s);
}

@if(!skin_drawn)
fn skin_model(s: ptr<function, Surface>) -> Shaded {
    let m = &material.skin;
    let skin = skin_of(s);
    @if(skin_pre_integrated || skin_wrapped) var receiver = skin_receiver(s, skin);
    @if(skin_pre_integrated || skin_wrapped) var l = physical_light(&receiver, true);
    @if(!skin_pre_integrated && !skin_wrapped) var l = physical_light(s, s.n_dot_l > 0.0);
    l.gi *= occluded_diffuse(skin.open, s.lit);
    let share = skin_share(s, skin, l.own_lit);
    var lit = skin_lit(s, skin, frame.to_light, share.spread, share.own * f32(s.n_dot_l > 0.0));
    lit.scattered *= s.light;
    lit.mirrored *= s.light;
    var through = skin_through(skin, s.n_dot_l, skin_way(s, skin)) * s.light;
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, s.at.world_position);
        let of_lamp = skin_lit(s, skin, arriving.to_light, vec3f(1.0), 1.0);
        lit.scattered += of_lamp.scattered * arriving.radiance;
        lit.mirrored += of_lamp.mirrored * arriving.radiance;
        through += skin_through(skin, dot(s.normal, arriving.to_light), skin.thickness) * arriving.radiance;
    }
    let left = 1.0 - skin.mirrored;
    var color = s.lit;
    @if(skin_screen_space) {
        lit.scattered = skin_scattered(s);
        @if(skin_pre_scatter) color = sqrt(s.lit);
    }
    @if(skin_texture_space) {
        @if(skin_pre_scatter) color = sqrt(s.lit);
        @if(skin_pre_scatter) let before = color;
        @if(!skin_pre_scatter) let before = vec3f(1.0);
        lit.scattered = skin_of_layer(s, before * (lit.scattered + l.gi));
    }
    l.direct = color * lit.scattered * left + s.lit * through * left + lit.mirrored;
    let brdf = environment_brdf(skin.n_dot_v, m.roughness);
    let around = (skin.f0 * brdf.x + brdf.y) * m.specular_strength
        * environment_radiance(reflect(-s.view, s.normal), m.roughness)
        * occluded_specular(skin.open, skin.n_dot_v, m.roughness * m.roughness);
    l.ambient = around;
    @if(!skin_screen_space && !skin_texture_space) l.ambient += s.lit * l.gi * left;
    @if(channel_skin_irradiance) shown = skin_irradiance(s);
    @if(channel_skin_scattered) shown = lit.scattered;
    @if(channel_skin_specular) shown = lit.mirrored + around;
    @if(channel_skin_thickness) shown = vec3f(skin.thickness * 0.1);
    @if(channel_skin_occlusion) shown = vec3f(skin.open);
    @if(channel_skin_curvature) shown = select(
        vec3f(0.0, 0.0, -skin.curvature * 2.0), vec3f(skin.curvature * 2.0), skin.curvature >= 0.0
    );
    @if(channel_skin_profile) shown = strip_hue(u32(m.profile_number));
    @if(skin_toon) {
        let drawn = toon_model(s);
        l.direct = mix(drawn.direct, l.direct, m.natural);
        l.ambient = mix(drawn.ambient, l.ambient, m.natural);
        l.lit = drawn.lit;
        l.shading = mix(drawn.shading, l.shading, m.natural);
        l.gi = mix(drawn.gi, l.gi, m.natural);
    }
    return l;
}
