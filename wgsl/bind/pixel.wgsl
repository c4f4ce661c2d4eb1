// What a fragment gives to the picture: its colour, and the samples that it covers where it may leave some out.
struct Pixel {
    @location(0) color: vec4f,
    @if(covered) @builtin(sample_mask) samples: u32,
}

fn pixel(color: vec4f, samples: u32) -> Pixel {
    var out: Pixel;
    out.color = color;
    @if(covered) out.samples = samples;
    return out;
}
