// Morphs and skin, once a frame for every vertex; every later pass reads the result.
import package::bind::actor::DeformVertex;
import package::lib::normal::{normalize_or, octahedral_from_unit, unit_from_octahedral};

// Vertices of one mesh part under one node.
struct DeformGroup {
    first_vertex: u32,
    // First entry of `influences`.
    first_influence: u32,
    // 0 for a rigid part.
    influences_per_vertex: u32,
    // First entry of `joints`; a rigid part uses just this one.
    first_joint: u32,
    // First entry of `morph_weights`.
    first_weight: u32,
}

// Displacement of one vertex by one morph target.
struct MorphEntry {
    target_index: u32,
    dx: f32,
    dy: f32,
    dz: f32,
    nx: f32,
    ny: f32,
    nz: f32,
}

// Rows of character_from_mesh.
struct Joint {
    row_x: vec4f,
    row_y: vec4f,
    row_z: vec4f,
}

// What is deformed: of each body its slot in the buffers of many.
struct Moved {
    // Joints and weights of a body.
    joints: u32,
    weights: u32,
    slots: array<vec4u, 256>,
}

@group(0) @binding(0) var<storage, read> groups: array<DeformGroup>;
@group(0) @binding(1) var<storage, read> source: array<DeformVertex>;
// For each vertex: its group, its first morph entry; one more pair closes the list.
@group(0) @binding(2) var<storage, read> vertex_refs: array<vec2u>;
// Joint in the low half, weight (unorm16) in the high half.
@group(0) @binding(3) var<storage, read> influences: array<u32>;
@group(0) @binding(4) var<storage, read> morph_entries: array<MorphEntry>;
@group(0) @binding(5) var<storage, read> joints: array<Joint>;
@group(0) @binding(6) var<storage, read> morph_weights: array<f32>;
@group(0) @binding(7) var<storage, read_write> deformed: array<DeformVertex>;
@group(0) @binding(8) var<uniform> moved: Moved;

fn pack_unit(n: vec3f) -> u32 {
    return pack2x16snorm(octahedral_from_unit(n));
}

fn unpack_unit(packed: u32) -> vec3f {
    return unit_from_octahedral(unpack2x16snorm(packed));
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let index = id.x + id.y * 65535u * 64u;
    let vertices = arrayLength(&source);
    if index >= vertices {
        return;
    }
    let slot = moved.slots[id.z / 4u][id.z % 4u];
    let vertex = source[index];
    let reference = vertex_refs[index];
    let part = groups[reference.x];

    var position = vec3f(vertex.x, vertex.y, vertex.z);
    var normal = unpack_unit(vertex.normal);
    var outline_normal = unpack_unit(vertex.outline_normal);
    let tangent = unpack_unit(vertex.tangent);

    for (var i = reference.y; i < vertex_refs[index + 1u].y; i++) {
        let weight = morph_weights[slot * moved.weights + part.first_weight + morph_entries[i].target_index];
        if weight != 0.0 {
            let entry = morph_entries[i];
            position += weight * vec3f(entry.dx, entry.dy, entry.dz);
            let turn = weight * vec3f(entry.nx, entry.ny, entry.nz);
            normal += turn;
            outline_normal += turn;
        }
    }

    let first_joint = slot * moved.joints + part.first_joint;
    var row_x = joints[first_joint].row_x;
    var row_y = joints[first_joint].row_y;
    var row_z = joints[first_joint].row_z;
    if part.influences_per_vertex > 0u {
        row_x = vec4f(0.0);
        row_y = vec4f(0.0);
        row_z = vec4f(0.0);
        let first = part.first_influence + (index - part.first_vertex) * part.influences_per_vertex;
        for (var i = first; i < first + part.influences_per_vertex; i++) {
            let influence = influences[i];
            let weight = f32(influence >> 16u) / 65535.0;
            // Heaviest first: nothing follows a zero.
            if weight == 0.0 {
                break;
            }
            let joint = joints[first_joint + (influence & 0xffffu)];
            row_x += weight * joint.row_x;
            row_y += weight * joint.row_y;
            row_z += weight * joint.row_z;
        }
    }

    let p = vec4f(position, 1.0);
    let moved = vec3f(dot(row_x, p), dot(row_y, p), dot(row_z, p));
    // Normals go by the cofactor matrix: right under uneven scale, and defined where the matrix is singular.
    let cofactor_x = cross(row_y.xyz, row_z.xyz);
    let cofactor_y = cross(row_z.xyz, row_x.xyz);
    let cofactor_z = cross(row_x.xyz, row_y.xyz);
    let side = select(-1.0, 1.0, dot(row_x.xyz, cofactor_x) >= 0.0);
    let turned = side * vec3f(dot(cofactor_x, normal), dot(cofactor_y, normal), dot(cofactor_z, normal));
    let turned_outline =
        side * vec3f(dot(cofactor_x, outline_normal), dot(cofactor_y, outline_normal), dot(cofactor_z, outline_normal));
    let turned_tangent = vec3f(dot(row_x.xyz, tangent), dot(row_y.xyz, tangent), dot(row_z.xyz, tangent));

    let handedness = (vertex.tangent & 1u) ^ select(1u, 0u, side > 0.0);
    deformed[slot * vertices + index] = DeformVertex(
        moved.x,
        moved.y,
        moved.z,
        pack_unit(normalize_or(turned, vec3f(0.0, 0.0, 1.0))),
        (pack_unit(normalize_or(turned_tangent, vec3f(1.0, 0.0, 0.0))) & 0xfffffffeu) | handedness,
        pack_unit(normalize_or(turned_outline, vec3f(0.0, 0.0, 1.0))),
    );
}
