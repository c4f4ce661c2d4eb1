//! `VRMC_materials_mtoon` 1.0.

use crate::material::{AlphaMode, Matcap, Material, Origin, Outline, OutlineWidth, Rim, Shading, Toon, UvAnimation};

use super::fault::{Result, quoted};
use super::json::Json;
use super::texture::Textures;
use super::warnings::Warnings;

/// Widest outline, metres or picture heights: beyond it a file is broken and the hull would fill the view.
pub(super) const WIDEST_OUTLINE: f32 = 10.0;

/// Reads the extension into the material.
pub(super) fn apply(
    ext: &Json,
    material: &mut Material,
    textures: &mut Textures,
    warnings: &mut Warnings,
) -> Result<()> {
    material.origin = Origin::Mtoon1;
    let color = |key: &str, default: [f32; 3]| -> Result<[f32; 3]> {
        Ok(ext.floats(key)?.unwrap_or(default).map(|c: f32| c.max(0.0)))
    };
    let unit = |key: &str, default: f32| -> Result<f32> { Ok(ext.f32(key)?.unwrap_or(default).clamp(0.0, 1.0)) };

    material.alpha.write_depth =
        material.alpha.mode == AlphaMode::Blend && ext.bool("transparentWithZWrite")?.unwrap_or(false);
    material.alpha.queue_offset = queue_offset(ext, material)?;

    let toon = Toon::default();
    let shift_texture = textures.info(ext, "shadingShiftTexture", warnings)?;
    material.shading = Shading::Toon(Toon {
        shade_color: color("shadeColorFactor", toon.shade_color)?,
        shade_texture: textures.info(ext, "shadeMultiplyTexture", warnings)?,
        shift: ext.f32("shadingShiftFactor")?.unwrap_or(toon.shift).clamp(-1.0, 1.0),
        shift_texture,
        shift_texture_scale: ext.object("shadingShiftTexture")?.map_or(Ok(None), |t| t.f32("scale"))?.unwrap_or(1.0),
        toony: unit("shadingToonyFactor", toon.toony)?,
        gi_equalization: unit("giEqualizationFactor", toon.gi_equalization)?,
    });

    let matcap = textures.info(ext, "matcapTexture", warnings)?;
    let matcap_color = color("matcapFactor", [1.0; 3])?;
    // A factor of 0 is kept: an expression may drive it.
    material.matcap = matcap.map(|t| Matcap { texture: t, color: matcap_color });

    let rim = Rim::default();
    material.rim = Rim {
        color: color("parametricRimColorFactor", rim.color)?,
        fresnel_power: ext.f32("parametricRimFresnelPowerFactor")?.unwrap_or(rim.fresnel_power).max(0.0),
        lift: ext.f32("parametricRimLiftFactor")?.unwrap_or(rim.lift),
        mask: textures.info(ext, "rimMultiplyTexture", warnings)?,
        lighting_mix: unit("rimLightingMixFactor", rim.lighting_mix)?,
    };

    let width = ext.f32("outlineWidthFactor")?.unwrap_or(0.0).clamp(0.0, WIDEST_OUTLINE);
    let width = match ext.str("outlineWidthMode")?.unwrap_or("none") {
        "worldCoordinates" => Some(OutlineWidth::World { metres: width }),
        "screenCoordinates" => Some(OutlineWidth::Screen { height_ratio: width }),
        "none" => None,
        other => {
            warnings.add(ext.pointer(), format!("unknown outlineWidthMode {}: no outline", quoted(other)));
            None
        }
    };
    let outline = Outline {
        width: width.unwrap_or(OutlineWidth::World { metres: 0.0 }),
        width_mask: textures.info(ext, "outlineWidthMultiplyTexture", warnings)?,
        color: color("outlineColorFactor", [0.0; 3])?,
        lighting_mix: unit("outlineLightingMixFactor", 1.0)?,
        ..Outline::default()
    };
    material.outline = width.map(|_| outline);

    material.uv_animation = UvAnimation {
        mask: textures.info(ext, "uvAnimationMaskTexture", warnings)?,
        scroll_u_per_s: ext.f32("uvAnimationScrollXSpeedFactor")?.unwrap_or(0.0),
        scroll_v_per_s: ext.f32("uvAnimationScrollYSpeedFactor")?.unwrap_or(0.0),
        rotation_rad_per_s: ext.f32("uvAnimationRotationSpeedFactor")?.unwrap_or(0.0),
    };
    Ok(())
}

/// The specification allows -9..0 without depth writing and 0..9 with it, and nothing for opaque materials.
fn queue_offset(ext: &Json, material: &Material) -> Result<i32> {
    let offset = ext.f32("renderQueueOffsetNumber")?.unwrap_or(0.0).clamp(-9.0, 9.0) as i32;
    Ok(match (material.alpha.mode, material.alpha.write_depth) {
        (AlphaMode::Blend, true) => offset.max(0),
        (AlphaMode::Blend, false) => offset.min(0),
        _ => 0,
    })
}
