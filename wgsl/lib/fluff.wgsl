// A coat of short hair in shells.
import package::lib::noise::cell_hash;

// The strand at a place: which way it leans, -1..1, and its height there, 0..1 of the length. One strand a cell, pointed.
fn fluff_strand(at: vec2f) -> vec4f {
    var strand = vec4f(0.0);
    let first = vec2i(floor(at - 0.5));
    for (var i = 0; i < 4; i++) {
        let cell = first + vec2i(i % 2, i / 2);
        let random = cell_hash(vec3i(cell, 3));
        let middle = vec2f(cell) + 0.5 + (random.xy - 0.5) * 0.8;
        // Cones of different height that touch at their foot.
        let height = (0.55 + 0.45 * random.z) * (1.0 - distance(at, middle) / 0.9);
        if height > strand.w {
            strand = vec4f(cell_hash(vec3i(cell, 4)) * 2.0 - 1.0, height);
        }
    }
    return strand;
}

// Strands across a clump.
const FLUFF_CLUMP: f32 = 6.0;

// The clump at a place: how far its middle is, and which way all of it leans, -1..1.
struct FluffClump {
    to_middle: vec2f,
    lean: vec3f,
}

fn fluff_clump(at: vec2f) -> FluffClump {
    let p = at / FLUFF_CLUMP;
    var clump = FluffClump(vec2f(0.0), vec3f(0.0));
    var nearest = 9.0;
    let first = vec2i(floor(p - 0.5));
    for (var i = 0; i < 4; i++) {
        let cell = first + vec2i(i % 2, i / 2);
        let middle = vec2f(cell) + 0.5 + (cell_hash(vec3i(cell, 5)).xy - 0.5) * 0.6;
        let away = distance(p, middle);
        if away < nearest {
            nearest = away;
            clump = FluffClump((middle - p) * FLUFF_CLUMP, cell_hash(vec3i(cell, 6)) * 2.0 - 1.0);
        }
    }
    return clump;
}

// Opacity of a shell at `level` of the length, 0..1.
fn fluff_cover(height: f32, level: f32, softness: f32) -> f32 {
    return saturate((height - level) / max(softness, 1e-3) + 1.0 - level);
}

// Movement of a tip by wind at a place of the world, metres of a unit wind; it repeats with the phase.
fn fluff_wind(position: vec3f, phase: f32) -> vec3f {
    let turn = 6.2831853 * phase;
    let along = position.x * 9.0 + position.y * 5.0 + position.z * 7.0;
    return vec3f(sin(turn + along), 0.3 * sin(2.0 * turn + along), cos(turn + along * 1.3));
}

// Shells that a coat needs on the picture: a pixel and a half apart, at least 4. Nobody sees the gaps, and each costs.
fn fluff_shells(length_m: f32, px_per_m: f32, most: f32) -> f32 {
    return clamp(ceil(length_m * px_per_m / 1.5), min(4.0, most), most);
}
