//! Primitives as the file states them: attributes, indices and targets checked for type and count, nothing read yet.

use std::collections::BTreeMap;

use super::accessor::{Accessor, Component};
use super::fault::{Limits, Result, within};
use super::json::Json;
use super::warnings::Warnings;

use Component::{F32, I8, I16, U8, U16, U32};

/// How indices make triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Topology {
    List,
    Strip,
    Fan,
    /// Points and lines, which are not drawn.
    None,
}

/// Accessors of one morph target.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Target {
    pub(super) position: Option<usize>,
    pub(super) normal: Option<usize>,
}

/// Accessors of one primitive.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) pointer: String,
    pub(super) topology: Topology,
    pub(super) material: Option<usize>,
    pub(super) indices: Option<usize>,
    pub(super) position: Option<usize>,
    pub(super) normal: Option<usize>,
    pub(super) tangent: Option<usize>,
    pub(super) color: Option<usize>,
    /// By the number of the `TEXCOORD` attribute.
    pub(super) uvs: BTreeMap<u32, usize>,
    /// `JOINTS_n` and `WEIGHTS_n`.
    pub(super) influences: Vec<(usize, usize)>,
    pub(super) targets: Vec<Target>,
    /// Of strips of hair.
    pub(super) hair: Hair,
}

/// Accessors of what files say of strips of hair.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hair {
    pub(super) tangent: Option<usize>,
    pub(super) root_tip: Option<usize>,
    pub(super) strip_id: Option<usize>,
}

/// Reads and checks the primitives of a mesh.
pub(super) fn read(
    mesh: &Json,
    accessors: &[Accessor],
    materials: usize,
    limits: &Limits,
    warnings: &mut Warnings,
) -> Result<Vec<Source>> {
    mesh.need("primitives")?;
    let sources = mesh
        .objects("primitives")?
        .iter()
        .map(|p| read_one(p, accessors, materials, limits, warnings))
        .collect::<Result<Vec<_>>>()?;
    let targets = sources.first().map_or(0, |s| s.targets.len());
    if let Some(other) = sources.iter().find(|s| s.targets.len() != targets) {
        return Err(super::fault::Fault::new(
            &other.pointer,
            format!("found {} morph targets, expected {targets} as in the first primitive", other.targets.len()),
        ));
    }
    Ok(sources)
}

/// Finds accessors by attribute name and checks them.
struct Attributes<'a> {
    json: Json<'a>,
    accessors: &'a [Accessor<'a>],
    /// Count that all attributes must have: the first one's.
    count: Option<u64>,
}

impl Attributes<'_> {
    fn get(&mut self, name: &str, kinds: &[&str], components: &[Component]) -> Result<Option<usize>> {
        let Some(index) = self.json.index(name, self.accessors.len(), "accessors")? else { return Ok(None) };
        let Some(accessor) = self.accessors.get(index) else { return Ok(None) };
        let pointer = format!("{}/{name}", self.json.pointer());
        accessor.expect(name, kinds, components, &pointer)?;
        let count = *self.count.get_or_insert(accessor.count);
        if accessor.count != count {
            return Err(super::fault::Fault::new(
                pointer,
                format!(
                    "attribute {name}: found accessor count {}, expected {count} as in the other attributes",
                    accessor.count
                ),
            ));
        }
        Ok(Some(index))
    }

    /// An attribute of an application. Names of these are nobody's: what is of another type means something else.
    fn own(
        &mut self,
        name: &str,
        kind: &str,
        components: &[Component],
        warnings: &mut Warnings,
    ) -> Result<Option<usize>> {
        let Some(index) = self.json.index(name, self.accessors.len(), "accessors")? else { return Ok(None) };
        let Some(accessor) = self.accessors.get(index) else { return Ok(None) };
        let pointer = format!("{}/{name}", self.json.pointer());
        if accessor.expect(name, &[kind], components, &pointer).is_err() {
            let message =
                format!("attribute {name}: found {} of another type, expected {kind}: left out", accessor.kind);
            warnings.add(pointer, message);
            return Ok(None);
        }
        if self.count.is_some_and(|count| count != accessor.count) {
            warnings.add(pointer, format!("attribute {name}: another count than the other attributes: left out"));
            return Ok(None);
        }
        Ok(Some(index))
    }
}

fn read_one(
    json: &Json,
    accessors: &[Accessor],
    materials: usize,
    limits: &Limits,
    warnings: &mut Warnings,
) -> Result<Source> {
    let topology = match json.u64("mode")?.unwrap_or(4) {
        0..=3 => Topology::None,
        4 => Topology::List,
        5 => Topology::Strip,
        6 => Topology::Fan,
        other => return Err(json.fault(format!("found mode {other}, expected 0 to 6"))),
    };
    let indices = json.index("indices", accessors.len(), "accessors")?;
    if let Some(accessor) = indices.and_then(|i| accessors.get(i)) {
        accessor.expect("indices", &["SCALAR"], &[U8, U16, U32], json.pointer())?;
    }
    let attributes_json = json.need("attributes")?;
    let names: Vec<&str> = attributes_json.entries()?.into_iter().map(|(name, _)| name).collect();
    let mut attributes = Attributes { json: attributes_json, accessors, count: None };
    // KHR_mesh_quantization allows the integers; they are taken without it as well.
    let position = attributes.get("POSITION", &["VEC3"], &[F32, I8, U8, I16, U16])?;
    let normal = attributes.get("NORMAL", &["VEC3"], &[F32, I8, I16])?;
    let tangent = attributes.get("TANGENT", &["VEC4"], &[F32, I8, I16])?;
    let color = attributes.get("COLOR_0", &["VEC3", "VEC4"], &[F32, U8, U16])?;
    let mut uvs = BTreeMap::new();
    let mut influences = Vec::new();
    for name in names {
        if let Some(set) = name.strip_prefix("TEXCOORD_").and_then(|n| n.parse::<u32>().ok()) {
            if let Some(accessor) = attributes.get(name, &["VEC2"], &[F32, I8, U8, I16, U16])? {
                uvs.insert(set, accessor);
            }
        } else if let Some(set) = name.strip_prefix("JOINTS_") {
            let weights_name = format!("WEIGHTS_{set}");
            let joints = attributes.get(name, &["VEC4"], &[U8, U16])?;
            let weights = attributes.get(&weights_name, &["VEC4"], &[F32, U8, U16])?;
            match (joints, weights) {
                (Some(joints), Some(weights)) => influences.push((joints, weights)),
                _ => return Err(json.fault(format!("found {name} without {weights_name}, expected both"))),
            }
        } else if let Some(set) = name.strip_prefix("WEIGHTS_") {
            let joints_name = format!("JOINTS_{set}");
            if attributes.json.get(&joints_name).is_none() {
                return Err(json.fault(format!("found {name} without {joints_name}, expected both joints and weights")));
            }
        }
    }
    let hair = Hair {
        tangent: attributes.own("_HAIR_TANGENT", "VEC3", &[F32, I8, I16], warnings)?,
        root_tip: attributes.own("_ROOT_TIP", "SCALAR", &[F32, U8, U16], warnings)?,
        strip_id: attributes.own("_STRIP_ID", "SCALAR", &[F32, U8, U16, U32], warnings)?,
    };
    let mut targets = Vec::new();
    let target_json = json.objects("targets")?;
    within(json.pointer(), target_json.len() as u64, limits.morph_targets, "morph targets")?;
    for target in target_json {
        let mut attributes = Attributes { json: target, accessors, count: attributes.count };
        let position = attributes.get("POSITION", &["VEC3"], &[F32, I8, I16])?;
        let normal = attributes.get("NORMAL", &["VEC3"], &[F32, I8, I16])?;
        attributes.get("TANGENT", &["VEC3"], &[F32, I8, I16])?;
        targets.push(Target { position, normal });
    }
    Ok(Source {
        pointer: json.pointer().to_owned(),
        topology,
        material: json.index("material", materials, "materials")?,
        indices,
        position,
        normal,
        tangent,
        color,
        uvs,
        influences,
        targets,
        hair,
    })
}
