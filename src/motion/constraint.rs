//! Constraints between nodes (`VRMC_node_constraint` 1.0): roll, aim, rotation, each after what it depends on.

use std::collections::BTreeMap;

use glam::{Quat, Vec3};

use super::places::place_of;
use super::rotation::{between, direction, inverse, mul, slerp, turn};
use super::skeleton::Skeleton;
use crate::scene::{ConstraintKind, NodeConstraint, Transform};

/// A constraint, and its node at rest.
#[derive(Clone, Debug)]
pub(crate) struct ConstraintStep {
    constraint: NodeConstraint,
    rest: Quat,
}

impl ConstraintStep {
    /// All constraints, sources first. In a circle, which only nodes above each other can close, the first one of the file
    /// takes the last values.
    pub fn in_order(list: &[NodeConstraint], parents: &[Option<usize>], rest: &[Transform]) -> Vec<Self> {
        let nodes = parents.len();
        let mut of_node: Vec<Option<&NodeConstraint>> = vec![None; nodes];
        for constraint in list.iter().filter(|c| c.node < nodes && c.source < nodes) {
            of_node[constraint.node] = Some(constraint);
        }
        let mut order: Vec<&NodeConstraint> = Vec::new();
        // Walked without recursion: files nest as deep as they like.
        let mut done: BTreeMap<Step, bool> = BTreeMap::new();
        for constraint in list {
            let mut stack = vec![Step::Node(constraint.node)];
            while let Some(&step) = stack.last() {
                match done.get(&step) {
                    None => {
                        done.insert(step, false);
                        let needs = step.needs(&of_node, parents);
                        stack.extend(needs.into_iter().flatten().filter(|s| !done.contains_key(s)));
                    }
                    Some(is_done) => {
                        stack.pop();
                        if let (false, Step::Node(node)) = (is_done, step) {
                            order.extend(of_node.get(node).copied().flatten());
                        }
                        done.insert(step, true);
                    }
                }
            }
        }
        order.into_iter().map(|c| Self { constraint: *c, rest: rest[c.node].rotation }).collect()
    }
}

/// What must have been done before others.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Step {
    /// The constraint on a node.
    Node(usize),
    /// Those on a node and on all above it.
    Above(usize),
}

impl Step {
    fn needs(self, of_node: &[Option<&NodeConstraint>], parents: &[Option<usize>]) -> [Option<Self>; 2] {
        let above = |node: usize| parents[node].map(Self::Above);
        match self {
            Self::Above(node) => [of_node[node].map(|_| Self::Node(node)), above(node)],
            Self::Node(node) => match of_node.get(node).copied().flatten() {
                None => [None; 2],
                // To aim, its own place must be known.
                Some(c) if matches!(c.kind, ConstraintKind::Aim { .. }) => [Some(Self::Above(c.source)), above(node)],
                Some(c) => [Some(Self::Above(c.source)), None],
            },
        }
    }
}

/// Applies all constraints.
pub(crate) fn constrain(skeleton: &Skeleton, locals: &mut [Transform]) {
    for ConstraintStep { constraint, rest } in &skeleton.constraints {
        let NodeConstraint { node, source, source_rest, .. } = *constraint;
        let target = match constraint.kind {
            ConstraintKind::Rotation => mul(*rest, mul(inverse(source_rest), locals[source].rotation)),
            ConstraintKind::Roll { axis } => {
                let change = mul(locals[source].rotation, inverse(source_rest));
                let change = mul(inverse(*rest), mul(change, *rest));
                let swing = between(axis, turn(change, axis));
                mul(*rest, mul(inverse(swing), change))
            }
            ConstraintKind::Aim { axis } => aim(skeleton, locals, node, source, axis, *rest),
        };
        locals[node].rotation = slerp(*rest, target, constraint.weight);
    }
}

fn aim(skeleton: &Skeleton, locals: &[Transform], node: usize, source: usize, axis: Vec3, rest: Quat) -> Quat {
    let at = place_of(&skeleton.parents, locals, node).position;
    let to = place_of(&skeleton.parents, locals, source).position;
    let above = skeleton.parents[node].map_or(Quat::IDENTITY, |p| place_of(&skeleton.parents, locals, p).rotation);
    let from = turn(above, turn(rest, axis));
    let Some(to) = direction(Vec3::new(to.x - at.x, to.y - at.y, to.z - at.z)) else { return rest };
    mul(inverse(above), mul(between(from, to), mul(above, rest)))
}
