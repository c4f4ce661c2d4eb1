// Exponential shadow test of the bangs (Annen et al. 2008), each tap clamped before they are summed: far taps cannot leak
// into near ones, and percentage closer filtering is its lower bound.

// Texels along a block of the nearest depths; `BLOCK` in `src/render/pass/bangs_near.rs`.
const BANGS_BLOCK: i32 = 8;

// Light that passes casters at depths `d` to a receiver at depth `z`, 0..1 over the range; `c` per unit of depth.
fn esm_taps(d: vec4f, z: f32, c: f32, bias: f32) -> vec4f {
    return exp(min(vec4f(0.0), c * (d - z + bias)));
}

// Share of shadow where the share `lit` of light arrives. 1e-6: equal edges are a step.
fn bangs_share(lit: f32, edges: vec2f, strength: f32) -> f32 {
    return strength * (1.0 - smoothstep(edges.x, max(edges.y, edges.x + 1e-6), lit));
}

// How far a colour is the white of an eye or of a tooth: bright, and more neutral than skin.
fn bangs_white(color: vec3f) -> f32 {
    let most = max(color.r, max(color.g, color.b));
    let least = min(color.r, min(color.g, color.b));
    return smoothstep(0.88, 0.96, least / max(most, 1e-4)) * smoothstep(0.5, 0.7, most);
}

// Place between the middle of the shadow's edge (0) and where no light arrives (-1) or all of it (1).
fn bangs_depth(lit: f32, edges: vec2f) -> f32 {
    let middle = clamp(0.5 * (edges.x + edges.y), 0.01, 0.99);
    return (lit - middle) / select(middle, 1.0 - middle, lit > middle);
}

// Depth by which a receiver is moved towards the light, by the cosine between its normal and that: not where it faces it, and a
// tenth of the map's width (the range of depth is twice that) where it is only grazed. There each texel is a long step, and the
// shadow of a lock a smear.
fn bangs_grazed(facing: f32) -> f32 {
    return 0.05 * (1.0 - smoothstep(0.0, 0.4, facing));
}

// Taps along one axis: a box three texels wide lies on four of them.
const BANGS_TAPS: i32 = 4;

// Weight of tap `i` along one axis at the fraction `f` of a texel.
fn bangs_weight(i: i32, f: f32) -> f32 {
    return select(select(1.0, 1.0 - f, i == 0), f, i == BANGS_TAPS - 1) / 3.0;
}
