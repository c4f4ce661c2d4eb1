// A surface on its way through the stages of shading, and the stages in their order. Which looks take part is written in
// the generated module `package::material`, stage by stage. Stages pass it on by pointer: drivers spend most of a pipeline's
// making on copies of structs.
import package::bind::frame::frame;
import package::bind::lights::punctual_light;
import package::bind::shown::shown;
import package::bind::varying::Varying;
import package::lib::color::srgb_from_linear;
import package::lib::normal::normalize_or;
import package::material::{
    stage_bend, stage_contour, stage_lamps, stage_model, stage_paint, stage_shine, stage_surface, stage_uv, stage_vanish,
};

// What is known of a place of a surface before its model shades it.
struct Surface {
    at: Varying,
    // Both UV sets after the material's animation.
    uv: vec4f,
    // What base colour and alpha are multiplied with: texture and vertex colour.
    texel: vec4f,
    // Colours in full light and in full shade, linear.
    lit: vec3f,
    shade: vec3f,
    alpha: f32,
    emission: vec3f,
    // World, unit, towards the viewer; bent by normal maps.
    normal: vec3f,
    // World, unit, along u.
    tangent: vec3f,
    // World, unit, to the viewer.
    view: vec3f,
    // Of the key light: N·L and radiance.
    n_dot_l: f32,
    light: vec3f,
    // Radiance of lamps that it faces.
    lamps: vec3f,
}

// Where light ends on a toon surface. Looks of the stage `shade` talk to each other through it.
struct Border {
    // Colours in light and in shade.
    lit: vec3f,
    shade: vec3f,
    // How far the border of the model is shifted.
    shift: f32,
    // Share of light with the border of the model, and with that of the transition or the ramp.
    shading: f32,
    soft: f32,
    // Share of the surface that is face: neck and body take no shadow of bangs. Where normals shade it: there it takes the
    // character's own.
    of_face: f32,
    of_body: f32,
    // Share of the key light that arrives, and of the shadow that is received: of bangs, and on ramps of the character itself.
    own_lit: f32,
    received: f32,
    // Place across the warm edge of skin: 0 at the drawn border, -1 where it ends in shade, positive in light.
    @if(skin_edge) edge: f32,
    // What the lit colour and what the whole is multiplied by.
    tint: vec3f,
    bangs: vec3f,
}

// What looks of the stage `shade` start from, where light falls on the whole of it.
fn border_of(s: ptr<function, Surface>) -> Border {
    var b: Border;
    b.lit = s.lit;
    b.shade = s.shade;
    b.shading = 1.0;
    b.soft = 1.0;
    b.of_face = 1.0;
    b.of_body = 1.0;
    b.own_lit = 1.0;
    b.tint = vec3f(1.0);
    b.bangs = vec3f(1.0);
    return b;
}

// A surface that its model has shaded.
struct Shaded {
    // Light from lamps and from all around, and of its own; they are added.
    direct: vec3f,
    ambient: vec3f,
    emission: vec3f,
    // Alpha, and how far it adds its light to what is behind it instead of covering it.
    cover: f32,
    adds: f32,
    // What later looks ask for: lit colour, share of light, share of the key light, radiance of lamps and from all around.
    lit: vec3f,
    shading: f32,
    own_lit: f32,
    light: vec3f,
    gi: vec3f,
    // What a sphere mirrors.
    matcap: vec3f,
}

// What is drawn: linear, straight.
struct Drawn {
    color: vec3f,
    alpha: f32,
    adds: f32,
}

// A place before any light falls on it. A back face is seen with its normal turned (glTF doubleSided).
fn surface_of(in: Varying, front_facing: bool) -> Surface {
    var s: Surface;
    s.at = in;
    @if(uv) s.uv = stage_uv(in.uv);
    s.texel = vec4f(1.0);
    s.lit = vec3f(1.0);
    s.alpha = 1.0;
    @if(lit) s.normal = select(-in.normal, in.normal, front_facing);
    stage_surface(&s);
    return s;
}

// With the frame in which it is shaded.
fn framed(s: ptr<function, Surface>) {
    s.normal = normalize(s.normal);
    @if(tangent) s.tangent = normalize_or(
        s.at.tangent.xyz - s.normal * dot(s.normal, s.at.tangent.xyz), vec3f(0.0)
    );
    @if(lit) s.view = normalize(frame.eye - s.at.world_position);
    stage_bend(s);
}

fn bitangent(s: ptr<function, Surface>) -> vec3f {
    return cross(s.normal, s.tangent) * s.at.tangent.w;
}

// With the light that falls on it.
fn lit_by_lamps(s: ptr<function, Surface>) {
    s.light = frame.light_color;
    s.n_dot_l = dot(s.normal, frame.to_light);
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, s.at.world_position);
        s.lamps += arriving.radiance * smoothstep(-0.2, 0.2, dot(s.normal, arriving.to_light));
    }
    stage_lamps(s);
}

// What lamps add to a surface that they light by so much, as it takes light.
fn taken_from_lamps(surface: ptr<function, Surface>, lamps: vec3f) -> vec3f {
    var s = *surface;
    s.light = frame.light_color + lamps;
    stage_lamps(&s);
    return max(s.light - surface.light, vec3f(0.0));
}

// What a model starts from.
fn shaded_of(s: ptr<function, Surface>) -> Shaded {
    var l: Shaded;
    l.emission = s.emission;
    l.cover = s.alpha;
    l.lit = s.lit;
    l.shading = 1.0;
    l.own_lit = 1.0;
    l.light = s.light;
    @if(punctual) l.light += taken_from_lamps(s, s.lamps);
    return l;
}

// All stages.
fn drawn(in: Varying, front_facing: bool) -> Drawn {
    stage_vanish(in);
    var s = surface_of(in, front_facing);
    @if(lit) framed(&s);
    @if(lit) lit_by_lamps(&s);
    stage_paint(&s);
    var l = stage_model(&s);
    stage_shine(&s, &l);
    var color = stage_contour(&s, &l, l.direct + l.ambient + l.emission);
    @if(channel) color = shown;
    return Drawn(color, l.cover, l.adds);
}

// As the target holds it.
fn encoded(color: vec3f) -> vec3f {
    @if(encode_srgb) return srgb_from_linear(color);
    @if(!encode_srgb) return color;
}
