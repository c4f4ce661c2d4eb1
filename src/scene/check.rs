//! What of a scene refers to nothing, or to something of another length: importers write none of it, code may.

use super::{Primitive, Scene};
use crate::{Error, Result};

impl Scene {
    /// Whether everything in it refers to what is there. [`Renderer::upload`](crate::Renderer::upload) asks; importers give
    /// nothing else. Sizes of images and face maps are checked as they are uploaded.
    ///
    /// # Errors
    /// [`Error::Argument`] that names the element: a parent that does not stand before its child, an index beyond its list, a
    /// list of another length than the vertices, a number that is not finite.
    pub fn check(&self) -> Result<()> {
        for (i, node) in self.nodes.iter().enumerate() {
            let of = |what: &str| format!("nodes[{i}].{what}");
            if let Some(parent) = node.parent.filter(|p| *p >= i) {
                return fault(of("parent"), format!("is {parent}; expected a node that stands before it"));
            }
            index(of("mesh"), node.mesh, self.meshes.len())?;
            index(of("skin"), node.skin, self.skins.len())?;
            if !node.transform.matrix().is_finite() {
                return fault(of("transform"), "is not finite".to_owned());
            }
        }
        for (i, skin) in self.skins.iter().enumerate() {
            let of = format!("skins[{i}].joints");
            skin.joints.iter().try_for_each(|joint| index(of.clone(), Some(*joint), self.nodes.len()))?;
            length(&format!("skins[{i}].joint_from_mesh"), skin.joint_from_mesh.len(), skin.joints.len())?;
        }
        for (i, mesh) in self.meshes.iter().enumerate() {
            // Joints that every skin under which the mesh stands has.
            let skins = self.nodes.iter().filter(|n| n.mesh == Some(i)).filter_map(|n| self.skins.get(n.skin?));
            let joints = skins.map(|s| s.joints.len()).min();
            for (p, primitive) in mesh.primitives.iter().enumerate() {
                let of = format!("meshes[{i}].primitives[{p}]");
                index(format!("{of}.material"), Some(primitive.material), self.materials.len())?;
                primitive.check(&of, mesh.morph_names.len(), joints)?;
            }
        }
        for (i, texture) in self.textures.iter().enumerate() {
            index(format!("textures[{i}].image"), Some(texture.image), self.images.len())?;
        }
        for (i, material) in self.materials.iter().enumerate() {
            let of = format!("material {i} {:?}", material.name);
            for (key, texture, _) in material.textures().into_iter().filter(|(key, ..)| !key.starts_with("authored.")) {
                index(format!("{of}, {key}"), Some(texture), self.textures.len())?;
            }
            let map = material.face_shadow.map(|f| f.map);
            index(format!("{of}, face_shadow.map"), map, self.face_maps.len())?;
        }
        for (bone, node) in self.character.iter().flat_map(|c| &c.bones) {
            index(format!("character.bones[{}]", bone.name()), Some(*node), self.nodes.len())?;
        }
        if let Some(name) = self.pupils.as_ref().and_then(|p| p.unknown(self.character.as_ref())) {
            return fault(format!("pupils.expressions[{name:?}]"), "is no expression of the character".to_owned());
        }
        Ok(())
    }
}

impl Primitive {
    fn check(&self, of: &str, morphs: usize, joints: Option<usize>) -> Result<()> {
        let count = self.positions.len();
        if !self.indices.len().is_multiple_of(3) {
            return fault(format!("{of}.indices"), format!("has {}; expected three a triangle", self.indices.len()));
        }
        index(format!("{of}.indices"), self.indices.iter().max().map(|i| *i as usize), count)?;
        if let Some(at) = self.positions.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
            return fault(format!("{of}.positions[{at}]"), "is not finite".to_owned());
        }
        let optional = [
            ("normals", self.normals.len()),
            ("tangents", self.tangents.len()),
            ("colors", self.colors.len()),
            ("outline_normals", self.outline_normals.len()),
            ("strands", self.strands.len()),
            ("root_tip", self.root_tip.len()),
            ("strip_ids", self.strip_ids.len()),
        ];
        let uvs = self.uvs.iter().map(|set| ("uvs", set.len()));
        for (name, found) in optional.into_iter().chain(uvs).filter(|(_, found)| *found > 0) {
            length(&format!("{of}.{name}"), found, count)?;
        }
        let is_odd =
            |s: &[f32; 3]| (glam::Vec3::from(*s).length() - 1.0).abs() > 1e-2 || !glam::Vec3::from(*s).is_finite();
        if let Some(at) = self.strands.iter().position(is_odd) {
            return fault(format!("{of}.strands[{at}]"), "is no unit vector".to_owned());
        }
        if let Some(at) = self.root_tip.iter().position(|t| !(0.0..=1.0).contains(t)) {
            return fault(format!("{of}.root_tip[{at}]"), format!("is {}; expected 0 to 1", self.root_tip[at]));
        }
        let influences = &self.influences;
        length(&format!("{of}.influences.joints"), influences.joints.len(), count * influences.per_vertex)?;
        length(&format!("{of}.influences.weights"), influences.weights.len(), count * influences.per_vertex)?;
        if let Some(joints) = joints {
            let most = influences.joints.iter().max().map(|j| usize::from(*j));
            index(format!("{of}.influences.joints"), most, joints)?;
        }
        length(&format!("{of}.morphs"), self.morphs.len(), morphs)?;
        for (i, morph) in self.morphs.iter().enumerate() {
            let of = format!("{of}.morphs[{i}]");
            index(format!("{of}.vertices"), morph.vertices.iter().max().map(|v| *v as usize), count)?;
            if !morph.vertices.is_sorted_by(|a, b| a < b) {
                return fault(format!("{of}.vertices"), "do not grow; expected each vertex once, in order".to_owned());
            }
            length(&format!("{of}.positions"), morph.positions.len(), morph.vertices.len())?;
            length(&format!("{of}.normals"), morph.normals.len(), morph.vertices.len())?;
        }
        Ok(())
    }
}

fn fault<T>(what: String, message: String) -> Result<T> {
    Err(Error::Argument { what, message })
}

fn index(what: String, index: Option<usize>, len: usize) -> Result<()> {
    match index {
        Some(index) if index >= len => fault(what, format!("refers to {index}; there are {len}")),
        _ => Ok(()),
    }
}

fn length(what: &str, found: usize, expected: usize) -> Result<()> {
    if found == expected {
        return Ok(());
    }
    fault(what.to_owned(), format!("has {found}; expected {expected}"))
}
