// A picture of radiance as rough mirrors see it: a side of a cube at a level, by importance sampling of GGX from straight above
// (Karis 2013), each sample read from the mip of its solid angle (Křivánek and Colbert 2008).
import package::bind::picture::picture_varying;
import package::lib::brdf::{LEAST_ALPHA, ggx_distribution};

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var radiance_sampler: sampler;

struct SideVarying {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    // Side, and level.
    @location(1) @interpolate(flat) which: vec2u,
}

const SIDES: u32 = 6u;
const LEVELS: u32 = 6u;
const SAMPLES: u32 = 64u;
const PI: f32 = 3.14159265;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32, @builtin(instance_index) which: u32) -> SideVarying {
    let p = picture_varying(vertex);
    return SideVarying(p.position, p.uv, vec2u(which % SIDES, which / SIDES));
}

// Direction of a place on a side, as cube textures have it.
fn side_direction(side: u32, uv: vec2f) -> vec3f {
    let s = uv.x * 2.0 - 1.0;
    let t = 1.0 - uv.y * 2.0;
    switch side {
        case 0u { return normalize(vec3f(1.0, t, -s)); }
        case 1u { return normalize(vec3f(-1.0, t, s)); }
        case 2u { return normalize(vec3f(s, 1.0, -t)); }
        case 3u { return normalize(vec3f(s, -1.0, t)); }
        case 4u { return normalize(vec3f(s, t, 1.0)); }
        default { return normalize(vec3f(-s, t, -1.0)); }
    }
}

// Place of a direction in the picture.
fn radiance_uv(d: vec3f) -> vec2f {
    return vec2f(atan2(d.x, -d.z) / (2.0 * PI) + 0.5, acos(clamp(d.y, -1.0, 1.0)) / PI);
}

// Solid angle of a texel at d.
fn texel_angle(d: vec3f) -> f32 {
    let size = vec2f(textureDimensions(radiance));
    return 2.0 * PI * PI * sqrt(max(1.0 - d.y * d.y, 1e-4)) / (size.x * size.y);
}

fn radiance_at(d: vec3f, angle: f32) -> vec3f {
    let level = max(0.5 * log2(angle / texel_angle(d)), 0.0);
    return textureSampleLevel(radiance, radiance_sampler, radiance_uv(d), level).rgb;
}

@fragment
fn fs_main(in: SideVarying) -> @location(0) vec4f {
    let n = side_direction(in.which.x, in.uv);
    let roughness = f32(in.which.y) / f32(LEVELS - 1u);
    let alpha = max(roughness * roughness, LEAST_ALPHA);
    if in.which.y == 0u {
        // Of a texel of the cube, at its middle.
        return vec4f(radiance_at(n, 4.0 * PI / (6.0 * 128.0 * 128.0)), 1.0);
    }
    let right = normalize(select(vec3f(1.0, 0.0, 0.0), vec3f(n.z, 0.0, -n.x), abs(n.y) < 0.999));
    let up = cross(n, right);
    var sum = vec3f(0.0);
    var weights = 0.0;
    for (var i = 0u; i < SAMPLES; i++) {
        // Evenly spread by the golden ratio.
        let u = (f32(i) + 0.5) / f32(SAMPLES);
        let turn = 2.0 * PI * fract(f32(i) * 0.61803399);
        let cos_h = sqrt((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u));
        let sin_h = sqrt(max(1.0 - cos_h * cos_h, 0.0));
        let h = right * (sin_h * cos(turn)) + up * (sin_h * sin(turn)) + n * cos_h;
        let l = h * (2.0 * cos_h) - n;
        let n_dot_l = dot(n, l);
        if n_dot_l > 0.0 {
            // Twice as wide as a sample's share: what lies between samples is seen, too.
            let angle = 16.0 / (f32(SAMPLES) * max(ggx_distribution(cos_h, alpha), 1e-4));
            sum += radiance_at(l, angle) * n_dot_l;
            weights += n_dot_l;
        }
    }
    return vec4f(sum / max(weights, 1e-4), 1.0);
}
