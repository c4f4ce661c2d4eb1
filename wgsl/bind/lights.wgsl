// Light that arrives at a place.
import package::bind::frame::frame;
import package::lib::light::{distance_attenuation, spot_attenuation};

struct Arriving {
    // Unit.
    to_light: vec3f,
    radiance: vec3f,
}

// Light of a point or spot light at a place.
fn punctual_light(i: u32, position: vec3f) -> Arriving {
    let to_light = frame.punctual[i].position - position;
    let distance_sq = dot(to_light, to_light);
    let l = to_light * inverseSqrt(max(distance_sq, 1e-8));
    let radiance = frame.punctual[i].color
        * distance_attenuation(distance_sq, frame.punctual[i].range)
        * spot_attenuation(
            dot(-l, frame.punctual[i].direction), frame.punctual[i].spot_scale, frame.punctual[i].spot_offset
        );
    return Arriving(l, radiance);
}

// Ambient radiance on a surface that faces n.
fn ambient(n_y: f32) -> vec3f {
    return mix(frame.ambient_ground, frame.ambient_sky, n_y * 0.5 + 0.5);
}

// Light that falls on a place from anywhere, at most 1: a line takes it whole, whatever its own direction.
fn arriving_light(position: vec3f) -> vec3f {
    var light = frame.light_color + 0.5 * (frame.ambient_sky + frame.ambient_ground);
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        light += punctual_light(i, position).radiance;
    }
    return min(light, vec3f(1.0));
}
