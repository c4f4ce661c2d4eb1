// Shadow of the bangs.
import package::bind::maps::{BANGS_LAYER, LIDS_LAYER, bangs_from_character, bangs_lit, bangs_nearer};
import package::bind::shown::shown;
import package::bind::surface::{Border, Surface};
import package::bind::varying::Varying;
import package::bind::vertex::Vertex;
import package::lib::bangs::{bangs_depth, bangs_share, bangs_white};
import package::material::material;

struct BangsShadow {
    color: vec3f,
    strength: f32,
    edges: vec2f,
}

// What shade leaves of each colour of the white of an eye.
const WHITE_SHADE: vec3f = vec3f(0.82, 0.8, 0.9);

fn bangs_shadow_vary(v: Vertex, out: ptr<function, Varying>) {
    out.bangs = bangs_from_character(v.actor, v.position);
    out.bangs.z -= bangs_nearer(v.actor, out.normal);
}

fn bangs_shadow_shade(s: ptr<function, Surface>, b: ptr<function, Border>) {
    let m = &material.bangs_shadow;
    // Whites of eyes that are part of the face: lit, or a lavender of no warmth, and not barred by shadows of hair.
    let white = bangs_white(s.lit) * b.of_face;
    b.shade = mix(b.shade, b.lit * WHITE_SHADE, white);
    b.tint = mix(b.tint, vec3f(1.0), white);
    // What is in shade already gets no darker.
    var light = b.shading;
    @if(shade_ramp) light = ceil(b.soft);
    let share = light * b.of_face * (1.0 - white);
    var wanted = share;
    @if(skin_edge) wanted = max(wanted, (1.0 + b.edge) * b.of_face);
    // On eyes lids and lashes alone: bands of hair would cut through what must stay readable.
    @if(bangs_lids) let lit = bangs_lit(s.at.actor, s.at.bangs, LIDS_LAYER, wanted > 0.0);
    @if(!bangs_lids) let lit = bangs_lit(s.at.actor, s.at.bangs, BANGS_LAYER, wanted > 0.0);
    let received = share * bangs_share(lit, m.edges, m.strength);
    b.received = 1.0 - (1.0 - b.received) * (1.0 - received);
    b.bangs = mix(vec3f(1.0), m.color, received);
    @if(skin_edge) b.edge = min(b.edge, mix(1.0, bangs_depth(lit, m.edges), m.strength * b.of_face));
    @if(channel_bangs_shadow) shown = vec3f(lit);
}
