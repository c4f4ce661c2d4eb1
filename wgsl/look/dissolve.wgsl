// Surfaces that burn away.
import package::bind::shown::shown;
import package::bind::surface::Surface;
import package::bind::varying::Varying;
import package::lib::dissolve::{dissolve_place, dissolve_time};
import package::material::material;

struct Dissolve {
    color: vec3f,
    amount: f32,
    cell_m: f32,
    border: f32,
}

// Place of a point between what is gone (below 0), the glowing border (0..1) and what is whole.
fn burning(at: vec4f) -> f32 {
    let m = &material.dissolve;
    return dissolve_place(dissolve_time(at.xyz / m.cell_m, at.w), m.amount, m.border);
}

fn dissolve_vanish(in: Varying) {
    // Through holes in a line the hull of the far side would be seen.
    @if(line) if material.dissolve.amount > 0.1 {
        discard;
    }
    if burning(in.burn) < 0.0 {
        discard;
    }
}

fn dissolve_gone(in: Varying) -> bool {
    return burning(in.burn) < 0.0;
}

fn dissolve_surface(s: ptr<function, Surface>) {
    let burn = burning(s.at.burn);
    s.emission += material.dissolve.color * (1.0 - saturate(burn));
    @if(channel_emission) shown = s.emission;
    @if(channel_dissolve) shown = vec3f(saturate(burn), 1.0, 0.0);
}

// Lines grow thin.
fn dissolve_line(width: f32) -> f32 {
    return width * (1.0 - saturate(material.dissolve.amount * 10.0));
}
