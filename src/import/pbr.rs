//! glTF's metallic-roughness material as a toon material.

use crate::material::{Material, Origin, Rim, Shading, Toon};

use super::fault::Result;
use super::json::Json;

/// Shade over lit colour, linear: about three quarters as bright to the eye, turned a little towards violet, as painters
/// shade skin, cloth and hair alike.
const SHADE_TINT: [f32; 3] = [0.49, 0.45, 0.53];

/// Lit colour as it is, shade a darker, cooler version of it over the same texture.
pub(super) fn apply(json: &Json, material: &mut Material) -> Result<()> {
    let (mut metallic, mut masked) = (0.0, false);
    if let Some(pbr) = json.object("pbrMetallicRoughness")? {
        // The default of 1 is meant for files that bring a texture; taken by itself it is most often an oversight.
        metallic = pbr.f32("metallicFactor")?.unwrap_or(0.0).clamp(0.0, 1.0);
        pbr.f32("roughnessFactor")?;
        masked = pbr.get("metallicRoughnessTexture").is_some();
    }
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
