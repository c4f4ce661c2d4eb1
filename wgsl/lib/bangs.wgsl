// Exponential shadow test of the bangs (Annen et al. 2008), each tap clamped before they are summed: far taps cannot leak
// into near ones, and percentage closer filtering is its lower bound.

// Light that passes a caster at depth `d` to a receiver at depth `z`, both 0..1 over the range; `c` per unit of depth.
fn esm_tap(d: f32, z: f32, c: f32, bias: f32) -> f32 {
    return min(1.0, exp(min(0.0, c * (d - z + bias))));
}

// What lit colour is multiplied by where the share `lit` of light arrives. 1e-6: equal edges are a step.
fn bangs_factor(lit: f32, edges: vec2f, strength: f32, color: vec3f) -> vec3f {
    let shadow = 1.0 - smoothstep(edges.x, max(edges.y, edges.x + 1e-6), lit);
    return mix(vec3f(1.0), color, strength * shadow);
}

// Weight of tap `i` of five along one axis: a box four texels wide at the fraction `f` of a texel.
fn bangs_weight(i: i32, f: f32) -> f32 {
    return select(select(1.0, 1.0 - f, i == 0), f, i == 4) * 0.25;
}
