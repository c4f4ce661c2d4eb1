//! What motion needs of a character, found once: its nodes, its bones, and the order of everything that depends on others.

use std::collections::BTreeMap;

use glam::{Mat4, Quat, Vec3};

use super::constraint::ConstraintStep;
use super::expression::kinds_of;
use super::places::{Place, place_all};
use super::pose::Pose;
use super::spring::SpringRig;
use crate::scene::{Character, Expression, HumanBone, LookAt, Scene, Transform};

/// The moving parts of a character. Made at the upload ([`Character::skeleton`](crate::Character::skeleton)), or by
/// [`Skeleton::of`] where nothing is drawn.
#[derive(Clone, Debug)]
pub struct Skeleton {
    pub(crate) parents: Vec<Option<usize>>,
    /// Transforms at rest.
    pub(crate) rest: Vec<Transform>,
    /// Places at rest, the character's own space.
    pub(crate) rest_places: Vec<Place>,
    /// Weights of morphs at rest, of each node.
    pub(crate) rest_weights: Vec<Vec<f32>>,
    /// Nodes that have some.
    pub(crate) morphed: Vec<u32>,
    pub(crate) bones: BTreeMap<HumanBone, usize>,
    pub(crate) expressions: Vec<Expression>,
    pub(crate) kinds: Vec<Option<usize>>,
    /// What the diameter of pupils is multiplied by at weight 1 of each.
    pub(crate) pupils: Vec<f32>,
    /// Morph targets that expressions drive: node, target.
    pub(crate) bound: Vec<(u32, u32)>,
    /// Expressions that blinks and gazes drive.
    pub(crate) driven: DrivenExpressions,
    pub(crate) look_at: Option<LookAt>,
    pub(crate) head: Option<HeadRig>,
    pub(crate) constraints: Vec<ConstraintStep>,
    pub(crate) springs: SpringRig,
}

/// Expressions by what drives them; `None` where the character lacks one.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct DrivenExpressions {
    /// `blink`, else both of `blinkLeft` and `blinkRight`.
    pub blink: [Option<usize>; 2],
    /// `lookLeft`, `lookRight`, `lookUp`, `lookDown`.
    pub look: [Option<usize>; 4],
}

/// The head and what turns with a gaze.
#[derive(Clone, Debug)]
pub(crate) struct HeadRig {
    pub head: usize,
    pub neck: Option<usize>,
    /// Left, right.
    pub eyes: [Option<usize>; 2],
    /// The first of neck and head, and all below it.
    pub below: Vec<u32>,
}

impl Skeleton {
    /// That of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let nodes = &scene.nodes;
        let parents: Vec<Option<usize>> = nodes.iter().map(|n| n.parent).collect();
        let rest: Vec<Transform> = nodes.iter().map(|n| n.transform).collect();
        let mut rest_places = Vec::with_capacity(nodes.len());
        place_all(&parents, &rest, &Place::ORIGIN, &mut rest_places);
        let none = Character::default();
        let character = scene.character.as_ref().unwrap_or(&none);
        let expressions = character.expressions.clone();
        let pupils = expressions.iter().map(|e| {
            let factors = scene.pupils.as_ref().map(|p| &p.expressions);
            factors.and_then(|f| f.get(&e.name)).copied().unwrap_or(1.0)
        });
        let has = |node: usize, target: usize| nodes.get(node).is_some_and(|n| target < n.morph_weights.len());
        let mut bound: Vec<(u32, u32)> = expressions
            .iter()
            .flat_map(|e| &e.morphs)
            .filter(|b| has(b.node, b.target))
            .map(|b| (b.node as u32, b.target as u32))
            .collect();
        bound.sort_unstable();
        bound.dedup();
        let bones: BTreeMap<HumanBone, usize> =
            character.bones.iter().filter(|(_, n)| **n < nodes.len()).map(|(b, n)| (*b, *n)).collect();
        Self {
            morphed: (0..nodes.len() as u32).filter(|n| !nodes[*n as usize].morph_weights.is_empty()).collect(),
            rest_weights: nodes.iter().map(|n| n.morph_weights.clone()).collect(),
            pupils: pupils.collect(),
            bound,
            kinds: kinds_of(&expressions),
            driven: DrivenExpressions::of(&expressions),
            look_at: character.look_at.clone(),
            head: HeadRig::of(&bones, &parents),
            constraints: ConstraintStep::in_order(&character.constraints, &parents, &rest),
            springs: SpringRig::of(character, &parents, &rest, &rest_places),
            expressions,
            bones,
            parents,
            rest,
            rest_places,
        }
    }

    /// Number of nodes.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.parents.len()
    }

    /// Where the nodes of a pose stand: position, metres, and rotation, for a character at `world`. The same bits everywhere.
    #[must_use]
    pub fn places(&self, pose: &Pose, world: &Mat4) -> Vec<(Vec3, Quat)> {
        let mut places = Vec::with_capacity(self.node_count());
        place_all(&self.parents, &pose.locals, &Place::of(world), &mut places);
        places.into_iter().map(|place| (place.position, place.rotation)).collect()
    }

    /// Index of an expression.
    #[must_use]
    pub fn expression(&self, name: &str) -> Option<usize> {
        self.expressions.iter().position(|e| e.name == name)
    }

    /// Rotation at rest of what is above a node, in the character's own space.
    pub(crate) fn rest_above(&self, node: usize) -> Quat {
        self.parents[node].map_or(Quat::IDENTITY, |p| self.rest_places[p].rotation)
    }
}

impl DrivenExpressions {
    fn of(expressions: &[Expression]) -> Self {
        let find = |name: &str| expressions.iter().position(|e| e.name == name);
        let blink = match find("blink") {
            Some(both) => [Some(both), None],
            None => [find("blinkLeft"), find("blinkRight")],
        };
        Self { blink, look: ["lookLeft", "lookRight", "lookUp", "lookDown"].map(find) }
    }
}

impl HeadRig {
    fn of(bones: &BTreeMap<HumanBone, usize>, parents: &[Option<usize>]) -> Option<Self> {
        let of = |bone| bones.get(&bone).copied();
        let head = of(HumanBone::Head)?;
        let neck = of(HumanBone::Neck).filter(|neck| is_below(parents, *neck, head));
        let eyes = [HumanBone::LeftEye, HumanBone::RightEye].map(of);
        Some(Self { head, neck, eyes, below: descendants(parents, neck.unwrap_or(head)) })
    }
}

/// A node and all below it, parents before children.
pub(crate) fn descendants(parents: &[Option<usize>], root: usize) -> Vec<u32> {
    let mut is_in = vec![false; parents.len()];
    let mut list = Vec::new();
    for (node, parent) in parents.iter().enumerate().skip(root) {
        if node == root || parent.is_some_and(|p| is_in[p]) {
            is_in[node] = true;
            list.push(node as u32);
        }
    }
    list
}

/// Whether a node is another one, or above it.
pub(crate) fn is_below(parents: &[Option<usize>], above: usize, node: usize) -> bool {
    std::iter::successors(Some(node), |n| parents[*n]).any(|n| n == above)
}
