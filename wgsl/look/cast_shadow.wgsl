// Shadow of the character on itself.
import package::bind::maps::{shadow_drawn, shadow_receiver, shadow_soft};
import package::bind::shown::shown;
import package::bind::surface::{Border, Surface};
import package::bind::actor::actors;
import package::bind::varying::{Varying, in_face_frame};
import package::bind::vertex::{Vertex, world_position};
import package::lib::face_shadow::face_underside;
import package::lib::normal::normalize_or;
import package::lib::shadow::shadow_edge;
import package::material::material;

struct CastShadow {
    received: f32,
}

fn cast_shadow_vary(v: Vertex, out: ptr<function, Varying>) {
    out.shadow = shadow_receiver(v, out.world_position, out.normal);
    @if(face_shadow) {
        let from_middle = out.world_position - world_position(v, actors[v.actor].head);
        let place = in_face_frame(v, normalize_or(from_middle, vec3f(0.0, 1.0, 0.0)));
        out.shadow.w += UNDERSIDE * face_underside(place.y, in_face_frame(v, out.normal).y);
    }
    // Shells of a coat lie over each other, and its hair is soft: once a vertex instead of once a pixel of each.
    @if(level) out.shadow.x = shadow_soft(v.actor, out.shadow, true);
}

// Share of what the map spreads that is soft on a coat.
const COAT_EDGE: f32 = 0.7;

// How far the underside of the jaw shows in the number of the layer, which is rounded.
const UNDERSIDE: f32 = 0.45;

fn cast_shadow_shade(s: ptr<function, Surface>, b: ptr<function, Border>) {
    var wanted = b.shading;
    @if(shade_ramp) wanted = max(wanted, b.soft);
    @if(skin_edge) wanted = max(wanted, 1.0 + b.edge);
    @if(level) let soft = s.at.shadow.x;
    @if(!level) let soft = shadow_soft(s.at.actor, s.at.shadow, wanted > 0.0);
    @if(level) b.own_lit = min(shadow_edge(soft, COAT_EDGE), actors[s.at.actor].key_light);
    @if(!level) b.own_lit = shadow_drawn(s.at.actor, s.at.shadow, soft);
    // On a face with a map only where that leaves it to normal shading, and below the jaw.
    var of_body = b.of_body;
    @if(face_shadow) of_body = max(of_body, saturate((s.at.shadow.w - round(s.at.shadow.w)) / UNDERSIDE));
    let received = material.cast_shadow.received * of_body;
    let left = 1.0 - (1.0 - b.own_lit) * received;
    @if(skin_edge) b.edge = min(b.edge, mix(1.0, 2.0 * soft - 1.0, received));
    b.shading *= left;
    // By its share and not along the ramp, whose terminator is much narrower than the shadow's soft edge.
    @if(shade_ramp) b.received = 1.0 - left;
    @if(!shade_ramp) b.soft *= left;
    @if(channel_self_shadow) shown = vec3f(b.own_lit);
}
