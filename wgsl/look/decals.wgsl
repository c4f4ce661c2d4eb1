// Pictures laid over a surface.
import package::bind::shown::shown;
import package::bind::surface::Surface;
import package::bind::uv::UvTransform;
import package::lib::paint::{Painted, painted};
import package::material::{decals_map, decals_map_sampler, material};

struct DecalPlace {
    // Rows from texture coordinates to 0..1 over the decal; w of row_v: 1 multiplies.
    row_u: vec4f,
    row_v: vec4f,
    // Left, top, width, height.
    sheet: vec4f,
    color: vec4f,
}

struct Decals {
    placed: array<DecalPlace, 4>,
    // Of which the UV set alone counts.
    map_uv: UvTransform,
    count: u32,
}

fn decals_paint(s: ptr<function, Surface>) {
    var over = Painted(s.lit, s.shade);
    let uv = select(s.at.uv.xy, s.at.uv.zw, material.decals.map_uv.row_u.w > 0.5);
    let across = vec2f(length(dpdx(uv)), length(dpdy(uv)));
    for (var i = 0u; i < material.decals.count; i++) {
        let decal = material.decals.placed[i];
        let p = vec3f(uv, 1.0);
        // 0..1 over the decal.
        let at = vec2f(dot(decal.row_u.xyz, p), dot(decal.row_v.xyz, p));
        let on_sheet = decal.sheet.xy + saturate(at) * decal.sheet.zw;
        let step = length(decal.row_u.xy) * decal.sheet.z * max(across.x, across.y);
        let level = log2(max(step * f32(textureDimensions(decals_map).x), 1.0));
        let found = textureSampleLevel(decals_map, decals_map_sampler, on_sheet, level) * decal.color;
        let inside = all(at >= vec2f(0.0)) && all(at <= vec2f(1.0));
        let share = select(0.0, found.a, inside);
        over = painted(over, found.rgb, share, decal.row_v.w > 0.5);
        @if(channel_overlay) shown = max(shown, vec3f(share));
    }
    s.lit = over.lit;
    s.shade = over.shade;
}
