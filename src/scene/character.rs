//! Character data of VRM 0.x and 1.0 in one form (the one of VRM 1.0).

use std::collections::BTreeMap;

use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};

/// VRM data of a character. VRM 0.x is converted on import.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Character {
    /// `0.x` or `1.0`, as found in the file.
    pub vrm_version: String,
    /// Title, authors, licence.
    pub meta: Meta,
    /// Humanoid bones and their nodes.
    pub bones: BTreeMap<HumanBone, usize>,
    /// Facial expressions.
    pub expressions: Vec<Expression>,
    /// How the gaze moves eyes or morphs.
    pub look_at: Option<LookAt>,
    /// Visibility of meshes in first-person views, by node.
    pub first_person: BTreeMap<usize, FirstPerson>,
    /// Swinging chains.
    pub springs: Vec<Spring>,
    /// Shapes that chains must not enter.
    pub colliders: Vec<Collider>,
    /// Constraints between nodes (`VRMC_node_constraint`).
    pub constraints: Vec<NodeConstraint>,
}

/// Title, authors and licence, as the file states them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Meta {
    /// Name of the model.
    pub name: String,
    /// Version of the model.
    pub version: String,
    /// Authors.
    pub authors: Vec<String>,
    /// Copyright line.
    pub copyright: String,
    /// Contact.
    pub contact: String,
    /// Works that it derives from.
    pub references: Vec<String>,
    /// Licence: a URL (VRM 1.0) or a licence name (VRM 0.x).
    pub license: String,
    /// Further licence terms, name and value as in the file.
    pub permissions: BTreeMap<String, String>,
}

macro_rules! human_bones {
    ($($(#[$doc:meta])* $variant:ident = $name:literal),+ $(,)?) => {
        /// Bones of VRM 1.0's humanoid.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum HumanBone { $(#[doc = concat!("`", $name, "`")] #[serde(rename = $name)] $variant),+ }

        impl HumanBone {
            /// All bones.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Name in VRM 1.0.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),+ }
            }

            /// The bone with this VRM 1.0 name.
            #[must_use]
            pub fn from_name(name: &str) -> Option<Self> {
                match name { $($name => Some(Self::$variant),)+ _ => None }
            }
        }
    };
}

human_bones! {
    Hips = "hips", Spine = "spine", Chest = "chest", UpperChest = "upperChest", Neck = "neck", Head = "head",
    LeftEye = "leftEye", RightEye = "rightEye", Jaw = "jaw",
    LeftUpperLeg = "leftUpperLeg", LeftLowerLeg = "leftLowerLeg", LeftFoot = "leftFoot", LeftToes = "leftToes",
    RightUpperLeg = "rightUpperLeg", RightLowerLeg = "rightLowerLeg", RightFoot = "rightFoot", RightToes = "rightToes",
    LeftShoulder = "leftShoulder", LeftUpperArm = "leftUpperArm", LeftLowerArm = "leftLowerArm", LeftHand = "leftHand",
    RightShoulder = "rightShoulder", RightUpperArm = "rightUpperArm", RightLowerArm = "rightLowerArm",
    RightHand = "rightHand",
    LeftThumbMetacarpal = "leftThumbMetacarpal", LeftThumbProximal = "leftThumbProximal",
    LeftThumbDistal = "leftThumbDistal",
    LeftIndexProximal = "leftIndexProximal", LeftIndexIntermediate = "leftIndexIntermediate",
    LeftIndexDistal = "leftIndexDistal",
    LeftMiddleProximal = "leftMiddleProximal", LeftMiddleIntermediate = "leftMiddleIntermediate",
    LeftMiddleDistal = "leftMiddleDistal",
    LeftRingProximal = "leftRingProximal", LeftRingIntermediate = "leftRingIntermediate",
    LeftRingDistal = "leftRingDistal",
    LeftLittleProximal = "leftLittleProximal", LeftLittleIntermediate = "leftLittleIntermediate",
    LeftLittleDistal = "leftLittleDistal",
    RightThumbMetacarpal = "rightThumbMetacarpal", RightThumbProximal = "rightThumbProximal",
    RightThumbDistal = "rightThumbDistal",
    RightIndexProximal = "rightIndexProximal", RightIndexIntermediate = "rightIndexIntermediate",
    RightIndexDistal = "rightIndexDistal",
    RightMiddleProximal = "rightMiddleProximal", RightMiddleIntermediate = "rightMiddleIntermediate",
    RightMiddleDistal = "rightMiddleDistal",
    RightRingProximal = "rightRingProximal", RightRingIntermediate = "rightRingIntermediate",
    RightRingDistal = "rightRingDistal",
    RightLittleProximal = "rightLittleProximal", RightLittleIntermediate = "rightLittleIntermediate",
    RightLittleDistal = "rightLittleDistal",
}

/// A facial expression: morphs and material changes under one weight.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expression {
    /// VRM 1.0 preset name (`happy`, `aa`, `blinkLeft`, …) or the custom name.
    pub name: String,
    /// Whether it is one of VRM's presets.
    pub preset: bool,
    /// Whether a weight above 0.5 counts as 1 and any other as 0.
    pub is_binary: bool,
    /// What it does to blinking (`blink`, `blinkLeft`, `blinkRight`).
    pub override_blink: ExpressionOverride,
    /// What it does to gaze expressions (`lookUp`, …).
    pub override_look_at: ExpressionOverride,
    /// What it does to mouth expressions (`aa`, `ih`, `ou`, `ee`, `oh`).
    pub override_mouth: ExpressionOverride,
    /// Morph targets that it drives.
    pub morphs: Vec<MorphBind>,
    /// Material colours that it drives.
    pub colors: Vec<ColorBind>,
    /// Texture transforms that it drives.
    pub uv_transforms: Vec<UvBind>,
}

/// What an expression does to another group of expressions (VRM 1.0, `overrideBlink` and its kin).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ExpressionOverride {
    /// Nothing.
    #[default]
    None,
    /// Switches it off while the weight is above 0.
    Block,
    /// Fades it by 1 - weight.
    Blend,
}

/// One morph target under an expression.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MorphBind {
    /// Node that carries the mesh.
    pub node: usize,
    /// Index of the morph target.
    pub target: usize,
    /// Weight of the target at expression weight 1.
    pub weight: f32,
}

/// One material colour under an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorBind {
    /// Index of the material.
    pub material: usize,
    /// Which colour.
    pub target: ColorTarget,
    /// Colour at expression weight 1, linear RGBA.
    pub value: [f32; 4],
}

/// Material colours that an expression can drive (VRM 1.0 `materialColorBinds.type`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ColorTarget {
    /// Base (lit) colour and alpha.
    Color,
    /// Emission.
    EmissionColor,
    /// Shade colour.
    ShadeColor,
    /// Matcap factor.
    MatcapColor,
    /// Parametric rim.
    RimColor,
    /// Outline.
    OutlineColor,
}

/// The UV transform of a material's textures under an expression.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UvBind {
    /// Index of the material.
    pub material: usize,
    /// Scale at expression weight 1.
    pub scale: [f32; 2],
    /// Offset at expression weight 1, in UV units.
    pub offset: [f32; 2],
}

/// How the gaze moves the eyes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LookAt {
    /// Origin of the gaze relative to the head bone, metres. Default of files of VRM 1.0: 0.06 above it.
    pub offset_from_head: Vec3,
    /// Whether eye bones turn (`true`) or gaze expressions are driven.
    pub uses_bones: bool,
    /// Towards the nose.
    pub horizontal_inner: RangeMap,
    /// Away from the nose.
    pub horizontal_outer: RangeMap,
    /// Downwards.
    pub vertical_down: RangeMap,
    /// Upwards.
    pub vertical_up: RangeMap,
}

/// Map of a gaze angle: `0..=input_max_rad` to `0..=output_scale`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RangeMap {
    /// Gaze angle of full effect, radians; with 0 any gaze has the full effect. Range 0... Default of files: π/2.
    pub input_max_rad: f32,
    /// Full effect: radians of eye bone rotation, or expression weight. Default of files: 10° or 1.
    pub output_scale: f32,
    /// Share of the full effect over the share of the full angle, keys in order of time; empty for the angle's own share. Only
    /// VRM 0.x has such curves.
    pub curve: Vec<CurveKey>,
}

/// One key of a curve of Unity's: a cubic Hermite spline.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurveKey {
    /// Where it is.
    pub time: f32,
    /// Value there.
    pub value: f32,
    /// Slope towards the key before, value by time.
    pub in_tangent: f32,
    /// Slope towards the next key, value by time.
    pub out_tangent: f32,
}

/// Least full angle of a [`RangeMap`], degrees.
const LEAST_INPUT_MAX_DEG: f32 = 0.001;

impl RangeMap {
    /// The effect of a gaze angle, whatever its sign: radians or weight, 0 for no angle unless the curve says otherwise.
    #[must_use]
    pub fn map(&self, angle_rad: f32) -> f32 {
        if angle_rad.is_nan() {
            return 0.0;
        }
        let share = (angle_rad.abs() / self.input_max_rad.max(LEAST_INPUT_MAX_DEG.to_radians())).min(1.0);
        let curved = curve_at(&self.curve, share) * self.output_scale;
        // Keys may be as far apart as numbers go.
        if curved.is_finite() {
            curved
        } else {
            share * self.output_scale
        }
    }
}

/// Value of a curve; that of the nearest key outside of them, the place itself without keys.
fn curve_at(keys: &[CurveKey], time: f32) -> f32 {
    let next = keys.partition_point(|key| key.time <= time);
    let before = next.checked_sub(1).and_then(|i| keys.get(i));
    let (a, b) = match (before, keys.get(next)) {
        (Some(a), Some(b)) => (a, b),
        (Some(key), None) | (None, Some(key)) => return key.value,
        (None, None) => return time,
    };
    let span = b.time - a.time;
    let u = (time - a.time) / span;
    let (u2, u3) = (u * u, u * u * u);
    let tangents = (u3 - 2.0 * u2 + u) * a.out_tangent + (u3 - u2) * b.in_tangent;
    (2.0 * u3 - 3.0 * u2 + 1.0) * a.value + (3.0 * u2 - 2.0 * u3) * b.value + span * tangents
}

/// Visibility of a mesh in first-person views.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum FirstPerson {
    /// Head parts are hidden in first person.
    #[default]
    Auto,
    /// Always visible.
    Both,
    /// Hidden in first person.
    ThirdPersonOnly,
    /// Visible in first person only.
    FirstPersonOnly,
}

/// A chain of joints that swings (`VRMC_springBone`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spring {
    /// Name in the file; may be empty.
    pub name: String,
    /// Joints from root to tip. The last one only gives the tail of the one before it.
    pub joints: Vec<SpringJoint>,
    /// Node in whose space inertia is measured; `None` for the world.
    pub center: Option<usize>,
    /// Indices in [`Character::colliders`], each once, in the order in which they push: that of the file's groups.
    pub colliders: Vec<usize>,
}

/// One joint of a [`Spring`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpringJoint {
    /// Its node.
    pub node: usize,
    /// Radius against colliders, metres. Range 0... Default of files: 0.
    pub hit_radius: f32,
    /// Pull back to rest. Range 0... Default of files: 1.
    pub stiffness: f32,
    /// Strength of gravity; a negative one lifts. Default of files: 0.
    pub gravity_power: f32,
    /// Direction of gravity, world space. Its length counts as in the file: gravity is this times the strength, so zero is none.
    /// Default of files: (0, -1, 0).
    pub gravity_dir: Vec3,
    /// Share of velocity lost a step. Range 0..1. Default of files: 0.5.
    pub drag: f32,
}

/// A shape that spring joints must not enter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collider {
    /// Node that carries it.
    pub node: usize,
    /// Its shape in the space of the node.
    pub shape: ColliderShape,
}

/// Shapes of colliders (`VRMC_springBone`, `VRMC_springBone_extended_collider`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColliderShape {
    /// A sphere; with `inside` joints must stay in it.
    Sphere {
        /// Centre, metres.
        offset: Vec3,
        /// Radius, metres.
        radius: f32,
        /// Joints stay inside.
        inside: bool,
    },
    /// A capsule; with `inside` joints must stay in it.
    Capsule {
        /// First end, metres.
        offset: Vec3,
        /// Second end, metres.
        tail: Vec3,
        /// Radius, metres.
        radius: f32,
        /// Joints stay inside.
        inside: bool,
    },
    /// A half space; joints stay on the side of the normal.
    Plane {
        /// A point on it, metres.
        offset: Vec3,
        /// Unit normal.
        normal: Vec3,
    },
}

/// A constraint that turns a node after another (`VRMC_node_constraint`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeConstraint {
    /// Node that is turned.
    pub node: usize,
    /// Node that it follows.
    pub source: usize,
    /// How much. Range 0..1.
    pub weight: f32,
    /// What is transferred.
    pub kind: ConstraintKind,
    /// Rest rotation of the source, kept because constraints transfer the change from rest.
    pub source_rest: Quat,
}

/// Kinds of [`NodeConstraint`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConstraintKind {
    /// Rotation about one local axis.
    Roll {
        /// Unit axis.
        axis: Vec3,
    },
    /// An axis that points at the source.
    Aim {
        /// Unit axis.
        axis: Vec3,
    },
    /// The whole rotation.
    Rotation,
}
