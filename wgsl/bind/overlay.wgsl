// What lies over a surface and is lit with it: decals and stockings.
import package::bind::material::{material, base_sampler, decal_texture};
import package::lib::stocking::stocking_cover;

// Colours in light and in shade.
struct Painted {
    lit: vec3f,
    shade: vec3f,
    // How much of the surface is covered.
    cover: f32,
}

// Paint of `color` over a share of a surface: in shade it is as much darker as the surface is.
fn painted(below: Painted, color: vec3f, share: f32, multiplies: bool) -> Painted {
    let dark = saturate(below.shade / max(below.lit, vec3f(0.02)));
    let lit = select(color, below.lit * color, multiplies);
    let shade = select(color * dark, below.shade * color, multiplies);
    return Painted(mix(below.lit, lit, share), mix(below.shade, shade, share), max(below.cover, share));
}

fn with_decals(surface: Painted, uv: vec2f) -> Painted {
    var result = surface;
    let across = vec2f(length(dpdx(uv)), length(dpdy(uv)));
    for (var i = 0u; i < material.decal_count; i++) {
        let decal = material.decals[i];
        let p = vec3f(uv, 1.0);
        // 0..1 over the decal.
        let at = vec2f(dot(decal.row_u.xyz, p), dot(decal.row_v.xyz, p));
        let on_sheet = decal.sheet.xy + saturate(at) * decal.sheet.zw;
        let step = length(decal.row_u.xy) * decal.sheet.z * max(across.x, across.y);
        let level = log2(max(step * f32(textureDimensions(decal_texture).x), 1.0));
        let found = textureSampleLevel(decal_texture, base_sampler, on_sheet, level) * decal.color;
        let inside = all(at >= vec2f(0.0)) && all(at <= vec2f(1.0));
        result = painted(result, found.rgb, select(0.0, found.a, inside), decal.row_v.w > 0.5);
    }
    return result;
}

fn with_stocking(surface: Painted, n_dot_v: f32) -> Painted {
    return painted(surface, material.stocking_color, stocking_cover(material.stocking_cover, n_dot_v), false);
}
