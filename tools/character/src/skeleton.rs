//! The bones: VRM's humanoid in T-pose, and the chains that parts add to swing.

use glam::Vec3;

/// Up to four bones and their weights, which sum to 1; unused ones have weight 0.
pub type Weights = [(u16, f32); 4];

/// A bone. At rest no bone is turned, so its axes are those of the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Bone {
    /// Name of its node.
    pub name: String,
    /// Bone above it.
    pub parent: Option<usize>,
    /// Position at rest, world space, metres.
    pub position: Vec3,
    /// Whether `name` is a humanoid bone of VRM 1.0.
    pub human: bool,
}

/// All bones; parents stand before their children.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// The bones.
    pub bones: Vec<Bone>,
}

/// Bones of the middle: name, parent, position.
const MIDDLE: &[(&str, &str, [f32; 3])] = &[
    ("hips", "", [0.0, 0.865, 0.0]),
    ("spine", "hips", [0.0, 0.935, 0.002]),
    ("chest", "spine", [0.0, 1.03, 0.0]),
    ("upperChest", "chest", [0.0, 1.125, -0.008]),
    ("neck", "upperChest", [0.0, 1.255, -0.022]),
    ("head", "neck", [0.0, 1.325, -0.012]),
    ("jaw", "head", [0.0, 1.358, 0.012]),
];

/// Bones of the left side; `*` stands for `left`, and the right side mirrors them.
const SIDE: &[(&str, &str, [f32; 3])] = &[
    ("*Eye", "head", [0.036, 1.412, 0.045]),
    ("*Shoulder", "upperChest", [0.022, 1.222, -0.014]),
    ("*UpperArm", "*Shoulder", [0.112, 1.215, -0.016]),
    ("*LowerArm", "*UpperArm", [0.332, 1.215, -0.02]),
    ("*Hand", "*LowerArm", [0.54, 1.215, -0.014]),
    ("*ThumbMetacarpal", "*Hand", [0.559, 1.206, 0.006]),
    ("*ThumbProximal", "*ThumbMetacarpal", [0.582, 1.2, 0.03]),
    ("*ThumbDistal", "*ThumbProximal", [0.604, 1.197, 0.046]),
    ("*IndexProximal", "*Hand", [0.618, 1.217, 0.015]),
    ("*IndexIntermediate", "*IndexProximal", [0.652, 1.216, 0.018]),
    ("*IndexDistal", "*IndexIntermediate", [0.673, 1.214, 0.02]),
    ("*MiddleProximal", "*Hand", [0.621, 1.219, -0.005]),
    ("*MiddleIntermediate", "*MiddleProximal", [0.658, 1.218, -0.004]),
    ("*MiddleDistal", "*MiddleIntermediate", [0.682, 1.216, -0.003]),
    ("*RingProximal", "*Hand", [0.617, 1.217, -0.023]),
    ("*RingIntermediate", "*RingProximal", [0.651, 1.216, -0.025]),
    ("*RingDistal", "*RingIntermediate", [0.674, 1.214, -0.026]),
    ("*LittleProximal", "*Hand", [0.609, 1.212, -0.038]),
    ("*LittleIntermediate", "*LittleProximal", [0.635, 1.211, -0.043]),
    ("*LittleDistal", "*LittleIntermediate", [0.652, 1.209, -0.045]),
    ("*UpperLeg", "hips", [0.076, 0.828, 0.002]),
    ("*LowerLeg", "*UpperLeg", [0.078, 0.45, 0.006]),
    ("*Foot", "*LowerLeg", [0.078, 0.083, -0.022]),
    ("*Toes", "*Foot", [0.08, 0.022, 0.068]),
];

impl Skeleton {
    /// The humanoid of VRM 1.0 in T-pose, 1.55 m tall.
    #[must_use]
    pub fn humanoid() -> Self {
        let mut skeleton = Self::default();
        let mut add = |name: String, parent: &str, position: Vec3| {
            let parent = skeleton.bones.iter().position(|b| b.name == parent);
            skeleton.bones.push(Bone { name, parent, position, human: true });
        };
        for (name, parent, position) in MIDDLE {
            add((*name).to_owned(), parent, Vec3::from_array(*position));
        }
        for (side, sign) in [("left", 1.0), ("right", -1.0)] {
            for (name, parent, [x, y, z]) in SIDE {
                add(name.replace('*', side), &parent.replace('*', side), Vec3::new(x * sign, *y, *z));
            }
        }
        skeleton
    }

    /// Index of the bone of this name.
    ///
    /// # Panics
    /// Where there is none: names are written in this crate.
    #[must_use]
    pub fn find(&self, name: &str) -> usize {
        self.bones.iter().position(|b| b.name == name).unwrap_or_else(|| panic!("no bone {name}"))
    }

    /// Position of the bone of this name.
    #[must_use]
    pub fn place(&self, name: &str) -> Vec3 {
        self.bones[self.find(name)].position
    }

    /// Adds a bone that is not part of the humanoid.
    pub fn add(&mut self, name: impl Into<String>, parent: usize, position: Vec3) -> usize {
        self.bones.push(Bone { name: name.into(), parent: Some(parent), position, human: false });
        self.bones.len() - 1
    }

    /// Full weight on one bone.
    #[must_use]
    pub fn only(&self, name: &str) -> Weights {
        blend(&[(self.find(name), 1.0)])
    }

    /// The same weights on the bones of the other side.
    #[must_use]
    pub fn mirrored(&self, weights: Weights) -> Weights {
        weights.map(|(bone, weight)| {
            let name = &self.bones[usize::from(bone)].name;
            let swapped = if let Some(rest) = name.strip_prefix("left") {
                format!("right{rest}")
            } else if let Some(rest) = name.strip_prefix("right") {
                format!("left{rest}")
            } else if name.contains("Left") {
                name.replace("Left", "Right")
            } else {
                name.replace("Right", "Left")
            };
            (self.find(&swapped) as u16, weight)
        })
    }
}

/// Normalized weights of the four heaviest of these bones.
#[must_use]
pub fn blend(bones: &[(usize, f32)]) -> Weights {
    let mut merged: Vec<(usize, f32)> = Vec::new();
    for &(bone, weight) in bones.iter().filter(|(_, w)| *w > 1e-4) {
        match merged.iter_mut().find(|(b, _)| *b == bone) {
            Some((_, sum)) => *sum += weight,
            None => merged.push((bone, weight)),
        }
    }
    merged.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    merged.truncate(4);
    let sum: f32 = merged.iter().map(|(_, w)| w).sum();
    let mut weights = Weights::default();
    for (slot, (bone, weight)) in weights.iter_mut().zip(merged) {
        *slot = (bone as u16, weight / sum);
    }
    weights
}
