// Shadow of the character on itself.
import package::bind::maps::{shadow_drawn, shadow_receiver, shadow_soft};
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
    @if(skin_edge) wanted = max(wanted, 1.0 + b.edge);
    let soft = shadow_soft(s.at.actor, s.at.shadow, wanted > 0.0);
    b.own_lit = shadow_drawn(s.at.actor, soft);
    // On a face with a map only where that leaves it to normal shading.
    let received = material.cast_shadow.received * b.of_body;
    let left = 1.0 - (1.0 - b.own_lit) * received;
    @if(skin_edge) b.edge = min(b.edge, mix(1.0, 2.0 * soft - 1.0, received));
    b.shading *= left;
    b.soft *= left;
    @if(channel_self_shadow) shown = vec3f(b.own_lit);
    return b;
}
