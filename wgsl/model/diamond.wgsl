// A cut stone that throws light back.
import package::bind::shown::shown;
import package::bind::studio::studio_light;
import package::bind::surface::{Shaded, Surface, bitangent};
import package::lib::diamond::diamond_path;
import package::lib::gem::fresnel;
import package::material::material;
import package::model::standard::physical_light;
import package::model::toon::{toon_border, toon_light};

fn diamond_model(s: ptr<function, Surface>) -> Shaded {
    let m = &material.diamond;
    // What highlights fade by.
    @if(toon) var b = toon_border(s);
    @if(toon) var l = toon_light(s, &b);
    @if(!toon) var l = physical_light(s, s.n_dot_l > 0.0);
    // A shadow takes the key light; scattered light stays.
    let light = l.light * mix(0.3, 1.0, l.own_lit);
    let across = bitangent(s);
    // Texture coordinates run across the stone.
    let start = vec3f(clamp((s.at.uv.xy - 0.5) * vec2f(0.9, -0.9), vec2f(-0.4), vec2f(0.4)), 0.2);
    var inner = vec3f(0.0);
    for (var c = 0; c < 3; c++) {
        let r = refract(-s.view, s.normal, 1.0 / m.ior[c]);
        let inside = normalize(vec3f(dot(r, s.tangent), dot(r, across), dot(r, s.normal)));
        let exit = diamond_path(start, inside, m.ior[c], m.bounces, f32(m.facets));
        let d = s.tangent * exit.direction.x + across * exit.direction.y + s.normal * exit.direction.z;
        inner[c] = studio_light(d, light, l.gi, m.brilliance * 0.5, m.brilliance)[c] * exit.share;
    }
    let mirrored = fresnel(saturate(dot(s.normal, s.view)), m.ior.y);
    let sky = studio_light(reflect(-s.view, s.normal), light, l.gi, m.brilliance * 0.5, m.brilliance);
    l.direct = mix(inner * m.color, sky, mirrored);
    @if(channel_stone) shown = vec3f(inner.y, 0.0, mirrored);
    return l;
}
