// Numbers of a coat of short hair; wgsl/pass/fluff.wgsl draws its shells.

struct Fluff {
    shells: u32,
    length_m: f32,
    density: f32,
    softness: f32,
    gravity_m: f32,
    wind_m: f32,
    wind_period_s: f32,
    root_light: f32,
    ruffle: f32,
}
