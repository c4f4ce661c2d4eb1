// Group 1: the character that is drawn.

struct Character {
    // Axes of the face as the head is posed, character space, unit.
    face_left: vec3f,
    face_up: vec3f,
    face_forward: vec3f,
}

@group(1) @binding(0) var<uniform> character: Character;
