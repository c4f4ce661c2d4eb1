// The table of azimuthal scattering of fibres of one roughness and index: an entry for an angle about the fibre, an inclination
// of the view, and what half a pass lets through. R, TT, TRT and the rest, 1/rad; the last two columns hold the
// energies of R, of all that goes forwards and backwards, and of what goes about among many fibres and comes back.
import package::lib::fibre::{Detector, PI, TABLE_ANGLES, fibre_azimuthal};

struct FibreNumbers {
    width: f32,
    ior: f32,
    is_gaussian: u32,
    nodes: u32,
}

@group(0) @binding(0) var<uniform> numbers: FibreNumbers;
@group(0) @binding(1) var table: texture_storage_3d<rgba16float, write>;

// For the energies: drivers end loops after 65536 rounds.
const COARSE: u32 = 48u;

// Of light that has met three fibres and more, and comes back: its share, and what of it meets two more. Both by the pictures of
// a path tracer (`cargo xtask compare-real hair`), whose hair of four colours follows this sum within 6 %.
const AROUND: f32 = 0.137;
const FURTHER: f32 = 0.66;

@compute @workgroup_size(8, 8, 1)
fn main(@builtin(global_invocation_id) at: vec3u) {
    let size = textureDimensions(table);
    if any(at >= size) {
        return;
    }
    let up = 1.0 - f32(at.y) / f32(size.y - 1u);
    let cos_o = up * up;
    let sin_o = sqrt(1.0 - cos_o * cos_o);
    // Half of what one pass absorbs; whole darkness stands for an absorption of 32.
    let absorption = -2.0 * log(max(f32(at.z) / f32(size.z - 1u), 1.1e-7));
    let detector = Detector(numbers.width, numbers.is_gaussian == 1u);
    if at.x < TABLE_ANGLES {
        let phi = f32(at.x) / f32(TABLE_ANGLES - 1u) * PI;
        let n = fibre_azimuthal(phi, sin_o, cos_o, numbers.ior, absorption, detector, numbers.nodes);
        textureStore(table, at, n);
        return;
    }
    var forwards = 0.0;
    var backwards = 0.0;
    // By R alone.
    var reflected = 0.0;
    for (var i = 0u; i < COARSE; i++) {
        let phi = (f32(i) + 0.5) / f32(COARSE) * PI;
        let n = fibre_azimuthal(phi, sin_o, cos_o, numbers.ior, absorption, detector, COARSE);
        // Both sides.
        let step = 2.0 * PI / f32(COARSE);
        let sum = dot(n, vec4f(1.0)) * step;
        forwards += select(0.0, sum, phi > 0.5 * PI);
        backwards += select(sum, 0.0, phi > 0.5 * PI);
        reflected += select(n.x * step, 0.0, phi > 0.5 * PI);
    }
    // What a fibre does not keep goes on to others.
    let met = forwards + backwards;
    let around = AROUND * met * met * met / (1.0 - FURTHER * met * met);
    textureStore(table, at, vec4f(reflected, forwards, backwards, around));
}
