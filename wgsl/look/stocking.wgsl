// Thin knit.
import package::bind::shown::shown;
import package::bind::surface::Surface;
import package::lib::paint::{Painted, painted};
import package::lib::stocking::stocking_cover;
import package::material::material;

struct Stocking {
    color: vec3f,
    cover: f32,
}

fn stocking_paint(s: ptr<function, Surface>) {
    let cover = stocking_cover(material.stocking.cover, abs(dot(s.normal, s.view)));
    let over = painted(Painted(s.lit, s.shade), material.stocking.color, cover, false);
    s.lit = over.lit;
    s.shade = over.shade;
    @if(channel_overlay) shown = max(shown, vec3f(cover));
}
