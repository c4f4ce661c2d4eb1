//! Every struct that is shared with WGSL. `tests/layout.rs` compares them with the shaders by reflection.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3};

use crate::{
    color::hue_saturation,
    material::{
        AngleMapping, Decal, MAX_DECALS, MAX_PARTS, MAX_SHELLS, Material, OutlineWidth, Shading, TextureRef,
        UvTransform,
    },
    render::{
        Background, View,
        pass::{bangs_shadow::BangsMap, shadow::ShadowRows},
    },
    scene::{EyesThrough, MAX_PUNCTUAL_LIGHTS, Post, ToneCurve},
    sdf::{FaceMap, MAX_PITCHES},
};

/// Distance between two cards of a stack, metres.
const LAYER_STEP_M: f32 = 1e-4;

/// `PunctualLight` of `wgsl/bind/frame.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct PunctualLightUniform {
    pub position: [f32; 3],
    pub range: f32,
    pub color: [f32; 3],
    pub spot_scale: f32,
    pub direction: [f32; 3],
    pub spot_offset: f32,
}

/// `Frame` of `wgsl/bind/frame.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct FrameUniform {
    pub clip_from_world: [[f32; 4]; 4],
    pub view_from_world: [[f32; 4]; 4],
    pub eye: [f32; 3],
    pub time_s: f32,
    pub to_light: [f32; 3],
    pub aspect: f32,
    pub light_color: [f32; 3],
    pub punctual_count: u32,
    pub ambient_sky: [f32; 3],
    pub near: f32,
    pub ambient_ground: [f32; 3],
    pub coolness: f32,
    pub instances: u32,
    pub px_per_m: f32,
    pub padding_frame: [u32; 2],
    pub punctual: [PunctualLightUniform; MAX_PUNCTUAL_LIGHTS],
}

/// `UvTransform` of `wgsl/bind/material.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct UvTransformUniform {
    pub row_u: [f32; 4],
    pub row_v: [f32; 4],
}

/// `DecalPlace` of `wgsl/bind/material.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct DecalUniform {
    pub row_u: [f32; 4],
    pub row_v: [f32; 4],
    pub sheet: [f32; 4],
    pub color: [f32; 4],
}

/// `Material` of `wgsl/bind/material.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct MaterialUniform {
    pub base_color: [f32; 4],
    pub shade_color: [f32; 3],
    pub shift: f32,
    pub emission: [f32; 3],
    pub toony: f32,
    pub rim_color: [f32; 3],
    pub rim_fresnel_power: f32,
    pub matcap_color: [f32; 3],
    pub rim_lift: f32,
    pub outline_color: [f32; 3],
    pub outline_width: f32,
    pub shift_texture_scale: f32,
    pub gi_equalization: f32,
    pub rim_lighting_mix: f32,
    pub outline_lighting_mix: f32,
    pub scroll_per_s: [f32; 2],
    pub rotation_rad_per_s: f32,
    pub alpha_cutoff: f32,
    pub normal_scale: f32,
    pub face_softness: f32,
    pub face_overhead_fade: f32,
    pub face_cosine: f32,
    pub face_pitches: [f32; MAX_PITCHES],
    pub face_pitch_count: u32,
    pub layer_pull: f32,
    pub stay_lit: f32,
    pub transition_width: f32,
    pub transition_color: [f32; 3],
    pub transition_strength: f32,
    pub blush_color: [f32; 3],
    pub blush_strength: f32,
    pub line_color: [f32; 3],
    pub shadow_line_strength: f32,
    pub nose_line_yaw: [f32; 2],
    pub nose_line_strength: f32,
    pub depth_rim_width: f32,
    pub depth_rim_color: [f32; 3],
    pub depth_rim_threshold: f32,
    pub depth_rim_side: [f32; 2],
    pub second_motion: f32,
    pub second_strength: f32,
    pub second_color: [f32; 3],
    pub highlight_breakup: f32,
    pub depth_rim_tint: f32,
    pub dissolve_border: f32,
    pub padding_rim: [f32; 2],
    pub bangs_color: [f32; 3],
    pub bangs_strength: f32,
    pub bangs_edges: [f32; 2],
    pub highlight_in_shade: f32,
    pub highlight_facing: f32,
    pub highlight_color: [f32; 3],
    pub highlight_strength: f32,
    pub highlight_turn: f32,
    pub highlight_light: f32,
    pub highlight_view: f32,
    pub padding_highlight: f32,
    pub ramp_terminator: [f32; 3],
    pub ramp_v: f32,
    pub ramp_edges: [f32; 4],
    pub ramp_part_v: [f32; MAX_PARTS],
    pub shade_shift_warm: [[f32; 4]; 3],
    pub shade_shift_cool: [[f32; 4]; 3],
    pub light_bounds: [f32; 2],
    pub light_monochrome: f32,
    pub fur_softness: f32,
    pub fur_shares: [f32; 3],
    pub fur_normal_scale: f32,
    pub fur_terminator: [f32; 2],
    pub fur_blur: f32,
    pub shadow_received: f32,
    pub outline_tint: [f32; 3],
    pub outline_gamma: f32,
    pub outline_bounds: [f32; 2],
    pub outline_push: f32,
    pub padding_outline: f32,
    pub outline_shift: [[f32; 4]; 3],
    pub outline_parts: [[f32; 4]; MAX_PARTS],
    pub shaped_color: [f32; 3],
    pub shaped_strength: f32,
    pub shaped_move: [f32; 2],
    pub shaped_split: [f32; 2],
    pub shaped_turn: [f32; 2],
    pub shaped_squash: f32,
    pub shaped_size: f32,
    pub shaped_square: f32,
    pub shaped_in_shade: f32,
    pub shaped_anisotropy: f32,
    pub shaped_map_scale: f32,
    pub matcap_mix: f32,
    pub sparkle_px: f32,
    pub sparkle_spread: f32,
    pub sparkle_cos: f32,
    pub sparkle_color: [f32; 3],
    pub gem_ior: f32,
    pub gem_color: [f32; 3],
    pub gem_cloudiness: f32,
    pub gem_depth_uv: f32,
    pub gem_layers: f32,
    pub gem_caustic: f32,
    pub gem_focus: f32,
    pub gem_polish: f32,
    pub diamond_bounces: u32,
    pub diamond_facets: f32,
    pub diamond_brilliance: f32,
    pub diamond_color: [f32; 3],
    pub fire_erosion: f32,
    pub diamond_ior: [f32; 3],
    pub fire_softness: f32,
    pub fire_rim: [f32; 3],
    pub fire_turbulence: f32,
    pub fire_body: [f32; 3],
    pub fire_sway: f32,
    pub fire_heart: [f32; 3],
    pub fire_additive: f32,
    pub fire_edges: [f32; 2],
    pub fire_period: f32,
    pub fire_cells: i32,
    pub emission_scroll: [f32; 2],
    pub blink_low: f32,
    pub blink_sharpness: f32,
    pub blink_period: f32,
    pub dissolve_amount: f32,
    pub dissolve_cells: [i32; 2],
    pub dissolve_color: [f32; 3],
    pub dither_opacity: f32,
    pub dither_near: [f32; 2],
    pub stocking_cover: f32,
    pub decal_set: f32,
    pub stocking_color: [f32; 3],
    pub decal_count: u32,
    pub decals: [DecalUniform; MAX_DECALS],
    pub depth_rim_shade: [f32; 3],
    pub depth_rim_punctual: f32,
    pub depth_rim_fade: [f32; 2],
    pub fluff_shells: f32,
    pub fluff_length: f32,
    pub fluff_density: f32,
    pub fluff_softness: f32,
    pub fluff_gravity: f32,
    pub fluff_wind: f32,
    pub fluff_period: f32,
    pub fluff_root: f32,
    pub glow: f32,
    pub glow_highlight: f32,
    pub line_tint: [f32; 3],
    pub line_width: f32,
    pub line_steps: [f32; 2],
    pub line_parts: f32,
    pub fluff_ruffle: f32,
    pub rim_width_uv: UvTransformUniform,
    pub base_uv: UvTransformUniform,
    pub shade_uv: UvTransformUniform,
    pub shift_uv: UvTransformUniform,
    pub normal_uv: UvTransformUniform,
    pub emission_uv: UvTransformUniform,
    pub rim_mask_uv: UvTransformUniform,
    pub outline_mask_uv: UvTransformUniform,
    pub animation_mask_uv: UvTransformUniform,
    pub highlight_uv: UvTransformUniform,
    pub face_paint_uv: UvTransformUniform,
    pub detail_color_uv: UvTransformUniform,
    pub detail_normal_uv: UvTransformUniform,
    pub part_ids_uv: UvTransformUniform,
}

/// `Character` of `wgsl/bind/character.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct CharacterUniform {
    pub face_left: [f32; 3],
    pub padding_left: f32,
    pub face_up: [f32; 3],
    pub padding_up: f32,
    pub face_forward: [f32; 3],
    pub padding_forward: f32,
    pub bangs_row_u: [f32; 4],
    pub bangs_row_v: [f32; 4],
    pub bangs_row_depth: [f32; 4],
    pub bangs_world_row_u: [f32; 4],
    pub bangs_world_row_v: [f32; 4],
    pub bangs_world_row_depth: [f32; 4],
    pub bangs_hardness: f32,
    pub bangs_bias: f32,
    pub through_opacity: f32,
    pub through_window: f32,
    pub through_fade_yaw: [f32; 2],
    pub through_fade_pitch: [f32; 2],
    pub head: [f32; 3],
    pub padding_head: f32,
    pub shadow_right: [f32; 3],
    pub shadow_scale: f32,
    pub shadow_up: [f32; 3],
    pub shadow_bias: f32,
    pub shadow_to_light: [f32; 3],
    pub shadow_spread: f32,
    pub shadow_middle: [f32; 3],
    pub shadow_layers: u32,
}

/// `PostUniform` of `wgsl/pass/post.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct PostUniform {
    pub background: [f32; 4],
    pub bloom: f32,
    pub tone: u32,
    pub padding: [u32; 2],
}

impl PostUniform {
    pub(crate) fn new(post: Post, background: Background) -> Self {
        let background = match background {
            Background::Transparent => [0.0; 4],
            Background::Color(srgb) => {
                let [r, g, b] = srgb.to_linear().0;
                [r, g, b, 1.0]
            }
        };
        let tone = match post.tone {
            ToneCurve::None => 0,
            ToneCurve::Filmic => 1,
            ToneCurve::Neutral => 2,
        };
        Self { background, bloom: post.bloom.map_or(0.0, |b| b.strength), tone, padding: [0; 2] }
    }
}

/// `DeformVertex` of `wgsl/pass/deform.wgsl`, and the first vertex stream of every draw.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct DeformVertex {
    pub position: [f32; 3],
    pub normal: u32,
    pub tangent: u32,
    pub outline_normal: u32,
}

/// `DeformGroup` of `wgsl/pass/deform.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct DeformGroup {
    pub first_vertex: u32,
    pub first_influence: u32,
    pub influences_per_vertex: u32,
    pub first_joint: u32,
    pub first_weight: u32,
}

/// `MorphEntry` of `wgsl/pass/deform.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct MorphEntry {
    pub target_index: u32,
    pub position: [f32; 3],
    pub normal: [f32; 3],
}

/// Rows of an affine matrix: `Joint` of `wgsl/pass/deform.wgsl`, and the instance stream of every draw.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct AffineRows {
    pub row_x: [f32; 4],
    pub row_y: [f32; 4],
    pub row_z: [f32; 4],
}

impl From<Mat4> for AffineRows {
    fn from(m: Mat4) -> Self {
        Self { row_x: m.row(0).to_array(), row_y: m.row(1).to_array(), row_z: m.row(2).to_array() }
    }
}

/// Second vertex stream of every draw: what does not move.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct StaticVertex {
    pub uv: [f32; 4],
    pub color: [u8; 4],
    pub part: u32,
}

impl FrameUniform {
    /// Uniform of a view.
    pub fn new(view: &View) -> Self {
        let aspect = view.size[0] as f32 / view.size[1] as f32;
        let camera = &view.camera;
        let view_from_world = camera.view_from_world();
        let lights = &view.lights;
        let mut punctual = [PunctualLightUniform::default(); MAX_PUNCTUAL_LIGHTS];
        for (uniform, light) in punctual.iter_mut().zip(&lights.punctual) {
            let (direction, spot_scale, spot_offset) = light.spot.map_or((Vec3::Z, 0.0, 1.0), |spot| {
                // KHR_lights_punctual, "Inner and Outer Cone Angles".
                let outer_cos = spot.outer_rad.cos();
                let scale = 1.0 / (spot.inner_rad.cos() - outer_cos).max(1e-3);
                (spot.direction, scale, -outer_cos * scale)
            });
            *uniform = PunctualLightUniform {
                position: light.position.to_array(),
                range: light.range,
                color: light.color.scaled(light.intensity).0,
                spot_scale,
                direction: direction.to_array(),
                spot_offset,
            };
        }
        Self {
            clip_from_world: (camera.clip_from_view(aspect) * view_from_world).to_cols_array_2d(),
            view_from_world: view_from_world.to_cols_array_2d(),
            eye: camera.eye.to_array(),
            time_s: view.time_s,
            to_light: lights.directional.to_light.normalize_or(Vec3::Z).to_array(),
            aspect,
            light_color: lights.directional.color.scaled(lights.directional.intensity).0,
            punctual_count: lights.punctual.len().min(MAX_PUNCTUAL_LIGHTS) as u32,
            ambient_sky: lights.ambient.sky.0,
            near: camera.near,
            ambient_ground: lights.ambient.ground.0,
            coolness: lights.coolness(),
            instances: view.instances.len() as u32,
            px_per_m: view.px_per_m(),
            padding_frame: [0; 2],
            punctual,
        }
    }
}

impl UvTransformUniform {
    fn new(texture: Option<TextureRef>) -> Self {
        let texture = texture.unwrap_or_default();
        let UvTransform { offset, rotation_rad, scale } = texture.transform;
        let (sin, cos) = rotation_rad.sin_cos();
        // KHR_texture_transform: translation * rotation * scale, v downwards.
        Self {
            row_u: [cos * scale[0], sin * scale[1], offset[0], texture.uv_set as f32],
            row_v: [-sin * scale[0], cos * scale[1], offset[1], 0.0],
        }
    }
}

impl DecalUniform {
    fn new(decal: &Decal) -> Self {
        let (sin, cos) = decal.rotation_rad.sin_cos();
        let [w, h] = decal.size.map(|s| s.abs().max(1e-6));
        let [x, y] = decal.middle;
        // Turned back, scaled, and moved so that 0..1 spans the decal.
        let row = |a: f32, b: f32, scale: f32| {
            let (a, b) = (a / scale, b / scale);
            [a, b, 0.5 - a * x - b * y, 0.0]
        };
        let mut row_v = row(-sin, cos, h);
        row_v[3] = f32::from(u8::from(decal.multiplies));
        Self { row_u: row(cos, sin, w), row_v, sheet: decal.sheet, color: decal.color }
    }
}

impl MaterialUniform {
    /// Uniform of a material; `face_maps` are those of its scene, `metres_per_uv` those of its surfaces.
    pub fn new(material: &Material, face_maps: &[FaceMap], metres_per_uv: [f32; 2]) -> Self {
        let toon = match material.shading {
            Shading::Toon(toon) => toon,
            Shading::Unlit => crate::material::Toon::default(),
        };
        let outline = material.outline.unwrap_or_default();
        let face = material.face_shadow.unwrap_or_default();
        let bangs = material.bangs_shadow.unwrap_or_default();
        let highlight = material.highlight.unwrap_or_default();
        let transition = material.transition.unwrap_or_default();
        let paint = material.face_paint.unwrap_or_default();
        let layer = material.layer.unwrap_or_default();
        let rim = material.depth_rim.unwrap_or_default();
        let ramp = material.shade_ramp.unwrap_or_default();
        let maps = ramp.maps.unwrap_or_default();
        let row_v = |row: u32| {
            let rows = maps.rows.max(1);
            (row.min(rows - 1) as f32 + 0.5) / rows as f32
        };
        let columns =
            |hue_rad: f32, saturation: f32| hue_saturation(hue_rad, saturation).map(|[x, y, z]| [x, y, z, 0.0]);
        let shift = |set: usize| columns(ramp.shade_hue_rad[set], ramp.shade_saturation[set]);
        let tint = outline.tint.unwrap_or_default();
        let parts = tint.parts.unwrap_or_default();
        let response = material.light_response.unwrap_or_default();
        let fur = material.fur_detail.unwrap_or_default();
        let shaped = material.shaped_highlight.unwrap_or_default();
        let sparkle = material.sparkle.unwrap_or_default();
        let gem = material.gem.unwrap_or_default();
        let diamond = material.diamond.unwrap_or_default();
        let fire = material.fire.unwrap_or_default();
        let blink = material.emission.blink.unwrap_or_default();
        let dissolve = material.dissolve.unwrap_or_default();
        let fade = material.dither_fade.unwrap_or_default();
        let stocking = material.stocking.unwrap_or_default();
        let placed = material.decals.as_ref().map_or(&[] as &[_], |d| d.placed.as_slice());
        let fluff = material.fluff.unwrap_or_default();
        let lines = material.inner_lines.unwrap_or_default();
        let glow = material.glow.unwrap_or_default();
        // One painted picture serves whichever of these a material has.
        let painted = material.painted_highlight();
        let pitches = face_maps.get(face.map).map_or([0.0].as_slice(), |m| m.pitches_rad.as_slice());
        let scaled = |color: [f32; 3], by: f32| color.map(|c| c * by);
        let cutoff = match material.alpha.mode {
            crate::material::AlphaMode::Mask => material.alpha.cutoff,
            _ => 0.5,
        };
        Self {
            base_color: material.base.color,
            shade_color: toon.shade_color,
            shift: toon.shift,
            emission: material.emission.color,
            toony: toon.toony,
            rim_color: material.rim.color,
            rim_fresnel_power: material.rim.fresnel_power,
            matcap_color: material.matcap.map_or([0.0; 3], |m| m.color),
            rim_lift: material.rim.lift,
            outline_color: outline.color,
            outline_width: match outline.width {
                OutlineWidth::World { metres } => metres,
                OutlineWidth::Screen { height_ratio } => height_ratio,
            },
            shift_texture_scale: toon.shift_texture_scale,
            gi_equalization: toon.gi_equalization,
            rim_lighting_mix: material.rim.lighting_mix,
            outline_lighting_mix: outline.lighting_mix,
            scroll_per_s: [material.uv_animation.scroll_u_per_s, material.uv_animation.scroll_v_per_s],
            rotation_rad_per_s: material.uv_animation.rotation_rad_per_s,
            alpha_cutoff: cutoff,
            normal_scale: material.normal_map.map_or(1.0, |n| n.scale),
            face_softness: face.softness,
            face_overhead_fade: face.overhead_fade,
            face_cosine: f32::from(u8::from(face.angle == AngleMapping::Cosine)),
            face_pitches: std::array::from_fn(|i| pitches.get(i).copied().unwrap_or(0.0)),
            face_pitch_count: pitches.len().clamp(1, MAX_PITCHES) as u32,
            layer_pull: layer.index.clamp(-8, 8) as f32 * LAYER_STEP_M,
            stay_lit: layer.stay_lit,
            transition_width: material.shade_ramp.map_or(transition.width, |r| r.width).max(1e-3),
            transition_color: transition.color,
            transition_strength: transition.strength,
            blush_color: paint.blush_color,
            blush_strength: paint.blush_strength,
            line_color: paint.line_color,
            shadow_line_strength: paint.shadow_line_strength,
            nose_line_yaw: paint.nose_line_yaw_rad,
            nose_line_strength: paint.nose_line_strength,
            depth_rim_width: rim.width_px,
            depth_rim_color: scaled(rim.color, rim.strength),
            depth_rim_threshold: rim.threshold_m,
            depth_rim_side: rim.light_side,
            second_motion: highlight.second_motion,
            second_strength: highlight.second_strength,
            second_color: highlight.second_color,
            highlight_breakup: highlight.breakup,
            depth_rim_tint: rim.tint,
            dissolve_border: dissolve.border,
            padding_rim: [0.0; 2],
            bangs_color: bangs.color,
            bangs_strength: bangs.strength,
            bangs_edges: bangs.edges,
            highlight_in_shade: highlight.in_shade,
            highlight_facing: highlight.facing,
            highlight_color: highlight.color,
            highlight_strength: highlight.strength,
            highlight_turn: highlight.turn_u,
            highlight_light: highlight.light_v,
            highlight_view: highlight.view_v,
            padding_highlight: 0.0,
            ramp_terminator: ramp.terminator_color,
            ramp_v: row_v(maps.row),
            ramp_edges: ramp.edges,
            ramp_part_v: maps.part_rows.map(row_v),
            shade_shift_warm: shift(0),
            shade_shift_cool: shift(1),
            light_bounds: [response.min, response.max],
            light_monochrome: response.monochrome,
            fur_softness: fur.softness.clamp(1e-4, ((fur.terminator[1] - fur.terminator[0]) * 0.5).max(1e-4)),
            fur_shares: fur.shares,
            fur_normal_scale: fur.normal_scale,
            fur_terminator: fur.terminator,
            fur_blur: fur.blur_levels,
            shadow_received: material.cast_shadow.map_or(0.0, |s| s.received),
            outline_tint: tint.factor,
            outline_gamma: tint.gamma,
            outline_bounds: outline.clamp_px.unwrap_or_default(),
            outline_push: outline.push_m,
            padding_outline: 0.0,
            outline_shift: columns(tint.hue_rad, tint.saturation),
            outline_parts: parts.colors.map(|[r, g, b]| [r, g, b, 1.0]),
            shaped_color: shaped.color,
            shaped_strength: shaped.strength,
            shaped_move: shaped.translate,
            shaped_split: shaped.split,
            shaped_turn: [shaped.rotate_rad.cos(), shaped.rotate_rad.sin()],
            shaped_squash: shaped.squash.clamp(0.0, 0.99),
            shaped_size: shaped.size_rad.clamp(0.0, 1.57).sin(),
            shaped_square: shaped.square,
            shaped_in_shade: shaped.in_shade,
            shaped_anisotropy: shaped.anisotropy,
            shaped_map_scale: 1.0 / shaped.map_width.max(0.05),
            matcap_mix: shaped.matcap_mix,
            sparkle_px: sparkle.spacing_px.clamp(2.0, 64.0),
            sparkle_spread: sparkle.spread,
            sparkle_cos: sparkle.size_rad.clamp(0.02, 0.5).cos(),
            sparkle_color: sparkle.color,
            gem_ior: gem.ior.clamp(1.0, 3.0),
            gem_color: gem.color,
            gem_cloudiness: gem.cloudiness,
            gem_depth_uv: gem.depth_m * gem.uv_per_m,
            gem_layers: gem.layers.clamp(1, 4) as f32,
            gem_caustic: gem.caustic,
            gem_focus: gem.caustic_focus.max(1.0),
            gem_polish: gem.polish,
            diamond_bounces: diamond.bounces.clamp(1, 6),
            diamond_facets: diamond.facets.clamp(4, 16) as f32,
            diamond_brilliance: diamond.brilliance,
            diamond_color: diamond.color,
            fire_erosion: fire.erosion,
            diamond_ior: diamond.ior.map(|n| n.clamp(1.0, 4.0)),
            fire_softness: fire.softness.max(1e-3),
            fire_rim: scaled(fire.colors[0], fire.strength),
            fire_turbulence: fire.turbulence,
            fire_body: scaled(fire.colors[1], fire.strength),
            fire_sway: fire.sway,
            fire_heart: scaled(fire.colors[2], fire.strength),
            fire_additive: fire.additive,
            fire_edges: fire.edges,
            fire_period: fire.period_s.max(0.05),
            fire_cells: fire.cells.clamp(1, 32) as i32,
            emission_scroll: material.emission.scroll_per_s,
            blink_low: blink.low,
            blink_sharpness: blink.sharpness,
            blink_period: blink.period_s.max(0.05),
            dissolve_amount: dissolve.amount,
            dissolve_cells: metres_per_uv.map(|m| (m / dissolve.cell_m.max(1e-4)).round().clamp(1.0, 256.0) as i32),
            dissolve_color: dissolve.color,
            dither_opacity: fade.opacity,
            dither_near: fade.near_m,
            stocking_cover: stocking.cover,
            decal_set: material.decals.as_ref().and_then(|d| d.map).map_or(0.0, |m| m.uv_set as f32),
            stocking_color: stocking.color,
            decal_count: placed.len().min(MAX_DECALS) as u32,
            decals: std::array::from_fn(|i| placed.get(i).map_or_else(DecalUniform::default, DecalUniform::new)),
            depth_rim_shade: scaled(rim.shade_color, rim.strength),
            depth_rim_punctual: rim.punctual,
            depth_rim_fade: rim.fade_m,
            fluff_shells: fluff.shells.clamp(1, MAX_SHELLS) as f32,
            fluff_length: fluff.length_m,
            fluff_density: fluff.density,
            fluff_softness: fluff.softness,
            fluff_gravity: fluff.gravity_m,
            fluff_wind: fluff.wind_m,
            fluff_period: fluff.wind_period_s.max(0.05),
            fluff_root: fluff.root_light,
            glow: glow.emission,
            glow_highlight: glow.highlight,
            line_tint: lines.color,
            line_width: lines.width_px,
            line_steps: [lines.step_m, lines.fold_rad.cos()],
            line_parts: f32::from(u8::from(lines.between_parts)),
            fluff_ruffle: fluff.ruffle,
            rim_width_uv: UvTransformUniform::new(rim.width_mask),
            base_uv: UvTransformUniform::new(material.base.texture),
            shade_uv: UvTransformUniform::new(toon.shade_texture),
            shift_uv: UvTransformUniform::new(toon.shift_texture),
            normal_uv: UvTransformUniform::new(material.normal_map.map(|n| n.texture)),
            emission_uv: UvTransformUniform::new(material.emission.texture),
            rim_mask_uv: UvTransformUniform::new(material.rim.mask),
            outline_mask_uv: UvTransformUniform::new(outline.width_mask),
            animation_mask_uv: UvTransformUniform::new(material.uv_animation.mask),
            highlight_uv: UvTransformUniform::new(painted),
            face_paint_uv: UvTransformUniform::new(Some(paint.map)),
            detail_color_uv: UvTransformUniform::new(fur.detail_color),
            detail_normal_uv: UvTransformUniform::new(Some(fur.detail_normal)),
            part_ids_uv: UvTransformUniform::new(material.part_ids()),
        }
    }
}

impl CharacterUniform {
    /// Uniform of a character whose head is moved so from its rest, with the head's middle at rest, the light in her space,
    /// what takes the world to that, and her shadow on herself.
    pub(crate) fn new(
        head: Mat4,
        middle: Vec3,
        bangs: Option<&BangsMap>,
        through: Option<EyesThrough>,
        to_light: Vec3,
        from_world: Mat4,
        shadow: ShadowRows,
    ) -> Self {
        let [row_u, row_v, row_depth] = bangs.map_or([glam::Vec4::ZERO; 3], |b| b.rows(head, to_light));
        let [hardness, bias] = bangs.map_or([0.0; 2], BangsMap::test);
        let of_world = |row: glam::Vec4| (from_world.transpose() * row).to_array();
        // A bone that is scaled to nothing has no rotation.
        let axis = |axis: Vec3| head.transform_vector3(axis).normalize_or(axis).to_array();
        Self {
            face_left: axis(Vec3::X),
            padding_left: 0.0,
            face_up: axis(Vec3::Y),
            padding_up: 0.0,
            face_forward: axis(Vec3::Z),
            padding_forward: 0.0,
            bangs_row_u: row_u.to_array(),
            bangs_row_v: row_v.to_array(),
            bangs_row_depth: row_depth.to_array(),
            bangs_world_row_u: of_world(row_u),
            bangs_world_row_v: of_world(row_v),
            bangs_world_row_depth: of_world(row_depth),
            bangs_hardness: hardness,
            bangs_bias: bias,
            through_opacity: through.map_or(0.0, |t| t.opacity),
            through_window: through.map_or(0.0, |t| t.window_m),
            through_fade_yaw: through.map_or([0.0; 2], |t| t.fade_yaw_rad),
            through_fade_pitch: through.map_or([0.0; 2], |t| t.fade_pitch_rad),
            head: head.transform_point3(middle).to_array(),
            padding_head: 0.0,
            shadow_right: shadow.right.to_array(),
            shadow_scale: shadow.scale,
            shadow_up: shadow.up.to_array(),
            shadow_bias: shadow.bias,
            shadow_to_light: shadow.to_light.to_array(),
            shadow_spread: shadow.spread,
            shadow_middle: shadow.middle.to_array(),
            shadow_layers: shadow.layers,
        }
    }
}

/// Octahedral snorm16 pair of a unit vector; the CPU side of `wgsl/lib/normal.wgsl`.
pub fn pack_unit(v: [f32; 3]) -> u32 {
    let n = Vec3::from(v).normalize_or(Vec3::Z);
    let p = n / (n.x.abs() + n.y.abs() + n.z.abs());
    let sign = |x: f32| if x >= 0.0 { 1.0 } else { -1.0 };
    let (x, y) = if p.z < 0.0 {
        ((1.0 - p.y.abs()) * sign(p.x), (1.0 - p.x.abs()) * sign(p.y))
    } else {
        (p.x, p.y)
    };
    let quantize = |x: f32| u32::from((x.clamp(-1.0, 1.0) * 32767.0).round() as i16 as u16);
    quantize(x) | quantize(y) << 16
}

/// Inverse of [`pack_unit`].
pub(crate) fn unpack_unit(packed: u32) -> Vec3 {
    let [x, y] = [packed as u16, (packed >> 16) as u16].map(|c| f32::from(c as i16) / 32767.0);
    let z = 1.0 - x.abs() - y.abs();
    let t = (-z).max(0.0);
    let towards = |c: f32| if c >= 0.0 { c - t } else { c + t };
    Vec3::new(towards(x), towards(y), z).normalize_or(Vec3::Z)
}
