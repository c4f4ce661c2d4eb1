// Surfaces that fade pixel by pixel.
import package::bind::frame::frame;
import package::bind::varying::Varying;
import package::lib::dissolve::{dither_samples, dither_threshold};
import package::material::material;

struct DitherFade {
    near_m: vec2f,
    opacity: f32,
}

// What is left of it.
fn dither_fade_left(in: Varying) -> f32 {
    let near = material.dither_fade.near_m;
    return material.dither_fade.opacity
        * smoothstep(near.x, max(near.y, near.x + 1e-4), distance(frame.eye, in.world_position));
}

// Where a pixel has one sample: whether it is left out.
fn dither_fade_vanish(in: Varying) {
    @if(!dither_samples) if dither_fade_left(in) <= dither_threshold(vec2u(in.clip_position.xy)) {
        discard;
    }
}

// Which of a pixel's four samples are left.
fn dither_fade_samples(in: Varying) -> u32 {
    return dither_samples(dither_fade_left(in), vec2u(in.clip_position.xy));
}

// It counts where it covers half.
fn dither_fade_gone(in: Varying) -> bool {
    return dither_fade_left(in) < 0.5;
}
