// The base colour, whatever the light.
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface, shaded_of};

fn unlit_model(s: ptr<function, Surface>) -> Shaded {
    var l = shaded_of(s);
    l.direct = s.lit;
    @if(channel) shown = s.lit + s.emission;
    return l;
}
