// Surfaces that are on their way out: dissolved, or faded pixel by pixel.
import package::bind::frame::frame;
import package::bind::material::material;
import package::lib::dissolve::{dissolve_place, dissolve_time, dither_samples, dither_threshold};

// Place of a point between what is gone (below 0), the glowing border (0..1) and what is whole.
fn burning(uv: vec2f) -> f32 {
    return dissolve_place(
        dissolve_time(uv, material.dissolve_cells), material.dissolve_amount, material.dissolve_border
    );
}

// What is left of a surface that fades pixel by pixel.
fn dither_left(position: vec3f) -> f32 {
    let near = material.dither_near;
    return material.dither_opacity * smoothstep(near.x, max(near.y, near.x + 1e-4), distance(frame.eye, position));
}

// Whether a pixel is left out.
fn is_dithered_away(pixel: vec2f, position: vec3f) -> bool {
    return dither_left(position) <= dither_threshold(vec2u(pixel));
}

// Which of a pixel's four samples are left.
fn dithered_samples(pixel: vec2f, position: vec3f) -> u32 {
    return dither_samples(dither_left(position), vec2u(pixel));
}
