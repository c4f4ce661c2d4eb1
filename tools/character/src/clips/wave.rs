//! A wave of the right hand.

use super::clip::{Clip, Source};
use super::curve::{hold, mix, swing};
use super::idle::{ARM, breath, stand};
use super::posture::{Arm, Posture, turn};
use crate::skeleton::Skeleton;

/// Seconds.
const LENGTH: f32 = 2.9;
/// The arm while it waves: forearm upright, palm to the front.
const UP: Arm = Arm {
    raise: 7.0,
    protract: 4.0,
    swing: 20.0,
    abduct: 46.0,
    twist: -72.0,
    elbow: 124.0,
    pronate: -6.0,
    flex: -10.0,
    deviate: 0.0,
    curl: 0.25,
    spread: 5.0,
};
/// The hand goes to and fro this often a second.
const RATE: f32 = 2.1;

fn posture(time: f32) -> Posture {
    let mut posture = stand(breath(time / LENGTH), 0.0);
    // The elbow bends while the arm rises, then the forearm turns up and the hand comes last; so the hand passes close
    // before the body. It goes down the same way.
    let upper = hold(time, [0.1, 0.82, 2.0, 2.74]);
    let fore = hold(time, [0.1, 0.8, 2.02, 2.78]);
    let turned = hold(time, [0.26, 0.98, 1.86, 2.56]);
    let hand = hold(time, [0.3, 1.0, 2.02, 2.85]);
    let mut arm = posture.arms[1];
    arm.raise = mix(arm.raise, UP.raise, upper);
    arm.protract = mix(arm.protract, UP.protract, upper);
    arm.swing = mix(arm.swing, UP.swing, upper);
    arm.abduct = mix(arm.abduct, UP.abduct, upper);
    arm.twist = mix(ARM.twist, UP.twist, turned);
    arm.elbow = mix(ARM.elbow, UP.elbow, fore);
    arm.pronate = mix(ARM.pronate, UP.pronate, hand);
    arm.flex = mix(ARM.flex, UP.flex, hand);
    arm.curl = mix(ARM.curl, UP.curl, hand);
    arm.spread = mix(ARM.spread, UP.spread, hand);
    // To and fro, the hand late behind the forearm.
    let strength = hold(time, [0.68, 1.1, 1.7, 2.15]);
    let turns = (time - 0.75) * RATE;
    arm.elbow -= 17.0 * strength * swing(turns, 0.25);
    arm.abduct += 2.5 * strength * swing(turns, 0.2);
    arm.deviate += 13.0 * strength * swing(turns, 0.42);
    posture.arms[1] = arm;
    // Before the arm rises the body sinks a little towards it; then it leans away and the head tilts to the hand.
    let dip = hold(time, [0.0, 0.16, 0.16, 0.5]);
    let lean = hold(time, [0.12, 0.9, 1.95, 2.8]);
    let tilt = hold(time, [0.3, 1.05, 1.85, 2.7]);
    posture.hips.y -= 0.003 * dip + 0.001 * lean;
    posture.hips.x += 0.01 * lean;
    posture.pelvis *= turn(-1.5 * lean, 0.0, -0.8 * lean);
    posture.chest *= turn(2.5 * lean, dip - lean, 0.8 * dip - 3.0 * lean);
    posture.head *= turn(-3.0 * tilt, tilt + 2.0 * dip, 8.0 * tilt + 0.6 * strength * swing(turns, 0.35));
    posture.arms[0].swing -= 3.0 * lean;
    posture.arms[0].elbow += 6.0 * lean;
    posture
}

/// The right hand goes up and waves; she smiles.
pub(super) fn wave(skeleton: &Skeleton) -> Clip {
    let smile = [(0.0, 0.0), (0.3, 0.0), (0.4, 0.12), (0.6, 0.5), (0.72, 0.6), (2.0, 0.6), (2.2, 0.45), (2.5, 0.08)];
    let mut smile = smile.to_vec();
    smile.extend([(2.65, 0.0), (LENGTH, 0.0)]);
    let expressions = vec![("happy", smile)];
    Source { name: "wave", length: LENGTH, rate: 30.0, looped: false, travel: 0.0, posture: &posture, expressions }
        .clip(skeleton)
}
