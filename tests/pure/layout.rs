//! Structs shared with WGSL have the same members at the same offsets on both sides.

use std::mem::{offset_of, size_of};

use hikage::render::uniforms::{
    AffineRows, CharacterUniform, DecalUniform, DeformGroup, DeformVertex, FrameUniform, MaterialUniform, MorphEntry,
    PostUniform, PunctualLightUniform, UvTransformUniform,
};

struct Layout {
    entry: &'static str,
    name: &'static str,
    size: usize,
    members: Vec<(&'static str, usize)>,
}

macro_rules! layout {
    ($entry:literal, $wgsl:literal, $rust:ty { $($member:ident),+ $(,)? }) => {
        Layout {
            entry: $entry,
            name: $wgsl,
            size: size_of::<$rust>(),
            members: vec![$((stringify!($member), offset_of!($rust, $member))),+],
        }
    };
}

#[test]
fn structs_match_their_wgsl() {
    let layouts = [
        layout!(
            "opaque",
            "PunctualLight",
            PunctualLightUniform { position, range, color, spot_scale, direction, spot_offset }
        ),
        layout!(
            "opaque",
            "Frame",
            FrameUniform {
                clip_from_world,
                view_from_world,
                eye,
                time_s,
                to_light,
                aspect,
                light_color,
                punctual_count,
                ambient_sky,
                near,
                ambient_ground,
                coolness,
                instances,
                px_per_m,
                punctual,
            }
        ),
        layout!("post", "PostUniform", PostUniform { background, bloom, tone }),
        layout!("opaque", "UvTransform", UvTransformUniform { row_u, row_v }),
        layout!("opaque", "DecalPlace", DecalUniform { row_u, row_v, sheet, color }),
        layout!(
            "opaque",
            "Material",
            MaterialUniform {
                base_color,
                shade_color,
                shift,
                emission,
                toony,
                rim_color,
                rim_fresnel_power,
                matcap_color,
                rim_lift,
                outline_color,
                outline_width,
                shift_texture_scale,
                gi_equalization,
                rim_lighting_mix,
                outline_lighting_mix,
                scroll_per_s,
                rotation_rad_per_s,
                alpha_cutoff,
                normal_scale,
                face_softness,
                face_overhead_fade,
                face_cosine,
                face_pitches,
                face_pitch_count,
                layer_pull,
                stay_lit,
                transition_width,
                transition_color,
                transition_strength,
                blush_color,
                blush_strength,
                line_color,
                shadow_line_strength,
                nose_line_yaw,
                nose_line_strength,
                depth_rim_width,
                depth_rim_color,
                depth_rim_threshold,
                depth_rim_side,
                second_motion,
                second_strength,
                second_color,
                highlight_breakup,
                depth_rim_tint,
                dissolve_border,
                bangs_color,
                bangs_strength,
                bangs_edges,
                highlight_in_shade,
                highlight_facing,
                highlight_color,
                highlight_strength,
                highlight_turn,
                highlight_light,
                highlight_view,
                ramp_terminator,
                ramp_v,
                ramp_edges,
                ramp_part_v,
                shade_shift_warm,
                shade_shift_cool,
                light_bounds,
                light_monochrome,
                fur_softness,
                fur_shares,
                fur_normal_scale,
                fur_terminator,
                fur_blur,
                shadow_received,
                outline_tint,
                outline_gamma,
                outline_bounds,
                outline_push,
                outline_shift,
                outline_parts,
                shaped_color,
                shaped_strength,
                shaped_move,
                shaped_split,
                shaped_turn,
                shaped_squash,
                shaped_size,
                shaped_square,
                shaped_in_shade,
                shaped_anisotropy,
                shaped_map_scale,
                matcap_mix,
                sparkle_px,
                sparkle_spread,
                sparkle_cos,
                sparkle_color,
                gem_ior,
                gem_color,
                gem_cloudiness,
                gem_depth_uv,
                gem_layers,
                gem_caustic,
                gem_focus,
                gem_polish,
                diamond_bounces,
                diamond_facets,
                diamond_brilliance,
                diamond_color,
                fire_erosion,
                diamond_ior,
                fire_softness,
                fire_rim,
                fire_turbulence,
                fire_body,
                fire_sway,
                fire_heart,
                fire_additive,
                fire_edges,
                fire_period,
                fire_cells,
                emission_scroll,
                blink_low,
                blink_sharpness,
                blink_period,
                dissolve_amount,
                dissolve_cells,
                dissolve_color,
                dither_opacity,
                dither_near,
                stocking_cover,
                decal_set,
                stocking_color,
                decal_count,
                decals,
                depth_rim_shade,
                depth_rim_punctual,
                depth_rim_fade,
                fluff_shells,
                fluff_length,
                fluff_density,
                fluff_softness,
                fluff_gravity,
                fluff_wind,
                fluff_period,
                fluff_root,
                glow,
                glow_highlight,
                line_tint,
                line_width,
                line_steps,
                line_parts,
                fluff_ruffle,
                rim_width_uv,
                base_uv,
                shade_uv,
                shift_uv,
                normal_uv,
                emission_uv,
                rim_mask_uv,
                outline_mask_uv,
                animation_mask_uv,
                highlight_uv,
                face_paint_uv,
                detail_color_uv,
                detail_normal_uv,
                part_ids_uv,
            }
        ),
        layout!(
            "opaque",
            "Character",
            CharacterUniform {
                face_left,
                face_up,
                face_forward,
                bangs_row_u,
                bangs_row_v,
                bangs_row_depth,
                bangs_world_row_u,
                bangs_world_row_v,
                bangs_world_row_depth,
                bangs_hardness,
                bangs_bias,
                through_opacity,
                through_window,
                through_fade_yaw,
                through_fade_pitch,
                head,
                shadow_right,
                shadow_scale,
                shadow_up,
                shadow_bias,
                shadow_to_light,
                shadow_spread,
                shadow_middle,
                shadow_layers
            }
        ),
        layout!(
            "deform",
            "DeformGroup",
            DeformGroup { first_vertex, first_influence, influences_per_vertex, first_joint, first_weight }
        ),
        layout!("deform", "Joint", AffineRows { row_x, row_y, row_z }),
    ];
    for layout in layouts {
        let (members, size) = reflect(layout.entry, layout.name);
        assert_eq!(members, layout.members, "{}", layout.name);
        assert_eq!(size, layout.size, "size of {}", layout.name);
    }
    // Vectors of the CPU are single numbers in these, because WGSL would align them to 16 bytes.
    let (members, size) = reflect("deform", "DeformVertex");
    assert_eq!(size, size_of::<DeformVertex>());
    assert_eq!(offset(&members, "x"), offset_of!(DeformVertex, position));
    assert_eq!(offset(&members, "normal"), offset_of!(DeformVertex, normal));
    assert_eq!(offset(&members, "tangent"), offset_of!(DeformVertex, tangent));
    assert_eq!(offset(&members, "outline_normal"), offset_of!(DeformVertex, outline_normal));
    let (members, size) = reflect("deform", "MorphEntry");
    assert_eq!(size, size_of::<MorphEntry>());
    assert_eq!(offset(&members, "target_index"), offset_of!(MorphEntry, target_index));
    assert_eq!(offset(&members, "dx"), offset_of!(MorphEntry, position));
    assert_eq!(offset(&members, "nx"), offset_of!(MorphEntry, normal));
}

fn offset(members: &[(&'static str, usize)], name: &str) -> usize {
    members.iter().find(|(n, _)| *n == name).unwrap_or_else(|| panic!("no member {name}")).1
}

/// Members with offsets, and the size, of a struct of an entry's linked text.
fn reflect(entry: &str, name: &str) -> (Vec<(&'static str, usize)>, usize) {
    let (_, text) = hikage::shaders::ENTRIES.iter().find(|(stem, _)| *stem == entry).expect("an entry of that name");
    let module = naga::front::wgsl::parse_str(text).expect("valid WGSL");
    let found = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name));
    let (_, ty) = found.unwrap_or_else(|| panic!("{entry} has no struct {name}"));
    let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is no struct") };
    let list = members
        .iter()
        .map(|m| (&*Box::leak(m.name.clone().unwrap_or_default().into_boxed_str()), m.offset as usize))
        .collect();
    (list, *span as usize)
}
