// Light of a surface's own.
import package::bind::frame::frame;
import package::bind::material::{material, emission_texture, emission_sampler};
import package::bind::options::SurfaceOptions;
import package::bind::texel::texture_uv;
import package::lib::emission::blink;

// `burn` is its place in a dissolve.
fn emitted(options: SurfaceOptions, uv: vec4f, burn: f32) -> vec3f {
    var emission = material.emission;
    if options.emission_texture {
        var at = texture_uv(options, uv, material.emission_uv);
        if options.emission_scroll {
            at += fract(material.emission_scroll * frame.time_s);
        }
        emission *= textureSample(emission_texture, emission_sampler, at).rgb;
    }
    if options.emission_blink {
        emission *= blink(fract(frame.time_s / material.blink_period), material.blink_low, material.blink_sharpness);
    }
    if options.dissolve {
        emission += material.dissolve_color * (1.0 - saturate(burn));
    }
    return emission;
}
