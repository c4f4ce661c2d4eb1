// Spreads the light on skin over its texture coordinates: the discs of wgsl/pass/scatter_disc.wgsl, stretched as texels are, with
// distances straight through space (d'Eon and Luebke 2007; Christensen and Burley 2015).
import package::bind::picture::{PictureVarying, picture_varying};
import package::lib::skin::tap_weight;

struct ScatterUvNumbers {
    count: u32,
    // Place in a profile of d = 1, its radius, and 1/8 pi over the density of places there; of each texel of two by two, whose
    // mean is as good as all of them.
    taps: array<array<vec4f, 40>, 4>,
}

@group(0) @binding(0) var<uniform> numbers: ScatterUvNumbers;
// What wgsl/pass/irradiance_uv.wgsl writes.
@group(0) @binding(1) var light: texture_2d<f32>;
@group(0) @binding(2) var places: texture_2d<f32>;
@group(0) @binding(3) var spans: texture_2d<f32>;

// A step over a border of a chart: the place beyond it, in texels.
struct Seam {
    across: mat2x2f,
    base: vec2f,
    unused: vec2f,
}

@group(0) @binding(4) var<storage, read> seams: array<Seam>;
// The nearest of each texel, counted from 1; 0 for none.
@group(0) @binding(5) var seam_of: texture_2d<u32>;

// What lies this much farther or nearer than texels say lies on another chart, or beyond a fold.
const MOST_STRETCH: f32 = 1.5;
// Texels beyond the border of a chart that are filled, along a side: those that are read between texels.
const FILLED: i32 = 2;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

// Where a tap lands.
struct Landing {
    texel: vec2i,
    // Distance straight through space, over what it should be; 0 where nothing is.
    stretch: f32,
}

// What stands at a texel, which should be `mm` away.
fn landing(wanted: vec2i, mm: f32, place: vec3f, last: vec2i) -> Landing {
    let texel = clamp(wanted, vec2i(0), last);
    let way = distance(textureLoad(places, texel, 0).xyz, place);
    let is_there = all(texel == wanted) && textureLoad(spans, texel, 0).x > 0.0;
    return Landing(texel, select(0.0, way / max(mm, 1e-6), is_there));
}

fn is_near(of_tap: Landing, most: f32) -> bool {
    return of_tap.stretch < most && of_tap.stretch > 1.0 / most;
}

// So many texels on; over the nearest border of a chart, where they lie beyond that.
fn landed(home: vec2i, by: vec2f, mm: f32, place: vec3f, last: vec2i, seam: u32) -> Landing {
    let whole = vec2i(clamp(round(by), vec2f(-4096.0), vec2f(4096.0)));
    // Texels are whole, distances are not.
    var here = landing(home + whole, mm * length(vec2f(whole)) / max(length(by), 1e-4), place, last);
    if all(whole == vec2i(0)) {
        here.stretch = 1.0;
    }
    if seam > 0u && !is_near(here, MOST_STRETCH) {
        let over = &seams[seam - 1u];
        let there = (*over).base + (*over).across * (vec2f(home) + 0.5 + by);
        let beyond = landing(vec2i(floor(clamp(there, vec2f(-4096.0), vec2f(4096.0)))), mm, place, last);
        if is_near(beyond, MOST_STRETCH) {
            here = beyond;
        }
    }
    return here;
}

@fragment
fn fs_main(in: PictureVarying) -> @location(0) vec4f {
    let at = vec2i(in.position.xy);
    let last = vec2i(textureDimensions(light)) - 1;
    let is_bare = textureLoad(spans, at, 0).x == 0.0;
    // Beyond the border of a chart, the nearest texel of it.
    var home = at;
    var nearest = 1000;
    // Counts of 0 rather than branches: software rasterizers walk both sides of branches, but leave loops early.
    let side = 2 * FILLED + 1;
    let others = select(0, side * side, is_bare);
    for (var i = 0; i < others; i++) {
        let by = vec2i(i % side, i / side) - FILLED;
        let there = clamp(at + by, vec2i(0), last);
        let away = by.x * by.x + by.y * by.y;
        if away < nearest && textureLoad(spans, there, 0).x > 0.0 {
            nearest = away;
            home = there;
        }
    }
    let here = textureLoad(light, home, 0);
    let place = textureLoad(places, home, 0);
    let span = textureLoad(spans, home, 0);
    let d = vec3f(here.a, place.a, span.a);
    let far = max(d.r, max(d.g, d.b));
    let is_there = span.x > 0.0;
    // Where light stays within a texel nothing is spread.
    let taps = select(0u, numbers.count, is_there && far * 8.0 > min(span.x, span.z));
    let texel = (at.x & 1) + (at.y & 1) * 2;
    let seam = textureLoad(seam_of, min(home, vec2i(textureDimensions(seam_of)) - 1), 0).x;
    var sum = vec3f(0.0);
    var weights = vec3f(0.0);
    for (var i = 0u; i < taps; i++) {
        let unit = numbers.taps[texel][i];
        let tap = unit.xyz * far;
        let down = tap.y / max(span.z, 1e-4);
        let by = vec2f((tap.x - span.y * down) / max(span.x, 1e-4), down);
        // As far as texels there have it, then as far as wanted.
        let first = landed(home, by, tap.z, place.xyz, last, seam);
        let corrected = by / select(1.0, first.stretch, is_near(first, 4.0));
        let there = landed(home, corrected, tap.z, place.xyz, last, seam);
        let weight = tap_weight(tap.z * there.stretch, d, unit.w * far * far);
        let counted = select(vec3f(0.0), weight, is_near(there, MOST_STRETCH));
        sum += textureLoad(light, there.texel, 0).rgb * counted;
        weights += counted;
    }
    let spread = select(here.rgb, sum / max(weights, vec3f(1e-12)), weights > vec3f(1e-9));
    return select(vec4f(0.0), vec4f(spread, 1.0), is_there);
}
