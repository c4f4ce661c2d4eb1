// What goes from vertex to fragment: one struct for every pass, with what its shader reads.
import package::bind::actor::actors;
import package::bind::eye::eye_axes;
import package::bind::frame::frame;
import package::bind::vertex::{Vertex, bitangent_sign, world_direction, world_position, world_rotated};
import package::lib::normal::octahedral_from_unit;
import package::material::{stage_place, stage_vary};

struct Varying {
    @builtin(position) clip_position: vec4f,
    @if(world) @location(0) world_position: vec3f,
    @if(normal) @location(1) normal: vec3f,
    // w is the sign of the bitangent.
    @if(tangent) @location(2) tangent: vec4f,
    // Both UV sets at rest.
    @if(uv) @location(3) uv: vec4f,
    @if(vertex_color || strips) @location(4) color: vec4f,
    // Directional light in the frame of the face: x to the character's left, height (radians), angle over pi, and what
    // thresholds are compared with.
    @if(face_light && !eye_vertex) @location(5) @interpolate(flat) face_light: vec4f,
    // Direction of a place from the middle of its eye, by the axes of the face.
    @if(eye_lids) @location(5) eye_face: vec3f,
    // What the pupil of a drawn iris is multiplied by.
    @if(eye_depth) @location(5) @interpolate(flat) pupil: f32,
    // Place in the map of the bangs' shadow.
    @if(bangs) @location(6) bangs: vec3f,
    // Movement of the highlight, and what is left of it.
    @if(moved) @location(7) @interpolate(flat) moved: vec3f,
    // Colour of a line that vertices know.
    @if(at_vertices) @location(7) line_color: vec3f,
    // Place in the shadow map of the character, and its layer.
    @if(shadow) @location(8) shadow: vec4f,
    // Of an eye: its number, and its gaze and what is to the right of it in the world, octahedral snorm16.
    @if(eye_vertex) @location(9) @interpolate(flat) eye_axes: vec3u,
    // How far the line of the nose shows.
    @if(nose && !eye_vertex) @location(9) @interpolate(flat) nose: f32,
    // Height of a shell above the root, share of the length.
    @if(level) @location(10) @interpolate(flat) level: f32,
    // Of weighted layers, where there is no shell: distance of the middle of what is weighted, its radius, and how near it is
    // among all of them.
    @if(weighed) @location(10) @interpolate(flat) weigh: vec3f,
    // How much is seen through hair.
    @if(opacity) @location(10) @interpolate(flat) opacity: f32,
    // Share that a line covers of its pixels.
    @if(line) @location(10) line_cover: f32,
    // Of what burns: its place in the space of the character, and its height in shares of the character's.
    @if(dissolve) @location(11) burn: vec4f,
    // Part of the character; in channels of strips of hair the strip.
    @if(part || channel_strips || channel_strip_order) @location(12) @interpolate(flat) part: u32,
    // Depth in a map that is drawn from a light.
    @if(depth) @location(13) depth: f32,
    // Of skin in pictures: curvature, 1/m, thickness, m, and occlusion.
    @if(skin_vertex && !depth) @location(13) skin: vec3f,
    // Place in the eye: radii of its ball, or shares of a drawn iris.
    @if(eye_vertex && !depth) @location(13) eye_place: vec3f,
    @if(actor) @location(14) @interpolate(flat) actor: u32,
    // Where it was in the last picture: x, y and w of the clip position.
    @if(before) @location(15) before: vec3f,
}

fn packed_direction(d: vec3f) -> u32 {
    return pack2x16snorm(octahedral_from_unit(d));
}

// Of a vertex of the picture.
fn surface_varying(v: Vertex) -> Varying {
    var out: Varying;
    let position = world_position(v, v.position);
    out.clip_position = stage_place(frame.clip_from_world * vec4f(position, 1.0));
    @if(world) out.world_position = position;
    @if(normal) out.normal = world_direction(v, v.frame.x);
    @if(tangent) out.tangent = vec4f(world_direction(v, v.frame.y), bitangent_sign(v.frame.y));
    with_attributes(v, &out);
    stage_vary(v, &out);
    return out;
}

// With what passes from vertex to fragment as it is.
fn with_attributes(v: Vertex, out: ptr<function, Varying>) {
    @if(uv) out.uv = v.uv;
    @if(vertex_color || strips) out.color = v.color;
    @if(actor) out.actor = v.actor;
    @if(dissolve) {
        // The middle of the head stands at 5/6 of the height.
        let height = 1.2 * actors[v.actor].head.y;
        out.burn = vec4f(v.position, select(-1.0, saturate(v.position.y / height), height > 0.01));
    }
    @if(skin_vertex && !depth) out.skin = v.skin;
    @if(eye_vertex && !depth) out.eye_place = v.eye_place;
    @if(eye_vertex) out.eye_axes = vec3u(
        v.eye_axes.x, packed_direction(world_direction(v, v.eye_axes.y)), packed_direction(world_direction(v, v.eye_axes.z))
    );
}

// A world direction by the axes of the face: to the character's left, up, forward.
fn in_face_frame(v: Vertex, d: vec3f) -> vec3f {
    return vec3f(
        dot(d, world_rotated(v, actors[v.actor].face_left)),
        dot(d, world_rotated(v, actors[v.actor].face_up)),
        dot(d, world_rotated(v, actors[v.actor].face_forward)),
    );
}

// Direction of a place from the middle of its eye, by the axes of the face.
@if(eye_vertex)
fn eye_in_face(v: Vertex, given: ptr<function, Varying>) -> vec3f {
    let axes = eye_axes(*given);
    return in_face_frame(v, axes * given.eye_place);
}
