// Transfer functions for targets that do not encode by themselves.

// sRGB encoding (IEC 61966-2-1) of linear 0..1.
fn srgb_from_linear(color: vec3f) -> vec3f {
    let c = saturate(color);
    // 1e-9 keeps pow away from 0; the branch below never shows it.
    let high = 1.055 * pow(max(c, vec3f(1e-9)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, c * 12.92, c <= vec3f(0.0031308));
}
