// Numbers of a coat of short hair; wgsl/pass/fluff.wgsl draws its shells.

struct Fluff {
    shells: f32,
    length: f32,
    density: f32,
    softness: f32,
    gravity: f32,
    wind: f32,
    period: f32,
    root: f32,
    ruffle: f32,
}
