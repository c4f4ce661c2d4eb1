// An eye: iris behind a refracting cornea, white that scatters, and what the wet surface mirrors.
import package::bind::actor::actors;
import package::bind::environment::{environment_brdf, environment_irradiance, environment_radiance};
import package::bind::eye::{eye_axes, of_eye};
import package::bind::frame::frame;
import package::bind::lights::punctual_light;
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface};
import package::bind::uv::texture_uv;
import package::lib::brdf::{f0_of_ior, filtered_alpha2, ggx_distribution, schlick, smith_visibility};
import package::lib::eye::{
    catch_light, cornea_entry, cornea_refraction, iris_disc, iris_irradiance, iris_normal, iris_place, lid_shade, limbus_shade,
    pupil_place, sclera_veins, wet_line,
};
import package::lib::skin::diffused_place;
import package::material::{
    base_texture, base_texture_sampler, eye_iris_map, eye_iris_map_sampler, eye_table, eye_table_sampler, material,
};
import package::model::standard::physical_light;

const PI: f32 = 3.14159265;
// Half of the width over which white and iris meet, mm.
const LIMBUS_EDGE: f32 = 0.12;
// Of the wet line: it is hollow, and mirrors a light over some of its length.
const WET_ROUGHNESS: f32 = 0.32;

// What of an eye all lights ask for; directions in its space where nothing else is said.
struct Seen {
    axes: mat3x3f,
    // Where the view enters the cornea, from its centre, mm; share of cornea, place of the iris, mm, and in its unit disc.
    entry: vec3f,
    on_cornea: f32,
    iris: vec2f,
    q: vec2f,
    // Of the ball, and of what mirrors, in the world; shares of what lids leave of light, and of the wet line.
    ball: vec3f,
    normal: vec3f,
    open: f32,
    wet: f32,
    alpha: f32,
    n_dot_v: f32,
    f0: vec3f,
}

// Where a place of the iris is in its picture, whose pupil has this radius now.
fn iris_texture_place(q: vec2f, now: f32, number: u32) -> vec2f {
    let m = &material.eye;
    var place = vec3f(q, 1.0);
    if (*m).pupil_drawn > 0.0 {
        place = vec3f(pupil_place(q, (*m).pupil_drawn, now), 1.0);
    }
    let uv = vec2f(dot((*m).rows[3u * number].xyz, place), dot((*m).rows[3u * number + 1u].xyz, place));
    @if(eye_iris_map) return texture_uv(vec4f(uv, uv), (*m).iris_map_uv);
    @if(!eye_iris_map) return texture_uv(vec4f(uv, uv), material.base.texture_uv);
}

// Colour of the iris.
fn iris_colour(s: ptr<function, Surface>, q: vec2f) -> vec3f {
    let m = &material.eye;
    let a = &actors[s.at.actor];
    let mm = mix((*m).pupil_mm, (*a).pupil_mm, (*a).pupil_reflex) * (*a).pupil_scale;
    let now = clamp(0.5 * mm / (*m).dimensions_iris_radius_mm, 0.02, 0.9);
    var color = s.lit;
    @if(eye_iris_map || base_texture) {
        // Of numbers that are looked up, software rasterizers know nothing beside a triangle: the steps are told.
        let number = s.at.eye_axes.x;
        let at = iris_texture_place(q, now, number);
        let step_x = iris_texture_place(q + dpdx(q), now, number) - at;
        let step_y = iris_texture_place(q + dpdy(q), now, number) - at;
        @if(eye_iris_map) color = textureSampleGrad(eye_iris_map, eye_iris_map_sampler, at, step_x, step_y).rgb;
        @if(!eye_iris_map) color = material.base.color.rgb
            * textureSampleGrad(base_texture, base_texture_sampler, at, step_x, step_y).rgb;
    }
    let pupil = 1.0 - smoothstep(now - 0.03, now + 0.03, length(q));
    return mix(color * (*m).iris_color, (*m).pupil_color.rgb, (*m).pupil_color.a * pupil);
}

// Light of one direction on the iris, over the light's strength.
fn iris_light(e: Seen, to_light: vec3f) -> f32 {
    let m = &material.eye;
    // What falls on the middle without gathering, through a flat pane.
    let sine = to_light.xy / (*m).dimensions_ior;
    let within = vec3f(sine, sqrt(max(1.0 - dot(sine, sine), 0.0)));
    let gathered = iris_irradiance(
        vec3f(e.iris, (*m).iris_z_mm), to_light, (*m).cornea_centre_z_mm, (*m).dimensions_cornea_radius_mm, (*m).limbus_z_mm,
        (*m).dimensions_ior
    );
    let light = mix(saturate(to_light.z), gathered, (*m).caustic);
    return light * saturate(dot(iris_normal(e.q, (*m).hollow), within)) / within.z;
}

// Light of one direction on the white, over the light's strength.
fn sclera_light(e: Seen, to_light: vec3f) -> vec3f {
    let n_dot_l = dot(e.ball, to_light);
    var light = vec3f(saturate(n_dot_l));
    @if(eye_table) {
        let curvature = 1.0 / material.eye.dimensions_eyeball_radius_mm;
        let spread = textureSampleLevel(eye_table, eye_table_sampler, diffused_place(n_dot_l, curvature), 0.0).rgb;
        light = mix(light, spread, material.eye.scatter);
    }
    return light;
}

// What is mirrored of one direction, over the light's strength.
fn eye_lobe(s: ptr<function, Surface>, e: Seen, to_light: vec3f) -> vec3f {
    let n_dot_l = saturate(dot(e.normal, to_light));
    let h = normalize(s.view + to_light);
    let d = ggx_distribution(saturate(dot(e.normal, h)), e.alpha) * PI;
    return schlick(e.f0, dot(s.view, h)) * (d * smith_visibility(n_dot_l, e.n_dot_v, e.alpha) * n_dot_l * material.eye.specular_strength);
}

// Rows of an eye.
@if(eye_lids)
fn eye_rows(number: u32) -> mat3x4f {
    let m = &material.eye;
    return mat3x4f(
        of_eye(number, (*m).rows[0], (*m).rows[3], (*m).rows[6], (*m).rows[9]),
        of_eye(number, (*m).rows[1], (*m).rows[4], (*m).rows[7], (*m).rows[10]),
        of_eye(number, (*m).rows[2], (*m).rows[5], (*m).rows[8], (*m).rows[11])
    );
}

fn eye_seen(s: ptr<function, Surface>, place: vec3f) -> Seen {
    let m = &material.eye;
    var e: Seen;
    e.axes = eye_axes(s.at);
    let view = s.view * e.axes;
    let centre = vec3f(0.0, 0.0, (*m).cornea_centre_z_mm);
    let radius = (*m).dimensions_cornea_radius_mm;
    let entry = cornea_entry(place, view, (*m).cornea_centre_z_mm, radius);
    e.entry = entry.xyz - centre;
    let cornea = e.entry / radius;
    // A ray enters the cornea above the limbus; where it misses, what stands above that is cornea seen from the side.
    let above = smoothstep(-LIMBUS_EDGE, LIMBUS_EDGE, entry.z - (*m).limbus_z_mm);
    e.on_cornea = above * max(entry.w, smoothstep(-LIMBUS_EDGE, LIMBUS_EDGE, place.z - (*m).limbus_z_mm));
    let ray = cornea_refraction(view, cornea, (*m).dimensions_ior);
    let iris = iris_place(entry.xyz, ray, (*m).iris_z_mm);
    e.q = iris_disc(iris, (*m).dimensions_iris_radius_mm);
    e.iris = e.q * (*m).dimensions_iris_radius_mm;
    e.ball = normalize(e.axes * place);
    e.open = 1.0;
    @if(eye_lids) {
        let rows = eye_rows(s.at.eye_axes.x);
        let upper = vec3f(rows[0].w, rows[1].w, rows[2].x);
        let lower = rows[2].yzw;
        e.open = lid_shade(s.at.eye_face, upper, lower, (*m).lid_reach_rad, (*m).lid_shadow, (*m).lash_shadow);
        e.wet = wet_line(s.at.eye_face, lower, (*m).wet_line_rad);
    }
    let smooth_normal = normalize(mix(e.ball, e.axes * cornea, e.on_cornea));
    e.normal = normalize(smooth_normal + 0.85 * e.axes[1] * e.wet);
    let along_x = dpdx(e.normal);
    let along_y = dpdy(e.normal);
    let rough = mix(mix((*m).sclera_roughness, (*m).cornea_roughness, e.on_cornea), WET_ROUGHNESS, e.wet);
    e.alpha = sqrt(filtered_alpha2(pow(rough, 4.0), along_x, along_y));
    e.n_dot_v = max(dot(e.normal, s.view), 1e-3);
    e.f0 = vec3f(f0_of_ior((*m).dimensions_ior));
    return e;
}

// Painted lights, over the light's strength.
@if(eye_catch)
fn eye_catch_lights(s: ptr<function, Surface>, e: Seen) -> f32 {
    let m = &material.eye;
    let up = vec3f(frame.view_from_world[0].y, frame.view_from_world[1].y, frame.view_from_world[2].y);
    let right = normalize(cross(up, s.view));
    let screen = mat3x3f(right, cross(s.view, right), s.view);
    let radii = vec2f((*m).dimensions_cornea_radius_mm, (*m).dimensions_iris_radius_mm);
    let key = catch_light(
        e.entry, e.axes, screen, frame.to_light, radii, (*m).key_catch_half, (*m).key_catch_from_rad,
        vec3f((*m).key_catch_round, (*m).key_catch_follow, (*m).key_catch_within)
    );
    let fill = catch_light(
        e.entry, e.axes, screen, frame.to_light, radii, (*m).fill_catch_half, (*m).fill_catch_from_rad,
        vec3f((*m).fill_catch_round, (*m).fill_catch_follow, (*m).fill_catch_within)
    );
    return e.on_cornea * (key * (*m).key_catch_strength + fill * (*m).fill_catch_strength);
}

fn eye_model(s: ptr<function, Surface>) -> Shaded {
    let m = &material.eye;
    let place = s.at.eye_place * (*m).dimensions_eyeball_radius_mm;
    let e = eye_seen(s, place);
    let rho = length(e.q);
    let dark = 1.0 - (*m).limbus_strength;
    // Behind, there is no limbus.
    let surface_rho = select(2.0, length(place.xy) / (*m).dimensions_limbus_radius_mm, place.z > 0.0);
    let iris_limbus = limbus_shade(rho, (*m).limbus_width, dark);
    // Half as dark there: what shows is the iris' colour through the thin rim of the white.
    let sclera_limbus = limbus_shade(max(surface_rho, 1.0), (*m).limbus_width, 0.5 + 0.5 * dark);
    let iris = iris_colour(s, e.q) * iris_limbus;
    var sclera = s.lit * sclera_limbus;
    @if(eye_veins) sclera *= mix(vec3f(1.0), (*m).vein_color, (*m).veins * sclera_veins(place, surface_rho));
    var moved = *s;
    moved.normal = e.ball;
    moved.n_dot_l = dot(e.ball, frame.to_light);
    var l = physical_light(&moved, true);
    // The shadow map knows the lids as well.
    let arrives = l.own_lit * sqrt(e.open);
    var light = mix(sclera * sclera_light(e, frame.to_light), iris * iris_light(e, frame.to_light * e.axes), e.on_cornea);
    // Light goes about in the whole of the white.
    let gaze_gi = environment_irradiance(normalize(mix(e.ball, e.axes[2], max(e.on_cornea, 0.5 * (*m).scatter))));
    // What is mirrored does not come out.
    let brdf = environment_brdf(e.n_dot_v, sqrt(e.alpha));
    let mirrored = (e.f0 * brdf.x + brdf.y) * (*m).specular_strength;
    let through = max(1.0 - mirrored, vec3f(0.0));
    l.direct = (light * through + eye_lobe(s, e, frame.to_light)) * s.light * arrives;
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, s.at.world_position);
        light = mix(sclera * sclera_light(e, arriving.to_light), iris * iris_light(e, arriving.to_light * e.axes), e.on_cornea);
        l.direct += (light * through + eye_lobe(s, e, arriving.to_light)) * arriving.radiance * e.open;
    }
    let around = mirrored * environment_radiance(reflect(-s.view, e.normal), sqrt(e.alpha));
    // Beside and behind, the ball lies in its socket, which it mirrors.
    let before = smoothstep(0.0, 0.65, normalize(place).z);
    l.gi = gaze_gi * e.open;
    l.ambient = mix(sclera, iris, e.on_cornea) * l.gi * through + around * e.open * before;
    @if(eye_catch) {
        // As the whole eye is lit: what is painted has no shadow across.
        let facing = saturate(0.5 + 0.5 * dot(e.axes[2], frame.to_light));
        l.direct += eye_catch_lights(s, e) * (s.light * facing + l.gi);
    }
    l.lit = mix(sclera, iris, e.on_cornea);
    @if(channel_eye_place) shown = mix(vec3f(0.0, 0.0, 1.0), vec3f(e.q * 0.5 + 0.5, 0.0), e.on_cornea);
    @if(channel_eye_caustic) shown = vec3f(0.5 * iris_light(e, frame.to_light * e.axes) * e.on_cornea);
    @if(channel_eye_limbus) shown = vec3f(mix(sclera_limbus, iris_limbus, e.on_cornea));
    @if(channel_eye_lids) shown = vec3f(e.open);
    return l;
}
