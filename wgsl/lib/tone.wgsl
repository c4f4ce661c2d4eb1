// Tone curves that leave painted colours alone.

const TONE_FILMIC: u32 = 1u;
const TONE_NEUTRAL: u32 = 2u;

// Rolled off above 0.75 towards 1: half by the brightest channel, which keeps the hue, half each channel by itself, which
// lets what is very bright turn to white.
fn tone_filmic(color: vec3f) -> vec3f {
    let start = 0.75;
    let peak = max(color.r, max(color.g, color.b));
    let rolled = 1.0 - (1.0 - start) * exp(-(max(vec4f(color, peak), vec4f(start)) - start) / (1.0 - start));
    let by_hue = color * (rolled.w / max(peak, 1e-6));
    let each = select(rolled.xyz, color, color <= vec3f(start));
    return select(mix(by_hue, each, 0.5), color, peak <= start);
}

// Khronos PBR Neutral without its offset for Fresnel's 4 %: that would change dark painted colours.
fn tone_neutral(color: vec3f) -> vec3f {
    let start = 0.8 - 0.04;
    let peak = max(color.r, max(color.g, color.b));
    let d = 1.0 - start;
    let pressed = 1.0 - d * d / (max(peak, start) + d - start);
    let bent = color * (pressed / max(peak, 1e-6));
    let gone = 1.0 - 1.0 / (0.15 * (peak - pressed) + 1.0);
    return select(mix(bent, vec3f(pressed), gone), color, peak < start);
}

fn toned(color: vec3f, curve: u32) -> vec3f {
    switch curve {
        case TONE_FILMIC { return tone_filmic(color); }
        case TONE_NEUTRAL { return tone_neutral(color); }
        default { return color; }
    }
}
