// Light that falls on skin, over its texture coordinates, with where that is and how large a texel, for
// wgsl/pass/scatter_uv.wgsl.
import package::bind::surface::{framed, lit_by_lamps, surface_of};
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of};
import package::material::{material, stage_gone, stage_paint, stage_vanish};
import package::model::skin::skin_irradiance;

// Lengths in real mm. The last numbers are how far light of each colour goes.
struct Irradiance {
    // Over pi.
    @location(0) light: vec4f,
    @location(1) place: vec4f,
    // What a texel spans: along u; along v in the direction of u, and across it. 0 where there is nothing.
    @location(2) span: vec4f,
}

@vertex
fn vs_main(in: VertexInput) -> Varying {
    var out = surface_varying(vertex_of(in));
    let at = in.uv.xy * material.skin.layer_uv.xy + material.skin.layer_uv.zw;
    out.clip_position = vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, 0.0, 1.0);
    return out;
}

@fragment
fn fs_main(in: Varying) -> Irradiance {
    let m = &material.skin;
    let mm = 1000.0 * m.profile_world_scale;
    let along_u = dpdx(in.world_position) * mm;
    let along_v = dpdy(in.world_position) * mm;
    stage_vanish(in);
    if stage_gone(in) {
        discard;
    }
    // Mirrored texture coordinates turn no surface.
    var s = surface_of(in, true);
    framed(&s);
    lit_by_lamps(&s);
    stage_paint(&s);
    let u = max(length(along_u), 1e-4);
    let v = dot(along_u, along_v) / u;
    let across = max(length(cross(along_u, along_v)) / u, 1e-4);
    let d = m.profile_scattering_distance_mm;
    return Irradiance(
        vec4f(skin_irradiance(&s), d.r), vec4f(in.world_position * mm, d.g), vec4f(u, v, across, d.b)
    );
}
