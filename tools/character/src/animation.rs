//! Clips as glTF animations.

use serde_json::{Value, json};

use crate::clips::{Clip, Track};
use crate::glb::Binary;

/// Samplers and channels of one glTF animation, while it is written.
#[derive(Default)]
pub(crate) struct Animation {
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

impl Animation {
    /// The bones of a clip, on the nodes of their names. Bones without a node are left out.
    pub(crate) fn of_bones(binary: &mut Binary, clip: &Clip, node: impl Fn(&str) -> Option<usize>) -> Self {
        let mut animation = Self::default();
        for (bone, track) in &clip.rotations {
            if let Some(node) = node(bone) {
                animation.add(binary, node, "rotation", track, |q| q.to_array());
            }
        }
        if let Some(node) = node("hips") {
            animation.add(binary, node, "translation", &clip.hips, |place| place.to_array());
        }
        animation
    }

    /// Adds a track of a node.
    pub(crate) fn add<T: Copy, const N: usize>(
        &mut self,
        binary: &mut Binary,
        node: usize,
        path: &str,
        track: &Track<T>,
        value: impl Fn(T) -> [f32; N],
    ) {
        let times: Vec<f32> = track.iter().map(|(t, _)| *t).collect();
        let values: Vec<[f32; N]> = track.iter().map(|(_, v)| value(*v)).collect();
        let (input, output) = (binary.times(&times), binary.floats(&values, None));
        self.channels.push(json!({ "sampler": self.samplers.len(), "target": { "node": node, "path": path } }));
        self.samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
    }

    /// The animation under this name.
    pub(crate) fn value(self, name: &str) -> Value {
        json!({ "name": name, "samplers": self.samplers, "channels": self.channels })
    }
}
