// Unit vectors in two numbers, and normal maps.

// Octahedral encoding of a unit vector to -1..1 (Cigolle et al. 2014).
fn octahedral_from_unit(n: vec3f) -> vec2f {
    let p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    let folded = (1.0 - abs(p.yx)) * select(vec2f(-1.0), vec2f(1.0), p >= vec2f(0.0));
    return select(p, folded, n.z < 0.0);
}

// Its inverse.
fn unit_from_octahedral(p: vec2f) -> vec3f {
    let z = 1.0 - abs(p.x) - abs(p.y);
    let t = saturate(-z);
    let xy = p + select(vec2f(t), vec2f(-t), p >= vec2f(0.0));
    return normalize(vec3f(xy, z));
}

// Unit vector, or `fallback` where v has no direction. 1e-20: squares of f32 below 1e-10 m vanish.
fn normalize_or(v: vec3f, fallback: vec3f) -> vec3f {
    let square = dot(v, v);
    return select(fallback, v * inverseSqrt(max(square, 1e-20)), square > 1e-20);
}

// World-space normal of a tangent-space texel (glTF: +Y up, 0.5 is flat); `sign` is tangent.w.
fn normal_from_map(texel: vec3f, scale: f32, normal: vec3f, tangent: vec3f, sign: f32) -> vec3f {
    let n = vec3f((texel.xy * 2.0 - 1.0) * scale, texel.z * 2.0 - 1.0);
    let bitangent = cross(normal, tangent) * sign;
    return normalize_or(tangent * n.x + bitangent * n.y + normal * n.z, normal);
}
