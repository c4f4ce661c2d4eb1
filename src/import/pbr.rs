//! glTF's metallic-roughness material as a toon material.

use crate::material::{Material, Origin, Rim, Shading, Standard, Toon};

use super::fault::Result;
use super::json::Json;
use super::texture::Textures;
use super::warnings::Warnings;

/// Shade over lit colour, linear: about three quarters as bright to the eye, turned a little towards violet, as painters
/// shade skin, cloth and hair alike.
const SHADE_TINT: [f32; 3] = [0.49, 0.45, 0.53];

/// Lit colour as it is, shade a darker, cooler version of it over the same texture; the physical surface for looks that show it.
pub(super) fn apply(
    json: &Json,
    material: &mut Material,
    textures: &mut Textures,
    warnings: &mut Warnings,
) -> Result<()> {
    let (mut metallic, mut masked) = (0.0, false);
    let mut surface = Standard { metallic: 1.0, roughness: 1.0, ..Standard::default() };
    if let Some(pbr) = json.object("pbrMetallicRoughness")? {
        let factor = pbr.f32("metallicFactor")?.map(|m| m.clamp(0.0, 1.0));
        surface.metallic = factor.unwrap_or(1.0);
        surface.roughness = pbr.f32("roughnessFactor")?.unwrap_or(1.0).clamp(0.0, 1.0);
        surface.map = textures.info(&pbr, "metallicRoughnessTexture", warnings)?;
        masked = surface.map.is_some();
        // The default of 1 is meant for files that bring a texture; taken by itself it is most often an oversight.
        metallic = factor.unwrap_or(0.0);
    }
    if let Some(occlusion) = json.object("occlusionTexture")? {
        surface.occlusion = textures.info(json, "occlusionTexture", warnings)?;
        surface.occlusion_strength = occlusion.f32("strength")?.unwrap_or(1.0).clamp(0.0, 1.0);
    }
    if let Some(ior) = json.extension("KHR_materials_ior")? {
        surface.ior = ior.f32("ior")?.unwrap_or(1.5).clamp(1.0, 3.0);
    }
    material.authored.surface = Some(surface);
    material.origin = Origin::Pbr;
    let [r, g, b, _] = material.base.color;
    let [tr, tg, tb] = SHADE_TINT;
    material.shading = Shading::Toon(Toon {
        shade_color: [r * tr, g * tg, b * tb],
        shade_texture: material.base.texture,
        shift: -0.05,
        ..Toon::default()
    });
    if metallic > 0.5 && !masked {
        // Metal has no diffuse light of its own: a rim of its colour stands for the reflected surroundings.
        material.rim =
            Rim { color: [r, g, b].map(|c| c * 0.25 * metallic), fresnel_power: 3.0, lift: 0.05, ..Rim::default() };
    }
    Ok(())
}
