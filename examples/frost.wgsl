// Ice that grows from below; the numbers are those of `Frost` in own_look.rs.
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface};
import package::bind::uv::{UvTransform, texture_uv};
import package::material::{frost_flakes, frost_flakes_sampler, material};

struct Frost {
    color: vec3f,
    height_m: f32,
    softness_m: f32,
    flakes_uv: UvTransform,
}

// Hooked in by its name: what lies over the light of a surface.
fn frost_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    let m = &material.frost;
    var reach = m.height_m;
    @if(frost_flakes) reach += (textureSample(
        frost_flakes, frost_flakes_sampler, texture_uv(s.uv, m.flakes_uv)
    ).r - 0.5) * m.softness_m * 2.0;
    let ice = 1.0 - smoothstep(reach - m.softness_m, reach + m.softness_m, s.at.world_position.y);
    l.direct = mix(l.direct, m.color * l.light * mix(0.6, 1.0, l.shading), ice);
    @if(channel_frost) shown = vec3f(ice);
}
