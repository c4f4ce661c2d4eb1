//! Colours of shade for what a file leaves grey, or without any: a painter turns the hue with the light, and never mixes in black.

use std::collections::{BTreeMap, BTreeSet};
use std::f32::consts::PI;

use glam::{Vec2, Vec3, Vec3Swizzles};
use rayon::prelude::*;

use super::anime::materials_of_any;
use super::shade_texture::shaded;
use crate::material::{Material, Shading, TextureRef, Toon};
use crate::scene::painted::Painted;
use crate::scene::{Role, Scene, Texture};
use crate::smoothstep::smoothstep;
use crate::tone::{Tone, oklab};

/// Chroma up to which a factor of shade counts as nobody's choice.
const GREY: f32 = 0.045;
/// Luminance of a factor from which a file wants no shade at all.
const FLAT: f32 = 0.9;
/// Share of colour that lies in one hue where a material counts as of one colour.
const OF_ONE_HUE: f32 = 0.8;
/// What white cloth is multiplied by: sRGB (190, 196, 226) over (240, 240, 240).
const LAVENDER: [f32; 3] = [0.59, 0.63, 0.87];
/// The same where skin may lie among what is white.
const ROSY_LAVENDER: [f32; 3] = [0.6, 0.51, 0.7];
/// Hues in Oklch, radians: of the shade of what is cool, and of what is warm.
const BLUE: f32 = -1.5;
const ROSE: f32 = -0.1;

/// A material whose shade is grey by nobody's choice.
pub(super) struct Grey {
    material: usize,
    factor: [f32; 3],
    mean: Option<Mean>,
}

/// All of them but eyes and mouths.
pub(super) fn greys(scene: &Scene) -> Vec<Grey> {
    let kept = [Role::Eye, Role::EyeWhite, Role::EyeHighlight, Role::Lash, Role::Brow, Role::Mouth];
    let kept = materials_of_any(scene, &kept);
    let materials = scene.materials.par_iter().enumerate().filter(|(i, _)| !kept.contains(i));
    let grey = materials.filter_map(|(index, material)| {
        let own = factor(material, &unprepared_or_not(material)?);
        let is_grey = is_grey(own) && luminance(own) <= FLAT;
        is_grey.then(|| Grey { material: index, factor: own, mean: mean(scene, index) })
    });
    grey.collect()
}

/// Gives a hue to grey shade, to skin a warm one, and to black hair a light that its shade is told from.
pub(super) fn apply(scene: &mut Scene, greys: Vec<Grey>) {
    let role = |roles: &[Role]| materials_of_any(scene, roles);
    let others = role(&[Role::Hair, Role::HairFront, Role::Cloth, Role::Accessory, Role::Other]);
    let (of_body, unknown) = (role(&[Role::Face, Role::Skin]), role(&[Role::Other]));
    // A palette serves a whole character, skin among the rest.
    let skin: BTreeSet<usize> = of_body.difference(&others).copied().collect();
    let mixed: BTreeSet<usize> = of_body.intersection(&others).copied().collect();
    let hair = role(&[Role::Hair, Role::HairFront]);
    let of_more = role(&[Role::Face, Role::Skin, Role::Cloth, Role::Accessory, Role::Other]);
    let hair: Vec<usize> = hair.difference(&of_more).copied().collect();
    let of_file = skin.iter().find_map(|index| {
        let toon = unprepared_or_not(&scene.materials[*index])?;
        let factor = factor(&scene.materials[*index], &toon);
        (!is_grey(factor)).then_some(factor)
    });
    let face = role(&[Role::Face]);
    let picture = |index: &usize| Some(scene.materials.get(*index)?.base.texture?.texture);
    let of_others: BTreeSet<usize> = others.iter().filter_map(picture).collect();
    let mut chosen = BTreeMap::new();
    let mut palettes = BTreeSet::new();
    for Grey { material: index, factor: own, mean } in greys {
        let new = match (skin.contains(&index), mean) {
            (true, _) if of_file.is_some() => of_file.unwrap_or_default(),
            // Hands are painted by what the palette's picture says.
            (true, Some(Mean { tone, .. })) if picture(&index).is_some_and(|p| of_others.contains(&p)) => {
                as_dark_as(palette_shade(tone), own)
            }
            (true, Some(Mean { tone, .. })) => over(tone, skin_shade(tone)),
            _ if mixed.contains(&index) => {
                palettes.insert(index);
                ROSY_LAVENDER
            }
            (false, Some(Mean { tone, coherence })) if coherence > OF_ONE_HUE || tone.chroma < 0.03 => {
                over(tone, cloth_shade(tone))
            }
            _ if unknown.contains(&index) => {
                palettes.insert(index);
                ROSY_LAVENDER
            }
            _ => LAVENDER,
        };
        chosen.insert(index, new);
    }
    for (index, factor) in chosen {
        let material = &mut scene.materials[index];
        let base = material.base.color;
        if let Shading::Toon(toon) = &mut material.shading {
            toon.shade_color = std::array::from_fn(|c| base[c] * factor[c]);
            toon.shade_texture = material.base.texture;
        }
    }
    // What bangs and maps of faces are measured by is one factor.
    let mut painted = BTreeMap::new();
    for index in palettes.difference(&face) {
        paint_palette(scene, *index, &mut painted);
    }
    for index in hair {
        let Some(Mean { tone, .. }) = mean(scene, index) else { continue };
        let lifted = lifted_black(tone);
        scene.materials[index].base.color.iter_mut().zip(lifted).for_each(|(c, by)| *c *= by);
    }
}

/// Gives a material of many colours a picture of their shades. `painted`: textures that have one, by what they are multiplied
/// with; materials share them.
fn paint_palette(scene: &mut Scene, index: usize, painted: &mut BTreeMap<(usize, [u32; 3]), usize>) {
    let base = scene.materials[index].base;
    let [r, g, b, _] = base.color;
    let of_base = |t: TextureRef| Some((t, *scene.textures.get(t.texture)?));
    let Some((place, texture)) = base.texture.and_then(of_base) else { return };
    let key = (place.texture, [r, g, b].map(f32::to_bits));
    let shade = if let Some(found) = painted.get(&key) {
        *found
    } else {
        let image = scene.images.get(texture.image);
        let shade = image.and_then(|image| shaded(image, [r, g, b], |lit| palette_shade(Tone::of(lit))));
        let Some(shade) = shade else { return };
        scene.images.push(shade);
        scene.textures.push(Texture { image: scene.images.len() - 1, ..texture });
        painted.insert(key, scene.textures.len() - 1);
        scene.textures.len() - 1
    };
    if let Shading::Toon(toon) = &mut scene.materials[index].shading {
        toon.shade_color = [r, g, b];
        toon.shade_texture = Some(TextureRef { texture: shade, ..place });
    }
}

/// What a colour of a palette is multiplied by: what is like skin between the rule of skin and what suits all, since it may be
/// none; what is grey may be metal, on which lavender would be paint.
fn palette_shade(lit: Tone) -> [f32; 3] {
    let between = |a: [f32; 3], b: [f32; 3], share: f32| std::array::from_fn(|c| a[c] + (b[c] - a[c]) * share);
    let grey = smoothstep(0.045, 0.02, lit.chroma) * smoothstep(0.9, 0.75, lit.lightness);
    let cloth = over(lit, cloth_shade(lit));
    let cloth = between(cloth, [luminance(cloth); 3], 0.5 * grey);
    let skin: [f32; 3] = between(over(lit, skin_shade(lit)), ROSY_LAVENDER, 0.75);
    between(cloth, skin, lit.like_skin())
}

/// Share of the step from light to shade that a face keeps: nose and mouth live from it.
const STEP_KEPT: f32 = 0.93;

/// A factor of shade, darker where another has much more of a step from light.
fn as_dark_as(factor: [f32; 3], other: [f32; 3]) -> [f32; 3] {
    let most = 1.0 - STEP_KEPT * (1.0 - luminance(other));
    factor.map(|c| c * (most / luminance(factor)).min(1.0))
}

/// Oklab lightness below which hair is black: its shade would not be told from its light.
const BLACK: f32 = 0.3;

/// What the lit colour of black hair is multiplied by: painters mix it lighter and cooler than its shade.
fn lifted_black(lit: Tone) -> [f32; 3] {
    if lit.lightness >= BLACK {
        return [1.0; 3];
    }
    let light = Tone {
        lightness: BLACK,
        chroma: lit.chroma.max(0.015),
        hue_rad: if lit.chroma < 0.015 { BLUE } else { lit.hue_rad },
    };
    let (from, to) = (lit.to_linear(), light.to_linear());
    std::array::from_fn(|c| (to[c] / from[c].max(1e-3)).clamp(1.0, 2.4))
}

/// The shading of a material whose shade no texture of its own paints.
fn unprepared_or_not(material: &Material) -> Option<Toon> {
    let Shading::Toon(toon) = material.shading else { return None };
    let same = toon.shade_texture.is_none() || toon.shade_texture == material.base.texture;
    (same && material.authored.ramps.is_none() && material.authored.substance.is_none()).then_some(toon)
}

/// What the lit colour is multiplied by in shade.
fn factor(material: &Material, toon: &Toon) -> [f32; 3] {
    std::array::from_fn(|c| {
        let lit = material.base.color[c];
        if lit > 1e-3 {
            (toon.shade_color[c] / lit).clamp(0.0, 1.0)
        } else {
            1.0
        }
    })
}

fn is_grey(factor: [f32; 3]) -> bool {
    Tone::of(factor).chroma < GREY
}

fn luminance(color: [f32; 3]) -> f32 {
    crate::color::LinearRgb(color).luminance()
}

/// The colour of a material over its whole surface, and how much of its colour lies in one hue: 1 is all.
struct Mean {
    tone: Tone,
    coherence: f32,
}

fn mean(scene: &Scene, material: usize) -> Option<Mean> {
    let painted = Painted::new(scene, &scene.materials[material]);
    let parts = scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.material == material);
    let (mut sum, mut way, mut chroma, mut all) = (Vec3::ZERO, Vec2::ZERO, 0.0, 0.0);
    for (color, area) in parts.flat_map(|p| painted.of_triangles(p)) {
        let colored = oklab(color).yz() * area;
        sum += Vec3::from(color) * area;
        way += colored;
        chroma += colored.length();
        all += area;
    }
    (all > 0.0).then(|| Mean {
        tone: Tone::of((sum / all).to_array()),
        coherence: if chroma > 0.0 { way.length() / chroma } else { 1.0 },
    })
}

/// Warm, redder, and still alive.
fn skin_shade(lit: Tone) -> Tone {
    // Tan skin has its colour already: more would be sunburnt.
    let pale = smoothstep(0.14, 0.07, lit.chroma);
    let chroma = lit.chroma * (0.9 + 0.35 * pale) + 0.025 * pale;
    let shade = Tone { lightness: lit.lightness * (0.84 + 0.02 * pale), chroma, ..lit };
    shade.towards(0.5, 0.1 + 0.25 * pale)
}

/// What is cool turns to blue, what is warm to rose; white to lavender, black to blue-black.
fn cloth_shade(lit: Tone) -> Tone {
    let lightness = lit.lightness * (0.8 + 0.05 * smoothstep(0.75, 0.85, lit.lightness));
    let neutral = Tone { lightness, chroma: 0.042 * lit.lightness.max(0.35), hue_rad: BLUE };
    let warm = (lit.hue_rad + 0.5).rem_euclid(2.0 * PI);
    // Hues between warm and cool stay as they are: neighbours must not part.
    let between = warm.min((warm - 2.6).abs()).min(2.0 * PI - warm);
    // Deep colours would glow.
    let deep = smoothstep(0.08, 0.2, lit.chroma);
    let colored = Tone { lightness: lit.lightness * 0.8, chroma: lit.chroma * (1.06 - 0.14 * deep), ..lit };
    let target = if warm < 2.6 { ROSE } else { BLUE };
    let away = ((target - lit.hue_rad + PI).rem_euclid(2.0 * PI) - PI).abs();
    let turned = colored.towards(target, (0.17 * away).min(0.3) * smoothstep(0.0, 0.3, between));
    neutral.mixed(turned, smoothstep(0.02, 0.045, lit.chroma))
}

/// One colour over another, no channel of it so dark that all of it is lost.
fn over(lit: Tone, shade: Tone) -> [f32; 3] {
    let (lit, shade) = (lit.to_linear(), shade.to_linear());
    std::array::from_fn(|c| ((shade[c] + 0.004) / (lit[c] + 0.004)).clamp(0.12, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{LinearRgb, Srgb};

    fn shaded(hex: &str, rule: fn(Tone) -> Tone) -> [i32; 3] {
        let lit = Srgb::from_hex(hex).unwrap().to_linear().0;
        let factor = over(Tone::of(lit), rule(Tone::of(lit)));
        LinearRgb(std::array::from_fn(|c| lit[c] * factor[c])).to_srgb().0.map(i32::from)
    }

    #[test]
    fn white_turns_lavender_and_black_blue() {
        let [r, g, b] = shaded("#f0f0f0", cloth_shade);
        assert!((r - 190).abs() < 14 && (g - 196).abs() < 14 && (b - 226).abs() < 14, "{r} {g} {b}");
        let [r, _, b] = shaded("#1a1a1a", cloth_shade);
        assert!(b > r && r > 8, "{r} {b}");
    }

    #[test]
    fn black_hair_is_lifted_and_no_other() {
        let lit = |hex: &str| Tone::of(Srgb::from_hex(hex).unwrap().to_linear().0);
        let black = lit("#1c1c1e");
        let by = lifted_black(black);
        assert!(by.iter().all(|by| (1.3..=2.4).contains(by)) && by[2] > by[0], "{by:?}");
        let [r, g, b] = black.to_linear();
        let lifted = Tone::of([r * by[0], g * by[1], b * by[2]]).lightness;
        assert!(lifted <= BLACK + 1e-3, "{lifted}");
        assert_eq!(lifted_black(lit("#3a2a22")), [1.0; 3]);
    }

    #[test]
    fn skin_stays_warm_within_its_hue() {
        for hex in ["#ffe8d8", "#f2c9a8", "#8a5a3c"] {
            let lit = Tone::of(Srgb::from_hex(hex).unwrap().to_linear().0);
            let [r, g, b] = shaded(hex, skin_shade);
            assert!(r > g && g > b - 12, "{hex}: {r} {g} {b}");
            let turned = (skin_shade(lit).hue_rad - lit.hue_rad).abs().to_degrees();
            assert!(turned <= 25.0, "{hex}: {turned}");
        }
    }

    #[test]
    fn palettes_keep_skin_warm_and_metal_grey() {
        let shade = |hex: &str| {
            let lit = Srgb::from_hex(hex).unwrap().to_linear().0;
            let factor = palette_shade(Tone::of(lit));
            LinearRgb(std::array::from_fn(|c| lit[c] * factor[c])).to_srgb().0.map(i32::from)
        };
        let [r, g, b] = shade("#ffcda5");
        assert!(r > g + 35 && g > b, "{r} {g} {b}");
        let [r, _, b] = shade("#808a8c");
        assert!((0..25).contains(&(b - r)), "{r} {b}");
        let [r, g, b] = shade("#f0f0f0");
        assert!(b > r + 20 && b > g + 20, "{r} {g} {b}");
    }

    #[test]
    fn shades_of_neighbours_are_neighbours() {
        // Along lines through the colours of a screen, in steps of its codes.
        let line = |from: [f32; 3], to: [f32; 3]| {
            (0..=255).map(move |i| {
                let encoded: [f32; 3] = std::array::from_fn(|c| from[c] + (to[c] - from[c]) * i as f32 / 255.0);
                let lit = encoded.map(crate::color::linear_from_srgb);
                let factor = palette_shade(Tone::of(lit));
                let shade: [f32; 3] = std::array::from_fn(|c| crate::color::srgb_from_linear(lit[c] * factor[c]));
                shade
            })
        };
        let corner = |n: usize| std::array::from_fn(|c| (n >> c & 1) as f32);
        for (from, to) in (0..8).flat_map(|a| (0..8).map(move |b| (a, b))) {
            let shades: Vec<[f32; 3]> = line(corner(from), corner(to)).collect();
            for pair in shades.windows(2) {
                let most = (0..3).map(|c| (pair[1][c] - pair[0][c]).abs()).fold(0.0, f32::max);
                assert!(most < 6.0 / 255.0, "{:?} to {:?}: {pair:?}", corner(from), corner(to));
            }
        }
    }

    #[test]
    fn yellow_turns_towards_orange() {
        let [r, g, b] = shaded("#f2d040", cloth_shade);
        assert!(r - g > 45 && b < g, "{r} {g} {b}");
    }
}
