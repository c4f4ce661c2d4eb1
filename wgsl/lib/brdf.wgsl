// Light on physical surfaces: GGX with height-correlated Smith shadowing (Walter 2007, Heitz 2014), in the parametrisation of
// glTF (alpha = roughness squared).

// Smallest alpha: below it f32 loses the peak of the distribution.
const LEAST_ALPHA: f32 = 0.002;

// Density of microfacets round the half vector, 1/sr. The product form of 1 - cos² keeps digits near the peak.
fn ggx_distribution(n_dot_h: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let d = (1.0 - n_dot_h) * (1.0 + n_dot_h) + a2 * n_dot_h * n_dot_h;
    return a2 / (3.14159265 * d * d);
}

// Shadowing and masking over 4 (N·L) (N·V).
fn smith_visibility(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2);
    let v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2);
    return 0.5 / max(l + v, 1e-7);
}

// Fresnel's reflectance by Schlick's fit.
fn schlick(f0: vec3f, v_dot_h: f32) -> vec3f {
    return f0 + (1.0 - f0) * pow(1.0 - saturate(v_dot_h), 5.0);
}

// Reflectance at normal incidence of a dielectric.
fn f0_of_ior(ior: f32) -> f32 {
    let r = (ior - 1.0) / (ior + 1.0);
    return r * r;
}

// Square of alpha over a pixel: what the normal turns within it is roughness, too (Tokuyoshi and Kaplanyan 2019). `along_x` and
// `along_y` are the normal's change to the pixels beside; a pixel is a Gaussian of half of its side.
fn filtered_alpha2(alpha2: f32, along_x: vec3f, along_y: vec3f) -> f32 {
    let variance = 0.15915494 * (dot(along_x, along_x) + dot(along_y, along_y));
    // 0.18: wider kernels than that are no estimate.
    return min(alpha2 + min(2.0 * variance, 0.18), 1.0);
}
