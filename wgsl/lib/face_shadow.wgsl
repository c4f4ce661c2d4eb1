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

// What thresholds are compared with: the angle over pi, or (1 - cos) / 2 of it where `cosine` is 1.
fn face_measure(angle: f32, cosine: f32) -> f32 {
    return select(angle, 0.5 - 0.5 * cos(angle * 3.14159265359), cosine > 0.5);
}

// Share of light, 0..1, where a texel turns dark at `tau` and the light stands at `measure`; 0 is never and 1 always lit,
// whatever the softness (2/255: the two outermost codes of 8 bits).
fn face_lit(tau: f32, measure: f32, softness: f32) -> f32 {
    let soft = max(softness, 1e-4);
    let lit = smoothstep(-soft, soft, tau - measure);
    return max(lit * smoothstep(0.0, 2.0 / 255.0, tau), smoothstep(1.0 - 2.0 / 255.0, 1.0, tau));
}

// How far the light would have to turn for its border to lie where a texel turns dark at `tau`, radians; `angle` and `cosine` as
// above. Far where a texel is always dark or always lit.
fn face_turn(tau: f32, angle: f32, cosine: f32) -> f32 {
    let at = select(tau, acos(clamp(1.0 - 2.0 * tau, -1.0, 1.0)) * 0.31830988618, cosine > 0.5);
    let turn = select(at - angle, -1.0, tau < 1.0 / 255.0);
    return 3.14159265359 * select(turn, 1.0, tau > 1.0 - 1.0 / 255.0);
}

// Threshold on the light's side: `thresholds` are for light from the character's right (x) and left (y).
fn face_side(thresholds: vec2f, light_x: f32) -> f32 {
    return select(thresholds.x, thresholds.y, light_x >= 0.0);
}

// Share of the maps for light from the side to the back: they take over between 80 and 100 degrees.
fn face_back_share(angle: f32) -> f32 {
    return smoothstep(80.0 / 180.0, 100.0 / 180.0, angle);
}

// What extra masks leave of the light: `side` acts between 45 and 135 degrees, `back` beyond; each fades over 20 degrees.
fn face_masked(lit: f32, side: f32, back: f32, angle: f32) -> f32 {
    let behind = smoothstep(115.0 / 180.0, 135.0 / 180.0, angle);
    let beside = smoothstep(45.0 / 180.0, 65.0 / 180.0, angle) - behind;
    return lit * mix(1.0, side, beside) * mix(1.0, back, behind);
}

// Place in a stack of `count` maps for the height of the light, radians: the map below, and the share of the next one.
fn face_stack_place(pitch: f32, pitches: vec4f, count: u32) -> vec2f {
    var at = vec2f(0.0);
    for (var i = 1u; i < count; i++) {
        if pitch >= pitches[i - 1u] {
            at = vec2f(f32(i - 1u), saturate((pitch - pitches[i - 1u]) / max(pitches[i] - pitches[i - 1u], 1e-4)));
        }
    }
    return at;
}

// The map's shading in place of the normals': `region` is the share of normal shading, `strength` that of the map.
fn face_shading(normal_shading: f32, lit: f32, region: f32, strength: f32) -> f32 {
    return mix(normal_shading, mix(lit, normal_shading, region), strength);
}

// Share of the underside of the jaw at a place: heights of its direction from the middle of the head and of its normal, in the
// frame of the face. Nose and lips stand too high.
fn face_underside(place: f32, normal: f32) -> f32 {
    return smoothstep(0.6, 0.8, -place) * smoothstep(0.4, 0.65, -normal);
}
