// Vertices: where an actor's pose has put them, with their fixed attributes and the place of the actor.
import package::bind::actor::deformed;
import package::lib::normal::unit_from_octahedral;

struct VertexInput {
    @builtin(vertex_index) index: u32,
    // Two UV sets.
    @location(0) uv: vec4f,
    // Linear RGBA.
    @location(1) color: vec4f,
    @location(2) part: u32,
    // Of the instance: rows of world_from_character; the actor, its first vertex among those of all, and a number by the
    // pass: the shell of a coat, or the actor whose map is drawn.
    @location(3) world_row_x: vec4f,
    @location(4) world_row_y: vec4f,
    @location(5) world_row_z: vec4f,
    @location(6) actor: vec3u,
    // Curvature of skin, 1/m, its thickness, m, and the share of light from all around that does not arrive; character space.
    @if(skin_vertex) @location(7) skin: vec3f,
    // Place in the eye over 2, as snorm16, and the vertex that is the eye.
    @if(eye_vertex) @location(8) eye: vec2u,
}

struct Vertex {
    // Character space, metres.
    position: vec3f,
    // Octahedral snorm16 pairs: normal, tangent (lowest bit: sign of the bitangent), outline normal.
    frame: vec3u,
    uv: vec4f,
    color: vec4f,
    part: u32,
    // Rows of world_from_character.
    world_row_x: vec4f,
    world_row_y: vec4f,
    world_row_z: vec4f,
    actor: u32,
    // The number by the pass.
    extra: u32,
    // Curvature, 1/m, and thickness, m, in the world, and occlusion.
    @if(skin_vertex) skin: vec3f,
    // Place in the eye, its number, and its gaze and what is to the right of it, packed.
    @if(eye_vertex) eye_place: vec3f,
    @if(eye_vertex) eye_axes: vec3u,
}

fn vertex_of(in: VertexInput) -> Vertex {
    let at = deformed[in.actor.y + in.index];
    var v: Vertex;
    v.position = vec3f(at.x, at.y, at.z);
    v.frame = vec3u(at.normal, at.tangent, at.outline_normal);
    v.uv = in.uv;
    v.color = in.color;
    v.part = in.part;
    v.world_row_x = in.world_row_x;
    v.world_row_y = in.world_row_y;
    v.world_row_z = in.world_row_z;
    v.actor = in.actor.x;
    v.extra = in.actor.z;
    @if(eye_vertex) {
        let number = in.eye.y >> 16u;
        v.eye_place = 2.0 * vec3f(unpack2x16snorm(in.eye.x), unpack2x16snorm(in.eye.y).x);
        v.eye_axes = vec3u(number, deformed[in.actor.y + number].normal, deformed[in.actor.y + number].tangent);
    }
    @if(skin_vertex) {
        let scale = length(in.world_row_x.xyz);
        v.skin = in.skin * vec3f(1.0 / max(scale, 1e-6), scale, 1.0);
    }
    return v;
}

fn world_position(v: Vertex, position: vec3f) -> vec3f {
    let p = vec4f(position, 1.0);
    return vec3f(dot(v.world_row_x, p), dot(v.world_row_y, p), dot(v.world_row_z, p));
}

// Actors rotate, move and scale evenly, so normals need no inverse transpose.
fn world_direction(v: Vertex, packed: u32) -> vec3f {
    return world_rotated(v, unit_from_octahedral(unpack2x16snorm(packed)));
}

// A unit direction of the character in the world.
fn world_rotated(v: Vertex, d: vec3f) -> vec3f {
    return normalize(vec3f(dot(v.world_row_x.xyz, d), dot(v.world_row_y.xyz, d), dot(v.world_row_z.xyz, d)));
}

// Sign of the bitangent, from the tangent's lowest bit.
fn bitangent_sign(packed_tangent: u32) -> f32 {
    return select(1.0, -1.0, (packed_tangent & 1u) == 1u);
}
