// Bounds of the light that is taken.
import package::bind::surface::Surface;
import package::lib::light::light_response;
import package::material::material;

struct LightResponse {
    // Least and greatest luminance.
    min: f32,
    max: f32,
    monochrome: f32,
}

fn light_response_lamps(s: ptr<function, Surface>) {
    let m = &material.light_response;
    s.light = light_response(s.light, m.min, m.max, m.monochrome);
}
