// The table of azimuthal scattering of fibres of one roughness and index: a column for an angle about the fibre, a row for an
// inclination of the view. The first rows hold what leaves a fibre without pigment, the others by which absorption it is lost. The
// last two columns hold energies: what R throws back and forwards, what all else throws back (the rest of all light goes
// forwards), and by which absorption that is lost.
import package::lib::fibre::{Detector, PI, TABLE_ANGLES, TABLE_ROWS, fibre_azimuthal};

struct FibreNumbers {
    width: f32,
    ior: f32,
    is_gaussian: u32,
    nodes: u32,
}

@group(0) @binding(0) var<uniform> numbers: FibreNumbers;
@group(0) @binding(1) var table: texture_storage_2d<rgba16float, write>;

// For the energies: drivers end loops after 65536 rounds.
const COARSE: u32 = 48u;

// Absorption at which what is lost is measured. Ways through a fibre differ little in length (1.5 to 2 radii a pass), so that one
// exponential serves all absorptions.
const MEASURED: f32 = 1.0;

// The inclination of a row, as sine and cosine.
fn inclination(row: u32) -> vec2f {
    let up = 1.0 - f32(row) / f32(TABLE_ROWS - 1u);
    return vec2f(sqrt(1.0 - up * up * up * up), up * up);
}

// R, TT, TRT and the rest at an angle, 1/rad.
fn at_angle(column: u32, o: vec2f, absorption: f32) -> vec4f {
    let detector = Detector(numbers.width, numbers.is_gaussian == 1u);
    let phi = f32(column) / f32(TABLE_ANGLES - 1u) * PI;
    return fibre_azimuthal(phi, o.x, o.y, numbers.ior, absorption, detector, numbers.nodes);
}

// Energies: what R throws back and forwards, what all else does.
fn energies(o: vec2f, absorption: f32) -> vec4f {
    let detector = Detector(numbers.width, numbers.is_gaussian == 1u);
    var sum = vec4f(0.0);
    for (var i = 0u; i < COARSE; i++) {
        let phi = (f32(i) + 0.5) / f32(COARSE) * PI;
        // Both sides.
        let n = fibre_azimuthal(phi, o.x, o.y, numbers.ior, absorption, detector, COARSE) * (2.0 * PI / f32(COARSE));
        let inner = n.y + n.z + n.w;
        sum += select(vec4f(0.0, n.x, 0.0, inner), vec4f(n.x, 0.0, inner, 0.0), phi < 0.5 * PI);
    }
    return sum;
}

// By which absorption light is lost. 1e-20: where next to nothing leaves it is no matter how.
fn absorbed(clear: vec4f, dark: vec4f) -> vec4f {
    return log(max(clear, vec4f(1e-20)) / max(dark, vec4f(1e-20))) / MEASURED;
}

@compute @workgroup_size(8, 8, 1)
fn main(@builtin(global_invocation_id) at: vec3u) {
    if any(at.xy >= textureDimensions(table)) {
        return;
    }
    let o = inclination(at.y % TABLE_ROWS);
    if at.x >= TABLE_ANGLES {
        let clear = energies(o, 0.0);
        let lost = absorbed(clear, energies(o, MEASURED));
        textureStore(table, at.xy, vec4f(clear.xyz, lost.w));
        return;
    }
    let clear = at_angle(at.x, o, 0.0);
    let lost = absorbed(clear, at_angle(at.x, o, MEASURED));
    textureStore(table, at.xy, select(clear, lost, at.y >= TABLE_ROWS));
}
