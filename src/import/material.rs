//! Materials: what glTF says of all of them, then the one shading that each has.

use crate::material::{Alpha, AlphaMode, Base, Emission, Material, NormalMap, Origin, Shading, Substance, TextureRef};

use super::fault::{Result, quoted};
use super::json::Json;
use super::mtoon0::Properties;
use super::texture::Textures;
use super::warnings::Warnings;
use super::{mtoon, mtoon0, pbr};

/// Materials, and for each the `TEXCOORD` attributes that it reads.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub(super) list: Vec<Material>,
    pub(super) uv_sets: Vec<Vec<u32>>,
}

/// Reads all materials. `vrm0` is the `VRM` extension of a VRM 0.x file.
pub(super) fn read_all(
    root: &Json,
    vrm0: Option<&Json>,
    textures: &mut Textures,
    warnings: &mut Warnings,
) -> Result<Materials> {
    let json = root.objects("materials")?;
    let properties = mtoon0::read_properties(vrm0, json.len(), warnings);
    let mut out = Materials::default();
    for (index, json) in json.iter().enumerate() {
        let mut material = read(json, properties.get(index).and_then(Option::as_ref), textures, warnings)?;
        if let Some((key, message)) = material.clone().out_of_range() {
            warnings.add(json.pointer(), format!("{key}: {message}; it is moved there"));
            material = material.clamped();
        }
        let sets = gather_uv_sets(&mut material, json.pointer(), warnings);
        out.list.push(material);
        out.uv_sets.push(sets);
    }
    warn_about_shade(&out.list, warnings);
    Ok(out)
}

fn read(json: &Json, vrm0: Option<&Properties>, textures: &mut Textures, warnings: &mut Warnings) -> Result<Material> {
    let mut material = Material { name: json.name()?, ..Material::default() };
    read_common(json, &mut material, textures, warnings)?;
    let mtoon_json = json.extension("VRMC_materials_mtoon")?;
    let unlit = json.extension("KHR_materials_unlit")?.is_some();
    if let Some(properties) = vrm0
        && mtoon0::apply(properties, &mut material, textures, warnings)?
    {
        return Ok(material);
    }
    if let Some(ext) = mtoon_json {
        mtoon::apply(&ext, &mut material, textures, warnings)?;
    } else if unlit {
        material.origin = Origin::Unlit;
        material.shading = Shading::Unlit;
        material.emission = Emission::default();
        material.normal_map = None;
    } else {
        pbr::apply(json, &mut material, textures, warnings)?;
    }
    Ok(material)
}

/// What glTF says of every material.
fn read_common(json: &Json, material: &mut Material, textures: &mut Textures, warnings: &mut Warnings) -> Result<()> {
    if let Some(pbr) = json.object("pbrMetallicRoughness")? {
        let color = pbr.floats("baseColorFactor")?.unwrap_or([1.0; 4]);
        material.base =
            Base { color: color.map(|c| c.max(0.0)), texture: textures.info(&pbr, "baseColorTexture", warnings)? };
        check_info(&pbr, "metallicRoughnessTexture", textures)?;
    }
    check_info(json, "occlusionTexture", textures)?;
    let scale = json.object("normalTexture")?.map_or(Ok(None), |n| n.f32("scale"))?.unwrap_or(1.0);
    material.normal_map = textures.info(json, "normalTexture", warnings)?.map(|texture| NormalMap { texture, scale });

    let mut strength = 1.0;
    if let Some(ext) = json.extension("KHR_materials_emissive_strength")? {
        strength = ext.f32("emissiveStrength")?.unwrap_or(1.0);
    } else if let Some(ext) = json.extension("VRMC_materials_hdr_emissiveMultiplier")? {
        strength = ext.f32("emissiveMultiplier")?.unwrap_or(1.0);
    }
    let color = json.floats("emissiveFactor")?.unwrap_or([0.0; 3]);
    let color = color.map(|c: f32| (c * strength).clamp(0.0, 1e6));
    material.emission =
        Emission { color, texture: textures.info(json, "emissiveTexture", warnings)?, ..Emission::default() };

    // Textures for looks, which glTF and MToon have no place for. Extras of others may hold anything.
    if let Some(maps) = json.get("extras").and_then(|e| e.get("hikage")).filter(Json::is_object) {
        material.authored.highlight = match textures.info(&maps, "highlightBand", warnings)? {
            None => textures.info(&maps, "noseLipHighlight", warnings)?,
            band => band,
        };
        let authored = &mut material.authored;
        authored.face_paint = textures.info(&maps, "facePaint", warnings)?;
        authored.detail_normal = textures.info(&maps, "detailNormal", warnings)?;
        authored.part_ids = textures.info(&maps, "partId", warnings)?;
        authored.highlight_shape = textures.info(&maps, "highlightShape", warnings)?;
        authored.inclusions = textures.info(&maps, "inclusions", warnings)?;
        authored.heat = textures.info(&maps, "heat", warnings)?;
        authored.substance = Substance::from_name(maps.text("substance"));
        let ramps = [textures.info(&maps, "rampWarm", warnings)?, textures.info(&maps, "rampCool", warnings)?];
        authored.ramps = match ramps {
            [Some(warm), Some(cool)] => Some([warm, cool]),
            [one, other] => one.or(other).map(|ramp| [ramp; 2]),
        };
        let rows = maps.f32_or("rampRows", 1.0).clamp(1.0, 256.0) as u32;
        for (row, found) in authored.part_rows.iter_mut().zip(maps.list("partRows")) {
            *row = found.as_f32().map_or(-1, |r| (r.max(0.0) as u32).min(rows.saturating_sub(1)) as i32);
        }
        authored.ramp_rows = [rows, (maps.f32_or("rampRow", 0.0).max(0.0) as u32).min(rows.saturating_sub(1))];
    }

    material.double_sided = json.bool("doubleSided")?.unwrap_or(false);
    let mode = match json.str("alphaMode")?.unwrap_or("OPAQUE") {
        "OPAQUE" => AlphaMode::Opaque,
        "MASK" => AlphaMode::Mask,
        "BLEND" => AlphaMode::Blend,
        other => return Err(json.fault(format!("found alphaMode {}, expected OPAQUE, MASK or BLEND", quoted(other)))),
    };
    material.alpha = Alpha { mode, cutoff: json.f32("alphaCutoff")?.unwrap_or(0.5).max(0.0), ..Alpha::default() };
    Ok(())
}

/// Checks a texture that no toon material uses; its image is not decoded.
fn check_info(json: &Json, key: &str, textures: &Textures) -> Result<()> {
    if let Some(info) = json.object(key)? {
        info.need("index")?.as_index(textures.len(), "textures")?;
    }
    Ok(())
}

/// Every texture of a material that lies on its surface, the base colour's first.
fn each_texture(material: &mut Material, visit: &mut dyn FnMut(&mut TextureRef)) {
    material.each_texture(&mut |_, read, texture| {
        if read.by_uv {
            visit(texture);
        }
    });
    material.authored.each_texture(&mut |_, read, texture| {
        if read.by_uv {
            visit(texture);
        }
    });
}

/// Numbers the UV sets that a material uses from 0 and returns their `TEXCOORD` numbers, ascending. The result depends
/// on the material alone, so that primitives with different attributes can share it.
fn gather_uv_sets(material: &mut Material, pointer: &str, warnings: &mut Warnings) -> Vec<u32> {
    let mut sets: Vec<u32> = Vec::new();
    each_texture(material, &mut |texture| {
        if !sets.contains(&texture.uv_set) {
            sets.push(texture.uv_set);
        }
    });
    if sets.len() > 2 {
        warnings.add(pointer, format!("material uses {} UV sets: all but the first two read the first", sets.len()));
        sets.truncate(2);
    }
    let first = sets.first().copied().unwrap_or(0);
    sets.sort_unstable();
    let place = |set: u32| sets.iter().position(|s| *s == set);
    each_texture(material, &mut |texture| {
        let index = place(texture.uv_set).or_else(|| place(first)).unwrap_or(0);
        texture.uv_set = u32::try_from(index).unwrap_or(0);
    });
    sets
}

/// Names materials whose shade cannot be seen, or that were left at black.
fn warn_about_shade(materials: &[Material], warnings: &mut Warnings) {
    let mut same = Vec::new();
    let mut black = Vec::new();
    for (index, material) in materials.iter().enumerate() {
        let Shading::Toon(toon) = &material.shading else { continue };
        if !matches!(material.origin, Origin::Mtoon0 | Origin::Mtoon1) {
            continue;
        }
        let [r, g, b, _] = material.base.color;
        let lit_is_black = [r, g, b].iter().all(|c| *c < 1e-4);
        let texture = |t: Option<TextureRef>| t.map(|t| t.texture);
        if toon.shade_color.iter().all(|c| *c < 1e-4) && !lit_is_black {
            black.push((index, quoted(&material.name)));
        } else if toon.shade_color == [r, g, b]
            && texture(toon.shade_texture) == texture(material.base.texture)
            && !lit_is_black
        {
            same.push((index, quoted(&material.name)));
        }
    }
    for (list, what) in [(black, "shade colour is black"), (same, "shade colour is the lit colour: no shade will show")]
    {
        if let Some((first, _)) = list.first() {
            let names: Vec<_> = list.iter().take(8).map(|(_, n)| n.as_str()).collect();
            warnings.add(
                format!("/materials/{first}"),
                format!("{what}, in {} materials: {}", list.len(), names.join(", ")),
            );
        }
    }
}
