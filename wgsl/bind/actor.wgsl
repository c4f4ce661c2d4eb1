// Group 1: the actors of a stage, and their vertices in their poses.

// An actor: a character as it is posed.
struct Actor {
    // Axes of the face as the head is posed, character space, unit.
    face_left: vec3f,
    face_up: vec3f,
    face_forward: vec3f,
    // Rows of the map of the bangs from character space: u, v (downwards) and depth, each 0..1.
    bangs_row_u: vec4f,
    bangs_row_v: vec4f,
    bangs_row_depth: vec4f,
    // The same from the world, for what belongs to other characters.
    bangs_world_row_u: vec4f,
    bangs_world_row_v: vec4f,
    bangs_world_row_depth: vec4f,
    // Per unit of depth, and in units of depth.
    bangs_hardness: f32,
    bangs_bias: f32,
    // Share of the key light that arrives at it.
    key_light: f32,
    // Texels along the tile of its map.
    bangs_side: f32,
    // First layer of its page.
    bangs_layer: f32,
    // First texel of that.
    bangs_origin: vec2f,
    // Eyes through hair: opacity, metres, cosines between which it fades.
    through_opacity: f32,
    through_window: f32,
    // Angles of the view to the side and to above or below at which it begins to fade and has gone, radians.
    through_fade_yaw: vec2f,
    through_fade_pitch: vec2f,
    // Middle of the head, character space.
    head: vec3f,
    // Radius of the sphere that weighted layers are weighed over, world, metres; and its middle, character space.
    weigh_radius: f32,
    weigh_middle: vec3f,
    // Axes of the shadow map in the world, unit, and one over its width, metres.
    shadow_right: vec3f,
    shadow_scale: f32,
    shadow_up: vec3f,
    // Distance by which a receiver is moved along its normal, shares of the width.
    shadow_bias: f32,
    shadow_to_light: vec3f,
    // Width of the edge, shares of the width.
    shadow_spread: f32,
    // Its middle, world space.
    shadow_middle: vec3f,
    // Layer of its map; below 0 it has none.
    shadow_layer: f32,
    // First layer of the light on its skin over texture coordinates; below 0 it has none.
    skin_layer: f32,
    // Diameter of its pupils by the light, mm, before it is scaled; 0 where they do not follow the light.
    pupil_mm: f32,
    // What their diameter is multiplied by: expressions.
    pupil_scale: f32,
    // How far the diameter by the light stands in the place of the material's own, 0..1.
    pupil_reflex: f32,
}

// A vertex: position (character space once it is deformed) and octahedral snorm16 pairs of its normal, tangent
// (lowest bit: sign of the bitangent) and outline normal.
struct DeformVertex {
    x: f32,
    y: f32,
    z: f32,
    normal: u32,
    tangent: u32,
    outline_normal: u32,
}

@group(1) @binding(0) var<storage, read> actors: array<Actor>;
@group(1) @binding(1) var<storage, read> deformed: array<DeformVertex>;
