// Numbers that look random and are the same on every adapter: integers alone are hashed.

// Three numbers of 0..1 from a cell (pcg3d, Jarzynski and Olano 2020).
fn cell_hash(cell: vec3i) -> vec3f {
    var v = bitcast<vec3u>(cell) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3f(v >> vec3u(8u)) / 16777216.0;
}

// A cell of a lattice that repeats after `period` cells.
fn wrapped_cell(cell: vec2i, period: vec2i) -> vec2i {
    return ((cell % period) + period) % period;
}

// Smooth noise of 0..1 over a lattice of unit cells that repeats after `period` of them.
fn value_noise(p: vec2f, period: vec2i, seed: i32) -> f32 {
    let first = vec2i(floor(p));
    let f = fract(p);
    let t = f * f * (3.0 - 2.0 * f);
    let a = cell_hash(vec3i(wrapped_cell(first, period), seed)).x;
    let b = cell_hash(vec3i(wrapped_cell(first + vec2i(1, 0), period), seed)).x;
    let c = cell_hash(vec3i(wrapped_cell(first + vec2i(0, 1), period), seed)).x;
    let d = cell_hash(vec3i(wrapped_cell(first + vec2i(1, 1), period), seed)).x;
    return mix(mix(a, b, t.x), mix(c, d, t.x), t.y);
}
