//! A look over to her left, then to her right.

use super::clip::{Clip, Source};
use super::curve::{blink, ease, hold, mix};
use super::idle::{breath, stand};
use super::posture::{Posture, turn as turned};
use crate::skeleton::Skeleton;

/// Seconds.
const LENGTH: f32 = 4.2;
/// Starts of the three moves: to the left, to the right, back.
const MOVES: [f32; 3] = [0.15, 1.55, 3.0];

/// A direction that goes to 1, to -1 and back to 0, `late` seconds after the eyes, each way taking these seconds.
fn course(time: f32, late: f32, takes: [f32; 3]) -> f32 {
    let way = |i: usize| ease(time, MOVES[i] + late, MOVES[i] + late + takes[i]);
    way(0) - 2.0 * way(1) + way(2)
}

fn posture(time: f32) -> Posture {
    let mut posture = stand(breath(time / LENGTH), 0.0);
    let eyes = course(time, 0.0, [0.16, 0.2, 0.16]);
    let head = course(time, 0.12, [0.72, 0.92, 0.8]);
    let chest = course(time, 0.26, [0.85, 1.05, 0.85]);
    let hips = course(time, 0.34, [0.85, 1.1, 0.8]);
    // In the middle of a move the chin goes down: a head turns in an arc.
    let arc: f32 = MOVES.iter().map(|m| hold(time, [m + 0.14, m + 0.48, m + 0.48, m + 0.98])).sum();
    posture.pelvis *= turned(3.0 * hips, 0.0, 0.0);
    posture.hips.x += 0.004 * hips;
    posture.chest *= turned(10.0 * chest, 0.0, 1.2 * chest);
    // Over a shoulder she looks a little upwards, with the head a little aside.
    posture.head *= turned(43.0 * head, 4.5 * arc - 2.0 * head.abs(), 3.0 * head);
    for (arm, sign) in posture.arms.iter_mut().zip([1.0, -1.0]) {
        // Arms are dragged along.
        arm.swing -= sign * 5.0 * chest;
        arm.elbow += 2.0 * chest.abs();
    }
    // Where the eyes want to look, less what the head has turned already.
    let wanted = 50.0 * eyes;
    let yaw = (wanted - 43.0 * head).clamp(-28.0, 28.0);
    posture.gaze = [yaw, mix(0.0, 2.0, arc)];
    posture
}

/// She looks to her left, waits, looks to her right, waits, and looks ahead again.
pub(super) fn turn(skeleton: &Skeleton) -> Clip {
    let mut blinks = vec![(0.0, 0.0)];
    blinks.extend([MOVES[0] + 0.14, MOVES[1] + 0.2, MOVES[2] + 0.16].into_iter().flat_map(blink));
    let expressions = vec![("blink", blinks)];
    Source { name: "turn", length: LENGTH, rate: 30.0, looped: false, travel: 0.0, posture: &posture, expressions }
        .clip(skeleton)
}
