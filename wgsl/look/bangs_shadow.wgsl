// Shadow of the bangs.
import package::bind::maps::{BANGS_LAYER, LIDS_LAYER, bangs_from_character, bangs_lit};
import package::bind::shown::shown;
import package::bind::surface::{Border, Surface};
import package::bind::varying::Varying;
import package::bind::vertex::Vertex;
import package::lib::bangs::{bangs_depth, bangs_share};
import package::material::material;

struct BangsShadow {
    color: vec3f,
    strength: f32,
    edges: vec2f,
}

fn bangs_shadow_vary(v: Vertex, given: Varying) -> Varying {
    var out = given;
    out.bangs = bangs_from_character(v.actor, v.position);
    return out;
}

fn bangs_shadow_shade(s: Surface, border: Border) -> Border {
    var b = border;
    let m = &material.bangs_shadow;
    // What is in shade already gets no darker.
    var light = b.shading;
    @if(shade_ramp) light = ceil(b.soft);
    let share = light * b.of_face;
    var wanted = share;
    @if(skin_edge) wanted = max(wanted, (1.0 + b.edge) * b.of_face);
    var lit = bangs_lit(s.at.actor, s.at.bangs, BANGS_LAYER, wanted > 0.0);
    @if(bangs_lids) lit = min(lit, bangs_lit(s.at.actor, s.at.bangs, LIDS_LAYER, wanted > 0.0));
    let received = share * bangs_share(lit, m.edges, m.strength);
    b.received = 1.0 - (1.0 - b.received) * (1.0 - received);
    b.bangs = mix(vec3f(1.0), m.color, received);
    @if(skin_edge) b.edge = min(b.edge, mix(1.0, bangs_depth(lit, m.edges), m.strength * b.of_face));
    @if(channel_bangs_shadow) shown = vec3f(lit);
    return b;
}
