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

fn layer_place(clip: vec4f) -> vec4f {
    return vec4f(clip.xy, pulled_depth(clip.z, clip.w, material.layer.pull), clip.w);
}

fn layer_shade(s: Surface, border: Border) -> Border {
    var b = border;
    b.shading = max(b.shading, material.layer.stay_lit);
    b.soft = max(b.soft, material.layer.stay_lit);
    // Grey by the index, lighter above.
    @if(channel_layer) shown = vec3f(0.5 + material.layer.pull * 600.0);
    return b;
}
