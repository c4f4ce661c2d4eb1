// Paint that lies over a surface and is lit with it.

// Colours in light and in shade.
struct Painted {
    lit: vec3f,
    shade: vec3f,
}

// Paint of `color` over a share of a surface: in shade it is as much darker as the surface is.
fn painted(below: Painted, color: vec3f, share: f32, multiplies: bool) -> Painted {
    let dark = saturate(below.shade / max(below.lit, vec3f(0.02)));
    let lit = select(color, below.lit * color, multiplies);
    let shade = select(color * dark, below.shade * color, multiplies);
    return Painted(mix(below.lit, lit, share), mix(below.shade, shade, share));
}
