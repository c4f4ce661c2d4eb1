//! Bones that move the body and what is worn on it: smooth over about one radius to each side of a joint.

use glam::Vec3;

use crate::picture::smoothstep;
use crate::skeleton::{Skeleton, Weights, blend};

/// Shares of a chain of joints: each rules from its place to the next; borders are soft over `reach` to each side.
fn chain<const N: usize>(at: f32, borders: [f32; N], reach: [f32; N]) -> Vec<f32> {
    let mut rest = 1.0;
    let mut shares = Vec::with_capacity(N + 1);
    for (border, reach) in borders.iter().zip(reach) {
        let beyond = smoothstep(border - reach, border + reach, at);
        shares.push(rest * (1.0 - beyond));
        rest *= beyond;
    }
    shares.push(rest);
    shares
}

fn spine(skeleton: &Skeleton, y: f32) -> Vec<(usize, f32)> {
    let shares = chain(y, [0.925, 1.02, 1.115, 1.248], [0.045, 0.045, 0.04, 0.018]);
    ["hips", "spine", "chest", "upperChest", "neck"].iter().map(|n| skeleton.find(n)).zip(shares).collect()
}

fn side(x: f32) -> &'static str {
    if x < 0.0 { "right" } else { "left" }
}

fn arm_list(skeleton: &Skeleton, p: Vec3) -> Vec<(usize, f32)> {
    let shares = chain(p.x.abs(), [0.112, 0.332, 0.537], [0.052, 0.036, 0.018]);
    let bone = |name: &str| skeleton.find(&format!("{}{name}", side(p.x)));
    ["Shoulder", "UpperArm", "LowerArm", "Hand"].iter().map(|n| bone(n)).zip(shares).collect()
}

/// Torso and what is worn on it; towards the arms it follows them.
#[must_use]
pub fn torso(skeleton: &Skeleton, p: Vec3) -> Weights {
    let arm = smoothstep(0.07, 0.15, p.x.abs()) * smoothstep(1.085, 1.185, p.y);
    let mut list: Vec<(usize, f32)> = spine(skeleton, p.y).into_iter().map(|(b, w)| (b, w * (1.0 - arm))).collect();
    list.extend(arm_list(skeleton, p).into_iter().map(|(b, w)| (b, w * arm)));
    blend(&list)
}

/// Arm, by the distance from the middle of the body.
#[must_use]
pub fn arm(skeleton: &Skeleton, p: Vec3) -> Weights {
    blend(&arm_list(skeleton, p))
}

/// Leg, from the hip to the toes.
#[must_use]
pub fn leg(skeleton: &Skeleton, p: Vec3) -> Weights {
    let shares = chain(-p.y, [-0.815, -0.45, -0.095], [0.06, 0.05, 0.03]);
    let bone = |name: &str| skeleton.find(&format!("{}{name}", side(p.x)));
    let toes = smoothstep(0.05, 0.09, p.z) * smoothstep(0.1, 0.06, p.y);
    let mut list = vec![
        (skeleton.find("hips"), shares[0]),
        (bone("UpperLeg"), shares[1]),
        (bone("LowerLeg"), shares[2]),
        (bone("Foot"), shares[3] * (1.0 - toes)),
        (bone("Toes"), shares[3] * toes),
    ];
    list.retain(|(_, w)| *w > 0.0);
    blend(&list)
}
