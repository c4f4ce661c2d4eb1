//! Standing: the posture from which all clips start, and the life in it.

use glam::Vec3;

use super::clip::{Clip, Source};
use super::curve::{blink, hold, mix, swing};
use super::foot::ANKLE;
use super::posture::{Arm, Foot, Posture, turn};
use crate::skeleton::Skeleton;

/// An arm at ease beside the skirt.
pub(super) const ARM: Arm = Arm {
    raise: -2.0,
    protract: 0.0,
    swing: -3.0,
    abduct: 20.0,
    twist: 16.0,
    elbow: 21.0,
    pronate: 14.0,
    flex: 5.0,
    deviate: 0.0,
    curl: 1.0,
    spread: 0.0,
};

/// Standing at ease, `breath` 0 (out) to 1 (in) and `side` 0 (weight on the right leg) to 1 (on the left).
pub(super) fn stand(breath: f32, side: f32) -> Posture {
    let foot = |z: f32, out: f32| Foot { ankle: Vec3::new(0.058, ANKLE, z), out, knee: out * 0.25, ..Foot::default() };
    // Hips go to the leg that carries and are higher there; shoulders lean against them.
    let lean = mix(-1.0, 0.8, side);
    // Between the legs the hips pass a little lower.
    let low = 4.0 * side * (1.0 - side);
    let arm = Arm { raise: ARM.raise + 1.6 * breath, abduct: ARM.abduct + 0.5 * breath, ..ARM };
    Posture {
        hips: Vec3::new(0.017 * lean, 0.8605 - 0.002 * low + 0.0008 * breath, 0.0),
        pelvis: turn(-2.0 - 1.2 * lean, 1.5, 2.3 * lean),
        chest: turn(-1.0 - 0.4 * lean, -0.5 - 1.3 * breath, -1.5 * lean),
        head: turn(-0.6, 1.0 - 0.4 * breath, -1.2 * lean),
        arms: [arm; 2],
        feet: [foot(0.026, 12.0), foot(-0.016, 5.0)],
        gaze: [0.0; 2],
    }
}

/// Breath at a phase counted in breaths: in faster than out, 0 at whole numbers.
pub(super) fn breath(phase: f32) -> f32 {
    let phase = phase.rem_euclid(1.0);
    // A warped cosine: the peak comes at two fifths.
    let warped = phase + 0.03 * (std::f32::consts::TAU * phase).sin();
    0.5 - 0.5 * swing(warped, 0.0)
}

/// Seconds of the loop.
const LENGTH: f32 = 8.0;

fn posture(time: f32) -> Posture {
    let phase = time / LENGTH;
    let side = hold(time, [0.7, 3.5, 4.6, 7.4]);
    let mut posture = stand(breath(2.0 * phase), side);
    // Whole numbers of turns a loop. Each starts at its own rest, so that the loop starts standing.
    let drift = |turns: f32, late: f32| swing(turns * phase, late) - swing(0.0, late);
    posture.head *= turn(
        1.3 * drift(1.0, 0.3) + 0.5 * drift(3.0, 0.1),
        0.7 * drift(2.0, 0.35) + 0.3 * drift(3.0, 0.6),
        0.8 * drift(1.0, 0.55),
    );
    for (arm, [a, b]) in posture.arms.iter_mut().zip([[0.12, 0.4], [0.5, 0.85]]) {
        arm.swing += 0.9 * drift(1.0, a);
        arm.elbow += 1.4 * drift(2.0, b);
        arm.pronate += 1.6 * drift(1.0, b);
        arm.flex += 1.8 * drift(2.0, a);
        arm.curl += 0.1 * drift(3.0, a) + 0.06 * drift(2.0, b);
    }
    posture.gaze = [0.8 * drift(2.0, 0.2), 0.4 * drift(1.0, 0.7)];
    posture
}

/// Standing, breathing, shifting the weight from one leg to the other and back.
pub(super) fn idle(skeleton: &Skeleton) -> Clip {
    let mut blinks = vec![(0.0, 0.0)];
    blinks.extend([1.3, 4.1, 4.5, 6.6].into_iter().flat_map(blink));
    let expressions = vec![("blink", blinks)];
    Source { name: "idle", length: LENGTH, rate: 30.0, looped: true, travel: 0.0, posture: &posture, expressions }
        .clip(skeleton)
}
