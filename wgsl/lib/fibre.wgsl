// Light through a hair: a rough dielectric cylinder with absorption. Longitudinal scattering and roughened azimuth of d'Eon et
// al. 2011; parameters, tilts and logistic detector of Chiang et al. 2016; paths of Marschner et al. 2003 with the chord of the
// circle (2 cos gamma_t). Angles in radians; theta is the inclination from the plane that is square to the fibre, phi the angle
// about it from the viewer to the light, h = sin gamma_i the offset across it, absorption per fibre radius.

const PI: f32 = 3.14159265;

// The table of azimuthal scattering, which wgsl/pass/fibre.wgsl makes: angles from 0 to pi, a column each, and two more of
// energies; inclinations, a row each, twice.
const TABLE_ANGLES: u32 = 126u;
const TABLE_ROWS: u32 = 48u;

// e^(y - x) I0(x): a polynomial of one over a root that grows as that function falls (fitted; relative error 1.3e-4).
fn i0_scaled(x: f32, y: f32) -> f32 {
    let r = inverseSqrt(1.0 + 0.422993227 * x);
    let q = r * r;
    let p = 0.25943242 + q * (0.148429207 + q * (-0.00560678458 + q * (1.2949697 + q * (-4.8770419 + q * (10.2158911
        + q * (-8.53038180 + q * 2.49427397))))));
    return r * p * exp(y);
}

// Longitudinal scattering M of variance v: the integral of M cos theta over theta is 1. `scale` is csch(1/v) / (2v) without its
// part e^(-1/v), which is 1 / (v (1 - e^(-2/v))); `sharp` is 1/v. Half the squared distance of the two directions stands for
// 1 - cos of their sum, which keeps its digits for any v.
fn fibre_longitudinal(sharp: f32, scale: f32, sin_i: f32, cos_i: f32, sin_o: f32, cos_o: f32) -> f32 {
    let across = cos_i - cos_o;
    let along = sin_i + sin_o;
    let off = 0.5 * (across * across + along * along);
    return scale * i0_scaled(cos_i * cos_o * sharp, -off * sharp);
}

// Sine and cosine of an inclination that the scales of the hair tilt.
fn fibre_tilted(sin_o: f32, cos_o: f32, tilt: vec2f) -> vec2f {
    return vec2f(sin_o * tilt.y + cos_o * tilt.x, abs(cos_o * tilt.y - sin_o * tilt.x));
}

// Fresnel's reflectance of unpolarised light; 1 beyond the critical angle.
fn fresnel_dielectric(cos_i: f32, eta: f32) -> f32 {
    let c = saturate(cos_i);
    let sin2_t = (1.0 - c * c) / (eta * eta);
    let t = sqrt(max(0.0, 1.0 - sin2_t));
    let p = (eta * c - t) / (eta * c + t);
    let s = (c - eta * t) / (c + eta * t);
    return select(0.5 * (p * p + s * s), 1.0, sin2_t >= 1.0);
}

// Abramowitz and Stegun 4.4.46 (error 2e-8): drivers may be a thousand times worse.
fn arc_sine(x: f32) -> f32 {
    let a = min(abs(x), 1.0);
    let p = 1.5707963050 + a * (-0.2145988016 + a * (0.0889789874 + a * (-0.0501743046 + a * (0.0308918810
        + a * (-0.0170881256 + a * (0.0066700901 - a * 0.0012624911))))));
    return sign(x) * (1.57079633 - sqrt(1.0 - a) * p);
}

// A way across the fibre.
struct FibreCrossing {
    gamma_i: f32,
    gamma_t: f32,
    // At entry; one value serves all inner bounces.
    fresnel: f32,
    // Of one pass, in fibre radii.
    length: f32,
}

// 1e-3: at grazing inclination the way is as long as it gets.
fn fibre_crossing(sin_o: f32, cos_o: f32, h: f32, eta: f32) -> FibreCrossing {
    let cos_at = max(cos_o, 1e-3);
    let eta_across = sqrt(eta * eta - sin_o * sin_o) / cos_at;
    var c: FibreCrossing;
    let h_inside = h / eta_across;
    c.gamma_i = arc_sine(h);
    c.gamma_t = arc_sine(h_inside);
    c.fresnel = fresnel_dielectric(cos_at * sqrt(max((1.0 - h) * (1.0 + h), 0.0)), eta);
    c.length = 2.0 * sqrt(max(1.0 - h_inside * h_inside, 0.0)) / sqrt(1.0 - sin_o * sin_o / (eta * eta));
    return c;
}

// Shares of light that leave after no, one, two and more passes: R, TT, TRT and the rest.
fn fibre_attenuation(fresnel: f32, transmittance: f32) -> vec4f {
    let t = transmittance;
    let tt = (1.0 - fresnel) * (1.0 - fresnel) * t;
    let trt = tt * t * fresnel;
    return vec4f(fresnel, tt, trt, trt * t * fresnel / max(1.0 - t * fresnel, 1e-6));
}

// Angle about the fibre at which light leaves a smooth one after p passes.
fn fibre_exit(p: f32, gamma_i: f32, gamma_t: f32) -> f32 {
    return 2.0 * p * gamma_t - 2.0 * gamma_i + p * PI;
}

fn wrapped_angle(x: f32) -> f32 {
    return x - 2.0 * PI * round(x / (2.0 * PI));
}

// Densities round the circle: trimmed logistic of scale s, and wrapped Gaussian of a standard deviation.
fn trimmed_logistic(x: f32, s: f32) -> f32 {
    let e = exp(-abs(wrapped_angle(x)) / s);
    return e / (s * (1.0 + e) * (1.0 + e)) / tanh(PI / (2.0 * s));
}

fn wrapped_gaussian(x: f32, deviation: f32) -> f32 {
    var sum = 0.0;
    for (var k = -3; k <= 3; k++) {
        let z = (wrapped_angle(x) - 2.0 * PI * f32(k)) / deviation;
        sum += exp(-0.5 * z * z);
    }
    return sum / (sqrt(2.0 * PI) * deviation);
}

// What roughens the azimuth: its width in radians, and which density.
struct Detector {
    width: f32,
    is_gaussian: bool,
}

fn detected(x: f32, d: Detector) -> f32 {
    if d.is_gaussian {
        return wrapped_gaussian(x, d.width);
    }
    return trimmed_logistic(x, d.width);
}

// Offset h across the fibre of a node, and its weight; all weights add up to 1. This spread of even nodes removes the square
// roots at both ends, and weighs the ends by 0 so smoothly that a sum is as good as one of far more.
fn fibre_node(i: u32, nodes: u32) -> vec2f {
    let x = (2.0 * f32(i) + 1.0) / f32(nodes) - 1.0;
    let x2 = x * x;
    return vec2f(x * (15.0 - x2 * (10.0 - 3.0 * x2)) / 8.0, 1.875 / f32(nodes) * (1.0 - x2) * (1.0 - x2));
}

// Azimuthal scattering of a whole fibre, 1/rad: R, TT, TRT, and the rest, which leaves everywhere alike.
fn fibre_azimuthal(phi: f32, sin_o: f32, cos_o: f32, eta: f32, absorption: f32, d: Detector, nodes: u32) -> vec4f {
    var sum = vec4f(0.0);
    for (var i = 0u; i < nodes; i++) {
        let node = fibre_node(i, nodes);
        let c = fibre_crossing(sin_o, cos_o, node.x, eta);
        let a = fibre_attenuation(c.fresnel, exp(-absorption * c.length));
        let n = vec4f(
            detected(phi - fibre_exit(0.0, c.gamma_i, c.gamma_t), d),
            detected(phi - fibre_exit(1.0, c.gamma_i, c.gamma_t), d),
            detected(phi - fibre_exit(2.0, c.gamma_i, c.gamma_t), d),
            1.0 / (2.0 * PI),
        );
        sum += a * n * node.y;
    }
    return sum;
}

// What comes back of light that goes about in a body of hair, of which each fibre passes on a share `met`: it has met three
// fibres and more. Its share, and what of it meets two more, are those of pictures of a path tracer
// (`cargo xtask compare-real hair`), whose hair of four colours follows this sum within 7 %.
fn fibre_around(met: vec3f) -> vec3f {
    let again = met * met;
    return 0.137 * again * met / (1.0 - 0.66 * again);
}

// Absorption at which that body has a share of what it has without pigment: the inverse of that sum, within 0.01, where ways
// through a fibre are 1.85 radii long.
fn fibre_absorption(color: vec3f) -> vec3f {
    let x = -log(clamp(color, vec3f(1e-3), vec3f(1.0)));
    return x * (0.082 + 0.0138 * x);
}
