// Light on skin in pictures, in one texel: a texel is read for each tap.

struct SkinLight {
    // Irradiance over pi.
    light: vec3f,
    // Of the view with the surface.
    cosine: f32,
    // Distance along the view, metres.
    distance: f32,
    // Number of the profile, 0 where there is no skin, and whether a disc finds the light.
    profile: u32,
}

// What a disc finds the light of.
const BY_DISC: u32 = 0x10000u;

fn skin_light_packed(l: SkinLight) -> vec4u {
    // The most that a half float holds.
    let light = min(l.light, vec3f(65504.0));
    return vec4u(
        pack2x16float(light.rg), pack2x16float(vec2f(light.b, l.cosine)), bitcast<u32>(l.distance), l.profile
    );
}

fn skin_light_of(texel: vec4u) -> SkinLight {
    let blue = unpack2x16float(texel.y);
    return SkinLight(vec3f(unpack2x16float(texel.x), blue.x), blue.y, bitcast<f32>(texel.z), texel.w);
}
