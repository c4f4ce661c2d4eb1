//! Builds small glTF files in memory: JSON by hand, binary data by accessor.

#![allow(dead_code, reason = "each test file uses a part of it")]

use serde_json::{Value, json};

/// A file under construction.
pub(crate) struct Glb {
    /// The JSON; change at will.
    pub(crate) json: Value,
    /// The binary chunk.
    pub(crate) bin: Vec<u8>,
}

pub(crate) const U8: u32 = 5121;
pub(crate) const I8: u32 = 5120;
pub(crate) const I16: u32 = 5122;
pub(crate) const U16: u32 = 5123;
pub(crate) const U32: u32 = 5125;
pub(crate) const F32: u32 = 5126;

impl Glb {
    pub(crate) fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}}]}], "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}]
        });
        Self { json, bin: Vec::new() }
    }

    /// A triangle in the plane z = 0 with normals and `TEXCOORD_0`, counter-clockwise seen from +Z.
    pub(crate) fn triangle() -> Self {
        let mut glb = Self::new();
        glb.attribute("POSITION", F32, "VEC3", &floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]), 3, false);
        glb.attribute("NORMAL", F32, "VEC3", &floats(&[0., 0., 1., 0., 0., 1., 0., 0., 1.]), 3, false);
        glb.attribute("TEXCOORD_0", F32, "VEC2", &floats(&[0., 0., 1., 0., 0., 1.]), 3, false);
        glb
    }

    /// Appends to a list of the JSON and returns the index.
    pub(crate) fn push(&mut self, list: &str, value: Value) -> usize {
        if self.json.get(list).is_none() {
            self.json[list] = json!([]);
        }
        let list = self.json[list].as_array_mut().expect("an array");
        list.push(value);
        list.len() - 1
    }

    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let offset = self.bin.len();
        self.bin.extend_from_slice(bytes);
        self.push("bufferViews", json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}))
    }

    pub(crate) fn accessor(
        &mut self,
        component: u32,
        kind: &str,
        bytes: &[u8],
        count: usize,
        normalized: bool,
    ) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": component, "type": kind, "count": count, "normalized": normalized}),
        )
    }

    /// Adds an attribute to the first primitive.
    pub(crate) fn attribute(
        &mut self,
        name: &str,
        component: u32,
        kind: &str,
        bytes: &[u8],
        count: usize,
        normalized: bool,
    ) {
        let accessor = self.accessor(component, kind, bytes, count, normalized);
        self.primitive()["attributes"][name] = json!(accessor);
    }

    pub(crate) fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    /// Embeds an image file and a texture of it; returns the texture.
    pub(crate) fn texture(&mut self, bytes: &[u8], mime: &str) -> usize {
        let view = self.view(bytes);
        let image = self.push("images", json!({"bufferView": view, "mimeType": mime}));
        self.push("textures", json!({"source": image}))
    }

    /// Makes the file a VRM 1.0 character with the required bones as a chain of nodes. Returns the node of the head.
    pub(crate) fn vrm1(&mut self) -> usize {
        let bones = [
            "hips",
            "spine",
            "leftUpperLeg",
            "leftLowerLeg",
            "leftFoot",
            "rightUpperLeg",
            "rightLowerLeg",
            "rightFoot",
            "leftUpperArm",
            "leftLowerArm",
            "leftHand",
            "rightUpperArm",
            "rightLowerArm",
            "rightHand",
            "head",
        ];
        let first = self.json["nodes"].as_array().expect("nodes").len();
        let mut human = json!({});
        for (i, bone) in bones.iter().enumerate() {
            let children = if i + 1 < bones.len() {
                json!([first + i + 1])
            } else {
                json!([])
            };
            self.push("nodes", json!({"name": bone, "children": children, "translation": [0, 0.1, 0]}));
            human[bone] = json!({"node": first + i});
        }
        self.json["scenes"][0]["nodes"] = json!([0, first]);
        self.json["extensionsUsed"] = json!(["VRMC_vrm"]);
        self.json["extensions"]["VRMC_vrm"] = json!({
            "specVersion": "1.0", "humanoid": {"humanBones": human},
            "meta": {"name": "Test", "authors": ["A", "B"], "licenseUrl": "https://vrm.dev/licenses/1.0/", "allowRedistribution": true}
        });
        first + bones.len() - 1
    }

    /// The finished GLB.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if json["buffers"][0]["byteLength"] == json!(0) {
            json["buffers"][0]["byteLength"] = json!(self.bin.len());
        }
        let mut text = serde_json::to_vec(&json).expect("JSON");
        text.resize(text.len().next_multiple_of(4), b' ');
        glb(&text, &self.bin)
    }

    pub(crate) fn load(&self) -> hikage::Result<hikage::scene::Scene> {
        hikage::import::load_bytes("test.glb", &self.bytes(), None, &hikage::import::Limits::default())
    }
}

/// Wraps JSON text and a binary chunk.
pub(crate) fn glb(text: &[u8], bin: &[u8]) -> Vec<u8> {
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let total = 12 + 8 + text.len() + 8 + bin.len();
    let mut out = b"glTF".to_vec();
    for word in [2, total as u32, text.len() as u32] {
        out.extend(word.to_le_bytes());
    }
    out.extend(b"JSON");
    out.extend(text);
    out.extend((bin.len() as u32).to_le_bytes());
    out.extend(b"BIN\0");
    out.extend(bin);
    out
}

pub(crate) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

pub(crate) fn shorts(values: &[i16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

pub(crate) fn words(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A 2 x 1 picture, red and half-transparent blue, in the given format.
pub(crate) fn picture(format: image::ImageFormat) -> Vec<u8> {
    let pixels = image::RgbaImage::from_raw(2, 1, vec![255, 0, 0, 255, 0, 0, 255, 128]).expect("2 x 1");
    let mut out = std::io::Cursor::new(Vec::new());
    pixels.write_to(&mut out, format).expect("encodes");
    out.into_inner()
}
