// The gentle second band between light and shade.

// What the lit colour is multiplied by: `soft` is 1/2 at the border and 1 where the band ends in full light.
fn transition_tint(soft: f32, color: vec3f, strength: f32) -> vec3f {
    let t = saturate(soft * 2.0 - 1.0);
    return mix(vec3f(1.0), mix(color, vec3f(1.0), t), strength);
}
