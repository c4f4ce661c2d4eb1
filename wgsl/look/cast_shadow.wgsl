// Shadow of the character on itself.
import package::bind::maps::{shadow_lit, shadow_receiver};
import package::bind::shown::shown;
import package::bind::surface::{Border, Surface};
import package::bind::varying::Varying;
import package::bind::vertex::Vertex;
import package::material::material;

struct CastShadow {
    received: f32,
}

fn cast_shadow_vary(v: Vertex, given: Varying) -> Varying {
    var out = given;
    out.shadow = shadow_receiver(v, out.world_position, out.normal);
    return out;
}

fn cast_shadow_shade(s: Surface, border: Border) -> Border {
    var b = border;
    var wanted = b.shading;
    @if(shade_ramp) wanted = max(wanted, b.soft);
    b.own_lit = shadow_lit(s.at.actor, s.at.shadow, wanted > 0.0);
    // On a face with a map only where that leaves it to normal shading.
    let left = 1.0 - (1.0 - b.own_lit) * material.cast_shadow.received * b.of_body;
    b.shading *= left;
    b.soft *= left;
    @if(channel_self_shadow) shown = vec3f(b.own_lit);
    return b;
}
