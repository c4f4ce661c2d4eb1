// Group 0: what changes once a frame.
import package::lib::normal::unit_from_octahedral;

struct PunctualLight {
    position: vec3f,
    // Metres; 0 for none.
    range: f32,
    // Linear, times intensity.
    color: vec3f,
    spot_scale: f32,
    // Unit, in which the light shines.
    direction: vec3f,
    spot_offset: f32,
}

struct Frame {
    clip_from_world: mat4x4f,
    view_from_world: mat4x4f,
    // clip_from_world of the last picture of a window, without jitter.
    clip_before: mat4x4f,
    eye: vec3f,
    time_s: f32,
    // Unit, from the surface to the light.
    to_light: vec3f,
    // Width over height.
    aspect: f32,
    // Linear, times intensity.
    light_color: vec3f,
    punctual_count: u32,
    ambient_sky: vec3f,
    // Depth is near / distance.
    near: f32,
    ambient_ground: vec3f,
    // 0 warm, 1 cool.
    coolness: f32,
    // Size of a metre at the nearest character.
    px_per_m: f32,
    // Of the picture among those that are averaged.
    number: u32,
    // Distance along the view of the nearest sphere of weighted layers, metres.
    nearest_weighed: f32,
    // Depth of a host is x + y * near / distance.
    host_depth: vec2f,
    // How far the picture is moved under its pixels, and its size.
    jitter_px: vec2f,
    size_px: vec2f,
    punctual: array<PunctualLight, 4>,
    // Irradiance over pi as harmonics: factors of 1, y, z, x, xy, yz, 3z²-1, xz, x²-y²; strength included.
    irradiance: array<vec4f, 9>,
    // Cosine and sine of the turn of the environment, its strength, and its last level; below 0 there is none.
    environment_turn: vec2f,
    environment_strength: f32,
    environment_level: f32,
}

// Scale and bias of the reflectance at normal incidence for light from all around, two places in each; see SPLIT_SUM_SIDE.
struct SplitSum {
    table: array<vec4f, 512>,
}

@group(0) @binding(0) var<uniform> frame: Frame;
// Depth of all surfaces, one sample a pixel; only where a material reads it.
@group(0) @binding(1) var frame_depth: texture_depth_2d;

// Clip position as the depth of the target has it.
fn in_target(clip: vec4f) -> vec4f {
    @if(host_depth) return vec4f(clip.xy, frame.host_depth.x * clip.w + frame.host_depth.y * clip.z, clip.w);
    @if(!host_depth) return clip;
}

// Distance along the view of a fragment of the picture, metres.
fn distance_here(position: vec4f) -> f32 {
    @if(host_depth) return frame.near * frame.host_depth.y / (position.z - frame.host_depth.x);
    @if(!host_depth) return frame.near / max(position.z, 1e-12);
}

// Distance along the view of what stands at a pixel, metres; very far where nothing does.
fn distance_at(pixel: vec2i) -> f32 {
    let last = vec2i(textureDimensions(frame_depth)) - 1;
    return frame.near / max(textureLoad(frame_depth, clamp(pixel, vec2i(0), last), 0), 1e-12);
}

// Radiance of the environment, rougher from level to level; what surfaces of roughness 1 mirror is in the last one.
@group(0) @binding(3) var environment_map: texture_cube<f32>;
@group(0) @binding(4) var environment_sampler: sampler;
@group(0) @binding(5) var<uniform> split_sum: SplitSum;

// Light that has scattered in skin, over pi, of which the mean of two by two pixels is meant; and the distance along the view,
// metres, 0 where there is none.
@group(0) @binding(6) var frame_scattered: texture_2d<f32>;

// Light that has scattered in skin over texture coordinates, over pi, of which the mean of two by two texels is meant; and 1 where
// there is some. A layer for each material of each actor.
@group(0) @binding(7) var frame_skin: texture_2d_array<f32>;

// Normal and part of the nearest surface of each pixel, one sample a pixel; only where a material has inner lines.
@group(0) @binding(2) var frame_surfaces: texture_2d<u32>;

struct SurfaceAt {
    // World, unit.
    normal: vec3f,
    // 0 for none.
    part: u32,
}

fn surface_at(pixel: vec2i) -> SurfaceAt {
    let last = vec2i(textureDimensions(frame_surfaces)) - 1;
    let found = textureLoad(frame_surfaces, clamp(pixel, vec2i(0), last), 0).xy;
    return SurfaceAt(unit_from_octahedral(unpack2x16snorm(found.x)), found.y);
}
