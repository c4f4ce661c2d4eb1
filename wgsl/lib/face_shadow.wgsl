// Painted shadow of a face by a threshold map.

// Angle of the light about the head over pi: 0 in front, 1 behind. `light` is unit, in the frame of the face: x to the
// character's left, y up, z forward. Towards the up axis, where the angle is undefined, it fades to 0 below a horizontal
// length of `overhead`; 1e-6 keeps smoothstep defined.
fn face_light_angle(light: vec3f, overhead: f32) -> f32 {
    let horizontal = length(light.xz);
    // atan2(0, 0) is left to the driver.
    let angle = atan2(abs(light.x), select(1.0, light.z, horizontal > 1e-6)) * 0.31830988618;
    return angle * smoothstep(0.0, max(overhead, 1e-6), horizontal);
}

// Share of light, 0..1. `thresholds` are for light from the character's right (x) and left (y), as angle over pi at which
// the texel turns dark; 0 is never and 1 always lit, whatever the softness (2/255: the two outermost codes of 8 bits).
fn face_lit(thresholds: vec2f, light: vec3f, softness: f32, overhead: f32) -> f32 {
    let tau = select(thresholds.x, thresholds.y, light.x >= 0.0);
    let soft = max(softness, 1e-4);
    let lit = smoothstep(-soft, soft, tau - face_light_angle(light, overhead));
    return max(lit * smoothstep(0.0, 2.0 / 255.0, tau), smoothstep(1.0 - 2.0 / 255.0, 1.0, tau));
}

// The map's shading in place of the normals': `region` is the share of normal shading, `strength` that of the map.
fn face_shading(normal_shading: f32, lit: f32, region: f32, strength: f32) -> f32 {
    return mix(normal_shading, mix(lit, normal_shading, region), strength);
}
