// The table of azimuthal scattering of fibres of one roughness and index: an entry for an angle about the fibre, an inclination
// of the view, and what half a pass lets through. R, TT, TRT and the rest, 1/rad; the last two columns hold the
// energies of R, of all that goes forwards and backwards, and of what goes about among many fibres and comes back.
import package::lib::fibre::{Detector, PI, fibre_attenuation, fibre_azimuthal, fibre_crossing};

struct FibreNumbers {
    width: f32,
    ior: f32,
    is_gaussian: u32,
    nodes: u32,
}

@group(0) @binding(0) var<uniform> numbers: FibreNumbers;
@group(0) @binding(1) var table: texture_storage_3d<rgba16float, write>;

const ANGLES: u32 = 64u;
// For the energies: drivers end loops after 65536 rounds.
const COARSE: u32 = 48u;

@compute @workgroup_size(8, 8, 1)
fn main(@builtin(global_invocation_id) at: vec3u) {
    let size = textureDimensions(table);
    if any(at >= size) {
        return;
    }
    let theta = f32(at.y) / f32(size.y - 1u) * 0.5 * PI;
    let sin_o = sin(theta);
    let cos_o = sqrt(max(1.0 - sin_o * sin_o, 0.0));
    // Half of what one pass absorbs; whole darkness stands for an absorption of 32.
    let absorption = -2.0 * log(max(f32(at.z) / f32(size.z - 1u), 1.1e-7));
    let detector = Detector(numbers.width, numbers.is_gaussian == 1u);
    if at.x < ANGLES {
        let phi = f32(at.x) / f32(ANGLES - 1u) * PI;
        let n = fibre_azimuthal(phi, sin_o, cos_o, numbers.ior, absorption, detector, numbers.nodes);
        textureStore(table, at, n);
        return;
    }
    var forwards = 0.0;
    var backwards = 0.0;
    for (var i = 0u; i < COARSE; i++) {
        let phi = (f32(i) + 0.5) / f32(COARSE) * PI;
        let n = fibre_azimuthal(phi, sin_o, cos_o, numbers.ior, absorption, detector, COARSE);
        // Both sides.
        let sum = dot(n, vec4f(1.0)) * 2.0 * PI / f32(COARSE);
        forwards += select(0.0, sum, phi > 0.5 * PI);
        backwards += select(sum, 0.0, phi > 0.5 * PI);
    }
    var reflected = 0.0;
    for (var i = 0u; i < COARSE; i++) {
        let x = (2.0 * f32(i) + 1.0) / f32(COARSE) - 1.0;
        let c = fibre_crossing(sin_o, cos_o, x * (1.5 - 0.5 * x * x), numbers.ior);
        reflected += c.fresnel * (1.0 - x * x) * 1.5 / f32(COARSE);
    }
    // Scattered back once or thrice among many that go forwards (Zinke et al. 2008, equations 13 and 15). 0.99: white hair would
    // keep light for ever.
    let f2 = min(forwards * forwards, 0.98);
    let rest = 1.0 - f2;
    let around = backwards * f2 / rest + backwards * backwards * backwards * f2 / (rest * rest * rest);
    textureStore(table, at, vec4f(reflected, forwards, backwards, min(around, max(1.0 - backwards, 0.0))));
}
