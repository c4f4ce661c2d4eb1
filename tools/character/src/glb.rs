//! Writes the model as a GLB file with the extensions of VRM 1.0.

use std::collections::BTreeMap;

use glam::Vec3;
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use crate::animation::Animation;
use crate::clips::Clip;
use crate::mesh::Part;
use crate::model::{Alpha, Material, Model};
use crate::skeleton::Skeleton;
use crate::vrm;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_SHORT: u32 = 5123;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The binary chunk and the views and accessors into it.
#[derive(Default)]
pub(crate) struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Binary {
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, bytes: &[u8], count: usize, component: u32, shape: &str, target: Option<u32>) -> usize {
        let view = self.view(bytes, target);
        self.accessors.push(json!({
            "bufferView": view, "componentType": component, "count": count, "type": shape
        }));
        self.accessors.len() - 1
    }

    pub(crate) fn floats<const N: usize>(&mut self, values: &[[f32; N]], target: Option<u32>) -> usize {
        let shape = ["", "SCALAR", "VEC2", "VEC3", "VEC4"].get(N).copied().unwrap_or("MAT4");
        self.accessor(&float_bytes(values), values.len(), FLOAT, shape, target)
    }

    /// Times of keys, which have bounds.
    pub(crate) fn times(&mut self, times: &[f32]) -> usize {
        let values: Vec<[f32; 1]> = times.iter().map(|t| [*t]).collect();
        let index = self.floats(&values, None);
        self.accessors[index]["min"] = json!([times.iter().copied().fold(f32::INFINITY, f32::min)]);
        self.accessors[index]["max"] = json!([times.iter().copied().fold(0.0, f32::max)]);
        index
    }

    fn positions(&mut self, values: &[[f32; 3]]) -> usize {
        let index = self.floats(values, Some(ARRAY_BUFFER));
        set_bounds(&mut self.accessors[index], values);
        index
    }

    /// A sparse accessor: `count` zeros but for these vertices.
    fn sparse(&mut self, count: usize, offsets: &[(u32, Vec3)]) -> usize {
        let mut sorted: BTreeMap<u32, Vec3> = BTreeMap::new();
        for (vertex, offset) in offsets {
            *sorted.entry(*vertex).or_default() += *offset;
        }
        let indices: Vec<u8> = sorted.keys().flat_map(|i| i.to_le_bytes()).collect();
        let values: Vec<[f32; 3]> = sorted.values().map(|v| v.to_array()).collect();
        let (indices, view) = (self.view(&indices, None), self.view(&float_bytes(&values), None));
        let mut accessor = json!({
            "componentType": FLOAT, "count": count, "type": "VEC3",
            "sparse": {
                "count": values.len(),
                "indices": { "bufferView": indices, "componentType": UNSIGNED_INT },
                "values": { "bufferView": view },
            }
        });
        let mut all = values;
        if all.len() < count {
            all.push([0.0; 3]);
        }
        set_bounds(&mut accessor, &all);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

fn float_bytes<const N: usize>(values: &[[f32; N]]) -> Vec<u8> {
    values.iter().flatten().flat_map(|f| f.to_le_bytes()).collect()
}

fn set_bounds(accessor: &mut Value, values: &[[f32; 3]]) {
    let all = || values.iter().map(|v| Vec3::from_array(*v));
    let (min, max) = (all().reduce(Vec3::min), all().reduce(Vec3::max));
    accessor["min"] = json!(min.unwrap_or_default().to_array());
    accessor["max"] = json!(max.unwrap_or_default().to_array());
}

/// Bytes of the GLB file, with clips as animations of the bones. Weights of expressions are left out of them.
#[must_use]
pub fn write(model: &Model, clips: &[Clip]) -> Vec<u8> {
    let mut binary = Binary::default();
    let bones = model.skeleton.bones.len();
    let texture_index: BTreeMap<&str, usize> = model.textures.iter().enumerate().map(|(i, t)| (t.name, i)).collect();
    let material_index: BTreeMap<&str, usize> = model.materials.iter().enumerate().map(|(i, m)| (m.name, i)).collect();

    let inverse_bind: Vec<[f32; 16]> =
        model.skeleton.bones.iter().map(|b| glam::Mat4::from_translation(-b.position).to_cols_array()).collect();
    let inverse_bind = binary.floats(&inverse_bind, None);
    let meshes: Vec<Value> = model.parts.iter().map(|part| mesh(&mut binary, part, &material_index)).collect();

    // PNG takes most of the time, so all pictures are painted and packed side by side.
    let pictures: Vec<Vec<u8>> = model.textures.par_iter().map(|t| (t.paint)().png()).collect();
    let images: Vec<Value> = model
        .textures
        .iter()
        .zip(&pictures)
        .map(|(t, png)| json!({ "name": t.name, "mimeType": "image/png", "bufferView": binary.view(png, None) }))
        .collect();
    let textures: Vec<Value> = model
        .textures
        .iter()
        .enumerate()
        .map(|(i, t)| json!({ "name": t.name, "source": i, "sampler": usize::from(t.repeat) }))
        .collect();
    let sampler = |wrap: u32| json!({ "magFilter": 9729, "minFilter": 9987, "wrapS": wrap, "wrapT": wrap });

    let mut nodes = model.skeleton.nodes();
    for (i, part) in model.parts.iter().enumerate() {
        nodes.push(json!({ "name": part.name, "mesh": i, "skin": 0 }));
    }
    let mut roots = vec![0];
    roots.extend(bones..nodes.len());

    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("hikage-character ", env!("CARGO_PKG_VERSION")) },
        "extensionsUsed": ["KHR_materials_unlit", "VRMC_materials_mtoon", "VRMC_springBone", "VRMC_vrm"],
        "scene": 0,
        "scenes": [{ "name": "Hikage", "nodes": roots }],
        "nodes": nodes,
        "meshes": meshes,
        "skins": [{ "inverseBindMatrices": inverse_bind, "joints": (0..bones).collect::<Vec<_>>(), "skeleton": 0 }],
        "materials": model.materials.iter().map(|m| material(m, &texture_index)).collect::<Vec<_>>(),
        "textures": textures,
        "images": images,
        "samplers": [sampler(33071), sampler(10497)],
        "extensions": {
            "VRMC_vrm": vrm::humanoid(model, bones),
            "VRMC_springBone": vrm::spring_bone(model),
        },
    });
    let bone = |name: &str| model.skeleton.bones.iter().position(|b| b.name == name);
    let animations: Vec<Value> =
        clips.iter().map(|clip| Animation::of_bones(&mut binary, clip, bone).value(clip.name)).collect();
    if !animations.is_empty() {
        document["animations"] = Value::Array(animations);
    }
    container(document, binary)
}

impl Skeleton {
    /// The bones as nodes, at rest.
    pub(crate) fn nodes(&self) -> Vec<Value> {
        self.bones
            .iter()
            .enumerate()
            .map(|(i, bone)| {
                let origin = bone.parent.map_or(Vec3::ZERO, |p| self.bones[p].position);
                let children: Vec<usize> = (0..self.bones.len()).filter(|c| self.bones[*c].parent == Some(i)).collect();
                let mut node = json!({ "name": bone.name, "translation": (bone.position - origin).to_array() });
                if !children.is_empty() {
                    node["children"] = json!(children);
                }
                node
            })
            .collect()
    }
}

fn mesh(binary: &mut Binary, part: &Part, materials: &BTreeMap<&str, usize>) -> Value {
    let count = part.vertices.len();
    let positions: Vec<[f32; 3]> = part.vertices.iter().map(|v| v.position.to_array()).collect();
    let normals: Vec<[f32; 3]> = part.vertices.iter().map(|v| v.normal.to_array()).collect();
    let uvs: Vec<[f32; 2]> = part.vertices.iter().map(|v| v.uv.to_array()).collect();
    let weights: Vec<[f32; 4]> = part.vertices.iter().map(|v| v.weights.map(|(_, w)| w)).collect();
    // A joint of weight 0 is joint 0.
    let joints: Vec<u8> = part
        .vertices
        .iter()
        .flat_map(|v| v.weights.map(|(b, w)| if w > 0.0 { b } else { 0 }))
        .flat_map(u16::to_le_bytes)
        .collect();
    let indices: Vec<u8> = part.triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();

    let mut attributes = json!({
        "POSITION": binary.positions(&positions),
        "NORMAL": binary.floats(&normals, Some(ARRAY_BUFFER)),
        "TEXCOORD_0": binary.floats(&uvs, Some(ARRAY_BUFFER)),
        "JOINTS_0": binary.accessor(&joints, count, UNSIGNED_SHORT, "VEC4", Some(ARRAY_BUFFER)),
        "WEIGHTS_0": binary.floats(&weights, Some(ARRAY_BUFFER)),
    });
    if !part.tangents.is_empty() {
        let tangents: Vec<[f32; 4]> = part.tangents.iter().map(|t| t.to_array()).collect();
        attributes["TANGENT"] = json!(binary.floats(&tangents, Some(ARRAY_BUFFER)));
    }
    let indices =
        binary.accessor(&indices, part.triangles.len() * 3, UNSIGNED_INT, "SCALAR", Some(ELEMENT_ARRAY_BUFFER));
    let material = materials.get(part.material).unwrap_or_else(|| panic!("no material {}", part.material));
    let mut primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
    let mut mesh = json!({ "name": part.name });
    if !part.morphs.is_empty() {
        primitive["targets"] =
            part.morphs.iter().map(|m| json!({ "POSITION": binary.sparse(count, &m.offsets) })).collect();
        mesh["extras"] = json!({ "targetNames": part.morphs.iter().map(|m| m.name).collect::<Vec<_>>() });
        mesh["weights"] = json!(vec![0.0; part.morphs.len()]);
    }
    mesh["primitives"] = json!([primitive]);
    mesh
}

fn material(m: &Material, textures: &BTreeMap<&str, usize>) -> Value {
    let info = |name: &str| json!({ "index": textures.get(name).unwrap_or_else(|| panic!("material {}: no texture {name}", m.name)) });
    let (mode, depth_write, queue) = match m.alpha {
        Alpha::Opaque => ("OPAQUE", false, 0),
        Alpha::Mask(_) => ("MASK", false, 0),
        Alpha::Blend { depth_write, queue } => ("BLEND", depth_write, queue),
    };
    let mut pbr = json!({ "baseColorFactor": m.color, "metallicFactor": 0.0, "roughnessFactor": 0.9 });
    let mut mtoon = json!({
        "specVersion": "1.0",
        "transparentWithZWrite": depth_write,
        "renderQueueOffsetNumber": queue,
        "shadeColorFactor": m.shade,
        "shadingShiftFactor": m.shift,
        "shadingToonyFactor": m.toony,
        "giEqualizationFactor": 0.9,
        "matcapFactor": [0.0, 0.0, 0.0],
        "parametricRimColorFactor": [0.0, 0.0, 0.0],
        "rimLightingMixFactor": 1.0,
    });
    let mut value = json!({
        "name": m.name, "alphaMode": mode, "doubleSided": m.double_sided, "emissiveFactor": m.emission
    });
    if let Some(t) = m.texture {
        pbr["baseColorTexture"] = info(t);
    }
    if let Some(t) = m.shade_texture {
        mtoon["shadeMultiplyTexture"] = info(t);
    }
    if let Some((t, factor)) = m.matcap {
        mtoon["matcapTexture"] = info(t);
        mtoon["matcapFactor"] = json!(factor);
    }
    if let Some((color, power, lift)) = m.rim {
        mtoon["parametricRimColorFactor"] = json!(color);
        mtoon["parametricRimFresnelPowerFactor"] = json!(power);
        mtoon["parametricRimLiftFactor"] = json!(lift);
    }
    if m.outline > 0.0 {
        mtoon["outlineWidthMode"] = json!("worldCoordinates");
        mtoon["outlineWidthFactor"] = json!(m.outline);
        mtoon["outlineColorFactor"] = json!(m.outline_color);
        mtoon["outlineLightingMixFactor"] = json!(1.0);
        if let Some(t) = m.outline_mask {
            mtoon["outlineWidthMultiplyTexture"] = info(t);
        }
    } else {
        mtoon["outlineWidthMode"] = json!("none");
    }
    if m.scroll != [0.0; 2] {
        mtoon["uvAnimationScrollXSpeedFactor"] = json!(m.scroll[0]);
        mtoon["uvAnimationScrollYSpeedFactor"] = json!(m.scroll[1]);
    }
    if let Some(t) = m.normal_map {
        value["normalTexture"] = info(t);
    }
    if let Some(t) = m.emission_texture {
        value["emissiveTexture"] = info(t);
    }
    if let Alpha::Mask(cutoff) = m.alpha {
        value["alphaCutoff"] = json!(cutoff);
    }
    if !m.extras.is_empty() {
        let mut maps: Map<String, Value> = m.extras.iter().map(|(usage, t)| ((*usage).to_owned(), info(t))).collect();
        maps.insert("rampRow".to_owned(), json!(m.ramp_row));
        maps.insert("rampRows".to_owned(), json!(crate::ramp::row_count()));
        if !m.part_ramps.is_empty() {
            let rows: Vec<usize> = m.part_ramps.iter().map(|name| crate::ramp::row(name)).collect();
            maps.insert("partRows".to_owned(), json!(rows));
        }
        maps.extend(m.substance.map(|s| ("substance".to_owned(), json!(s))));
        value["extras"] = json!({ "hikage": maps });
    }
    value["pbrMetallicRoughness"] = pbr;
    value["extensions"] = json!({ "VRMC_materials_mtoon": mtoon, "KHR_materials_unlit": {} });
    value
}

/// The file of a document and its binary chunk.
pub(crate) fn container(mut document: Value, binary: Binary) -> Vec<u8> {
    document["accessors"] = Value::Array(binary.accessors);
    document["bufferViews"] = Value::Array(binary.views);
    document["buffers"] = json!([{ "byteLength": binary.bytes.len() }]);
    let binary = binary.bytes;
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + text.len() + 8 + binary.len();
    let mut file = Vec::with_capacity(total);
    let word = |file: &mut Vec<u8>, n: usize| file.extend_from_slice(&(n as u32).to_le_bytes());
    file.extend_from_slice(b"glTF");
    word(&mut file, 2);
    word(&mut file, total);
    word(&mut file, text.len());
    file.extend_from_slice(b"JSON");
    file.extend_from_slice(&text);
    word(&mut file, binary.len());
    file.extend_from_slice(b"BIN\0");
    file.extend_from_slice(&binary);
    file
}
