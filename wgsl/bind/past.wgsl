// Group 3: where actors were in the last picture.
import package::bind::actor::DeformVertex;
import package::bind::vertex::VertexInput;

// Rows of world_from_character.
struct PastWorld {
    row_x: vec4f,
    row_y: vec4f,
    row_z: vec4f,
}

@group(3) @binding(0) var<storage, read> worlds_before: array<PastWorld>;
@group(3) @binding(1) var<storage, read> deformed_before: array<DeformVertex>;

// Where a vertex was.
fn position_before(in: VertexInput) -> vec3f {
    let at = deformed_before[in.actor.y + in.index];
    let p = vec4f(at.x, at.y, at.z, 1.0);
    let world = worlds_before[in.actor.x];
    return vec3f(dot(world.row_x, p), dot(world.row_y, p), dot(world.row_z, p));
}
