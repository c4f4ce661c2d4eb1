// What a pipeline includes: constants set at its creation. `surface_options` is the only reader.
import package::bind::surface::SurfaceOptions;

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
// What is drawn in place of the shaded colour; 0: nothing.
override CHANNEL: u32 = 0u;

fn surface_options() -> SurfaceOptions {
    return SurfaceOptions(
        UNLIT, BASE_TEXTURE, SHADE_TEXTURE, SHADE_IS_BASE, SHIFT_TEXTURE, NORMAL_MAP, EMISSION_TEXTURE, MATCAP, RIM,
        RIM_MASK, UV_TRANSFORMS, UV_ANIMATION, UV_ANIMATION_MASK, VERTEX_COLOR, ALPHA_MASK, ALPHA_COVERAGE,
        FACE_SHADOW, FACE_STACK, FACE_BACK, FACE_MASKS, TRANSITION, FACE_PAINT, BANGS_SHADOW, LID_SHADOW, HIGHLIGHT,
        HIGHLIGHT_SECOND, HIGHLIGHT_APART, HIGHLIGHT_BREAKUP, LAYERED, CAST_SHADOW, SHADE_RAMP, RAMP_MAPS, RAMP_PARTS, SHADE_SHIFT,
        LIGHT_RESPONSE, FUR_DETAIL, FUR_COLOR, DEPTH_RIM, CHANNEL
    );
}
