//! Where the renderer of the references is known to depart from the specifications. With that reproduced in our
//! pictures, or left out where it cannot be, what remains is ours.

use hikage::color::linear_from_srgb;
use hikage::material::{Material, Origin, OutlineWidth, Shading, TextureRef};
use hikage::scene::{Scene, Texture};
use serde::Serialize;

/// The renderer, and each departure with the clause that it breaks.
pub(super) const LEGEND: &str = "\
known: departures of the references' renderer (three-vrm 3.5.5, three.js r180) that materials in view have
  shift   shadingShiftTexture is decoded as sRGB; MToon 1.0 \"shadingShiftTexture\": components are linear
  width   screen-coordinate outlines thin with distance; MToon 1.0 \"Outline Width\": a ratio of the screen's height
  half    _OutlineWidth of VRM 0.x is taken as % of the screen's height; MToon 0.x offsets clip space by it, so % of half
  normal  normal maps use a derivative frame with both axes scaled alike, and outlines of such materials are shaded
          with the normal reversed; glTF 2.0 section 3.7.2.1: MikkTSpace
explained: off % with shift, width and half reproduced, without the pixels of normal (their share of the parts: left out %)
";

/// Reach of an outline beyond its part, pixels.
const OUTLINE: usize = 4;

/// A departure from the specifications.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Known {
    Shift,
    Width,
    Half,
    Normal,
}

impl Known {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Shift => "shift",
            Self::Width => "width",
            Self::Half => "half",
            Self::Normal => "normal",
        }
    }

    /// Those that show with this material.
    pub(super) fn of(material: &Material) -> impl Iterator<Item = Self> {
        let has_shift = matches!(&material.shading, Shading::Toon(toon) if toon.shift_texture.is_some());
        let has_width = matches!(
            material.outline.map(|o| o.width),
            Some(OutlineWidth::Screen { height_ratio }) if height_ratio > 0.0
        );
        let all = [
            (Self::Shift, has_shift),
            (Self::Width, has_width),
            (Self::Half, has_width && material.origin == Origin::Mtoon0),
            (Self::Normal, material.normal_map.is_some()),
        ];
        all.into_iter().filter_map(|(known, has)| has.then_some(known))
    }
}

/// The scene with `shift`, `width` and `half` as the references have them. `distance` from the eye to what it looks at stands
/// for the depth of every outline.
pub(super) fn reproduce(scene: &Scene, distance: f32) -> Scene {
    let mut scene = scene.clone();
    let mut materials = std::mem::take(&mut scene.materials);
    for material in &mut materials {
        if let Shading::Toon(toon) = &mut material.shading
            && let Some(shift) = &mut toon.shift_texture
        {
            decode(&mut scene, shift);
        }
        if let Some(OutlineWidth::Screen { height_ratio }) = material.outline.as_mut().map(|o| &mut o.width) {
            *height_ratio *= if material.origin == Origin::Mtoon0 { 2.0 } else { 1.0 } / distance;
        }
    }
    Scene { materials, ..scene }
}

/// Turns the use of a texture to a copy that is decoded from sRGB.
fn decode(scene: &mut Scene, used: &mut TextureRef) {
    let Some(Texture { image, sampler }) = scene.textures.get(used.texture).copied() else { return };
    let Some(mut image) = scene.images.get(image).cloned() else { return };
    for texel in image.pixels.chunks_exact_mut(4) {
        for channel in &mut texel[..3] {
            *channel = (linear_from_srgb(f32::from(*channel) / 255.0) * 255.0).round() as u8;
        }
    }
    scene.images.push(image);
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler });
    used.texture = scene.textures.len() - 1;
}

/// Which pixels lie within [`OUTLINE`] pixels of a marked one, diagonals included.
pub(super) fn with_outlines(marked: &[bool], width: usize) -> Vec<bool> {
    let mut reached = vec![false; marked.len()];
    let height = marked.len() / width.max(1);
    for i in (0..marked.len()).filter(|i| marked[*i]) {
        let (x, y) = (i % width, i / width);
        for y in y.saturating_sub(OUTLINE)..(y + OUTLINE + 1).min(height) {
            reached[y * width..][x.saturating_sub(OUTLINE)..(x + OUTLINE + 1).min(width)].fill(true);
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;
    use hikage::material::{Outline, Toon};
    use hikage::scene::Image;

    #[test]
    fn shift_is_decoded_for_itself_alone_and_width_divided() {
        let texture = TextureRef::default();
        let mut material = Material::default();
        material.base.texture = Some(texture);
        material.shading = Shading::Toon(Toon { shift_texture: Some(texture), ..Toon::default() });
        let width = OutlineWidth::Screen { height_ratio: 0.01 };
        material.outline = Some(Outline { width, ..Outline::default() });
        let known: Vec<_> = Known::of(&material).collect();
        assert!(known == [Known::Shift, Known::Width]);

        let image = Image { width: 1, height: 1, pixels: vec![188, 0, 255, 77], ..Image::default() };
        let scene = Scene {
            materials: vec![material],
            textures: vec![Texture::default()],
            images: vec![image.clone()],
            ..Scene::default()
        };
        let theirs = reproduce(&scene, 4.0);
        let Shading::Toon(toon) = theirs.materials[0].shading else { panic!("toon") };
        let shift = theirs.textures[toon.shift_texture.expect("a texture").texture];
        // 188 is half the light.
        assert_eq!(theirs.images[shift.image].pixels, [128, 0, 255, 77]);
        assert_eq!(theirs.materials[0].base.texture, Some(texture));
        assert_eq!(theirs.images[0], image);
        let width = theirs.materials[0].outline.expect("an outline").width;
        assert_eq!(width, OutlineWidth::Screen { height_ratio: 0.0025 });

        let mut old = scene;
        old.materials[0].origin = Origin::Mtoon0;
        let width = reproduce(&old, 4.0).materials[0].outline.expect("an outline").width;
        assert_eq!(width, OutlineWidth::Screen { height_ratio: 0.005 });
    }

    #[test]
    fn outlines_reach_four_pixels_and_stop_at_the_edge() {
        let mut marked = vec![false; 12 * 12];
        marked[2 * 12 + 5] = true;
        let reached = with_outlines(&marked, 12);
        for (i, found) in reached.iter().enumerate() {
            let (x, y) = (i % 12, i / 12);
            assert_eq!(*found, x.abs_diff(5) <= 4 && y.abs_diff(2) <= 4, "{x},{y}");
        }
    }
}
