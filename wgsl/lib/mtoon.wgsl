// MToon 1.0 (VRMC_materials_mtoon) as pure functions: arguments in, value out.
// Colours are linear RGB; n, l, v are unit, world space; l and v point away from the surface.

// Clamped inverse lerp. toony = 1 makes the specification divide 0 by 0: a hard step at b instead.
fn linearstep(a: f32, b: f32, t: f32) -> f32 {
    if b - a <= 0.0 {
        return select(0.0, 1.0, t >= b);
    }
    return saturate((t - a) / (b - a));
}

// Share of light, 0 in shade to 1 in light. "Shading Shift": half is reached at n.l = -shift, the ramp is
// 2 (1 - toony) wide. shift in -1..1, toony in 0..1.
fn mtoon_shading(n_dot_l: f32, shift: f32, toony: f32) -> f32 {
    return linearstep(toony - 1.0, 1.0 - toony, n_dot_l + shift);
}

// Direct light. The specification's pseudocode has lerp(base, shade, shading), which contradicts its own text and
// figure; shading = 1 is lit.
fn mtoon_direct(base: vec3f, shade: vec3f, shading: f32, light: vec3f) -> vec3f {
    return mix(shade, base, shading) * light;
}

// Ambient light with its direction evened out. "Global Illumination": two-point mean of up and down.
fn mtoon_gi(gi_n: vec3f, gi_up: vec3f, gi_down: vec3f, equalization: f32) -> vec3f {
    return mix(gi_n, (gi_up + gi_down) * 0.5, equalization);
}

// "MatCap". Result in 0.005..0.995, v upwards. A vertical view direction has no horizontal axis: x is taken instead.
fn mtoon_matcap_uv(n: vec3f, v: vec3f) -> vec2f {
    let horizontal = vec3f(v.z, 0.0, -v.x);
    let square = dot(horizontal, horizontal);
    // 1e-12: below it the f32 normalisation loses all digits.
    let x = select(vec3f(1.0, 0.0, 0.0), horizontal * inverseSqrt(max(square, 1e-12)), square > 1e-12);
    let y = cross(v, x);
    return vec2f(dot(x, n), dot(y, n)) * 0.495 + 0.5;
}

// "Parametric Rim Lighting". 1e-5 is the specification's guard against pow(0, 0).
fn mtoon_parametric_rim(n_dot_v: f32, lift: f32, fresnel_power: f32) -> f32 {
    let x = saturate(1.0 - n_dot_v + lift);
    // pow of 0 is left to no driver.
    return select(0.0, pow(x, max(fresnel_power, 1e-5)), x > 0.0);
}

// "Rim Lighting Mix". `lighting` is open in the specification: direct light plus ambient at the point.
fn mtoon_rim(matcap: vec3f, parametric: vec3f, mask: vec3f, lighting: vec3f, lighting_mix: f32) -> vec3f {
    return (matcap + parametric) * mask * mix(vec3f(1.0), lighting, lighting_mix);
}

// "UV Animation": rotation (rad, time multiplied in) about the centre, counter-clockwise with v down, then scroll.
fn mtoon_animate_uv(uv: vec2f, scroll: vec2f, rotation_rad: f32, mask: f32) -> vec2f {
    let c = cos(rotation_rad * mask);
    let s = sin(rotation_rad * mask);
    let d = uv - 0.5;
    return vec2f(c * d.x + s * d.y, c * d.y - s * d.x) + 0.5 + scroll * mask;
}

// "Outline Lighting Mix": the outline colour, multiplied by the shaded surface as far as `lighting_mix` says.
fn mtoon_outline(color: vec3f, surface: vec3f, lighting_mix: f32) -> vec3f {
    return color * mix(vec3f(1.0), surface, lighting_mix);
}
