//! Looking at something (`VRMC_vrm.lookAt` and VRM 0.x `firstPerson`): eyes by bones or expressions, and on request the head.

use glam::Vec3;

use super::blink::{random, share};
use super::places::{Place, place_some};
use super::rotation::{about, inverse, mul, slerp, turn};
use super::skeleton::{HeadRig, Skeleton};
use crate::scene::{LookAt, Transform};

/// What a character looks at, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaze {
    /// What it looks at. Default: `None`, what clips say, straight ahead where they say nothing.
    pub target: Option<GazeTarget>,
    /// Share of the way to the target that neck and head turn, smoothly; eyes do the rest. Range 0..1. Default: 0, eyes alone.
    pub head: f32,
    /// Time in which the head does most of a turn, seconds. Range 0... Default: 0.35.
    pub head_s: f32,
    /// Small, quick movements of the eyes, as living ones have: their seed. Default: none.
    pub saccades: Option<u64>,
    /// Angles of the head's own turn and their speed: yaw, pitch, radians.
    turn: [f32; 2],
    speed: [f32; 2],
    /// The last yaw, held where it has no meaning.
    yaw: f32,
}

impl Default for Gaze {
    fn default() -> Self {
        Self { target: None, head: 0.0, head_s: 0.35, saccades: None, turn: [0.0; 2], speed: [0.0; 2], yaw: 0.0 }
    }
}

/// Where a gaze goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GazeTarget {
    /// At a point, world space.
    Point(Vec3),
    /// By angles from straight ahead.
    Angles {
        /// Positive to the character's left, radians.
        yaw_rad: f32,
        /// Positive downwards, radians.
        pitch_rad: f32,
    },
}

/// Yaw (left +) and pitch (down +) of a gaze from the head, radians.
pub(crate) type Angles = [f32; 2];

/// How far a head turns and tilts, radians.
const MOST_TURN: Angles = [1.2, 0.6];
/// Turn (radians) and speed (radians a second) of a head below which it stands still.
const STILL: f32 = 1e-5;
/// Yaw from which on a target counts as behind, where the head stays on its side.
const BEHIND: f32 = 2.4;
/// Distance from the vertical through the head within which a target has no yaw, metres.
const NO_YAW_M: f32 = 1e-4;
/// How far small movements of the eyes go, radians, and how long each rests, seconds.
const SACCADE: Angles = [0.035, 0.02];
const SACCADE_S: f64 = 0.45;

/// Angles of a rotation of the gaze, roll left out.
pub(crate) fn angles_of(rotation: glam::Quat) -> Angles {
    let ahead = turn(rotation, Vec3::Z);
    [libm::atan2f(ahead.x, ahead.z), libm::asinf((-ahead.y).clamp(-1.0, 1.0))]
}

/// The way back: yaw after pitch.
fn rotation_of([yaw, pitch]: Angles) -> glam::Quat {
    mul(about(Vec3::Y, yaw), about(Vec3::X, pitch))
}

impl Gaze {
    /// At a point, world space.
    #[must_use]
    pub fn at(point: impl Into<Vec3>) -> Self {
        Self { target: Some(GazeTarget::Point(point.into())), ..Self::default() }
    }

    /// The same with the head: a share of the way.
    #[must_use]
    pub fn with_head(self, head: f32) -> Self {
        Self { head, ..self }
    }

    /// Whether it does nothing of its own.
    pub(crate) fn is_idle(&self) -> bool {
        self.target.is_none() && self.saccades.is_none() && self.head <= 0.0 && self.turn == [0.0; 2]
    }

    /// Turns neck and head towards the target, and says where the eyes go. `places` are those of `locals` in the character's own
    /// space, `root` its place in the world, `of_clips` what clips say.
    pub(crate) fn aim(
        &mut self,
        skeleton: &Skeleton,
        locals: &mut [Transform],
        places: &mut [Place],
        root: &Place,
        of_clips: Option<Angles>,
        [time_s, dt]: [f64; 2],
    ) -> Option<Angles> {
        let head = skeleton.head.as_ref()?;
        let offset = skeleton.look_at.as_ref().map_or(Vec3::Y * 0.06, |l| l.offset_from_head);
        // Eyes that move about do so round straight ahead where there is nothing to see.
        let ahead = self.saccades.map(|_| [0.0; 2]);
        let of_clips = of_clips.or(ahead).map(|[yaw_rad, pitch_rad]| GazeTarget::Angles { yaw_rad, pitch_rad });
        let target = self.target.or(of_clips);
        if self.head > 0.0 || self.turn != [0.0; 2] {
            let wanted = match target {
                Some(GazeTarget::Point(point)) => {
                    self.angles_to(root.inverse_point(point), skeleton, head, places, offset)
                }
                Some(GazeTarget::Angles { yaw_rad, pitch_rad }) => [yaw_rad, pitch_rad],
                None => [0.0; 2],
            };
            self.turn_head(wanted, dt as f32);
            self.apply_head(skeleton, head, locals, places);
        }
        let [mut yaw, mut pitch] = match target? {
            GazeTarget::Point(point) => {
                let angles = self.angles_to(root.inverse_point(point), skeleton, head, places, offset);
                self.yaw = angles[0];
                angles
            }
            // Where the head has gone already, the eyes need not.
            GazeTarget::Angles { yaw_rad, pitch_rad } => [yaw_rad - self.turn[0], pitch_rad - self.turn[1]],
        };
        if let Some(seed) = self.saccades {
            let dice = random(seed, libm::floor(time_s / SACCADE_S) as i64 as u64);
            // Most of the time eyes rest.
            let strength = share(dice >> 40).max(0.5) * 2.0 - 1.0;
            yaw += (share(dice) * 2.0 - 1.0) * SACCADE[0] * strength;
            pitch += (share(dice >> 20) * 2.0 - 1.0) * SACCADE[1] * strength;
        }
        Some([yaw, pitch])
    }

    /// Angles from the head as it stands to a point, the character's own space.
    fn angles_to(&self, point: Vec3, skeleton: &Skeleton, head: &HeadRig, places: &[Place], offset: Vec3) -> Angles {
        let place = &places[head.head];
        let origin = place.point(offset);
        let turned = mul(place.rotation, inverse(skeleton.rest_places[head.head].rotation));
        let v = turn(inverse(turned), Vec3::new(point.x - origin.x, point.y - origin.y, point.z - origin.z));
        let level = (v.x * v.x + v.z * v.z).sqrt();
        // Out of reach of numbers: straight ahead.
        if !(level < f32::MAX && v.y.abs() < f32::MAX) {
            return [self.yaw, 0.0];
        }
        let yaw = if level < NO_YAW_M {
            self.yaw
        } else {
            libm::atan2f(v.x, v.z)
        };
        [yaw, libm::atan2f(-v.y, level)]
    }

    /// Moves the head's turn towards a share of what is wanted, without overshoot (critically damped).
    fn turn_head(&mut self, wanted: Angles, dt: f32) {
        let share = self.head.clamp(0.0, 1.0);
        let mut yaw = wanted[0];
        if yaw.abs() > BEHIND && yaw * self.turn[0] < 0.0 {
            yaw = -yaw;
        }
        for (axis, wanted) in [yaw, wanted[1]].into_iter().enumerate() {
            let goal = (wanted * share).clamp(-MOST_TURN[axis], MOST_TURN[axis]);
            let rate = 4.0 / self.head_s.max(1e-3);
            let decay = libm::expf(-rate * dt.max(0.0));
            let gap = self.turn[axis] - goal;
            let slope = self.speed[axis] + rate * gap;
            self.turn[axis] = goal + (gap + slope * dt.max(0.0)) * decay;
            self.speed[axis] = (self.speed[axis] - rate * slope * dt.max(0.0)) * decay;
            // Comes to an end, instead of fading for ever.
            if goal == 0.0 && self.turn[axis].abs() < STILL && self.speed[axis].abs() < STILL {
                (self.turn[axis], self.speed[axis]) = (0.0, 0.0);
            }
        }
    }

    /// Half of the turn by the neck, the rest by the head, about the axes of the head as the clips have it.
    fn apply_head(&self, skeleton: &Skeleton, head: &HeadRig, locals: &mut [Transform], places: &mut [Place]) {
        let before = &places[head.head];
        let faces = mul(before.rotation, inverse(skeleton.rest_places[head.head].rotation));
        let whole = mul(faces, mul(rotation_of(self.turn), inverse(faces)));
        let (half, nodes) = match head.neck {
            Some(neck) => (slerp(glam::Quat::IDENTITY, whole, 0.5), [Some(neck), Some(head.head)]),
            None => (whole, [Some(head.head), None]),
        };
        for node in nodes.into_iter().flatten() {
            let above = skeleton.parents[node].map_or(glam::Quat::IDENTITY, |p| places[p].rotation);
            let turned = mul(half, mul(above, locals[node].rotation));
            locals[node].rotation = mul(inverse(above), turned);
            place_some(&head.below, &skeleton.parents, locals, &Place::ORIGIN, places);
        }
    }
}

/// Turns the eye bones of a character whose gaze goes by bones.
pub(crate) fn turn_eyes(skeleton: &Skeleton, angles: Angles, locals: &mut [Transform]) {
    let (Some(look), Some(head)) = (skeleton.look_at.as_ref().filter(|l| l.uses_bones), &skeleton.head) else { return };
    for (is_left, eye) in [true, false].into_iter().zip(head.eyes) {
        let Some(eye) = eye else { continue };
        let [yaw, pitch] = eye_angles(look, angles, is_left);
        let above = skeleton.rest_above(eye);
        let rest = skeleton.rest_places[eye].rotation;
        locals[eye].rotation = mul(inverse(above), mul(rotation_of([yaw, pitch]), rest));
    }
}

fn eye_angles(look: &LookAt, [yaw, pitch]: Angles, is_left: bool) -> Angles {
    let horizontal = if (yaw > 0.0) == is_left {
        &look.horizontal_outer
    } else {
        &look.horizontal_inner
    };
    let vertical = if pitch > 0.0 {
        &look.vertical_down
    } else {
        &look.vertical_up
    };
    [with_sign(horizontal.map(yaw), yaw), with_sign(vertical.map(pitch), pitch)]
}

fn with_sign(size: f32, like: f32) -> f32 {
    if like == 0.0 { 0.0 } else { size * like.signum() }
}

/// What is asked of the gaze expressions of a character whose gaze goes by these.
pub(crate) fn drive_looks(skeleton: &Skeleton, [yaw, pitch]: Angles, weights: &mut [f32]) {
    let Some(look) = skeleton.look_at.as_ref().filter(|l| !l.uses_bones) else { return };
    let sideways = look.horizontal_outer.map(yaw).min(1.0);
    let [left, right, up, down] = skeleton.driven.look;
    let upwards = look.vertical_up.map(pitch).min(1.0);
    let downwards = look.vertical_down.map(pitch).min(1.0);
    let sides = [(left, yaw > 0.0, sideways), (right, yaw < 0.0, sideways)];
    let heights = [(up, pitch < 0.0, upwards), (down, pitch > 0.0, downwards)];
    for (expression, is_on, weight) in sides.into_iter().chain(heights) {
        if let Some(slot) = expression.and_then(|e| weights.get_mut(e)) {
            *slot = if is_on { weight } else { 0.0 };
        }
    }
}
