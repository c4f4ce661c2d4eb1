// What actors stand on: two tones, the texture, lines, and the shadow of the stage.
import package::bind::frame::{frame, in_target};
import package::bind::lights::punctual_light;
import package::lib::color::srgb_from_linear;
import package::lib::shadow::{StageShadow, stage_shadow};

struct GroundNumbers {
    shadow: StageShadow,
    middle: vec3f,
    radius: f32,
    // Linear.
    color: vec3f,
    // Metres.
    texture_size: f32,
    shade: vec3f,
    grid_spacing: f32,
    grid_color: vec3f,
    grid_width: f32,
}

@group(1) @binding(0) var<uniform> ground: GroundNumbers;
@group(1) @binding(1) var shadow_map: texture_depth_2d_array;
@group(1) @binding(2) var shadow_sampler: sampler_comparison;
@group(1) @binding(3) var ground_texture: texture_2d<f32>;
@group(1) @binding(4) var ground_sampler: sampler;

struct GroundVarying {
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
}

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> GroundVarying {
    let corner = vec2f(f32(vertex % 2u), f32(vertex / 2u)) * 2.0 - 1.0;
    let world = ground.middle + vec3f(corner.x, 0.0, corner.y) * ground.radius;
    return GroundVarying(in_target(frame.clip_from_world * vec4f(world, 1.0)), world);
}

// Share of a pixel, `wide` metres along each axis, that lines cover.
fn lines(at: vec2f, wide: vec2f) -> f32 {
    let away = abs(fract(at / ground.grid_spacing + 0.5) - 0.5) * ground.grid_spacing;
    // Those that are narrower than a pixel are as much fainter.
    let cover = min((ground.grid_width * 0.5 - away) / wide + 0.5, min(ground.grid_width / wide, vec2f(1.0)));
    return saturate(max(cover.x, cover.y));
}

@fragment
fn fs_main(in: GroundVarying) -> @location(0) vec4f {
    let up = vec3f(0.0, 1.0, 0.0);
    let fade = 1.0 - smoothstep(0.5, 1.0, distance(in.world, ground.middle) / ground.radius);
    // Edges are finer than a pixel where the ground is seen along itself: four places stand for one.
    let across = dpdx(in.world);
    let down = dpdy(in.world);
    var share = 0.0;
    for (var i = 0; i < 4; i++) {
        let place = vec2f(f32(i) * 0.25 - 0.375, f32((i * 3 + 2) % 5) * 0.25 - 0.375);
        let at = in.world + across * place.x + down * place.y;
        share += 0.25 * stage_shadow(ground.shadow, shadow_map, shadow_sampler, at, up);
    }
    // From below nothing arrives.
    share *= step(0.0, frame.to_light.y);
    @if(shadow_only) {
        // As near to a product as one alpha comes.
        let least = min(ground.shade.x, min(ground.shade.y, ground.shade.z));
        let cover = (1.0 - least) * (1.0 - share) * fade;
        let tint = (ground.shade - least) * 0.5 * (1.0 - share) * fade;
        return vec4f(encoded(tint), cover);
    }
    @if(!shadow_only) {
        let at = in.world.xz;
        var base = ground.color;
        @if(textured) base *= textureSample(ground_texture, ground_sampler, at / ground.texture_size).rgb;
        @if(grid) base = mix(base, ground.grid_color, lines(at, fwidth(at)));
        var color = base * frame.ambient_sky + base * mix(ground.shade, vec3f(1.0), share) * frame.light_color;
        @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
            let arriving = punctual_light(i, in.world);
            color += base * min(arriving.radiance, vec3f(1.0)) * saturate(arriving.to_light.y);
        }
        return vec4f(encoded(color) * fade, fade);
    }
}

fn encoded(color: vec3f) -> vec3f {
    @if(encode_srgb) return srgb_from_linear(color);
    @if(!encode_srgb) return color;
}
