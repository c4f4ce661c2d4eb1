//! `VRMC_springBone` 1.0 with `VRMC_springBone_extended_collider`, and `VRMC_node_constraint`.

use std::collections::BTreeSet;

use glam::Vec3;

use crate::scene::{Character, Collider, ColliderShape, ConstraintKind, NodeConstraint, Spring, SpringJoint};

use super::fault::{Limits, quoted};
use super::graph::Graph;
use super::json::Json;
use super::warnings::Warnings;

/// Reads colliders and springs. Broken parts are left out with a warning.
pub(super) fn read(ext: &Json, graph: &Graph, character: &mut Character, limits: &Limits, warnings: &mut Warnings) {
    // Index in the scene of each collider of the file.
    let mut from_file = Vec::new();
    for json in ext.list("colliders") {
        let collider = graph.maybe_node(&json, "node").zip(shape(&json));
        from_file.push(collider.map(|(node, shape)| {
            character.colliders.push(Collider { node, shape });
            character.colliders.len().saturating_sub(1)
        }));
        if collider.is_none() {
            warnings.add(json.pointer(), "collider without a known node or shape: skipped");
        }
    }
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for group in ext.list("colliderGroups") {
        let list = group.list("colliders");
        let known = list.iter().filter_map(|c| from_file.get(c.as_index(from_file.len(), "").ok()?).copied().flatten());
        groups.push(distinct(known));
    }
    let mut taken = vec![false; graph.nodes.len()];
    // References to colliders are copied for each spring, so their number needs a bound.
    let mut references = limits.nodes.saturating_mul(10);
    for json in ext.list("springs") {
        let joints = joints(&json, graph, &mut taken, warnings);
        if joints.is_empty() {
            warnings.add(json.pointer(), "spring without usable joints: skipped");
            continue;
        }
        let colliders = colliders_of(&json, &groups, &mut references);
        if references == 0 {
            warnings.add(json.pointer(), "too many springs and colliders: the rest is left out");
            return;
        }
        let name = json.name().unwrap_or_default();
        character.springs.push(Spring { name, joints, center: graph.maybe_node(&json, "center"), colliders });
    }
}

/// Each entry once, where it stands first.
fn distinct(list: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut seen = BTreeSet::new();
    list.filter(|entry| seen.insert(*entry)).collect()
}

/// Colliders of the groups that a spring names, in the order of the groups and of the colliders in each. `left` is how many
/// references may still be followed; at 0 the list is cut.
pub(super) fn colliders_of(spring: &Json, groups: &[Vec<usize>], left: &mut u64) -> Vec<usize> {
    let list = spring.list("colliderGroups");
    let known = distinct(list.iter().filter_map(|g| g.as_index(groups.len(), "").ok()));
    let all = known.iter().filter_map(|g| groups.get(*g)).flatten().copied();
    distinct(all.take_while(|_| {
        *left = left.saturating_sub(1);
        *left > 0
    }))
}

fn joints(spring: &Json, graph: &Graph, taken: &mut [bool], warnings: &mut Warnings) -> Vec<SpringJoint> {
    let mut out: Vec<SpringJoint> = Vec::new();
    for json in spring.list("joints") {
        let Some(node) = graph.maybe_node(&json, "node") else {
            warnings.add(json.pointer(), "spring joint on an unknown node: the chain ends before it");
            break;
        };
        if out.last().is_some_and(|above| !graph.is_below(above.node, node)) {
            warnings.add(json.pointer(), "spring joint is not below the joint before it: the chain ends before it");
            break;
        }
        match taken.get_mut(node) {
            Some(slot) if !*slot => *slot = true,
            _ => {
                warnings.add(json.pointer(), "node is a joint of two springs: the second chain ends before it");
                break;
            }
        }
        out.push(SpringJoint {
            node,
            hit_radius: json.f32_or("hitRadius", 0.0).max(0.0),
            stiffness: json.f32_or("stiffness", 1.0).max(0.0),
            gravity_power: json.f32_or("gravityPower", 0.0),
            gravity_dir: vec3(&json, "gravityDir", Vec3::NEG_Y),
            drag: json.f32_or("dragForce", 0.5).clamp(0.0, 1.0),
        });
    }
    out
}

fn vec3(json: &Json, key: &str, default: Vec3) -> Vec3 {
    Vec3::from_array(json.floats_or(key, default.to_array()))
}

/// The extended shape where there is one; the plain one is its fallback.
fn shape(collider: &Json) -> Option<ColliderShape> {
    let extended = collider.at("extensions").at("VRMC_springBone_extended_collider").at("shape");
    read_shape(&extended).or_else(|| read_shape(&collider.at("shape")))
}

fn read_shape(json: &Json) -> Option<ColliderShape> {
    let offset = |s: &Json| vec3(s, "offset", Vec3::ZERO);
    let radius = |s: &Json| s.f32_or("radius", 0.0).max(0.0);
    let [sphere, capsule, plane] = ["sphere", "capsule", "plane"].map(|k| json.at(k));
    if sphere.is_object() {
        return Some(ColliderShape::Sphere {
            offset: offset(&sphere),
            radius: radius(&sphere),
            inside: sphere.flag("inside"),
        });
    }
    if capsule.is_object() {
        return Some(ColliderShape::Capsule {
            offset: offset(&capsule),
            tail: vec3(&capsule, "tail", Vec3::ZERO),
            radius: radius(&capsule),
            inside: capsule.flag("inside"),
        });
    }
    let normal = vec3(&plane, "normal", Vec3::Z).try_normalize().unwrap_or(Vec3::Z);
    plane.is_object().then(|| ColliderShape::Plane { offset: offset(&plane), normal })
}

/// Reads the constraints of all nodes; those on themselves and in circles are left out.
pub(super) fn read_constraints(nodes: &[Json], graph: &Graph, warnings: &mut Warnings) -> Vec<NodeConstraint> {
    let mut found: Vec<(NodeConstraint, &str)> = Vec::new();
    let mut source_of: Vec<Option<usize>> = vec![None; graph.nodes.len()];
    for (index, json) in nodes.iter().enumerate() {
        let ext = json.at("extensions").at("VRMC_node_constraint");
        let Some(node) = graph.node(index).filter(|_| !ext.is_null()) else { continue };
        match read_constraint(node, &ext.at("constraint"), graph) {
            Some(constraint) => {
                if let Some(slot) = source_of.get_mut(node) {
                    *slot = Some(constraint.source);
                }
                found.push((constraint, json.pointer()));
            }
            None => warnings.add(json.pointer(), "constraint of an unknown kind or source, or on itself: skipped"),
        }
    }
    let circular = circular(&source_of);
    let mut out = Vec::new();
    for (constraint, pointer) in found {
        if circular.get(constraint.node).copied().unwrap_or(false) {
            let name = graph.nodes.get(constraint.node).map_or("", |n| n.name.as_str());
            warnings.add(pointer, format!("constraint of node {} is part of a circle: skipped", quoted(name)));
        } else {
            out.push(constraint);
        }
    }
    out
}

fn read_constraint(node: usize, json: &Json, graph: &Graph) -> Option<NodeConstraint> {
    let [roll, aim, rotation] = ["roll", "aim", "rotation"].map(|k| json.at(k));
    let (json, kind) = if roll.is_object() {
        let axis = match roll.text("rollAxis") {
            "X" => Vec3::X,
            "Y" => Vec3::Y,
            "Z" => Vec3::Z,
            _ => return None,
        };
        (roll, ConstraintKind::Roll { axis })
    } else if aim.is_object() {
        let axis = match aim.text("aimAxis") {
            "PositiveX" => Vec3::X,
            "NegativeX" => Vec3::NEG_X,
            "PositiveY" => Vec3::Y,
            "NegativeY" => Vec3::NEG_Y,
            "PositiveZ" => Vec3::Z,
            "NegativeZ" => Vec3::NEG_Z,
            _ => return None,
        };
        (aim, ConstraintKind::Aim { axis })
    } else if rotation.is_object() {
        (rotation, ConstraintKind::Rotation)
    } else {
        return None;
    };
    let source = graph.maybe_node(&json, "source").filter(|s| *s != node)?;
    let source_rest = graph.nodes.get(source)?.transform.rotation;
    Some(NodeConstraint { node, source, weight: json.f32_or("weight", 1.0).clamp(0.0, 1.0), kind, source_rest })
}

/// Marks the nodes whose chain of sources leads back to themselves. Every node has at most one source.
fn circular(source_of: &[Option<usize>]) -> Vec<bool> {
    let mut circular = vec![false; source_of.len()];
    // The walk on which each node was met, 0 for none.
    let mut met = vec![0usize; source_of.len()];
    for start in 0..source_of.len() {
        let walk = start.saturating_add(1);
        let mut at = start;
        while let Some(next) = source_of.get(at).copied().flatten() {
            match met.get(at).copied() {
                Some(0) => {}
                Some(m) if m == walk => {
                    // Met twice on this walk: everything from here round is the circle.
                    while let Some(slot) = circular.get_mut(at).filter(|c| !**c) {
                        *slot = true;
                        at = source_of.get(at).copied().flatten().unwrap_or(at);
                    }
                    break;
                }
                _ => break,
            }
            if let Some(slot) = met.get_mut(at) {
                *slot = walk;
            }
            at = next;
        }
    }
    circular
}
