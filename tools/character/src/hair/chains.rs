//! Chains of bones on which the locks swing.

use glam::Vec3;

use crate::model::{Collider, Model, Spring};
use crate::skeleton::{Skeleton, Weights, blend};

/// A chain: its bones and their places, root first; the last one only marks the end.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    joints: Vec<(usize, Vec3)>,
}

/// How a chain swings: stiffness at the root and at the tip, drag and gravity.
///
/// Drag holds a chain back in the world: at speed v (m/s) it trails by about atan(v * drag / (stiffness + gravity)), more with
/// each bone up to atan(v * drag / gravity). These let the hair lean back a little in a
/// walk and stream in waves in a run.
type Swing = ([f32; 2], f32, f32);
const FRONT: Swing = ([3.0, 3.0], 0.3, 0.05);
const SIDE: Swing = ([1.5, 0.6], 0.18, 0.3);
const BACK: Swing = ([1.9, 0.4], 0.14, 0.65);

/// Places of the chains' bones. Those of the left side are mirrored.
const CHAINS: &[(&str, bool, &[[f32; 3]], Swing)] = &[
    ("HairFront_Middle", false, &[[0.002, 1.5, 0.085], [0.002, 1.462, 0.102], [0.002, 1.425, 0.106]], FRONT),
    ("HairFront_Left", true, &[[0.045, 1.5, 0.07], [0.052, 1.458, 0.085], [0.056, 1.415, 0.086]], FRONT),
    (
        "HairSide_Left",
        true,
        &[[0.088, 1.42, 0.03], [0.092, 1.34, 0.05], [0.09, 1.26, 0.078], [0.084, 1.18, 0.108], [0.08, 1.08, 0.12]],
        SIDE,
    ),
    (
        "HairBack_Middle",
        false,
        &[
            [0.0, 1.38, -0.118],
            [0.0, 1.29, -0.138],
            [0.0, 1.2, -0.148],
            [0.0, 1.1, -0.15],
            [0.0, 1.01, -0.155],
            [0.0, 0.92, -0.16],
        ],
        BACK,
    ),
    (
        "HairBack_Left1",
        true,
        &[
            [0.05, 1.38, -0.108],
            [0.056, 1.29, -0.13],
            [0.062, 1.2, -0.142],
            [0.068, 1.1, -0.145],
            [0.07, 1.01, -0.15],
            [0.068, 0.92, -0.155],
        ],
        BACK,
    ),
    (
        "HairBack_Left2",
        true,
        &[
            [0.09, 1.38, -0.07],
            [0.105, 1.29, -0.095],
            [0.118, 1.2, -0.115],
            [0.128, 1.1, -0.122],
            [0.132, 1.01, -0.128],
            [0.128, 0.92, -0.135],
        ],
        BACK,
    ),
];

/// Adds the bones, the springs and the collider of the head; gives the chains by name.
pub(super) fn add(model: &mut Model) -> Vec<(String, Chain)> {
    let head = model.skeleton.find("head");
    let mut chains = Vec::new();
    for (name, sided, places, (stiffness, drag, gravity)) in CHAINS {
        for sign in if *sided { &[1.0, -1.0][..] } else { &[1.0] } {
            let name = if *sign < 0.0 {
                name.replace("Left", "Right")
            } else {
                (*name).to_owned()
            };
            let mut parent = head;
            let mut joints = Vec::new();
            for (i, [x, y, z]) in places.iter().enumerate() {
                let place = Vec3::new(x * sign, *y, *z);
                parent = model.skeleton.add(format!("{name}_{i}"), parent, place);
                joints.push((parent, place));
            }
            model.springs.push(Spring {
                name: name.clone(),
                joints: joints.iter().map(|(bone, _)| *bone).collect(),
                stiffness: *stiffness,
                drag: *drag,
                gravity: *gravity,
                radius: 0.018,
                colliders: vec!["head", "body"],
            });
            chains.push((name, Chain { joints }));
        }
    }
    let origin = model.skeleton.bones[head].position;
    model.colliders.push(Collider {
        group: "head",
        bone: head,
        offset: Vec3::new(0.0, 1.445, -0.012) - origin,
        tail: None,
        radius: 0.088,
    });
    chains
}

/// Bones that move a point of a lock: the head above the chain, then each joint in turn by height.
pub(super) fn weights(skeleton: &Skeleton, chain: Option<&Chain>, p: Vec3) -> Weights {
    let head = skeleton.find("head");
    let Some(Chain { joints }) = chain else { return blend(&[(head, 1.0)]) };
    let top = joints[0].1.y;
    // Over the first joint the head holds the lock.
    let free = 1.0 - crate::picture::smoothstep(top - 0.02, top + 0.05, p.y);
    let mut list = vec![(head, 1.0 - free)];
    let movable = joints.len() - 1;
    for i in 0..movable {
        let (upper, lower) = (joints[i].1.y, joints[i + 1].1.y);
        // Each joint rules the span below it; neighbours share the border.
        let span = (upper - lower) * 0.5;
        let enter = if i == 0 {
            1.0
        } else {
            1.0 - crate::picture::smoothstep(upper - span, upper + span, p.y)
        };
        let next = joints[i + 1].1.y;
        let next_span = joints.get(i + 2).map_or(span, |j| (next - j.1.y) * 0.5);
        let leave = if i + 1 == movable {
            0.0
        } else {
            1.0 - crate::picture::smoothstep(next - next_span, next + next_span, p.y)
        };
        list.push((joints[i].0, free * (enter - leave).max(0.0)));
    }
    blend(&list)
}
