//! The natural look: physical surfaces in a studio, hair as strands, no lines.

use super::{anime::materials_of, natural_eyes};
use crate::color::LinearRgb;
use crate::material::{
    Alpha, AlphaMode, Blending, CastShadow, FibreModel, Hair, Material, Origin, Rim, Shading, Skin, Standard, Strips,
    Substance,
};
use crate::scene::{DirectionalLight, Environment, Lights, Post, Pupils, Role, Scene, SelfShadow, ToneCurve};

/// Strengths of the key light and of the studio: together they show white skin just below white.
const KEY: f32 = 0.9;
const STUDIO: f32 = 0.75;

pub(super) fn apply(scene: &mut Scene) {
    for material in &mut scene.materials {
        physical(material);
    }
    for (roles, change) in [
        (&[Role::Face, Role::Skin][..], skin as fn(&mut Material)),
        (&[Role::Mouth], mouth),
        (&[Role::Eye, Role::EyeWhite], eye),
        (&[Role::HairFront, Role::Hair], hair),
    ] {
        for role in roles {
            for index in materials_of(scene, *role) {
                change(&mut scene.materials[index]);
            }
        }
    }
    natural_eyes::apply(scene);
    scene.pupils = Some(Pupils::default());
    scene.self_shadow = Some(SelfShadow { side: 2048, soft_width_m: 0.008, ..SelfShadow::default() });
    scene.lights = Some(Lights {
        directional: DirectionalLight { intensity: KEY, color: LinearRgb([1.0, 0.965, 0.92]), ..Default::default() },
        environment: Some(Environment { strength: STUDIO, ..Environment::studio() }),
        ..Lights::default()
    });
    scene.post = Some(Post { tone: ToneCurve::Filmic, ..scene.post.unwrap_or_default() });
}

/// What the file says of the surface, without what is drawn and not lit.
fn physical(material: &mut Material) {
    let surface = match material.origin {
        Origin::Pbr => material.authored.surface.unwrap_or_default(),
        _ => Standard::default(),
    };
    material.shading = Shading::Standard(surface);
    material.rim = Rim::default();
    material.matcap = None;
    material.outline = None;
    material.cast_shadow = Some(CastShadow::default());
    if let (Some(Substance::Metal), Shading::Standard(surface)) = (material.authored.substance, &mut material.shading) {
        // A file that paints its shine paints the metal itself darker than it is.
        *surface = Standard { metallic: 1.0, roughness: 0.3, ..*surface };
        material.base.color.iter_mut().take(3).for_each(|c| *c = (*c * 1.6).min(1.0));
    }
    // Painted lights stay what they are.
    if material.alpha.mode == AlphaMode::Blend && material.origin == Origin::Unlit {
        material.shading = Shading::Unlit;
    }
}

/// A standard surface of this roughness, where the file does not say one.
fn rough(material: &mut Material, roughness: f32) {
    if let (Shading::Standard(surface), true) = (&mut material.shading, material.origin != Origin::Pbr) {
        surface.roughness = roughness;
    }
}

/// Light scatters in it; the roughness of a file counts as far as skin may have it: below 0.5 the sharper lobe looks oiled. Drawn
/// faces look soiled where all that hides light from them counts.
fn skin(material: &mut Material) {
    rough(material, 0.5);
    if let Shading::Standard(surface) = &material.shading {
        material.skin = Some(Skin { roughness: surface.roughness.clamp(0.5, 0.7), occlusion: 0.7, ..Skin::default() });
    }
}

fn mouth(material: &mut Material) {
    rough(material, 0.35);
}

fn eye(material: &mut Material) {
    rough(material, 0.12);
    // What lies in the lid's shadow would be black in its own.
    material.cast_shadow = Some(CastShadow { casts: false, ..CastShadow::default() });
}

/// The colour is that of the file; locks that are modelled as one shine as the combed strands that they stand for.
fn hair(material: &mut Material) {
    // 1.6: light that has been about often, and what the head throws back, which the measured hair on a black head is without.
    let fibre = FibreModel { of_base: 1.0, longitudinal: 0.2, azimuthal: 0.35, scatter: 1.6, ..FibreModel::default() };
    material.hair = Some(Hair { fibre, highlight_color: [1.8; 3], occlusion: 0.6, ..Hair::default() });
    // Cards lie over each other, and what is denser than not hides what is behind.
    if material.alpha.mode == AlphaMode::Blend {
        material.alpha =
            Alpha { blending: Blending::ThreePass, opaque_cutoff: 0.5, least_alpha: 0.1, ..material.alpha };
        material.strips = Some(Strips::default());
    }
}
