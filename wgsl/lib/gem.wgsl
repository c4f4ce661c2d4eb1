// Light in clear bodies: Snell, Fresnel, Beer-Lambert.

// Share that is mirrored where light goes from index 1 into `ior`, both polarisations alike; 1 past the critical angle.
// `cos_i` is that of the angle of incidence, 0..1.
fn fresnel(cos_i: f32, ior: f32) -> f32 {
    let sin_sq = (1.0 - cos_i * cos_i) / (ior * ior);
    if sin_sq >= 1.0 {
        return 1.0;
    }
    let cos_t = sqrt(1.0 - sin_sq);
    let s = (cos_i - ior * cos_t) / (cos_i + ior * cos_t);
    let p = (ior * cos_i - cos_t) / (ior * cos_i + cos_t);
    return 0.5 * (s * s + p * p);
}

// Movement along the surface of what lies `depth` below it, in units of the depth; r is the refracted view in the frame of
// the surface and looks down.
fn parallax(r: vec3f, depth: f32) -> vec2f {
    return r.xy / max(-r.z, 1e-3) * depth;
}

// What is left of white light that went down `depth` along r, where `color` is left of it after one unit straight down.
fn absorbed(color: vec3f, r: vec3f, depth: f32) -> vec3f {
    return pow(max(color, vec3f(1e-3)), vec3f(depth / max(-r.z, 1e-3)));
}

// Light that a round body gathers on the side away from the light: n is the normal where the view leaves it.
fn gathered(n: vec3f, to_light: vec3f, focus: f32) -> f32 {
    return pow(saturate(dot(n, -to_light)), focus);
}

// Where a ray along r leaves a body that is round where it enters with normal n: the normal there, turned towards the side on
// which it entered, since light that is scattered once makes the whole side away from a light shine.
fn far_normal(n: vec3f, r: vec3f) -> vec3f {
    let far = n - 2.0 * dot(n, r) * r;
    return normalize(far + 0.75 * n);
}
