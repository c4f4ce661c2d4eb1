// Numbers of an eye behind its cornea; wgsl/model/eye.wgsl shades it.
import package::bind::uv::UvTransform;
import package::bind::varying::Varying;
import package::bind::vertex::Vertex;
import package::bind::varying::eye_in_face;

struct Eye {
    iris_color: vec3f,
    // Diameter, mm.
    pupil_mm: f32,
    pupil_color: vec4f,
    pupil_drawn: f32,
    limbus_width: f32,
    limbus_strength: f32,
    hollow: f32,
    vein_color: vec3f,
    veins: f32,
    caustic: f32,
    cornea_roughness: f32,
    sclera_roughness: f32,
    specular_strength: f32,
    scatter: f32,
    lid_shadow: f32,
    lid_reach_rad: f32,
    lash_shadow: f32,
    wet_line_rad: f32,
    dimensions_eyeball_radius_mm: f32,
    dimensions_cornea_radius_mm: f32,
    dimensions_limbus_radius_mm: f32,
    dimensions_iris_radius_mm: f32,
    dimensions_ior: f32,
    // Heights above the middle of the ball, mm.
    cornea_centre_z_mm: f32,
    limbus_z_mm: f32,
    iris_z_mm: f32,
    key_catch_half: vec2f,
    key_catch_from_rad: vec2f,
    key_catch_strength: f32,
    key_catch_round: f32,
    key_catch_follow: f32,
    key_catch_within: f32,
    fill_catch_half: vec2f,
    fill_catch_from_rad: vec2f,
    fill_catch_strength: f32,
    fill_catch_round: f32,
    fill_catch_follow: f32,
    fill_catch_within: f32,
    iris_map_uv: UvTransform,
    // Three for each eye: texture coordinates u and v by x, y and 1 of its unit disc, and behind them the numbers of both lids.
    rows: array<vec4f, 12>,
}

fn eye_vary(v: Vertex, out: ptr<function, Varying>) {
    @if(eye_lids) out.eye_face = eye_in_face(v, out);
}
