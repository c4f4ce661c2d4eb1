// Light from all around on places that other surfaces hide; `open` is the share that they leave.

// Share of it that is scattered, with what surfaces of the same colour throw on each other (Jimenez et al. 2016).
fn occluded_diffuse(open: f32, albedo: vec3f) -> vec3f {
    let a = 2.0404 * albedo - 0.3324;
    let b = -4.7951 * albedo + 0.6417;
    let c = 2.7552 * albedo + 0.6903;
    return max(vec3f(open), ((open * a + b) * open + c) * open);
}

// Share of it that is mirrored (Lagarde and de Rousiers 2014).
fn occluded_specular(open: f32, n_dot_v: f32, alpha: f32) -> f32 {
    return saturate(pow(max(n_dot_v + open, 1e-6), exp2(-16.0 * alpha - 1.0)) - 1.0 + open);
}
