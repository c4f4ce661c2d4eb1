//! The body of an actor: pose, place, and what of its materials has changed.

use glam::{Mat4, Vec3};

use super::Actor;
use super::maps::MapsKey;
use super::troupe::Troupe;
use super::volume::{Sphere, Volume};
use crate::eye::PupilReflex;
use crate::render::looks::Edits;
use crate::render::made::Made;
use crate::render::numbers::ActorState;
use crate::render::pass::shadow::ShadowRows;
use crate::render::shaders::Shaders;
use crate::render::skin_layers::SkinPart;
use crate::render::vertex::AffineRows;
use crate::render::{Character, CharacterData};
use crate::scene::Lights;
use crate::{Error, Result};

/// The body of one actor.
#[derive(Debug)]
pub(crate) struct Body {
    /// That of its actor.
    pub(super) id: u64,
    pub character: Character,
    /// Its troupe, and its slot there.
    pub troupe: usize,
    pub(super) slot: u32,
    /// What stands for itself.
    pub instance: u32,
    /// What stands for itself and for others that cast on it, in its own shadow map: their troupes and instances.
    pub casters: Vec<(usize, u32)>,
    /// The same of others that cast on its face.
    pub face_casters: Vec<(usize, u32)>,
    pub world: Mat4,
    /// Where it was when its stage was prepared last, while somebody asks.
    pub(super) last_world: Option<Mat4>,
    /// Share of the key light that arrives.
    pub(super) key_light: f32,
    /// Least and greatest corner in its pose, character space; and what that is in the world.
    pub(super) bounds: (Vec3, Vec3),
    pub(super) volume: Volume,
    pub(super) shadow_layer: Option<u32>,
    /// First layer of the light on its skin.
    pub(super) skin_layer: Option<u32>,
    /// Moves the head from its rest to the pose, and the hips.
    pub(super) head: Mat4,
    pub(super) hips: Mat4,
    pub(super) pupils: PupilReflex,
    /// What the diameter of its pupils is multiplied by.
    pub(super) pupil_scale: f32,
    pub(super) edits: Edits,
    /// How often the pose, and what is cut out of materials, have become others; no pose has been taken at first.
    pub(super) revisions: [u64; 2],
    pub maps: Made<MapsKey, ()>,
    /// Matrices of its nodes, character space; its joints and the weights of its morphs.
    pub(super) nodes: Vec<Mat4>,
    pub(super) joints: Vec<AffineRows>,
    pub(super) weights: Vec<f32>,
    /// Whether its troupe has not seen these.
    pub(super) has_moved: bool,
}

/// Where the light of the shadow on a face comes from: along a column.
#[derive(Clone, Copy, Debug)]
pub(super) struct FaceLight {
    pub(super) head: Volume,
    pub(super) to_light: Vec3,
}

/// A box round spheres that joints have moved; morphs do not count.
fn bounds(moved: &[Option<(Vec3, f32)>], joints: &[AffineRows]) -> (Vec3, Vec3) {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for (joint, (middle, radius)) in joints.iter().zip(moved).filter_map(|(j, m)| Some((j, (*m)?))) {
        let middle = joint.transform_point(middle);
        let radius = radius * joint.scale();
        (low, high) = (low.min(middle - radius), high.max(middle + radius));
    }
    if low.cmple(high).all() {
        (low, high)
    } else {
        (Vec3::ZERO, Vec3::ZERO)
    }
}

impl Body {
    pub(super) fn new(actor: &Actor, troupe: usize, slot: u32) -> Self {
        Self {
            id: actor.id,
            character: actor.character.clone(),
            troupe,
            slot,
            instance: 0,
            casters: Vec::new(),
            face_casters: Vec::new(),
            world: actor.world,
            last_world: None,
            key_light: actor.key_light,
            bounds: (Vec3::ZERO, Vec3::ZERO),
            volume: Volume::default(),
            shadow_layer: None,
            skin_layer: None,
            head: Mat4::IDENTITY,
            hips: Mat4::IDENTITY,
            pupils: PupilReflex::default(),
            pupil_scale: 1.0,
            edits: Edits::default(),
            revisions: [0; 2],
            maps: Made::not_yet(()),
            nodes: Vec::new(),
            joints: Vec::new(),
            weights: Vec::new(),
            has_moved: false,
        }
    }

    pub(super) fn is_of(&self, actor: &Actor) -> bool {
        self.id == actor.id && self.character.is(&actor.character)
    }

    /// What it is.
    pub fn data(&self) -> &CharacterData {
        &self.character.0
    }

    /// What is read of it in draws.
    pub fn edits(&self) -> &Edits {
        &self.edits
    }

    /// The same to change.
    pub fn edits_mut(&mut self) -> &mut Edits {
        // Maps of shadows show what is cut out.
        self.revisions[1] += 1;
        &mut self.edits
    }

    /// Its middle in the world.
    pub fn middle(&self) -> Vec3 {
        self.volume.middle
    }

    /// Its slot in its troupe.
    pub fn slot(&self) -> u32 {
        self.slot
    }

    /// Layer of its own shadow map.
    pub fn shadow_layer(&self) -> Option<u32> {
        self.shadow_layer
    }

    /// Layers of the light on its skin.
    pub fn skin_layers(&self) -> impl Iterator<Item = (u32, &SkinPart)> {
        self.skin_layer.into_iter().flat_map(|first| (first..).zip(&self.data().skin_layers))
    }

    /// Takes place and pose of an actor.
    pub(super) fn pose(&mut self, shaders: &Shaders, actor: &Actor) -> Result<()> {
        let CharacterData { scene, rig, looks, .. } = &*self.character.0;
        let pose = &actor.pose;
        pose.check(scene)?;
        scene.world_from_nodes_into(&pose.locals, &mut self.nodes);
        if let Some(at) = self.nodes.iter().position(|node| !node.is_finite()) {
            // Parents stand before their children: it is the first one's own fault.
            let what = format!("pose.locals[{at}] {:?}", scene.nodes[at].name);
            return Err(Error::Argument { what, message: "is not finite".to_owned() });
        }
        self.world = actor.world;
        self.key_light = actor.key_light;
        self.pupil_scale = pose.pupil_scale;
        let matrix = |node: usize| self.nodes.get(node).copied().unwrap_or(Mat4::IDENTITY);
        let moved = |bone: Option<(usize, Mat4)>| bone.map_or(Mat4::IDENTITY, |(node, inverse)| matrix(node) * inverse);
        (self.head, self.hips) = (moved(rig.head), moved(rig.hips));
        // Each is compared as it is written.
        let mut is_other = self.revisions[0] == 0;
        let joints = rig.palettes.iter().flat_map(|palette| palette.joints());
        self.joints.resize(self.character.0.source.joint_count(), AffineRows::default());
        for (last, (node, bind)) in self.joints.iter_mut().zip(joints) {
            let joint = AffineRows::from(bind.map_or_else(|| matrix(node), |bind| matrix(node) * bind));
            is_other |= *last != joint;
            *last = joint;
        }
        self.weights.resize(self.character.0.source.weight_count(), 0.0);
        let mut at = 0;
        for &(node, targets) in &rig.weights {
            let of_node = pose.morph_weights.get(node).map_or(&[] as &[f32], Vec::as_slice);
            for target in 0..targets {
                let weight = of_node.get(target).copied().unwrap_or(0.0);
                is_other |= self.weights[at] != weight;
                self.weights[at] = weight;
                at += 1;
            }
        }
        if is_other {
            self.revisions[0] += 1;
            self.has_moved = true;
            self.bounds = bounds(&rig.moved, &self.joints);
        }
        let (low, high) = self.bounds;
        self.volume = Volume::of(low, high, &self.world);
        if self.edits.take(shaders, looks, actor)? {
            self.revisions[1] += 1;
        }
        Ok(())
    }

    /// Moves its pupils towards what the light on its face asks of them.
    pub(super) fn adapt(&mut self, lights: &Lights, time_s: f32) {
        let CharacterData { scene, rig, .. } = &*self.character.0;
        let Some(pupils) = &scene.pupils else { return };
        let face = self.world * self.head;
        let forward = face.transform_vector3(Vec3::Z).normalize_or(Vec3::Z);
        let light = lights.luminance(face.transform_point3(rig.head_middle), forward, self.key_light);
        self.pupils.follow(pupils, time_s, light * pupils.luminance);
    }

    /// Spheres round its eyes and its hair in the world, where the ones are seen through the other.
    pub(super) fn eyes_and_hair(&self) -> Option<[Sphere; 2]> {
        let spheres = self.data().rig.eyes_and_hair?;
        Some(
            spheres.map(|(middle, radius)| {
                Sphere { middle: self.head.transform_point3(middle), radius }.moved(&self.world)
            }),
        )
    }

    /// Middle and radius of the sphere that its weighted layers are weighed over, character space.
    pub fn weighed(&self) -> Option<(Vec3, f32)> {
        let (middle, radius) = self.data().rig.weighed?;
        Some((self.head.transform_point3(middle), radius))
    }

    /// Where the light of the shadow on its face comes from.
    pub(super) fn face_light(&self, to_light: Vec3) -> Option<FaceLight> {
        let fit = self.data().bangs.as_ref()?;
        let of_character = self.world.inverse().transform_vector3(to_light).normalize_or(Vec3::Z);
        let direction = fit.light_direction(self.head, of_character);
        // The map may be turned about the light.
        let half = Vec3::splat(fit.half * std::f32::consts::SQRT_2);
        let middle = self.head.transform_point3(fit.middle);
        let to_light = self.world.transform_vector3(direction).normalize_or(to_light);
        Some(FaceLight { head: Volume::of(middle - half, middle + half, &self.world), to_light })
    }

    pub(super) fn state<'a>(
        &'a self,
        troupes: &'a [Troupe],
        shadow_side: u32,
        to_light: Vec3,
        of_world: ShadowRows,
    ) -> ActorState<'a> {
        let data = self.data();
        let from_world = self.world.inverse();
        let own = |layer: u32| {
            let fit = data.shadow.as_ref()?;
            let middle = self.world.transform_point3(self.hips.transform_point3(fit.middle));
            let rows = fit.rows(shadow_side, middle, self.world.x_axis.truncate().length(), to_light);
            Some(ShadowRows { layer: Some(layer), ..rows })
        };
        ActorState {
            head: self.head,
            head_middle: data.rig.head_middle,
            bangs: data.bangs.as_ref(),
            tile: troupes[self.troupe].bangs.as_ref().map(|atlas| atlas.place(self.slot)).unwrap_or_default(),
            through: data.scene.eyes_through,
            weighed: self.weighed(),
            to_light: from_world.transform_vector3(to_light).normalize_or(Vec3::Z),
            from_world,
            shadow: self.shadow_layer.and_then(own).unwrap_or(of_world),
            key_light: self.key_light,
            skin_layer: self.skin_layer,
            pupil_mm: self.pupils.diameter_mm().unwrap_or(0.0),
            pupil_reflex: data.scene.pupils.as_ref().map_or(0.0, |pupils| pupils.reflex),
            pupil_scale: self.pupil_scale,
        }
    }
}
