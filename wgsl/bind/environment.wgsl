// Light from all around: a picture of the environment, or sky and ground.
import package::bind::frame::{environment_map, environment_sampler, frame, split_sum};
import package::bind::lights::ambient;
import package::lib::split_sum::{SPLIT_SUM_SIDE, split_sum_place};

// A direction of the world in the picture of the environment.
fn in_environment(d: vec3f) -> vec3f {
    let c = frame.environment_turn.x;
    let s = frame.environment_turn.y;
    return vec3f(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
}

// Irradiance over pi on a surface that faces n: what a white one shows.
@if(environment)
fn environment_irradiance(n: vec3f) -> vec3f {
    let d = in_environment(n);
    let h = &frame.irradiance;
    let sum = h[0] + h[1] * d.y + h[2] * d.z + h[3] * d.x + h[4] * (d.x * d.y) + h[5] * (d.y * d.z)
        + h[6] * (3.0 * d.z * d.z - 1.0) + h[7] * (d.x * d.z) + h[8] * (d.x * d.x - d.y * d.y);
    return max(sum.rgb, vec3f(0.0));
}

@if(!environment)
fn environment_irradiance(n: vec3f) -> vec3f {
    return ambient(n.y);
}

// Radiance that a surface of this roughness mirrors from d.
@if(environment)
fn environment_radiance(d: vec3f, roughness: f32) -> vec3f {
    let level = saturate(roughness) * frame.environment_level;
    return textureSampleLevel(environment_map, environment_sampler, in_environment(d), level).rgb
        * frame.environment_strength;
}

@if(!environment)
fn environment_radiance(d: vec3f, roughness: f32) -> vec3f {
    return ambient(d.y);
}

// Scale and bias of the reflectance at normal incidence (Karis 2013), whose sum is the light that a perfect mirror of this
// roughness gives back in one bounce.
fn environment_brdf(n_dot_v: f32, roughness: f32) -> vec2f {
    let at = split_sum_place(n_dot_v, roughness);
    let first = vec2u(min(at, vec2f(f32(SPLIT_SUM_SIDE) - 2.0)));
    let f = at - vec2f(first);
    let low = mix(split_sum_entry(first.x, first.y), split_sum_entry(first.x + 1u, first.y), f.x);
    let high = mix(split_sum_entry(first.x, first.y + 1u), split_sum_entry(first.x + 1u, first.y + 1u), f.x);
    return mix(low, high, f.y);
}

fn split_sum_entry(x: u32, y: u32) -> vec2f {
    let two = split_sum.table[(y * SPLIT_SUM_SIDE + x) / 2u];
    return select(two.xy, two.zw, x % 2u == 1u);
}
