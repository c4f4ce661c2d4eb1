// Light that falls on skin, and how far it goes there, for wgsl/pass/scatter_line.wgsl and wgsl/pass/scatter_disc.wgsl.
import package::bind::frame::frame;
import package::bind::surface::{framed, lit_by_lamps, surface_of};
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of};
import package::lib::skin_light::{BY_DISC, SkinLight, skin_light_packed};
import package::material::{material, stage_gone, stage_paint, stage_vanish};
import package::model::skin::skin_irradiance;

struct Irradiance {
    // A packed SkinLight.
    @location(0) light: vec4u,
    // Scattering distance, mm in the scene.
    @location(1) distance: vec4f,
}

@vertex
fn vs_main(in: VertexInput) -> Varying {
    return surface_varying(vertex_of(in));
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> Irradiance {
    stage_vanish(in);
    if stage_gone(in) {
        discard;
    }
    var s = surface_of(in, front_facing);
    framed(&s);
    lit_by_lamps(&s);
    stage_paint(&s);
    let d = material.skin.profile_scattering_distance_mm / material.skin.profile_world_scale;
    // Of the triangle: normal maps change no area.
    let flat = abs(dot(normalize(in.normal), s.view));
    var light: SkinLight;
    light.light = skin_irradiance(&s);
    light.cosine = saturate(flat);
    light.distance = frame.near / max(in.clip_position.z, 1e-12);
    light.profile = u32(material.skin.profile_number);
    @if(skin_disc) light.profile |= BY_DISC;
    return Irradiance(skin_light_packed(light), vec4f(d, 1.0));
}
