// What a pipeline includes: constants set at its creation, so that what a material does not use costs nothing.
// `surface_options` is their only reader.

override UNLIT: bool = false;
override BASE_TEXTURE: bool = false;
override SHADE_TEXTURE: bool = false;
// The shade texture is the base texture: one lookup serves both.
override SHADE_IS_BASE: bool = false;
override SHIFT_TEXTURE: bool = false;
override NORMAL_MAP: bool = false;
override EMISSION_TEXTURE: bool = false;
override MATCAP: bool = false;
override RIM: bool = false;
override RIM_MASK: bool = false;
override UV_TRANSFORMS: bool = false;
override UV_ANIMATION: bool = false;
override UV_ANIMATION_MASK: bool = false;
override VERTEX_COLOR: bool = false;
override ALPHA_MASK: bool = false;
// Alpha is the share of a pixel's samples instead of a cut.
override ALPHA_COVERAGE: bool = false;
// The shade of a face comes from a threshold map.
override FACE_SHADOW: bool = false;
// Bangs and others cast their shadow on it.
override BANGS_SHADOW: bool = false;
// Its map has several pitches of the light; maps for light from the side to the back; masks for side and back.
override FACE_STACK: bool = false;
override FACE_BACK: bool = false;
override FACE_MASKS: bool = false;
// Light is tinted where it is about to turn into shade.
override TRANSITION: bool = false;
// Blush and lines.
override FACE_PAINT: bool = false;
// Lids and lashes cast theirs on it too.
override LID_SHADOW: bool = false;
// A painted highlight that moves; a second layer of it; whether that moves otherwise; strands that break both.
override HIGHLIGHT: bool = false;
override HIGHLIGHT_SECOND: bool = false;
override HIGHLIGHT_APART: bool = false;
override HIGHLIGHT_BREAKUP: bool = false;
// A card in a stack.
override LAYERED: bool = false;
// The character casts its shadow on it.
override CAST_SHADOW: bool = false;
// Painted steps from shade to light; in pictures; by part; with another hue in shade.
override SHADE_RAMP: bool = false;
override RAMP_MAPS: bool = false;
override RAMP_PARTS: bool = false;
override SHADE_SHIFT: bool = false;
// Bounds of the light.
override LIGHT_RESPONSE: bool = false;
// Painted fur; with detail colours of its own.
override FUR_DETAIL: bool = false;
override FUR_COLOR: bool = false;
// Light along the contour, by depth.
override DEPTH_RIM: bool = false;
// A highlight with a drawn shape; painted; brushed.
override SHAPED_HIGHLIGHT: bool = false;
override SHAPED_MAP: bool = false;
override SHAPED_BRUSHED: bool = false;
// Sparks.
override SPARKLE: bool = false;
// A stone that is seen into; with inclusions; one that throws light back.
override GEM: bool = false;
override GEM_INCLUSIONS: bool = false;
override DIAMOND: bool = false;
// Fire; with a drawn shape.
override FIRE: bool = false;
override FIRE_MAP: bool = false;
// Light of its own that moves; that swells and ebbs.
override EMISSION_SCROLL: bool = false;
override EMISSION_BLINK: bool = false;
// Thin knit; decals.
override STOCKING: bool = false;
override DECALS: bool = false;
// Burns away; fades pixel by pixel; sample by sample.
override DISSOLVE: bool = false;
override DITHER_FADE: bool = false;
override DITHER_SAMPLES: bool = false;
// A mask of the width of the rim by depth; its colour on the shaded side.
override RIM_WIDTH: bool = false;
override RIM_SHADE: bool = false;
// Lines where depth, normal or part change.
override INNER_LINES: bool = false;
// What is drawn in place of the shaded colour; 0: nothing.
override CHANNEL: u32 = 0u;

// Parts of a surface.
struct SurfaceOptions {
    unlit: bool,
    base_texture: bool,
    shade_texture: bool,
    shade_is_base: bool,
    shift_texture: bool,
    normal_map: bool,
    emission_texture: bool,
    matcap: bool,
    rim: bool,
    rim_mask: bool,
    uv_transforms: bool,
    uv_animation: bool,
    uv_animation_mask: bool,
    vertex_color: bool,
    alpha_mask: bool,
    alpha_coverage: bool,
    face_shadow: bool,
    face_stack: bool,
    face_back: bool,
    face_masks: bool,
    transition: bool,
    face_paint: bool,
    bangs_shadow: bool,
    lid_shadow: bool,
    highlight: bool,
    highlight_second: bool,
    highlight_apart: bool,
    highlight_breakup: bool,
    layered: bool,
    cast_shadow: bool,
    shade_ramp: bool,
    ramp_maps: bool,
    ramp_parts: bool,
    shade_shift: bool,
    light_response: bool,
    fur_detail: bool,
    fur_color: bool,
    depth_rim: bool,
    shaped_highlight: bool,
    shaped_map: bool,
    shaped_brushed: bool,
    sparkle: bool,
    gem: bool,
    gem_inclusions: bool,
    diamond: bool,
    fire: bool,
    fire_map: bool,
    emission_scroll: bool,
    emission_blink: bool,
    stocking: bool,
    decals: bool,
    dissolve: bool,
    dither_fade: bool,
    dither_samples: bool,
    rim_width: bool,
    rim_shade: bool,
    inner_lines: bool,
    channel: u32,
}

fn surface_options() -> SurfaceOptions {
    return SurfaceOptions(
        UNLIT, BASE_TEXTURE, SHADE_TEXTURE, SHADE_IS_BASE, SHIFT_TEXTURE, NORMAL_MAP, EMISSION_TEXTURE, MATCAP, RIM,
        RIM_MASK, UV_TRANSFORMS, UV_ANIMATION, UV_ANIMATION_MASK, VERTEX_COLOR, ALPHA_MASK, ALPHA_COVERAGE,
        FACE_SHADOW, FACE_STACK, FACE_BACK, FACE_MASKS, TRANSITION, FACE_PAINT, BANGS_SHADOW, LID_SHADOW, HIGHLIGHT,
        HIGHLIGHT_SECOND, HIGHLIGHT_APART, HIGHLIGHT_BREAKUP, LAYERED, CAST_SHADOW, SHADE_RAMP, RAMP_MAPS, RAMP_PARTS,
        SHADE_SHIFT,
        LIGHT_RESPONSE, FUR_DETAIL, FUR_COLOR, DEPTH_RIM, SHAPED_HIGHLIGHT, SHAPED_MAP, SHAPED_BRUSHED, SPARKLE, GEM,
        GEM_INCLUSIONS, DIAMOND, FIRE, FIRE_MAP, EMISSION_SCROLL, EMISSION_BLINK, STOCKING, DECALS, DISSOLVE, DITHER_FADE, DITHER_SAMPLES, RIM_WIDTH,
        RIM_SHADE, INNER_LINES, CHANNEL
    );
}

// Values of `SurfaceOptions.channel`; `Channel::shader_code` in Rust.
const CHANNEL_FACE_SHADOW: u32 = 1u;
const CHANNEL_TRANSITION: u32 = 2u;
const CHANNEL_FACE_PAINT: u32 = 3u;
const CHANNEL_HIGHLIGHT: u32 = 4u;
const CHANNEL_BANGS_SHADOW: u32 = 5u;
const CHANNEL_LAYER: u32 = 6u;
const CHANNEL_DEPTH_RIM: u32 = 7u;
const CHANNEL_EYES_THROUGH: u32 = 8u;
const CHANNEL_SHADE_RAMP: u32 = 9u;
const CHANNEL_FUR: u32 = 10u;
const CHANNEL_SELF_SHADOW: u32 = 11u;
const CHANNEL_STONE: u32 = 12u;
const CHANNEL_SPARKLE: u32 = 13u;
const CHANNEL_FIRE: u32 = 14u;
const CHANNEL_FLUFF: u32 = 15u;
const CHANNEL_DISSOLVE: u32 = 16u;
const CHANNEL_EMISSION: u32 = 17u;
const CHANNEL_OVERLAY: u32 = 18u;
const CHANNEL_INNER_LINES: u32 = 19u;

// Whether shading needs the tangent frame.
fn has_tangents(options: SurfaceOptions) -> bool {
    return options.normal_map || options.fur_detail || options.gem || options.diamond || options.sparkle
        || options.shaped_brushed;
}
