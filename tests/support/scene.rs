//! Scenes made in code: a sphere, a cube, flat squares; and a view that shows them.

#![allow(dead_code, reason = "every test file uses its own share")]

use std::cell::RefCell;
use std::ops::Deref;
use std::sync::Mutex;

use glam::{Mat4, Vec3};
use hikage::{
    Actor, Background, Channel, Character, Gpu, Output, Renderer, Stage, View,
    color::{LinearRgb, Srgb},
    material::{Base, Material, Shading, TextureRef, Toon},
    scene::{
        Ambient, Camera, DirectionalLight, Framing, Image, Lights, Mesh, Node, Primitive, Role, Sampler, Scene, Texture,
    },
};

/// Devices that wait for a test, with their renderers. Not in a thread's own memory: drivers cannot be closed while that
/// goes.
static DEVICES: Mutex<Vec<(Gpu, Option<Renderer>)>> = Mutex::new(Vec::new());

/// A device that no other test uses meanwhile, with its renderer of four samples, whose pipelines serve all scenes.
pub struct Lent {
    gpu: Gpu,
    renderer: RefCell<Option<Renderer>>,
    /// Whether another test may have it afterwards.
    is_pooled: bool,
}

impl Lent {
    /// A device of this adapter alone.
    pub fn of(name: &str) -> Self {
        let gpu = Gpu::headless(Some(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        Self { gpu, renderer: RefCell::new(None), is_pooled: false }
    }
}

impl Deref for Lent {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.gpu
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        // One on which a test has failed serves no other.
        if !std::thread::panicking() && self.is_pooled {
            let back = (self.gpu.clone(), self.renderer.take());
            DEVICES.lock().expect("no test panics while it gives a device back").push(back);
        }
    }
}

/// The adapter of the tests. `HIKAGE_ADAPTER` names another than the default.
pub fn gpu() -> Lent {
    let waiting = DEVICES.lock().expect("no test panics while it takes a device").pop();
    let open = || {
        let name = std::env::var("HIKAGE_ADAPTER").ok();
        (Gpu::headless(name.as_deref()).unwrap_or_else(|e| panic!("{e}")), None)
    };
    let (gpu, renderer) = waiting.unwrap_or_else(open);
    Lent { gpu, renderer: RefCell::new(renderer), is_pooled: true }
}

/// The built-in character as her file says.
pub fn heroine() -> Scene {
    let limits = hikage::import::Limits::default();
    hikage::import::load_bytes("hikage.vrm", &hikage_character::file(), None, &limits).expect("the file is read")
}

/// The built-in character with the anime look, its face map made from her mesh.
pub fn anime_heroine() -> Scene {
    let mut scene = heroine();
    hikage::Look::Anime(hikage::Anime::default()).apply(&mut scene);
    scene
}

/// What belongs to a head.
pub const HEAD: &[Role] = &[
    Role::Face,
    Role::Mouth,
    Role::Eye,
    Role::EyeWhite,
    Role::EyeHighlight,
    Role::Lash,
    Role::Brow,
    Role::Hair,
    Role::HairFront,
];

/// Leaves the parts of these roles alone, for pictures of nothing else: the rest takes most of an upload.
pub fn keep(scene: &mut Scene, roles: &[Role]) {
    let mut used = vec![false; scene.materials.len()];
    for mesh in &mut scene.meshes {
        mesh.primitives.retain(|p| roles.contains(&p.role));
        mesh.primitives.iter().for_each(|p| used[p.material] = true);
    }
    for (material, _) in scene.materials.iter_mut().zip(used).filter(|(_, used)| !used) {
        *material = Material { name: std::mem::take(&mut material.name), ..Material::default() };
    }
}

/// A material with a red lit and a blue shade colour.
pub fn two_tone() -> Material {
    Material {
        base: Base { color: [0.9, 0.3, 0.25, 1.0], texture: None },
        shading: Shading::Toon(Toon { shade_color: [0.3, 0.12, 0.4], ..Toon::default() }),
        ..Material::default()
    }
}

/// One node with one mesh of the given parts.
pub fn scene(parts: Vec<(Primitive, Material)>) -> Scene {
    let (mut primitives, mut materials) = (Vec::new(), Vec::new());
    for (mut primitive, material) in parts {
        primitive.material = materials.len();
        materials.push(material);
        primitives.push(primitive);
    }
    Scene {
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        meshes: vec![Mesh { primitives, ..Mesh::default() }],
        materials,
        ..Scene::default()
    }
}

/// Adds an image to a scene and returns how a material refers to it.
pub fn texture(scene: &mut Scene, width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> TextureRef {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).flat_map(|(x, y)| texel(x, y)).collect();
    scene.images.push(Image { width, height, pixels, ..Image::default() });
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler: Sampler::default() });
    TextureRef { texture: scene.textures.len() - 1, ..TextureRef::default() }
}

/// A sphere around the origin; u runs around +Y from -Z over -X and +Z, v down from the pole.
pub fn sphere(radius: f32, rings: u32, segments: u32) -> Primitive {
    let mut p = Primitive { uvs: vec![Vec::new()], ..Primitive::default() };
    for ring in 0..=rings {
        let v = ring as f32 / rings as f32;
        let (sin_polar, cos_polar) = (v * std::f32::consts::PI).sin_cos();
        for segment in 0..=segments {
            let u = segment as f32 / segments as f32;
            let (sin, cos) = (u * std::f32::consts::TAU).sin_cos();
            let n = Vec3::new(-sin * sin_polar, cos_polar, -cos * sin_polar);
            p.positions.push((n * radius).to_array());
            p.normals.push(n.to_array());
            p.outline_normals.push(n.to_array());
            p.tangents.push([-cos, 0.0, sin, 1.0]);
            p.uvs[0].push([u, v]);
        }
    }
    let row = segments + 1;
    for ring in 0..rings {
        for segment in 0..segments {
            let a = ring * row + segment;
            p.indices.extend([a, a + row, a + 1, a + 1, a + row, a + row + 1]);
        }
    }
    p
}

/// A cube with hard edges and smoothed outline normals.
pub fn cube(half: f32) -> Primitive {
    let mut p = Primitive { uvs: vec![Vec::new()], ..Primitive::default() };
    for axis in 0..3 {
        for sign in [-1.0f32, 1.0] {
            let n = Vec3::AXES[axis] * sign;
            let (s, t) = (Vec3::AXES[(axis + 1) % 3] * sign, Vec3::AXES[(axis + 2) % 3]);
            let first = p.positions.len() as u32;
            for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                let corner = n + s * a + t * b;
                p.positions.push((corner * half).to_array());
                p.normals.push(n.to_array());
                p.outline_normals.push(corner.normalize().to_array());
                p.uvs[0].push([a * 0.5 + 0.5, 0.5 - b * 0.5]);
            }
            p.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
        }
    }
    p
}

/// A square in the plane z that faces +Z.
pub fn square(center: [f32; 2], half: f32, z: f32) -> Primitive {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    Primitive {
        positions: corners.iter().map(|(a, b)| [center[0] + a * half, center[1] + b * half, z]).collect(),
        normals: vec![[0.0, 0.0, 1.0]; 4],
        outline_normals: vec![[0.0, 0.0, 1.0]; 4],
        tangents: vec![[1.0, 0.0, 0.0, 1.0]; 4],
        uvs: vec![corners.iter().map(|(a, b)| [a * 0.5 + 0.5, 0.5 - b * 0.5]).collect()],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Primitive::default()
    }
}

/// A view with the light on it, and where a character stands in it.
#[derive(Clone, Debug)]
pub struct Shot {
    pub size: [u32; 2],
    pub camera: Camera,
    pub lights: Lights,
    pub background: Background,
    pub time_s: f32,
    pub channel: Channel,
    /// An actor in the pose of the first one for each.
    pub instances: Vec<Mat4>,
}

impl Default for Shot {
    fn default() -> Self {
        Self::of(View::default(), Lights::default())
    }
}

impl Shot {
    fn of(view: View, lights: Lights) -> Self {
        let View { size, camera, background, channel, .. } = view;
        Self { size, camera, lights, background, time_s: 0.0, channel, instances: vec![Mat4::IDENTITY] }
    }

    /// A framing of a character at rest under the light of its scene.
    pub fn framed(scene: &Scene, framing: Framing, yaw_rad: f32, size: [u32; 2]) -> Self {
        Self::of(View::framed(scene, framing, yaw_rad, size), scene.lights.clone().unwrap_or_default())
    }

    pub fn view(&self) -> View {
        let Self { size, camera, background, channel, .. } = *self;
        View { size, camera, background, channel, ..View::default() }
    }

    /// Sets a stage under its light, with an actor for each place.
    pub fn set(&self, stage: &mut Stage) {
        stage.actors.truncate(self.instances.len());
        while let Some(first) = stage.actors.first().filter(|_| stage.actors.len() < self.instances.len()) {
            let another = Actor::new(&first.character).posed(first.pose.clone());
            stage.actors.push(another);
        }
        for (actor, world) in stage.actors.iter_mut().zip(&self.instances) {
            actor.world = *world;
        }
        stage.lights.clone_from(&self.lights);
        stage.time_s = self.time_s;
    }
}

/// A stage with one actor of a character.
pub fn staged(character: hikage::Result<Character>) -> Stage {
    Stage::of([Actor::new(&character.expect("an upload"))])
}

/// Draws shots.
pub trait Shoot {
    fn shoot(&self, stage: &mut Stage, shot: &Shot) -> hikage::Result<Image>;
}

impl Shoot for Renderer {
    fn shoot(&self, stage: &mut Stage, shot: &Shot) -> hikage::Result<Image> {
        shot.set(stage);
        self.render(stage, &shot.view())
    }
}

/// A square picture of the origin from +Z at `distance`, lit from the upper left, without ambient light.
pub fn view(size: u32, distance: f32) -> Shot {
    Shot {
        size: [size, size],
        camera: Camera { eye: Vec3::Z * distance, target: Vec3::ZERO, ..Camera::default() },
        lights: Lights {
            directional: DirectionalLight {
                to_light: Vec3::new(-0.5, 0.6, 0.62).normalize(),
                ..DirectionalLight::default()
            },
            ambient: Ambient::uniform(LinearRgb::BLACK),
            ..Lights::default()
        },
        background: Background::Color(Srgb([0x80; 3])),
        ..Shot::default()
    }
}

/// Works with the renderer of a device.
pub fn with_renderer<T>(gpu: &Lent, work: impl FnOnce(&Renderer) -> T) -> T {
    let mut renderer = gpu.renderer.borrow_mut();
    work(renderer.get_or_insert_with(|| Renderer::new(gpu).expect("a renderer")))
}

/// Renders a scene with four samples.
pub fn render(gpu: &Lent, scene: &Scene, shot: &Shot) -> Image {
    with_renderer(gpu, |renderer| {
        let mut stage = staged(renderer.upload(scene));
        renderer.shoot(&mut stage, shot).expect("a picture")
    })
}

/// Renders a scene into a given output.
pub fn render_with(gpu: &Gpu, scene: &Scene, shot: &Shot, output: Output) -> Image {
    let renderer = Renderer::with_output(gpu, output).expect("a renderer");
    let mut stage = staged(renderer.upload(scene));
    renderer.shoot(&mut stage, shot).expect("a picture")
}

/// A pixel, from the top left.
pub fn pixel(image: &Image, x: u32, y: u32) -> [u8; 4] {
    let at = ((y * image.width + x) * 4) as usize;
    image.pixels[at..at + 4].try_into().expect("four bytes")
}

/// Texels of a texture, without the padding of its rows.
pub fn texels(gpu: &Gpu, texture: &wgpu::Texture) -> Vec<u8> {
    let (width, height) = (texture.width(), texture.height());
    let texel = texture.format().block_copy_size(None).expect("a plain format");
    let row = (width * texel).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row * height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |result| result.expect("mapped"));
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("done");
    let mapped = buffer.slice(..).get_mapped_range().expect("mapped");
    mapped.chunks_exact(row as usize).flat_map(|line| &line[..(width * texel) as usize]).copied().collect()
}

/// A texture to draw into and to read back.
pub fn target(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat, samples: u32) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}
