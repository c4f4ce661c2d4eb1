// Shadow of a character on itself.

// Place in the map of a point `d` metres from its middle, `scale` being one over its width: u, v downwards, and depth that
// grows away from the light, each 0..1.
fn shadow_place(d: vec3f, right: vec3f, up: vec3f, to_light: vec3f, scale: f32) -> vec3f {
    return vec3f(dot(right, d) * scale + 0.5, 0.5 - dot(up, d) * scale, 0.5 - dot(to_light, d) * scale);
}

// Share of light with a drawn edge: the middle of what filtering spreads, which rounds teeth and corners off.
fn shadow_edge(lit: f32) -> f32 {
    return smoothstep(0.35, 0.65, lit);
}
