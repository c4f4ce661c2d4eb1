// How much of a surface blooms, and the light on what shines; wgsl/pass/glow.wgsl draws it.
import package::bind::maps::shadow_lit;
import package::bind::frame::frame;
import package::bind::surface::{Border, Surface};
import package::lib::mtoon::mtoon_shading;
import package::material::material;

struct Glow {
    // Shares of the light of its own, and of highlights.
    emission: f32,
    highlight: f32,
}

// Border of light by the key light alone: highlights fade by it.
fn glow_border(s: ptr<function, Surface>) -> Border {
    var b: Border;
    @if(toon) b.shading = mtoon_shading(dot(s.normal, frame.to_light), material.toon.shift, material.toon.toony);
    @if(!toon) b.shading = saturate(dot(s.normal, frame.to_light));
    b.own_lit = 1.0;
    @if(cast_shadow) {
        b.own_lit = shadow_lit(s.at.actor, s.at.shadow, b.shading > 0.0);
        b.shading *= 1.0 - (1.0 - b.own_lit) * material.cast_shadow.received;
    }
    return b;
}
