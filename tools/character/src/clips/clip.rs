//! A clip as keys over time, and how it is sampled.

use glam::{Quat, Vec3};

use super::posture::Posture;
use crate::skeleton::Skeleton;

/// Keys of one value: times in seconds, strictly rising from 0, with the value at each. Linear in between.
pub type Track<T> = Vec<(f32, T)>;

/// An animation of the humanoid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clip {
    /// Its name.
    pub name: &'static str,
    /// Length, seconds.
    pub length: f32,
    /// Whether the end passes into the beginning.
    pub looped: bool,
    /// Rotations of bones against their parents, by the bone's name. Bones without a track keep their rest.
    pub rotations: Vec<(String, Track<Quat>)>,
    /// Place of the hips, metres. In a clip that travels z grows over the loop.
    pub hips: Track<Vec3>,
    /// Weights of expressions, 0 to 1, by the name of VRM's preset.
    pub expressions: Vec<(&'static str, Track<f32>)>,
    /// Gaze against the head, degrees: yaw, positive to her left, and pitch, positive downwards.
    pub gaze: Track<[f32; 2]>,
}

/// A key that linear interpolation gives within this angle (radians) or length (metres) is left out.
const ANGLE: f32 = 0.05 * std::f32::consts::PI / 180.0;
const LENGTH: f32 = 0.0001;
/// Of a gaze, degrees.
const GAZE: f32 = 0.1;

/// What a clip is made of.
pub(super) struct Source<'a> {
    /// Its name.
    pub name: &'static str,
    /// Its length, seconds.
    pub length: f32,
    /// Keys a second before any is left out.
    pub rate: f32,
    /// Whether the last key repeats the first.
    pub looped: bool,
    /// Way that the hips have gone by the end, metres along z.
    pub travel: f32,
    /// Posture at a time, seconds.
    pub posture: &'a dyn Fn(f32) -> Posture,
    /// Weights of expressions.
    pub expressions: Vec<(&'static str, Track<f32>)>,
}

impl Source<'_> {
    /// Samples the postures and leaves out the keys that are not needed.
    pub(super) fn clip(self, skeleton: &Skeleton) -> Clip {
        let count = (self.length * self.rate).round() as usize;
        let times: Vec<f32> =
            (0..=count).map(|i| if i == count { self.length } else { i as f32 / self.rate }).collect();
        let mut postures: Vec<Posture> = times.iter().map(|t| (self.posture)(*t)).collect();
        if self.looped {
            let end = postures[0].moved(Vec3::Z * self.travel);
            postures[count] = end;
        }
        let mut poses: Vec<Vec<Quat>> = postures.iter().map(|p| p.rotations(skeleton)).collect();
        if self.looped {
            // To the last bit, which the way of the hips would change.
            poses[count] = poses[0].clone();
        }
        let rotations = skeleton
            .bones
            .iter()
            .enumerate()
            .filter(|(_, bone)| bone.human)
            .map(|(i, bone)| (bone.name.clone(), rotation_track(&times, poses.iter().map(|pose| pose[i]))))
            .filter(|(_, track)| track.len() > 1 || track[0].1 != Quat::IDENTITY)
            .collect();
        let zip = |value: &dyn Fn(&Posture) -> Vec3| -> Track<Vec3> {
            times.iter().copied().zip(postures.iter().map(value)).collect()
        };
        let gaze = zip(&|p| Vec3::new(p.gaze[0], p.gaze[1], 0.0));
        let gaze = reduced(gaze, &|a, b, t, v| a.lerp(b, t).distance(v) <= GAZE);
        Clip {
            name: self.name,
            length: self.length,
            looped: self.looped,
            rotations,
            hips: reduced(zip(&|p| p.hips), &|a, b, t, v| a.lerp(b, t).distance(v) <= LENGTH),
            expressions: self.expressions,
            gaze: if gaze.iter().all(|(_, g)| *g == Vec3::ZERO) {
                Vec::new()
            } else {
                gaze.into_iter().map(|(t, g)| (t, [g.x, g.y])).collect()
            },
        }
    }
}

fn rotation_track(times: &[f32], values: impl Iterator<Item = Quat>) -> Track<Quat> {
    let mut track: Track<Quat> = times.iter().copied().zip(values).collect();
    for i in 1..track.len() {
        // Of the two quaternions of a turn the nearer one, so that no player goes the long way round.
        if track[i].1.dot(track[i - 1].1) < 0.0 {
            track[i].1 = -track[i].1;
        }
    }
    reduced(track, &|a, b, t, v| a.slerp(b, t).angle_between(v) <= ANGLE)
}

/// Leaves out keys as long as those around stand for all between them; a value that never changes is one key.
fn reduced<T: Copy + PartialEq>(track: Track<T>, close: &dyn Fn(T, T, f32, T) -> bool) -> Track<T> {
    /// Keys further apart than this many samples would show how players interpolate.
    const SPAN: usize = 15;
    let fits = |from: usize, to: usize| {
        let ((t0, a), (t1, b)) = (track[from], track[to]);
        track[from + 1..to].iter().all(|(t, v)| close(a, b, (t - t0) / (t1 - t0), *v))
    };
    let first = track[0].1;
    if track.iter().all(|(t, v)| *v == first || close(first, first, *t, *v)) {
        return vec![(0.0, first)];
    }
    let mut kept = vec![track[0]];
    let mut at = 0;
    while at + 1 < track.len() {
        let far = (at + SPAN).min(track.len() - 1);
        at = (at + 1..=far).take_while(|to| fits(at, *to)).last().unwrap_or(at + 1);
        kept.push(track[at]);
    }
    kept
}
