// Vertex streams: the deformed vertices of a character, their fixed attributes, and the transform of an instance.
import package::lib::normal::unit_from_octahedral;

struct VertexInput {
    // Character space, metres.
    @location(0) position: vec3f,
    // Octahedral snorm16 pairs: normal, tangent (lowest bit: sign of the bitangent), outline normal.
    @location(1) frame: vec3u,
    // Two UV sets.
    @location(2) uv: vec4f,
    // Linear RGBA.
    @location(3) color: vec4f,
    @location(4) part: u32,
    // Rows of world_from_character.
    @location(5) world_row_x: vec4f,
    @location(6) world_row_y: vec4f,
    @location(7) world_row_z: vec4f,
    @builtin(instance_index) instance: u32,
}

fn world_position(v: VertexInput, position: vec3f) -> vec3f {
    let p = vec4f(position, 1.0);
    return vec3f(dot(v.world_row_x, p), dot(v.world_row_y, p), dot(v.world_row_z, p));
}

// Instances rotate, move and scale evenly, so normals need no inverse transpose.
fn world_direction(v: VertexInput, packed: u32) -> vec3f {
    return world_rotated(v, unit_from_octahedral(unpack2x16snorm(packed)));
}

// A unit direction of the character in the world.
fn world_rotated(v: VertexInput, d: vec3f) -> vec3f {
    return normalize(vec3f(dot(v.world_row_x.xyz, d), dot(v.world_row_y.xyz, d), dot(v.world_row_z.xyz, d)));
}

// Sign of the bitangent, from the tangent's lowest bit.
fn bitangent_sign(packed_tangent: u32) -> f32 {
    return select(1.0, -1.0, (packed_tangent & 1u) == 1u);
}
