// Painted steps from shade to light.

// Colour between full shade (place 0) and full light (1) over a band of the terminator's colour; `edges` are the places
// where shade turns into the terminator and that into light, growing. 1e-4: equal edges are a step.
fn ramp_bands(lit: vec3f, shade: vec3f, terminator: vec3f, edges: vec4f, place: f32) -> vec3f {
    let band = mix(shade, terminator, smoothstep(edges.x, max(edges.y, edges.x + 1e-4), place));
    return mix(band, lit, smoothstep(edges.z, max(edges.w, edges.z + 1e-4), place));
}

// Number of a part in a map of ids, from 0 on; -1 where it knows none.
fn part_number(red: f32) -> i32 {
    let part = i32(red * 255.0 + 0.5) - 1;
    return select(-1, part, part < 8);
}
