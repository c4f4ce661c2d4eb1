// A picture of light on a sphere; the rim adds it.
import package::bind::surface::{Shaded, Surface};
import package::lib::mtoon::mtoon_matcap_uv;
import package::material::{material, matcap_texture, matcap_texture_sampler};

struct Matcap {
    color: vec3f,
}

fn matcap_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    // Images begin at the top left; the lookup has v upwards.
    let uv = mtoon_matcap_uv(s.normal, s.view) * vec2f(1.0, -1.0) + vec2f(0.0, 1.0);
    l.matcap = textureSample(matcap_texture, matcap_texture_sampler, uv).rgb * material.matcap.color;
}
