// What polished stones mirror where a scene has no picture of its surroundings.

// A studio: brightness of sky, ground, a ring of lamps whose edges are hard, and the key light.
fn studio(d: vec3f, to_light: vec3f) -> vec4f {
    let sky = smoothstep(-0.6, 0.8, d.y);
    let around = atan2(d.x, select(1e-6, d.z, abs(d.z) > 1e-6)) * 2.5464791;
    // Eight tall lamps round the horizon.
    let lamp = smoothstep(0.1, 0.2, sin(around * 3.1415927) - 0.35) * smoothstep(-0.5, -0.3, d.y);
    return vec4f(sky, 1.0 - sky, lamp, smoothstep(0.9, 0.915, dot(d, to_light)));
}
