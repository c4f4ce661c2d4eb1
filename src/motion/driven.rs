//! What expressions may change of a material: shaders must hold it even where it is off at rest.

use crate::scene::{ColorTarget, Scene};

/// What the expressions of a scene change of one material.
#[derive(Clone, Debug, Default)]
pub struct Driven {
    colors: Vec<ColorTarget>,
    /// Whether they move its textures.
    pub(crate) uvs: bool,
}

impl Driven {
    /// Nothing.
    pub(crate) const NONE: &'static Self = &Self { colors: Vec::new(), uvs: false };

    /// What the expressions of a scene change, for each material.
    pub(crate) fn of(scene: &Scene) -> Vec<Self> {
        let mut driven = vec![Self::default(); scene.materials.len()];
        for expression in scene.character.iter().flat_map(|c| &c.expressions) {
            for bind in &expression.colors {
                if let Some(material) = driven.get_mut(bind.material) {
                    material.colors.push(bind.target);
                }
            }
            for bind in &expression.uv_transforms {
                if let Some(material) = driven.get_mut(bind.material) {
                    material.uvs = true;
                }
            }
        }
        driven
    }

    /// Whether they change this colour.
    #[must_use]
    pub fn shifts(&self, target: ColorTarget) -> bool {
        self.colors.contains(&target)
    }
}
