// Fire.
import package::bind::frame::frame;
import package::bind::material::{material, highlight_texture, highlight_sampler};
import package::bind::options::{CHANNEL_FIRE, SurfaceOptions};
import package::bind::texel::texture_uv;
import package::lib::fire::{fire_color, fire_cover, fire_heat, fire_noise, fire_shape, fire_sway};

// Its colour and cover.
fn burning_shape(options: SurfaceOptions, uv: vec4f) -> vec4f {
    var at = texture_uv(options, uv, material.highlight_uv);
    let phase = fract(frame.time_s / material.fire_period);
    let noise = fire_noise(at, phase, material.fire_cells);
    at.x += fire_sway(at, phase, material.fire_cells, material.fire_sway);
    var drawn = fire_shape(at);
    if options.fire_map {
        drawn = textureSample(highlight_texture, highlight_sampler, at).r;
    }
    let heat = fire_heat(drawn, noise, material.fire_turbulence);
    let cover = fire_cover(heat, material.fire_erosion, material.fire_softness);
    if options.channel == CHANNEL_FIRE {
        return vec4f(vec3f(heat), cover);
    }
    if options.channel != 0u {
        return vec4f(vec3f(0.0), cover);
    }
    let color = fire_color(
        heat, material.fire_rim, material.fire_body, material.fire_heart, material.fire_edges, material.fire_softness
    );
    return vec4f(color, cover);
}
