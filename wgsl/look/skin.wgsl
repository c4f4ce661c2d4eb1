// Numbers of skin, and the warm edge of a toon shade; wgsl/model/skin.wgsl lights it.
import package::bind::surface::{Border, Surface};
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::bands::banded;
import package::lib::skin::burley_transmittance;
import package::material::{material, skin_curvature_map, skin_curvature_map_sampler};

struct Skin {
    natural: f32,
    edge: f32,
    edge_steps: u32,
    wrap: f32,
    roughness: f32,
    specular_strength: f32,
    lobes: vec2f,
    lobe_mix: f32,
    curvature_scale: f32,
    curvature_map_uv: UvTransform,
    thickness_map_uv: UvTransform,
    detail: f32,
    penumbra: f32,
    occlusion: f32,
    transmission: f32,
    profile_ior: f32,
    profile_scattering_distance_mm: vec3f,
    profile_world_scale: f32,
    profile_transmission_tint: vec3f,
    // Of the profile, the same for all skin that has it.
    profile_number: f32,
    profile_thickness_remap_mm: vec2f,
    // Thickness at the end of the table, mm.
    thickness_range_mm: f32,
    // Farthest that light comes from, mm.
    reach_mm: f32,
    // Metres along u and v.
    metres_per_uv: vec2f,
    // Place of the light over texture coordinates among layers of the actor; scale and offset of coordinates in it.
    layer: f32,
    layer_uv: vec4f,
}

// How far the warm edge of a toon shade reaches into shade, share of how far light reaches below the surface; and into light,
// share of the former.
const EDGE_REACH: f32 = 0.5;
const EDGE_IN_LIGHT: f32 = 0.4;
// Most that the surface, or the border of a map, turns over it, radians.
const EDGE_MOST: f32 = 0.6;

// How far that edge reaches into shade along the surface, m.
fn skin_edge_reach() -> f32 {
    let m = &material.skin;
    return EDGE_REACH * m.reach_mm * m.curvature_scale / (1000.0 * m.profile_world_scale);
}

// Angle by which a surface bends over it.
fn skin_edge_angle(s: ptr<function, Surface>) -> f32 {
    var curvature = s.at.skin.x;
    @if(skin_curvature_map) curvature = 1000.0 * material.skin.profile_world_scale * textureSample(
        skin_curvature_map, skin_curvature_map_sampler, texture_uv(s.uv, material.skin.curvature_map_uv)
    ).r;
    return clamp(abs(curvature) * skin_edge_reach(), 0.02, EDGE_MOST);
}

// Warm light along the drawn border between light and shade, in place of what is drawn there.
@if(skin_edge)
fn skin_edge(s: ptr<function, Surface>, b: ptr<function, Border>, drawn: vec3f) -> vec3f {
    let m = &material.skin;
    let side = select(-1.0, 1.0 / EDGE_IN_LIGHT, b.edge > 0.0);
    let near = saturate(1.0 - b.edge * side);
    // Over a pixel: cuts are no sharper than two, and what is narrower than one and a half fades.
    let per_px = length(vec2f(dpdx(b.edge), dpdy(b.edge)));
    let cut = clamp(2.0 * per_px * abs(side) * f32(m.edge_steps), 0.15, 1.0);
    let light = banded(near, m.edge_steps, cut) * smoothstep(0.3, 1.0, 1.0 / max(per_px, 1e-4));
    // What is left of each colour of light that comes so far, over that of the colour with most.
    let left = burley_transmittance(EDGE_REACH * m.reach_mm, m.profile_scattering_distance_mm);
    let hue = left / max(left.r, max(left.g, left.b));
    return mix(drawn, b.lit * hue * s.light, m.edge * light);
}
