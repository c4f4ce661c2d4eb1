// Light of a surface's own.
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::surface::Surface;
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::emission::blink;
import package::material::{emission_texture, emission_texture_sampler, material};

struct Emission {
    color: vec3f,
    blink_low: f32,
    scroll_per_s: vec2f,
    blink_sharpness: f32,
    blink_period_s: f32,
    texture_uv: UvTransform,
}

fn emission_surface(s: ptr<function, Surface>) {
    s.emission = material.emission.color;
    @if(emission_texture) {
        var at = texture_uv(s.uv, material.emission.texture_uv);
        @if(emission_scroll) at += fract(material.emission.scroll_per_s * frame.time_s);
        s.emission *= textureSample(emission_texture, emission_texture_sampler, at).rgb;
    }
    @if(emission_blink) s.emission *= blink(
        fract(frame.time_s / material.emission.blink_period_s), material.emission.blink_low, material.emission.blink_sharpness
    );
    @if(channel_emission) shown = s.emission;
}
