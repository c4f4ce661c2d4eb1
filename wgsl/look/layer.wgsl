// A card in a stack.
import package::bind::shown::shown;
import package::bind::surface::{Border, Surface};
import package::lib::eyes_through::pulled_depth;
import package::material::material;

struct Layer {
    // Metres by which it stands before its surface.
    pull: f32,
    stay_lit: f32,
}

// What shade leaves of each colour of a drawn eye.
const LAYER_SHADE: vec3f = vec3f(0.8, 0.78, 0.86);

fn layer_place(clip: vec4f) -> vec4f {
    return vec4f(clip.xy, pulled_depth(clip.z, clip.w, material.layer.pull), clip.w);
}

fn layer_shade(s: ptr<function, Surface>, b: ptr<function, Border>) {
    let m = &material.layer;
    // Shade is even and a grey of the card's own colour, not the skin's, and it has no edge.
    @if(lit) {
        b.shade = mix(b.shade, b.lit * LAYER_SHADE, m.stay_lit);
        let even = smoothstep(-1.0, 0.5, s.n_dot_l);
        b.shading = max(mix(b.shading, even, m.stay_lit), m.stay_lit);
        b.soft = max(mix(b.soft, even, m.stay_lit), m.stay_lit);
    }
    // Grey by the index, lighter above.
    @if(channel_layer) shown = vec3f(0.5 + material.layer.pull * 600.0);
}
