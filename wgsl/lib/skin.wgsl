// Light below skin: wrapped light, normals of a colour each (Ma 2007), Burley's normalised diffusion (Christensen and Burley
// 2015), and where the table of a profile has its values. Lengths in mm; `d` is how far light of each colour goes.
import package::lib::kajiya_kay::wrapped_lambert;

// Light that comes round, wrap 0..1, with no more energy than Lambert's.
fn wrapped_diffuse(n_dot_l: f32, wrap: f32) -> f32 {
    let w = max(wrap, 0.0);
    return wrapped_lambert(n_dot_l, w) / (1.0 + w);
}

// As it is mostly written: 1 + wrap times too bright.
fn wrapped_diffuse_as_written(n_dot_l: f32, wrap: f32) -> f32 {
    return wrapped_lambert(n_dot_l, max(wrap, 0.0));
}

// How much of the smooth normal green and blue see, whose light goes less far than red's; red sees nothing else. Away from the
// light, bumps are smoother.
fn detail_smoothing(low_dot_l: f32) -> vec2f {
    let away = saturate(1.0 - low_dot_l);
    let blur = away * away;
    return vec2f(0.3 + 0.7 * blur, blur);
}

// Shorter ways are no ways in f32, mm.
const LEAST_WAY: f32 = 1e-6;

// e^(-r/3d). All of Burley's terms are polynomials of it.
fn burley_fall(r: f32, d: vec3f) -> vec3f {
    return exp(-max(r, 0.0) / (3.0 * max(d, vec3f(LEAST_WAY))));
}

// Reflectance at a distance times that distance, 1/mm: without the pole at 0.
fn burley_times_r(r: f32, d: vec3f) -> vec3f {
    let e = burley_fall(r, d);
    return e * (1.0 + e * e) / (25.1327412 * max(d, vec3f(LEAST_WAY)));
}

// Reflectance at a distance, 1/mm²; over the plane it adds up to 1.
fn burley(r: f32, d: vec3f) -> vec3f {
    return burley_times_r(r, d) / max(r, LEAST_WAY);
}

// Share of light that goes through a slab: what leaves beyond a distance.
fn burley_transmittance(thickness: f32, d: vec3f) -> vec3f {
    let e = burley_fall(thickness, d);
    return e * (3.0 + e * e) * 0.25;
}

// Share of light that leaves within a distance. The product keeps its digits near 0.
fn burley_cdf(r: f32, d: vec3f) -> vec3f {
    let e = burley_fall(r, d);
    return (1.0 - e) * (4.0 + e * (1.0 + e)) * 0.25;
}

// Share of light that goes farther than x along a line, to both sides. A fit of exponentials to the integral of the line spread,
// 0.0045 off at most.
fn line_beyond(x_mm: f32, rate: vec3f) -> vec3f {
    // Nothing below normal floats, with which processors are slow.
    let e = exp2(clamp(rate * x_mm, vec3f(-15.0), vec3f(0.0)));
    let e2 = e * e;
    let e4 = e2 * e2;
    let e8 = max(e4 * e4, vec3f(1e-9));
    let e16 = e8 * e8;
    return e * 0.332732 + e2 * 0.433875 + e8 * 0.173498 + e16 * e16 * 0.059895;
}

// Of the slowest of them, 1/mm.
fn line_rate(d: vec3f) -> vec3f {
    return -0.526584 / max(d, vec3f(LEAST_WAY));
}

// Distance within which a share u of light leaves: y = e^(-r/3d) solves y³ + 3y = 4 (1 - u). At u = 1 it is 55 d.
fn burley_radius(u: f32, d: f32) -> f32 {
    let q = 2.0 * (1.0 - saturate(u));
    let w = pow(q + sqrt(q * q + 1.0), 1.0 / 3.0);
    let near = w - 1.0 / w;
    // A step of Newton's: the difference loses digits, and so does pow of drivers.
    let y = near - (near * near * near + 3.0 * near - 2.0 * q) / (3.0 * near * near + 3.0);
    return -3.0 * d * log(clamp(y, 1e-8, 1.0));
}

// The table of a profile (src/skin/tables.rs): 64 rows of diffused light by curvature, 32 of penumbras by their width, two of
// transmittance, one of the highlight's albedo.
const TABLE_COLUMNS: u32 = 64u;
const TABLE_ROWS: u32 = 99u;

// Texture coordinate of a share of the columns and a row, at centres of texels.
fn table_place(x: f32, row: f32) -> vec2f {
    return vec2f(0.5 + saturate(x) * f32(TABLE_COLUMNS - 1u), 0.5 + row) / vec2f(f32(TABLE_COLUMNS), f32(TABLE_ROWS));
}

fn diffused_place(n_dot_l: f32, curvature_per_mm: f32) -> vec2f {
    return table_place(n_dot_l * 0.5 + 0.5, saturate(curvature_per_mm) * 63.0);
}

// Rows are even in 1/width, up to 0.5 per mm.
fn penumbra_place(share: f32, width_mm: f32) -> vec2f {
    return table_place(share, 64.0 + min(62.0 / max(width_mm, LEAST_WAY), 31.0));
}

// Columns are even in the root of thickness: thin is where it changes.
fn transmittance_place(thickness_mm: f32, range_mm: f32, of_volume: bool) -> vec2f {
    let share = max(thickness_mm, 0.0) / max(range_mm, LEAST_WAY);
    return table_place(sqrt(share), select(96.0, 97.0, of_volume));
}

fn albedo_place(n_dot_v: f32) -> vec2f {
    return table_place(n_dot_v, 98.0);
}

// Weight of a tap at a distance in the plane that lies dz deeper: the reflectance over the density per area by which the place was
// drawn, of which 1/8 pi over it is given.
fn disc_weight(r_mm: f32, dz_mm: f32, d: vec3f, over_density: f32) -> vec3f {
    let r = max(r_mm, LEAST_WAY);
    return tap_weight(sqrt(r * r + dz_mm * dz_mm), d, over_density);
}

// The same of a tap that lies so far away.
fn tap_weight(way_mm: f32, d: vec3f, over_density: f32) -> vec3f {
    let way = max(way_mm, LEAST_WAY);
    let e = burley_fall(way, d);
    return e * (1.0 + e * e) * (over_density / way) / max(d, vec3f(LEAST_WAY));
}
