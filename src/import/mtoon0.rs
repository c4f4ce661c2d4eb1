//! VRM 0.x `materialProperties`, converted to MToon 1.0 by the migration rules that the VRM consortium published with
//! UniVRM.

use std::collections::BTreeSet;
use std::f32::consts::TAU;

use crate::color::linear_from_srgb;
use crate::material::{
    AlphaMode, Base, Emission, Matcap, Material, NormalMap, Origin, Outline, OutlineWidth, Rim, Shading, TextureRef,
    Toon, UvAnimation, UvTransform,
};

use super::fault::{Result, quoted};
use super::json::Json;
use super::mtoon::WIDEST_OUTLINE;
use super::texture::Textures;
use super::warnings::Warnings;

/// What kind of drawing a VRM 0.x shader asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shader {
    Mtoon,
    UnlitOpaque,
    UnlitCutout,
    UnlitTransparent,
    UnlitTransparentZWrite,
}

/// One entry of `materialProperties` with its place in the draw order.
#[derive(Debug)]
pub(super) struct Properties<'a> {
    json: Json<'a>,
    shader: Shader,
    mode: AlphaMode,
    write_depth: bool,
    queue_offset: i32,
}

/// Reads the entries that replace glTF materials; `None` where the glTF material holds.
pub(super) fn read_properties<'a>(
    vrm0: Option<&Json<'a>>,
    materials: usize,
    warnings: &mut Warnings,
) -> Vec<Option<Properties<'a>>> {
    let mut list: Vec<Option<Properties>> = Vec::new();
    let Some(vrm0) = vrm0 else { return list };
    for (index, json) in vrm0.list("materialProperties").into_iter().enumerate() {
        if index >= materials {
            warnings.add(
                json.pointer(),
                format!("more materialProperties than the {materials} materials: the rest is ignored"),
            );
            break;
        }
        let shader = match json.text("shader") {
            "VRM/MToon" => Some(Shader::Mtoon),
            "VRM/UnlitTexture" => Some(Shader::UnlitOpaque),
            "VRM/UnlitCutout" => Some(Shader::UnlitCutout),
            "VRM/UnlitTransparent" => Some(Shader::UnlitTransparent),
            "VRM/UnlitTransparentZWrite" => Some(Shader::UnlitTransparentZWrite),
            "VRM_USE_GLTFSHADER" | "" => None,
            other => {
                warnings.add(json.pointer(), format!("unknown shader {}: the glTF material is used", quoted(other)));
                None
            }
        };
        list.push(shader.map(|shader| {
            let (mode, write_depth) = blending(shader, &json);
            Properties { json, shader, mode, write_depth, queue_offset: 0 }
        }));
    }
    order_queues(&mut list);
    list
}

fn blending(shader: Shader, json: &Json) -> (AlphaMode, bool) {
    match shader {
        Shader::Mtoon => {
            let keywords = json.at("keywordMap");
            // Godot's exporter writes `_BlendMode` only; Unity writes both.
            let blend_mode = json.at("floatProperties").f32_or("_BlendMode", 0.0);
            if keywords.flag("_ALPHABLEND_ON") || blend_mode >= 2.0 {
                (AlphaMode::Blend, json.at("floatProperties").f32_or("_ZWrite", 0.0) == 1.0)
            } else if keywords.flag("_ALPHATEST_ON") || blend_mode == 1.0 {
                (AlphaMode::Mask, false)
            } else {
                (AlphaMode::Opaque, false)
            }
        }
        Shader::UnlitOpaque => (AlphaMode::Opaque, false),
        Shader::UnlitCutout => (AlphaMode::Mask, false),
        Shader::UnlitTransparent => (AlphaMode::Blend, false),
        Shader::UnlitTransparentZWrite => (AlphaMode::Blend, true),
    }
}

/// Turns Unity's render queues into offsets that keep their order: 0, -1, -2, … from the last for plain transparents,
/// 0, 1, 2, … from the first for those that write depth.
fn order_queues(list: &mut [Option<Properties>]) {
    for write_depth in [false, true] {
        let queue = |p: &Properties| p.json.f32_or("renderQueue", 3000.0) as i64;
        let belongs = |p: &Properties| p.mode == AlphaMode::Blend && p.write_depth == write_depth;
        let queues: BTreeSet<i64> = list.iter().flatten().filter(|p| belongs(p)).map(queue).collect();
        let queues: Vec<i64> = queues.into_iter().collect();
        for entry in list.iter_mut().flatten().filter(|p| belongs(p)) {
            let place = queues.binary_search(&queue(entry)).unwrap_or(0);
            let from_end = queues.len().saturating_sub(place).saturating_sub(1);
            let offset = i32::try_from(if write_depth { place } else { from_end }).unwrap_or(9).min(9);
            entry.queue_offset = if write_depth { offset } else { offset.saturating_neg() };
        }
    }
}

/// Decodes a number of a colour that may be over 1. Unity's HDR colours are gamma-encoded as well; above 1 it decodes with a
/// plain power of 2.2.
pub(super) fn linear_from_emission(encoded: f32) -> f32 {
    if encoded > 1.0 {
        encoded.powf(2.2)
    } else {
        linear_from_srgb(encoded)
    }
}

/// Fills the material from the entry.
pub(super) fn apply(
    p: &Properties,
    material: &mut Material,
    textures: &mut Textures,
    warnings: &mut Warnings,
) -> Result<bool> {
    let floats = p.json.at("floatProperties");
    let number = |key: &str, default: f32| floats.f32_or(key, default);
    material.alpha.mode = p.mode;
    material.alpha.write_depth = p.write_depth;
    material.alpha.queue_offset = p.queue_offset;
    material.alpha.cutoff = number("_Cutoff", 0.5).max(0.0);

    let mut texture =
        TextureReader { json: p.json.at("textureProperties"), transform: transform(&p.json), textures, warnings };
    let [r, g, b, a] = vector(&p.json, "_Color", [1.0; 4]);
    let [r, g, b] = [r, g, b].map(linear_from_srgb);
    let main = texture.get("_MainTex")?;
    material.base = Base { color: [r, g, b, a], texture: main };
    if p.shader != Shader::Mtoon {
        material.origin = Origin::Unlit;
        material.shading = Shading::Unlit;
        material.emission = Emission::default();
        material.normal_map = None;
        return Ok(true);
    }
    material.origin = Origin::Mtoon0;
    material.double_sided = number("_CullMode", 2.0) < 1.5;
    let scale = number("_BumpScale", 1.0);
    material.normal_map = texture.get("_BumpMap")?.map(|texture| NormalMap { texture, scale });
    let [er, eg, eb, _] = vector(&p.json, "_EmissionColor", [0.0; 4]);
    let [er, eg, eb] = [er, eg, eb].map(linear_from_emission);
    material.emission = Emission { color: [er, eg, eb], texture: texture.get("_EmissionMap")?, ..Emission::default() };
    material.shading = Shading::Toon(toon(&p.json, &floats, main, texture.get("_ShadeTexture")?));
    material.matcap = texture.get("_SphereAdd")?.map(|t| Matcap { texture: t, color: [1.0; 3] });
    material.rim = Rim {
        color: srgb(&p.json, "_RimColor", [0.0; 4]),
        fresnel_power: number("_RimFresnelPower", 1.0).max(0.0),
        lift: number("_RimLift", 0.0),
        mask: texture.get("_RimTexture")?,
        lighting_mix: number("_RimLightingMix", 0.0).clamp(0.0, 1.0),
    };
    material.outline = outline(&p.json, &floats, texture.get("_OutlineWidthTexture")?);
    material.uv_animation = UvAnimation {
        mask: texture.get("_UvAnimMaskTexture")?,
        scroll_u_per_s: number("_UvAnimScrollX", 0.0),
        // Unity's v grows upwards.
        scroll_v_per_s: -number("_UvAnimScrollY", 0.0),
        // Turns a second.
        rotation_rad_per_s: number("_UvAnimRotation", 0.0) * TAU,
    };
    Ok(true)
}

/// The band of MToon 0.x runs from `shift` to `lerp(1, shift, toony)` in N·L; 1.0 gives its middle and its hardness.
fn toon(json: &Json, floats: &Json, main: Option<TextureRef>, shade: Option<TextureRef>) -> Toon {
    let shift = floats.f32_or("_ShadeShift", 0.0).clamp(-1.0, 1.0);
    let toony = floats.f32_or("_ShadeToony", 0.9).clamp(0.0, 1.0);
    let end = 1.0 + (shift - 1.0) * toony;
    Toon {
        shade_color: srgb(json, "_ShadeColor", [0.97, 0.81, 0.86, 1.0]),
        // Authors relied on the lit texture showing in the shade, so the migration repeats it where none is given.
        shade_texture: shade.or(main),
        shift: (-(end + shift) * 0.5).clamp(-1.0, 1.0),
        shift_texture: None,
        shift_texture_scale: 1.0,
        toony: ((2.0 - (end - shift)) * 0.5).clamp(0.0, 1.0),
        gi_equalization: 1.0 - floats.f32_or("_IndirectLightIntensity", 0.1).clamp(0.0, 1.0),
    }
}

fn outline(json: &Json, floats: &Json, width_mask: Option<TextureRef>) -> Option<Outline> {
    let width = floats.f32_or("_OutlineWidth", 0.0).clamp(0.0, WIDEST_OUTLINE * 100.0);
    let width = match floats.f32_or("_OutlineWidthMode", 0.0) as i32 {
        // Centimetres.
        1 => OutlineWidth::World { metres: width * 0.01 },
        // Per cent of half the picture's height.
        2 => OutlineWidth::Screen { height_ratio: width * 0.01 * 0.5 },
        _ => return None,
    };
    let mixed = floats.f32_or("_OutlineColorMode", 0.0) == 1.0;
    let lighting_mix = if mixed {
        floats.f32_or("_OutlineLightingMix", 1.0).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let color = srgb(json, "_OutlineColor", [0.0; 4]);
    Some(Outline { width, width_mask, color, lighting_mix, ..Outline::default() })
}

/// A vector property; missing components keep their default.
fn vector(json: &Json, key: &str, default: [f32; 4]) -> [f32; 4] {
    let mut out = default;
    for (slot, value) in out.iter_mut().zip(json.at("vectorProperties").list(key)) {
        *slot = value.as_f32().unwrap_or(*slot);
    }
    out
}

/// A colour property, which Unity stores sRGB-encoded, in linear light.
fn srgb(json: &Json, key: &str, default: [f32; 4]) -> [f32; 3] {
    let [r, g, b, _] = vector(json, key, default);
    [r, g, b].map(|c| linear_from_srgb(c.max(0.0)))
}

/// Offset and scale of `_MainTex`, which hold for all textures; Unity's v starts at the bottom.
fn transform(json: &Json) -> UvTransform {
    let [u, v, scale_u, scale_v] = vector(json, "_MainTex", [0.0, 0.0, 1.0, 1.0]);
    UvTransform { offset: [u, 1.0 - scale_v - v], rotation_rad: 0.0, scale: [scale_u, scale_v] }
}

/// Looks up `textureProperties`.
struct TextureReader<'a, 'b, 't> {
    json: Json<'a>,
    transform: UvTransform,
    textures: &'b mut Textures<'t>,
    warnings: &'b mut Warnings,
}

impl TextureReader<'_, '_, '_> {
    fn get(&mut self, key: &str) -> Result<Option<TextureRef>> {
        let Some(value) = self.json.get(key) else { return Ok(None) };
        let Ok(index) = value.as_index(self.textures.len(), "textures") else {
            self.warnings.add(value.pointer(), "names a texture that does not exist: left out");
            return Ok(None);
        };
        let texture = self.textures.resolve(index, self.warnings)?;
        Ok(texture.map(|texture| TextureRef { texture, uv_set: 0, transform: self.transform }))
    }
}
