//! Looks: what is added to a character as its file describes it.

use std::collections::BTreeSet;

use crate::material::{BangsShadow, FaceShadow, Highlight, Material, Shading, TextureRef};
use crate::scene::{Bangs, EyesThrough, Filter, Image, Role, Sampler, Scene, Texture, Wrap};
use crate::sdf::{ThresholdMap, face_map};

/// Materials that get a face's shadow: characters have one to three, and a file of thousands must not fill the memory.
const MOST_FACES: usize = 16;

/// What a character is made to look like.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Look {
    /// As the file says.
    #[default]
    Plain,
    /// The face of a shipped anime game: its shadow is a drawn shape, not a matter of normals, its bangs cast theirs
    /// on it, and eyes and brows are seen through them.
    Anime {
        /// Threshold map painted for light from the character's left, over the face's texture; the other side mirrors
        /// it. `None`: one is made from the mesh of each face.
        face: Option<ThresholdMap>,
    },
}

impl Look {
    /// Changes the materials of a scene, before its upload. Roles decide what is a face; a scene without one stays as it
    /// is, and so does a face whose two sides share their texture coordinates.
    pub fn apply(&self, scene: &mut Scene) {
        let Self::Anime { face } = self else { return };
        highlights(scene);
        scene.bangs = Some(Bangs::default());
        scene.eyes_through = Some(EyesThrough::default());
        for material in materials_of(scene, Role::Face).into_iter().take(MOST_FACES) {
            let shade = shade_factor(&scene.materials[material]);
            scene.materials[material].bangs_shadow = Some(BangsShadow { color: shade, ..BangsShadow::default() });
            let Some(mut map) = face_map(scene, material) else { continue };
            if let Some(painted) = face {
                map = over(&painted.mirrored_image(), &map);
            }
            let texture = add_texture(scene, map);
            scene.materials[material].face_shadow =
                Some(FaceShadow { map: TextureRef { texture, ..TextureRef::default() }, ..FaceShadow::default() });
        }
    }
}

/// Materials that a part of this role has.
fn materials_of(scene: &Scene, role: Role) -> BTreeSet<usize> {
    let parts = scene.meshes.iter().flat_map(|m| &m.primitives);
    parts.filter(|p| p.role == role).map(|p| p.material).filter(|m| *m < scene.materials.len()).collect()
}

/// The highlights that the file carries: a band on hair, points on nose and lips.
fn highlights(scene: &mut Scene) {
    for (role, highlight) in [
        (Role::HairFront, Highlight::default()),
        (Role::Hair, Highlight::default()),
        (
            Role::Face,
            Highlight { strength: 0.9, light_v: 0.0, view_v: 0.0, turn_u: 0.012, facing: 0.35, ..Highlight::default() },
        ),
    ] {
        for index in materials_of(scene, role) {
            let material = &mut scene.materials[index];
            material.highlight = material.authored_highlight.map(|map| Highlight { map, ..highlight });
        }
    }
}

/// What the lit colour is multiplied by in shade, where one texture serves both; else the default of the shadow.
fn shade_factor(material: &Material) -> [f32; 3] {
    match material.shading {
        Shading::Toon(toon) if toon.shade_texture == material.base.texture => {
            let [r, g, b, _] = material.base.color;
            let share = |shade: f32, base: f32| {
                if base > 1e-3 {
                    (shade / base).clamp(0.0, 1.0)
                } else {
                    1.0
                }
            };
            [share(toon.shade_color[0], r), share(toon.shade_color[1], g), share(toon.shade_color[2], b)]
        }
        _ => BangsShadow::default().color,
    }
}

/// The painted thresholds, with the regions of the map from the mesh.
fn over(painted: &Image, mesh: &Image) -> Image {
    let mut map = painted.clone();
    let [width, height] = [map.width as usize, map.height as usize];
    for (i, pixel) in map.pixels.chunks_exact_mut(4).enumerate() {
        let (x, y) = (i % width * mesh.width as usize / width, i / width * mesh.height as usize / height);
        pixel[2] = mesh.pixels[(y * mesh.width as usize + x) * 4 + 2];
    }
    map
}

fn add_texture(scene: &mut Scene, image: Image) -> usize {
    scene.images.push(image);
    let sampler = Sampler {
        wrap_u: Wrap::Clamp,
        wrap_v: Wrap::Clamp,
        mag: Filter::Linear,
        min: Filter::Linear,
        mip: Some(Filter::Linear),
    };
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler });
    scene.textures.len() - 1
}
