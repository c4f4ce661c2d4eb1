//! What is seen: camera, size, background, channel; and framings of a character.

use glam::{Mat4, Quat, Vec2, Vec3, Vec4};

use super::{MAX_TEXTURE_SIDE, Output, pass::encodes_srgb, vertex::unpack_unit};
use crate::{
    Error, Result,
    color::Srgb,
    material::About,
    motion::Pose,
    scene::{Backdrop, Camera, DepthRange, Framing, HumanBone, Image, Scene},
    stage::Stage,
};

/// One picture of a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Width and height, pixels. Range 1..8192. Default: 1024 x 1024.
    pub size: [u32; 2],
    /// Camera.
    pub camera: Camera,
    /// What is behind the actors. Default: transparent.
    pub background: Background,
    /// What is shown. Default: the shaded picture.
    pub channel: Channel,
    /// Actor whose eyes it looks through, by its place on the stage: of itself it sees neither head nor hair, as its file says
    /// (VRM, `firstPerson`); shadows and other actors are whole. Default: none of them.
    pub first_person: Option<usize>,
    /// Moves the picture to the right and down under its pixels, for pictures that are averaged. It changes the projection, so
    /// that all passes agree; a host that moves its own frame moves its matrices instead. Pixels, range -1..1. Default: 0.
    pub jitter_px: [f32; 2],
    /// Number of the picture among those that are averaged: noise of [`hashed`](crate::material::Alpha::hashed) alpha is another
    /// one in each. Default: 0.
    pub frame: u32,
    /// Which pictures this one follows where a stage asks for
    /// [`Antialias::Temporal`](crate::scene::Antialias::Temporal): views that are drawn in the same frame (two halves of a window,
    /// a mirror) need numbers of their own, or none of them is smoothed. The renderer keeps those of the last 8 numbers. A picture
    /// follows where the stage was prepared once since, and the size is the same. Default: 0.
    pub history: u32,
    /// Whether it follows no picture, though it might: after a cut of the camera. Default: false.
    pub is_cut: bool,
}

impl Default for View {
    fn default() -> Self {
        Self {
            size: [1024, 1024],
            camera: Camera::default(),
            background: Background::default(),
            channel: Channel::default(),
            first_person: None,
            jitter_px: [0.0; 2],
            frame: 0,
            history: 0,
            is_cut: false,
        }
    }
}

/// What is behind the actors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Background {
    /// Nothing: the picture has alpha.
    #[default]
    Transparent,
    /// A colour.
    Color(Srgb),
    /// A painted one. It keeps its colours, whatever exposure and tone curve do.
    Backdrop(Backdrop),
    /// The stage's environment ([`Lights::environment`](crate::scene::Lights::environment)), as bright as it lights; exposure
    /// and tone curve change it with the actors. Nothing where the stage has none.
    Environment,
}

impl Background {
    pub(crate) fn clear_color(self, output: Output) -> wgpu::Color {
        let Self::Color(srgb) = self else { return wgpu::Color::TRANSPARENT };
        let [r, g, b] = if encodes_srgb(output.format) {
            srgb.0.map(|c| f64::from(c) / 255.0)
        } else {
            srgb.to_linear().0.map(f64::from)
        };
        wgpu::Color { r, g, b, a: 1.0 }
    }
}

/// What a [`View`] shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Channel {
    /// The shaded picture.
    #[default]
    Final,
    /// View-space normals, -1..1 as 0..255.
    Normal,
    /// Distance from the camera: white at the nearest visible point, dark at the farthest, transparent background.
    Depth,
    /// Part index + 1 in red (low byte) and green (high byte), 0 in the background. Parts are the primitives of the
    /// scene in the order of nodes.
    PartId,
    /// What a look does, by the name of its channel: `face-shadow`, `sparkle`. [`Channel::all`] lists them.
    Look(&'static str),
}

/// Channels that no section of a material has.
const OTHERS: [(Channel, &str, &str); 5] = [
    (Channel::Final, "final", "The shaded picture."),
    (Channel::Normal, "normal", "Normals as the camera sees them."),
    (Channel::Depth, "depth", "Distance from the camera, white where it is near."),
    (Channel::PartId, "part-id", "Number of each part."),
    (Channel::Look("eyes-through"), "eyes-through", "How much of eyes and brows is seen through hair."),
];

impl Channel {
    /// All channels with their names and what they show; those of an application's sections come last.
    pub fn all() -> impl Iterator<Item = (Self, &'static str, &'static str)> {
        // Sections may share one.
        let mut of_looks: Vec<(&str, &str)> = Vec::new();
        for channel in crate::material::all().flat_map(About::channels) {
            if !of_looks.iter().any(|(name, _)| *name == channel.0) {
                of_looks.push(channel);
            }
        }
        OTHERS.into_iter().chain(of_looks.into_iter().map(|(name, doc)| (Self::Look(name), name, doc)))
    }

    /// Its name: `final`, `normal`, `depth`, `part-id`, `face-shadow` and so on.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Final => "final",
            Self::Normal => "normal",
            Self::Depth => "depth",
            Self::PartId => "part-id",
            Self::Look(name) => name,
        }
    }

    /// The channel of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::all().find(|(_, known, _)| *known == name).map(|(channel, ..)| channel)
    }

    /// Turns read-back texels of the prepass into a picture.
    pub(crate) fn picture(self, view: &View, texels: Vec<u8>) -> Image {
        let word = |t: &[u8]| u32::from_le_bytes([t[0], t[1], t[2], t[3]]);
        let pixels = match self {
            Self::PartId => texels
                .chunks_exact(8)
                .flat_map(|t| {
                    let [low, high, ..] = word(&t[4..]).to_le_bytes();
                    [low, high, 0, 255]
                })
                .collect(),
            Self::Normal => {
                let view_from_world = view.camera.view_from_world();
                texels
                    .chunks_exact(8)
                    .flat_map(|t| {
                        if word(&t[4..]) == 0 {
                            return [0; 4];
                        }
                        let seen = view_from_world.transform_vector3(unpack_unit(word(t)));
                        let [r, g, b] = seen.to_array().map(|c| ((c * 0.5 + 0.5) * 255.0).round() as u8);
                        [r, g, b, 255]
                    })
                    .collect()
            }
            Self::Depth => {
                // Depth is near / distance.
                let distance = |t: &[u8]| view.camera.near / f32::from_bits(word(t));
                let finite = || texels.chunks_exact(4).map(distance).filter(|d| d.is_finite());
                let (near, far) = finite().fold((f32::MAX, 0f32), |(low, high), d| (low.min(d), high.max(d)));
                let span = (far - near).max(1e-6);
                texels
                    .chunks_exact(4)
                    .flat_map(|t| {
                        let d = distance(t);
                        let grey = (255.0 - 215.0 * ((d - near) / span)).clamp(0.0, 255.0).round() as u8;
                        if d.is_finite() { [grey, grey, grey, 255] } else { [0; 4] }
                    })
                    .collect()
            }
            _ => texels,
        };
        Image { width: view.size[0], height: view.size[1], pixels, format: "png", source_bits: 8, ..Image::default() }
    }
}

impl View {
    /// `clip_from_world` with reverse Z, moved by the jitter.
    pub(crate) fn clip_from_world(&self) -> Mat4 {
        let [width, height] = self.size.map(|s| s as f32);
        let mut clip_from_view = self.camera.clip_from_view(width / height);
        let [right, down] = self.jitter_px;
        if self.jitter_px != [0.0; 2] {
            let moved = Vec3::new(2.0 * right / width, -2.0 * down / height, 0.0);
            clip_from_view = Mat4::from_translation(moved) * clip_from_view;
        }
        clip_from_view * self.camera.view_from_world()
    }

    /// Size of a metre at the nearest character, pixels. Characters are taken as columns two metres high.
    pub(crate) fn px_per_m<'a>(&self, places: impl Iterator<Item = &'a Mat4>) -> f32 {
        let away = |m: &Mat4| {
            let (foot, top) = (m.transform_point3(Vec3::ZERO), m.transform_point3(Vec3::Y * 2.0));
            let along = top - foot;
            let t = ((self.camera.eye - foot).dot(along) / along.length_squared().max(1e-9)).clamp(0.0, 1.0);
            self.camera.eye.distance(foot + along * t)
        };
        let nearest = places.map(away).fold(f32::MAX, f32::min).max(self.camera.near);
        self.size[1] as f32 / (2.0 * nearest * (self.camera.fov_y_rad * 0.5).tan())
    }

    /// The view of a host's camera: `view_from_world` (right-handed, looking along -Z, without scale) and a perspective
    /// `clip_from_view`, whatever its depth: 0..1 or 1..0, with a far plane or without.
    #[must_use]
    pub fn of_matrices(view_from_world: Mat4, clip_from_view: Mat4, size: [u32; 2]) -> Self {
        let world_from_view = view_from_world.inverse();
        let eye = world_from_view.w_axis.truncate();
        let mut camera = Camera {
            eye,
            target: eye - world_from_view.z_axis.truncate(),
            up: world_from_view.y_axis.truncate(),
            fov_y_rad: 2.0 * (1.0 / clip_from_view.y_axis.y.abs()).atan(),
            matrices: Some([view_from_world, clip_from_view]),
            ..Camera::default()
        };
        camera.near = DepthRange::of(&camera).near();
        Self { size, camera, ..Self::default() }
    }

    /// A view of a character at rest: `yaw_rad` moves the camera around it, positive towards the character's left (+X).
    ///
    /// Head and hips come from the humanoid bones, else from nodes of that name, else from the bounding box.
    #[must_use]
    pub fn framed(scene: &Scene, framing: Framing, yaw_rad: f32, size: [u32; 2]) -> Self {
        Self::framed_pose(scene, &Pose::rest(scene), framing, yaw_rad, size)
    }

    /// [`View::framed`] of a character in a pose. Morphs do not count.
    #[must_use]
    pub fn framed_pose(scene: &Scene, pose: &Pose, framing: Framing, yaw_rad: f32, size: [u32; 2]) -> Self {
        let Framed { target, height, width, before } = Framed::of(scene, pose, framing);
        Self::at(target, [height, width], before, yaw_rad, size)
    }

    /// [`View::framed`] of all actors of a stage together.
    #[must_use]
    pub fn framed_stage(stage: &Stage, framing: Framing, yaw_rad: f32, size: [u32; 2]) -> Self {
        if let [actor] = &stage.actors[..]
            && actor.world == Mat4::IDENTITY
        {
            return Self::framed_pose(actor.character.scene(), &actor.pose, framing, yaw_rad, size);
        }
        let turn = Quat::from_rotation_y(yaw_rad);
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for actor in &stage.actors {
            let framed = Framed::of(actor.character.scene(), &actor.pose, framing);
            let scale = actor.world.x_axis.truncate().length();
            // As the camera sees it: right, up, towards the camera.
            let middle = turn.inverse() * actor.world.transform_point3(framed.target);
            let half = Vec3::new(framed.width * 0.5, framed.height * 0.5, framed.before) * scale;
            (low, high) = (low.min(middle - half.with_z(0.0)), high.max(middle + half));
        }
        if stage.actors.is_empty() {
            return Self { size, ..Self::default() };
        }
        let middle = (low + high) * 0.5;
        let before = high.z - middle.z;
        Self::at(turn * middle, [high.y - low.y, high.x - low.x], before, yaw_rad, size)
    }

    /// From a side, so that this height and width fill the picture; `before`: how far something stands before the target.
    fn at(target: Vec3, [height, width]: [f32; 2], before: f32, yaw_rad: f32, size: [u32; 2]) -> Self {
        let aspect = size[0] as f32 / size[1].max(1) as f32;
        let camera = Camera { target, ..Camera::default() };
        let tan = (camera.fov_y_rad * 0.5).tan();
        let distance = (height * 0.5 / tan).max(width * 0.5 / (tan * aspect)) + before;
        let eye = target + Quat::from_rotation_y(yaw_rad) * Vec3::Z * distance;
        let near = (distance * 0.05).clamp(1e-4, 0.1);
        Self { size, camera: Camera { eye, near, ..camera }, ..Self::default() }
    }

    /// Refuses what no picture can be made of.
    pub(crate) fn check(&self) -> Result<()> {
        let fault = |what: &str, message: String| Err(Error::Argument { what: what.to_owned(), message });
        if self.size.iter().any(|&s| s == 0 || s > MAX_TEXTURE_SIDE) {
            return fault(
                "size",
                format!("is {}x{}; expected 1 to {MAX_TEXTURE_SIDE} a side", self.size[0], self.size[1]),
            );
        }
        let camera = &self.camera;
        if let Some([view_from_world, clip_from_view]) = camera.matrices {
            let [x, y, z, w] = [0, 1, 2, 3].map(|i| clip_from_view.row(i));
            let is_perspective = w == Vec4::NEG_Z && z.truncate().truncate() == Vec2::ZERO && x.w == 0.0 && y.w == 0.0;
            if !view_from_world.is_finite() || !clip_from_view.is_finite() || !is_perspective {
                let message = "expected finite ones, and of clip_from_view a perspective whose w is the distance";
                return fault("camera matrices", message.to_owned());
            }
        }
        if !(camera.fov_y_rad > 0.0 && camera.fov_y_rad < std::f32::consts::PI) {
            return fault("field of view", format!("is {} rad; expected above 0, below pi", camera.fov_y_rad));
        }
        if !(camera.near > 0.0 && camera.near.is_finite()) {
            return fault("near plane", format!("is {} m; expected above 0", camera.near));
        }
        let forward = camera.target - camera.eye;
        let spanned = forward.cross(camera.up).length_squared();
        if !camera.eye.is_finite() || !spanned.is_finite() || spanned <= 0.0 {
            return fault("camera", "eye, target and up must be finite and span a plane".to_owned());
        }
        if !self.jitter_px.iter().all(|px| (-1.0..=1.0).contains(px)) {
            return fault("jitter", format!("is {:?} pixels; expected -1 to 1 along each axis", self.jitter_px));
        }
        if let Channel::Look(name) = self.channel
            && Channel::from_name(name).is_none()
        {
            let known: Vec<&str> = Channel::all().map(|(_, name, _)| name).collect();
            return fault("channel", format!("is {name:?}; expected one of {}", known.join(", ")));
        }
        Ok(())
    }
}

/// What of a character fills a picture, character space, metres.
struct Framed {
    target: Vec3,
    height: f32,
    width: f32,
    /// How far its nearest part stands before the target.
    before: f32,
}

impl Framed {
    fn of(scene: &Scene, pose: &Pose, framing: Framing) -> Self {
        let world = scene.world_from_nodes(&pose.locals);
        let (low, high) = bounds(scene, &world);
        let joint = |bone, name| Some(world.get(scene.joint_node(bone, name)?)?.w_axis.truncate());
        let head = joint(HumanBone::Head, "head");
        let hips = joint(HumanBone::Hips, "hips").or_else(|| joint(HumanBone::Hips, "pelvis"));
        let top = high.y;
        let height = (high.y - low.y).max(1e-3);
        let head_y = head.map_or(low.y + height * 0.82, |h| h.y);
        // The head bone is at the base of the skull; from there to the top of the hair is about a head.
        let head_height = (top - head_y).clamp(height * 0.05, height * 0.5);
        let head_center = Vec3::new(
            head.map_or((low.x + high.x) * 0.5, |h| h.x),
            head_y + head_height * 0.45,
            head.map_or((low.z + high.z) * 0.5, |h| h.z),
        );
        let (target, height, width) = match framing {
            Framing::Face => (head_center, head_height * 1.15, head_height * 1.15),
            Framing::Portrait => (head_center - Vec3::Y * head_height * 0.25, head_height * 1.75, head_height * 1.75),
            Framing::Bust => {
                let above = top + head_height * 0.1;
                let below = hips.map_or(head_y - head_height * 2.2, |h| h.y).min(head_y - head_height * 0.5);
                (head_center.with_y((above + below) * 0.5), above - below, head_height * 2.2)
            }
            // Round the body's axis, so that a turning character keeps its place and size.
            Framing::Full => (
                Vec3::new(head_center.x, (low.y + high.y) * 0.5, head_center.z),
                height * 1.08,
                radius(low, high, head_center) * 2.0,
            ),
        };
        // The nearest part of the head stands in front of its middle.
        let before = if framing == Framing::Full {
            radius(low, high, head_center) * 0.5
        } else {
            head_height * 0.5
        };
        Self { target, height, width, before }
    }
}

/// Distance of the farthest side of a box from the vertical axis through `axis`.
fn radius(low: Vec3, high: Vec3, axis: Vec3) -> f32 {
    (axis - low).max(high - axis).with_y(0.0).max_element()
}

/// Bounding box in world space, with the nodes at `world`.
fn bounds(scene: &Scene, world: &[Mat4]) -> (Vec3, Vec3) {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for (node, mesh) in scene.mesh_nodes() {
        let skin = scene.nodes[node].skin.and_then(|s| scene.skins.get(s));
        for primitive in &mesh.primitives {
            let per_vertex = primitive.influences.per_vertex;
            for (v, position) in primitive.positions.iter().enumerate() {
                let matrix = match skin {
                    // The heaviest influence is enough for a box.
                    Some(skin) if per_vertex > 0 => {
                        let joint = primitive.influences.joints.get(v * per_vertex).map_or(0, |j| usize::from(*j));
                        let node = skin.joints.get(joint).and_then(|n| world.get(*n)).copied().unwrap_or_default();
                        node * skin.joint_from_mesh.get(joint).copied().unwrap_or_default()
                    }
                    _ => world[node],
                };
                // A box beyond all measure cannot be framed; 1000 km hold anything that was meant.
                let p = matrix.transform_point3(Vec3::from(*position)).clamp(Vec3::splat(-1e6), Vec3::splat(1e6));
                (low, high) = (low.min(p), high.max(p));
            }
        }
    }
    if low.is_finite() && high.is_finite() && low.x <= high.x {
        (low, high)
    } else {
        (Vec3::NEG_ONE, Vec3::ONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_has_one_name_and_a_shader_that_writes_it() {
        for (channel, name, doc) in Channel::all() {
            assert_eq!((Channel::from_name(name), channel.name()), (Some(channel), name));
            assert!(!doc.is_empty(), "{name} says nothing");
            let Channel::Look(_) = channel else { continue };
            let option = format!("@if(channel_{}", name.replace('-', "_"));
            let writes = |text: &str| text.contains(&format!("{option})")) || text.contains(&format!("{option} "));
            assert!(super::super::shaders::tree().iter().any(|(_, text)| writes(text)), "nobody writes {name}");
        }
    }
}
