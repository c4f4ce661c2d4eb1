// Light that is about to turn into shade.
import package::bind::shown::shown;
import package::bind::surface::{Border, Surface};
import package::lib::transition::transition_tint;
import package::material::material;

struct Transition {
    color: vec3f,
    strength: f32,
    width: f32,
}

fn transition_shade(s: ptr<function, Surface>, b: ptr<function, Border>) {
    b.tint = transition_tint(b.soft, material.transition.color, material.transition.strength);
    @if(channel_transition) shown = b.tint;
}
