//! The text form of a model's summary.

use hikage::material::{AlphaMode, Outline, OutlineWidth, Shading};
use hikage::sdf::Landmarks;
use serde::Serialize;

use super::model::{MovesSummary, Summary};
use crate::failure::printable;
use crate::output::{Table, bytes, heading};

pub(super) fn model(summary: &Summary<'_>) -> String {
    let mut out = head(summary);
    let mut section = |title: String, table: &Table| {
        let text = table.text();
        if !text.is_empty() {
            out += &format!("\n{}{text}", heading(&title));
        }
    };
    section(format!("Meshes ({})", summary.meshes.len()), &meshes(summary));
    section(format!("Materials ({})", summary.materials.len()), &materials(summary));
    section(format!("Textures ({})", summary.textures.len()), &textures(summary));
    section(format!("Expressions ({})", summary.expressions.len()), &expressions(summary));
    section(format!("Springs ({}), colliders {}", summary.springs.len(), summary.colliders), &springs(summary));
    section(format!("Animations ({})", summary.animations.len()), &animations(summary));
    out += &bones(summary);
    out + &warnings(summary)
}

fn head(summary: &Summary<'_>) -> String {
    let mut lines = vec![
        ("file", format!("{}, {}", summary.source.file, bytes(summary.bytes))),
        (
            "format",
            match summary.vrm_version {
                Some(vrm) => format!("VRM {vrm} in glTF {}", summary.source.gltf_version),
                None => format!("glTF {}", summary.source.gltf_version),
            },
        ),
        ("generator", summary.source.generator.clone()),
    ];
    if let Some(meta) = summary.meta {
        lines.extend([
            ("title", [meta.name.as_str(), meta.version.as_str()].join(" ").trim().to_owned()),
            ("authors", meta.authors.join(", ")),
            ("copyright", meta.copyright.clone()),
            ("contact", meta.contact.clone()),
            ("references", meta.references.join(", ")),
            ("license", meta.license.clone()),
        ]);
        let terms: Vec<_> = meta.permissions.iter().map(|(name, value)| format!("{name}={value}")).collect();
        lines.push(("terms", terms.join(", ")));
    }
    let skins = match summary.skins.iter().max() {
        Some(most) => format!("{} skins of at most {most} joints", summary.skins.len()),
        None => "no skins".into(),
    };
    let gpu = &summary.gpu_bytes_estimate;
    lines.extend([
        ("extensions", summary.source.extensions_used.join(", ")),
        ("required", summary.source.extensions_required.join(", ")),
        (
            "size",
            format!("{} triangles, {} vertices, {} nodes, {skins}", summary.triangles, summary.vertices, summary.nodes),
        ),
        (
            "on the GPU",
            format!(
                "about {}: textures {}, geometry {}",
                bytes(gpu.textures + gpu.geometry),
                bytes(gpu.textures),
                bytes(gpu.geometry)
            ),
        ),
        ("moves", summary.moves.as_ref().map(moves).unwrap_or_default()),
        ("look-at", summary.look_at.unwrap_or_default().into()),
        ("face", summary.faces.values().map(face).collect::<Vec<_>>().join("; ")),
        (
            "constraints",
            if summary.constraints == 0 {
                String::new()
            } else {
                summary.constraints.to_string()
            },
        ),
    ]);
    lines
        .iter()
        .filter(|(_, value)| !value.is_empty())
        .map(|(name, value)| format!("{name:<12}{}\n", printable(value)))
        .collect()
}

fn face(found: &Landmarks) -> String {
    let cm = |share: f32| share * found.height_m * 100.0;
    let paint = |is_painted: bool| if is_painted { "painted" } else { "of the mesh" };
    let mouth = if found.mouth_is_bare() {
        "a crease of the mesh"
    } else {
        paint(found.mouth_is_painted)
    };
    format!(
        "{:.1} cm high; eyes at {:.1} cm, {:.1} cm from the middle; nose at {:.1} cm, {:.1} mm out, {}; mouth at {:.1} cm, {:.1} cm \
         wide, {mouth}; chin at {:.1} cm",
        cm(1.0),
        cm(found.eye[1]),
        cm(found.eye[0]),
        cm(found.nose),
        cm(found.nose_out) * 10.0,
        paint(found.nose_is_painted),
        cm(found.mouth),
        cm(found.mouth_half) * 2.0,
        cm(found.chin),
    )
}

fn moves(moves: &MovesSummary<'_>) -> String {
    let mut parts = vec![format!("{} bones", moves.bones.len())];
    if !moves.expressions.is_empty() {
        parts.push(format!("expressions {}", moves.expressions.join(" ")));
    }
    if moves.gaze {
        parts.push("the gaze".into());
    }
    parts.join(", ")
}

fn meshes(summary: &Summary<'_>) -> Table {
    let mut table = Table::new(&[
        "mesh", "part", "role", "material", "vertices", "triangles", "morphs", "influences", "uv", "colors",
    ]);
    for mesh in &summary.meshes {
        for (index, part) in mesh.primitives.iter().enumerate() {
            table.row([
                mesh.name.into(),
                index.to_string(),
                word(&part.role),
                part.material.to_string(),
                part.vertices.to_string(),
                part.triangles.to_string(),
                mesh.morph_targets.len().to_string(),
                part.influences.to_string(),
                part.uv_sets.to_string(),
                yes(part.has_colors),
            ]);
        }
    }
    table
}

fn materials(summary: &Summary<'_>) -> Table {
    let mut table = Table::new(&["", "material", "from", "roles", "shading", "alpha", "sides", "outline", "textures"]);
    for entry in &summary.materials {
        let material = entry.material;
        table.row([
            entry.index.to_string(),
            material.name.clone(),
            word(&material.origin),
            entry.roles.iter().map(word).collect::<Vec<_>>().join(" "),
            match &material.shading {
                Shading::Toon(toon) => format!("toon {:.2} shift {:.2}", toon.toony, toon.shift),
                _ => "unlit".into(),
            },
            match material.alpha.mode {
                AlphaMode::Opaque => "opaque".into(),
                AlphaMode::Mask => format!("mask {:.2}", material.alpha.cutoff),
                AlphaMode::Blend if material.alpha.write_depth => "blend+depth".into(),
                AlphaMode::Blend => "blend".into(),
            },
            if material.double_sided { "2" } else { "1" }.into(),
            material.outline.as_ref().map(outline).unwrap_or_default(),
            entry.textures_used.iter().map(|(what, _)| what.as_str()).collect::<Vec<_>>().join(", "),
        ]);
    }
    table
}

fn outline(outline: &Outline) -> String {
    match outline.width {
        OutlineWidth::World { metres } => format!("{:.2} mm", metres * 1000.0),
        OutlineWidth::Screen { height_ratio } => format!("{:.2} % of height", height_ratio * 100.0),
    }
}

fn textures(summary: &Summary<'_>) -> Table {
    let mut table = Table::new(&["", "texture", "format", "width", "height", "bits", "used as", "on the GPU"]);
    for (index, texture) in summary.textures.iter().enumerate() {
        table.row([
            index.to_string(),
            texture.name.into(),
            texture.format.into(),
            texture.width.to_string(),
            texture.height.to_string(),
            texture.bits.to_string(),
            if texture.uses.is_empty() {
                "nothing".into()
            } else {
                texture.uses.iter().map(word).collect::<Vec<_>>().join(" + ")
            },
            bytes(texture.gpu_bytes),
        ]);
    }
    table
}

fn expressions(summary: &Summary<'_>) -> Table {
    let mut table = Table::new(&["expression", "kind", "binary", "morphs", "colors", "uv"]);
    for e in &summary.expressions {
        table.row([
            e.name.into(),
            if e.preset { "preset" } else { "custom" }.into(),
            yes(e.binary),
            e.morphs.to_string(),
            e.colors.to_string(),
            e.uv_transforms.to_string(),
        ]);
    }
    table
}

fn springs(summary: &Summary<'_>) -> Table {
    let mut table = Table::new(&["spring", "joints", "colliders"]);
    for spring in &summary.springs {
        table.row([spring.name.into(), spring.joints.to_string(), spring.colliders.to_string()]);
    }
    table
}

fn animations(summary: &Summary<'_>) -> Table {
    let mut table = Table::new(&["animation", "channels", "seconds"]);
    for clip in &summary.animations {
        table.row([clip.name.into(), clip.channels.to_string(), format!("{:.2}", clip.seconds)]);
    }
    table
}

fn bones(summary: &Summary<'_>) -> String {
    if summary.bones.is_empty() {
        return String::new();
    }
    let mut table = Table::new(&["bone", "node"]);
    for (bone, node) in &summary.bones {
        table.row([(*bone).into(), (*node).into()]);
    }
    format!("\n{}{}", heading(&format!("Bones ({})", summary.bones.len())), table.text())
}

fn warnings(summary: &Summary<'_>) -> String {
    if summary.warnings.is_empty() {
        return String::new();
    }
    let mut out = format!("\n{}", heading(&format!("Warnings ({})", summary.warnings.len())));
    for warning in &summary.warnings {
        out += &format!("  {}: {}\n", printable(&warning.pointer), printable(&warning.message));
    }
    out
}

/// The name that a unit variant has in JSON, so that both forms use the same words.
fn word(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(name)) => name,
        _ => String::new(),
    }
}

fn yes(value: bool) -> String {
    if value { "yes" } else { "" }.into()
}
