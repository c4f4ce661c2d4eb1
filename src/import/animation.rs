//! Animation clips.

use std::collections::BTreeSet;

use crate::scene::{Animation, AnimationChannel, AnimationValues, Interpolation, Mesh};

use super::accessor::{Accessor, Component};
use super::fault::{Fault, Limits, Result, quoted};
use super::geometry::Budget;
use super::graph::Graph;
use super::json::Json;
use super::warnings::Warnings;

use Component::{F32, I8, I16, U8, U16};

/// What reading clips needs.
pub(super) struct Context<'a> {
    pub(super) accessors: &'a [Accessor<'a>],
    pub(super) graph: &'a Graph,
    pub(super) meshes: &'a [Mesh],
    pub(super) limits: &'a Limits,
}

/// Reads all clips. A clip of which nothing is left stays, so that the file's indices hold.
pub(super) fn read_all(
    root: &Json,
    cx: &Context,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<Vec<Animation>> {
    root.objects("animations")?.iter().map(|json| read_clip(json, cx, budget, warnings)).collect()
}

fn read_clip(json: &Json, cx: &Context, budget: &mut Budget, warnings: &mut Warnings) -> Result<Animation> {
    let samplers = json.objects("samplers")?;
    let list = json.objects("channels")?;
    if list.is_empty() {
        warnings.add(json.pointer(), "clip without channels: it moves nothing");
    }
    let mut channels = Vec::new();
    let mut taken = BTreeSet::new();
    for channel in list {
        let index = channel.need("sampler")?.as_index(samplers.len(), "samplers")?;
        let target = channel.need("target")?;
        let Some(sampler) = samplers.get(index) else { continue };
        let Some((node, path)) = read_target(&target, cx, warnings)? else { continue };
        if taken.contains(&(node, path)) {
            warnings.add(
                channel.pointer(),
                format!("another channel of the clip moves the {path} of the node as well: the first is kept"),
            );
            continue;
        }
        if let Some(read) = read_channel(node, path, &target, sampler, cx, budget, warnings)? {
            taken.insert((node, path));
            channels.push(read);
        }
    }
    Ok(Animation { name: json.name()?, channels })
}

fn accessor<'a>(sampler: &Json, key: &str, cx: &'a Context) -> Result<&'a Accessor<'a>> {
    let json = sampler.need(key)?;
    let index = json.as_index(cx.accessors.len(), "accessors")?;
    cx.accessors.get(index).ok_or_else(|| json.fault("accessor is missing"))
}

/// The node and the property that a channel moves.
fn read_target<'a>(target: &Json<'a>, cx: &Context, warnings: &mut Warnings) -> Result<Option<(usize, &'a str)>> {
    let path = target.need("path")?.as_str()?;
    if path == "pointer" {
        warnings.add(target.pointer(), "KHR_animation_pointer is not supported: channel skipped");
        return Ok(None);
    }
    if !matches!(path, "translation" | "rotation" | "scale" | "weights") {
        return Err(
            target.fault(format!("found path {}, expected translation, rotation, scale or weights", quoted(path)))
        );
    }
    let Some(gltf_node) = target.index("node", cx.graph.from_gltf.len(), "nodes")? else {
        warnings.add(target.pointer(), "channel without a node: skipped");
        return Ok(None);
    };
    let node = cx.graph.node(gltf_node).ok_or_else(|| target.fault("node is missing"))?;
    Ok(Some((node, path)))
}

fn read_channel(
    node: usize,
    path: &str,
    target: &Json,
    sampler: &Json,
    cx: &Context,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<Option<AnimationChannel>> {
    let interpolation = match sampler.str("interpolation")?.unwrap_or("LINEAR") {
        "LINEAR" => Interpolation::Linear,
        "STEP" => Interpolation::Step,
        "CUBICSPLINE" => Interpolation::CubicSpline,
        other => {
            return Err(
                sampler.fault(format!("found interpolation {}, expected LINEAR, STEP or CUBICSPLINE", quoted(other)))
            );
        }
    };
    let input = accessor(sampler, "input", cx)?;
    input.expect("sampler input", &["SCALAR"], &[F32], sampler.pointer())?;
    let output = accessor(sampler, "output", cx)?;
    if input.count == 0 {
        warnings.add(sampler.pointer(), "sampler without keys: channel skipped");
        return Ok(None);
    }
    budget.bytes(sampler.pointer(), input.count.saturating_add(output.count).saturating_mul(16), cx.limits)?;
    let mut finite = Finite { target, warnings };
    let Some(times) = finite.rows::<1>("sampler input", input)? else { return Ok(None) };
    let times = times.into_flattened();
    if !times.is_sorted_by(|a, b| a < b) {
        return Err(input.fault("sampler input: times are not strictly increasing"));
    }

    let per_key = if interpolation == Interpolation::CubicSpline {
        3
    } else {
        1
    };
    let expect_count = |values: u64| -> Result<()> {
        let expected = input.count.saturating_mul(per_key).saturating_mul(values);
        if output.count == expected {
            return Ok(());
        }
        Err(Fault::new(
            sampler.pointer(),
            format!(
                "sampler output for {path}: found count {}, expected {expected} for {} keys",
                output.count, input.count
            ),
        ))
    };
    let values = match path {
        "translation" | "scale" => {
            output.expect(&format!("sampler output for {path}"), &["VEC3"], &[F32], sampler.pointer())?;
            expect_count(1)?;
            let rows = finite.rows::<3>("sampler output", output)?;
            if path == "scale" {
                rows.map(AnimationValues::Scale)
            } else {
                rows.map(AnimationValues::Translation)
            }
        }
        "rotation" => {
            output.expect("sampler output for rotation", &["VEC4"], &[F32, I8, U8, I16, U16], sampler.pointer())?;
            if output.component != F32 && !output.normalized {
                return Err(output.fault(
                    "sampler output for rotation: found integers that are not normalized, expected normalized ones",
                ));
            }
            expect_count(1)?;
            let mut rows = finite.rows::<4>("sampler output", output)?;
            if interpolation != Interpolation::CubicSpline {
                normalize(rows.as_deref_mut().unwrap_or_default());
            }
            rows.map(AnimationValues::Rotation)
        }
        _ => {
            output.expect("sampler output for weights", &["SCALAR"], &[F32, I8, U8, I16, U16], sampler.pointer())?;
            let mesh = cx.graph.nodes.get(node).and_then(|n| n.mesh).and_then(|m| cx.meshes.get(m));
            let Some(mesh) = mesh.filter(|m| !m.morph_names.is_empty()) else {
                let message = "channel animates weights of a node without morph targets: skipped";
                finite.warnings.add(target.pointer(), message);
                return Ok(None);
            };
            expect_count(mesh.morph_names.len() as u64)?;
            let rows = finite.rows::<1>("sampler output", output)?;
            rows.map(|rows| AnimationValues::MorphWeights(rows.into_flattened()))
        }
    };
    Ok(values.map(|values| AnimationChannel { node, times, interpolation, values }))
}

/// Largest time, value and tangent of a key: products of three of them are numbers still.
const LARGEST: f32 = 1e12;

/// Reads what a channel refers to, and says where it is not finite.
struct Finite<'a, 'b> {
    target: &'a Json<'b>,
    warnings: &'a mut Warnings,
}

impl Finite<'_, '_> {
    /// All elements; `None` where one of them is NaN, infinite, or so large that what lies between keys would be.
    fn rows<const N: usize>(&mut self, what: &str, accessor: &Accessor) -> Result<Option<Vec<[f32; N]>>> {
        let (rows, bad) = accessor.all_floats::<N>()?;
        let large = rows.as_flattened().iter().filter(|value| value.abs() > LARGEST).count();
        if bad > 0 || large > 0 {
            let place = &accessor.pointer;
            let found = if bad > 0 {
                format!("{bad} NaN or infinite values")
            } else {
                format!("{large} values beyond {LARGEST:e}")
            };
            let message = format!("{what} {place} has {found}: channel skipped");
            self.warnings.add(self.target.pointer(), message);
            return Ok(None);
        }
        Ok(Some(rows))
    }
}

/// Makes quaternions unit; those without a direction become the identity.
#[allow(clippy::arithmetic_side_effects, reason = "float vectors cannot overflow")]
fn normalize(rows: &mut [[f32; 4]]) {
    for row in rows {
        let q = glam::DQuat::from_array(row.map(f64::from));
        let length = q.length();
        *row = if length > 1e-12 {
            (q / length).as_quat().to_array()
        } else {
            [0.0, 0.0, 0.0, 1.0]
        };
    }
}
