// One triangle over a whole picture.

struct PictureVarying {
    @builtin(position) position: vec4f,
    // From the top left, 0..1.
    @location(0) uv: vec2f,
}

fn picture_varying(vertex: u32) -> PictureVarying {
    let p = vec2f(f32(vertex % 2u) * 4.0 - 1.0, f32(vertex / 2u) * 4.0 - 1.0);
    return PictureVarying(vec4f(p, 0.0, 1.0), vec2f(p.x * 0.5 + 0.5, 0.5 - p.y * 0.5));
}
