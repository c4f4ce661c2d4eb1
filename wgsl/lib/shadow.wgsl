// Shadows of actors, on themselves and on anything else. No binding, no import: a host may paste this page before a shader of
// its own and call `stage_shadow`.

// The map of a whole stage, as `StageShadow::numbers` holds it.
struct StageShadow {
    // Axes of the map, unit, world space; one over its width, 1/m.
    right: vec3f,
    scale: f32,
    up: vec3f,
    // Distance by which a receiver is moved towards the light, and width of the edge: shares of the width.
    bias: f32,
    to_light: vec3f,
    spread: f32,
    // World space, metres.
    middle: vec3f,
    layer: f32,
}

// Share of the key light that arrives at a place of the world with this unit normal: 1 where nothing casts on it.
fn stage_shadow(
    s: StageShadow, map: texture_depth_2d_array, map_sampler: sampler_comparison, position: vec3f, normal: vec3f
) -> f32 {
    let at = shadow_place(position - s.middle, s.right, s.up, s.to_light, s.scale)
        + shadow_moved(normal, s.right, s.up, s.to_light) * s.bias;
    // What lies behind the map's range takes the shadow of all that is in it.
    let place = vec3f(at.xy, min(at.z, 1.0));
    let is_outside = any(at.xy <= vec2f(0.0)) || any(at.xy >= vec2f(1.0)) || s.layer < 0.0;
    return shadow_share(map, map_sampler, place, i32(round(s.layer)), s.spread, !is_outside);
}

// Place in a map of a point `d` metres from its middle, `scale` being one over its width: u, v downwards, and depth that
// grows away from the light, each 0..1.
fn shadow_place(d: vec3f, right: vec3f, up: vec3f, to_light: vec3f, scale: f32) -> vec3f {
    return vec3f(dot(right, d) * scale + 0.5, 0.5 - dot(up, d) * scale, 0.5 - dot(to_light, d) * scale);
}

// By how much a receiver is moved off its surface, towards the light: most where it lies along the light.
fn shadow_moved(normal: vec3f, right: vec3f, up: vec3f, to_light: vec3f) -> vec3f {
    let n_dot_l = dot(normal, to_light);
    let along = sqrt(saturate(1.0 - n_dot_l * n_dot_l));
    let moved = normal * along + to_light * 0.5;
    return shadow_place(moved, right, up, to_light, 1.0) - 0.5;
}

// Share of light at a place of a layer, with a drawn edge.
fn shadow_share(
    map: texture_depth_2d_array, map_sampler: sampler_comparison, at: vec3f, layer: i32, spread: f32, wanted: bool
) -> f32 {
    return shadow_edge(shadow_filtered(map, map_sampler, at, layer, spread, wanted), 0.3);
}

// Share of light at a place of a layer: the mean about it, by a bell that ends 1.5 texels beyond a square `spread` wide (share
// of the map's width, 3 to 5 texels). What the caller does not need (`wanted`) is lit.
fn shadow_filtered(
    map: texture_depth_2d_array, map_sampler: sampler_comparison, at: vec3f, layer: i32, spread: f32, wanted: bool
) -> f32 {
    let size = vec2f(textureDimensions(map));
    let reach = shadow_reach(spread * size.x);
    let p = at.xy * size - 0.5;
    // Eight by eight texels, four at a time.
    let first = floor(p) - 3.0;
    let f = p - floor(p);
    // A count of 0 rather than a branch: software rasterizers walk both sides of branches, but leave loops early.
    let corners = select(4, 0, !wanted);
    var texels = select(0.0, 16.0, corners == 0);
    for (var i = 0; i < corners; i++) {
        let place = vec2f(f32(i % 2), f32(i / 2)) * 6.0;
        let four = textureGatherCompare(map, map_sampler, (first + place + 1.0) / size, layer, at.z);
        texels += dot(four, vec4f(1.0));
    }
    // Where the corners agree, so does what lies between: most of a picture. They weigh next to nothing themselves.
    let agree = texels == 0.0 || texels == 16.0;
    let others = select(12, 0, agree);
    var lit = vec2f(0.0, 1e-6);
    for (var i = 0; i < others; i++) {
        // Four rows of four but the corners.
        let number = i + 1 + i32(i >= 2) + i32(i >= 10);
        let place = vec2f(f32(number % 4), f32(number / 4)) * 2.0;
        let four = textureGatherCompare(map, map_sampler, (first + place + 1.0) / size, layer, at.z);
        lit += shadow_weighted(four, place - 3.0 - f, reach);
    }
    return select(lit.x / lit.y, texels / 16.0, agree);
}

// How far the bell of an edge of `width` texels reaches, texels; one over it is how steep the edge is in its middle.
fn shadow_reach(width: f32) -> f32 {
    return width * 0.5 + 1.5;
}

// Four texels, the first of them `d` texels from the middle, by their weights in the bell; then the sum of these.
fn shadow_weighted(four: vec4f, d: vec2f, reach: f32) -> vec2f {
    let x = shadow_bell(vec2f(d.x, d.x + 1.0) / reach);
    let y = shadow_bell(vec2f(d.y, d.y + 1.0) / reach);
    // (0, 1), (1, 1), (1, 0), (0, 0).
    return vec2f(y.y * dot(x, four.xy) + y.x * dot(x, four.wz), (x.x + x.y) * (y.x + y.y));
}

fn shadow_bell(d: vec2f) -> vec2f {
    return smoothstep(vec2f(1.0), vec2f(0.0), abs(d));
}

// Share of light with a drawn edge: the middle of what filtering spreads, which rounds teeth and corners off. `width` is the
// share of it that is soft.
fn shadow_edge(lit: f32, width: f32) -> f32 {
    return smoothstep(0.5 - 0.5 * width, 0.5 + 0.5 * width, lit);
}
