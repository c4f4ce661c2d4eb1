//! A wave of the right hand.

use super::clip::{Clip, Source};
use super::curve::{hold, mix, swing};
use super::idle::{breath, stand};
use super::posture::{Arm, Posture, turn};
use crate::skeleton::Skeleton;

/// Seconds.
const LENGTH: f32 = 3.3;
/// The arm while it waves: upper arm nearly level, forearm upright, palm to the front.
const UP: Arm = Arm {
    raise: 15.0,
    protract: 5.0,
    swing: 12.0,
    abduct: 74.0,
    twist: -76.0,
    elbow: 87.0,
    pronate: -8.0,
    flex: -8.0,
    deviate: 0.0,
    curl: 0.2,
    spread: 7.0,
};
/// The hand goes to and fro this often a second.
const RATE: f32 = 2.0;

fn posture(time: f32) -> Posture {
    let lean = hold(time, [0.1, 0.95, 2.2, 3.2]);
    // She leans away from the arm, half over to the other leg.
    let mut posture = stand(breath(time / LENGTH), 0.62 * lean);
    // The elbow bends while the arm rises, then the forearm turns up and the hand comes last; so the hand passes close
    // before the body. It goes down the same way.
    let upper = hold(time, [0.1, 0.9, 2.25, 3.12]);
    let fore = hold(time, [0.08, 0.8, 2.36, 3.2]);
    let turned = hold(time, [0.24, 1.06, 2.08, 2.92]);
    let hand = hold(time, [0.4, 1.12, 2.25, 3.2]);
    let mut arm = posture.arms[1];
    arm.raise = mix(arm.raise, UP.raise, upper);
    arm.protract = mix(arm.protract, UP.protract, upper);
    arm.swing = mix(arm.swing, UP.swing, upper);
    arm.abduct = mix(arm.abduct, UP.abduct, upper);
    arm.twist = mix(arm.twist, UP.twist, turned);
    arm.elbow = mix(arm.elbow, UP.elbow, fore);
    arm.pronate = mix(arm.pronate, UP.pronate, hand);
    // On the way up the hand hangs back.
    arm.flex = mix(arm.flex, UP.flex, hand) + 16.0 * hold(time, [0.1, 0.5, 0.55, 1.1]);
    arm.curl = mix(arm.curl, UP.curl, hand) + 0.5 * hold(time, [0.1, 0.45, 0.5, 1.05]);
    arm.spread = mix(arm.spread, UP.spread, hand);
    // To and fro and ever less, the hand late behind the forearm and the fingers behind the hand.
    let strength = hold(time, [0.66, 1.06, 1.5, 2.6]);
    let turns = (time - 0.78) * RATE;
    arm.elbow -= 21.0 * strength * swing(turns, 0.25);
    arm.abduct += 4.0 * strength * swing(turns, 0.18);
    arm.twist += 5.0 * strength * swing(turns, 0.3);
    arm.deviate += 19.0 * strength * swing(turns, 0.43);
    arm.flex += 8.0 * strength * swing(2.0 * turns, 0.9);
    arm.curl += 0.35 * strength * (1.0 - swing(2.0 * turns, 0.05));
    arm.spread += 4.0 * strength * swing(2.0 * turns, 0.0);
    posture.arms[1] = arm;
    // Before the arm rises the body sinks a little towards it; then it leans away and the head tilts to the hand.
    let dip = hold(time, [0.0, 0.2, 0.2, 0.6]);
    let tilt = hold(time, [0.2, 1.0, 2.0, 3.0]);
    let bob = strength * swing(turns, 0.32);
    posture.hips.y -= 0.006 * dip;
    posture.hips.x += 0.003 * bob;
    posture.pelvis *= turn(-2.0 * lean, 0.0, 0.0);
    posture.chest *= turn(4.0 * lean, 2.0 * dip - 2.0 * lean, 1.5 * dip - 5.5 * lean - 1.2 * bob);
    posture.head *= turn(-4.0 * tilt, 2.5 * dip + tilt, 6.5 * tilt + 1.6 * bob);
    // The other arm is drawn in.
    let other = hold(time, [0.25, 1.15, 2.15, 3.2]);
    let arm = &mut posture.arms[0];
    arm.swing -= 5.0 * other;
    arm.abduct += 6.0 * other + 0.8 * bob;
    arm.elbow += 16.0 * other;
    arm.flex -= 14.0 * other;
    arm.curl -= 0.3 * other;
    arm.spread += 3.0 * other;
    posture
}

/// The right hand goes up and waves; she smiles.
pub(super) fn wave(skeleton: &Skeleton) -> Clip {
    let smile =
        [(0.0, 0.0), (0.04, 0.0), (0.14, 0.06), (0.32, 0.22), (0.44, 0.27), (2.3, 0.27), (2.6, 0.2), (3.0, 0.04)];
    let mut smile = smile.to_vec();
    smile.extend([(3.15, 0.0), (LENGTH, 0.0)]);
    let expressions = vec![("happy", smile)];
    Source { name: "wave", length: LENGTH, rate: 30.0, looped: false, travel: 0.0, posture: &posture, expressions }
        .clip(skeleton)
}
