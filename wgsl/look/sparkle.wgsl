// Sparks; the grains themselves are in wgsl/lib/sparkle.wgsl.
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::surface::{Border, Shaded, Surface, bitangent};
import package::lib::sparkle::sparkle;
import package::material::material;

struct Sparkle {
    color: vec3f,
    spacing_px: f32,
    spread: f32,
    // Cosine of the half angle in which a grain shines.
    size_cos: f32,
}

fn sparks(s: ptr<function, Surface>) -> f32 {
    let m = &material.sparkle;
    let h = normalize(frame.to_light + s.view);
    let uv = s.at.uv.xy;
    let uv_per_px = max(length(dpdx(uv)), length(dpdy(uv)));
    let of_surface = vec3f(dot(h, s.tangent), dot(h, bitangent(s)), dot(h, s.normal));
    let shine = sparkle(uv, uv_per_px, m.spacing_px, of_surface, m.spread, m.size_cos);
    return shine * smoothstep(0.0, 0.2, dot(s.normal, frame.to_light));
}

fn sparkle_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    let sparkling = sparks(s);
    l.direct += material.sparkle.color * l.light * sparkling * l.own_lit;
    @if(channel_sparkle) shown = vec3f(sparkling);
}

fn sparkle_glow(s: ptr<function, Surface>, b: ptr<function, Border>) -> vec3f {
    return material.sparkle.color * (sparks(s) * b.own_lit);
}
