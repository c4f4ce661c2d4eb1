// A stone that is seen into.
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::studio::studio_light;
import package::bind::surface::{Shaded, Surface, bitangent};
import package::lib::gem::{absorbed, far_normal, fresnel, gathered, parallax};
import package::material::{gem_inclusions, gem_inclusions_sampler, material};
import package::model::standard::physical_light;
import package::model::toon::{toon_border, toon_light};

fn gem_model(s: ptr<function, Surface>) -> Shaded {
    let m = &material.gem;
    // What highlights fade by.
    @if(toon) var b = toon_border(s);
    @if(toon) var l = toon_light(s, &b);
    @if(!toon) var l = physical_light(s, s.n_dot_l > 0.0);
    // A shadow takes the key light; scattered light stays.
    let light = l.light * mix(0.3, 1.0, l.own_lit);
    let r = refract(-s.view, s.normal, 1.0 / m.ior);
    let inside = vec3f(dot(r, s.tangent), dot(r, bitangent(s)), dot(r, s.normal));
    let glow = gathered(far_normal(s.normal, r), frame.to_light, m.caustic_focus);
    let around = l.gi * 0.8 + light * 0.4;
    let through = (around + light * m.caustic * glow) * absorbed(m.color, inside, 1.0);
    // Scattered light comes from a little below the surface, and from around the border of light; where it has come far, it
    // is deeper in colour. Thin borders let it through.
    let wrapped = saturate(dot(s.normal, frame.to_light) * 0.6 + 0.4);
    let far = pow(max(m.color, vec3f(1e-3)), vec3f(1.7 - 0.7 * wrapped));
    let thin = pow(1.0 - saturate(dot(s.normal, s.view)), 3.0);
    let milk = far * (light * (max(wrapped, 0.35) + 0.5 * thin) + l.gi) + m.color * light * (0.2 * m.caustic * glow);
    var body = mix(through, milk, m.cloudiness);
    var enclosed = 0.0;
    @if(gem_inclusions) for (var i = f32(m.layers); i >= 1.0; i -= 1.0) {
        let depth = i / f32(m.layers);
        let moved = parallax(inside, depth * (m.depth_m * m.uv_per_m)) * vec2f(1.0, -1.0);
        // Deeper layers show other parts of the picture.
        let at = s.at.uv.xy + moved + vec2f(0.37, 0.61) * (i - 1.0);
        let found = textureSample(gem_inclusions, gem_inclusions_sampler, at);
        let lit = light * (0.35 + 0.65 * wrapped + glow) + l.gi;
        body = mix(body, found.rgb * lit * absorbed(m.color, inside, depth), found.a);
        enclosed = mix(enclosed, depth, found.a);
    }
    let mirrored = fresnel(saturate(dot(s.normal, s.view)), m.ior) * m.polish;
    let sky = studio_light(reflect(-s.view, s.normal), light, l.gi, 0.0, 24.0);
    l.direct = mix(body, sky, mirrored);
    @if(channel_stone) shown = vec3f(glow, enclosed, mirrored);
    return l;
}
