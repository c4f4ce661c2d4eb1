// Numbers of skin; wgsl/model/skin.wgsl lights it.
import package::bind::uv::UvTransform;

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
