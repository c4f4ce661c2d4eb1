//! Scenes of skin: one colour all over, in a hard light, with every way of finding the light that scatters.

use std::path::Path;

use hikage::material::{Base, CastShadow, Material, Skin, SkinDiffuse};
use hikage::scene::SelfShadow;
use hikage::skin::{DiffusionProfile, Transmission};
use serde::Deserialize;

use super::{Reference, Shot};

/// Ways of finding the light that scatters, each compared.
pub(super) const METHODS: [SkinDiffuse; 6] = [
    SkinDiffuse::Lambert,
    SkinDiffuse::Wrapped,
    SkinDiffuse::PreIntegrated,
    SkinDiffuse::ScreenSpace,
    SkinDiffuse::ScreenSpaceDisc,
    SkinDiffuse::TextureSpace,
];

/// Sharp edges: three texels of the map, a few hundredths of a millimetre on a head.
const SHADOW: SelfShadow = SelfShadow { side: 4096, soft_width_m: 0.0001, bias_texels: 2.0 };
/// Edges for the table of penumbras, which has no others: five texels of a coarse map, 3 mm on a head.
const PENUMBRA: SelfShadow = SelfShadow { side: 512, soft_width_m: 0.012, bias_texels: 2.0 };
/// Pixels of ours along a side of one of the reference.
const SCALE: u32 = 4;

/// The name of a reference, taken apart: `skin_BODY_KIND_VIEW`.
pub(super) struct Name<'a> {
    pub(super) body: &'a str,
    kind: &'a str,
    view: &'a str,
}

impl<'a> Name<'a> {
    /// Of what is compared; others have something that is not drawn here, or are there for their noise.
    pub(super) fn of(name: &'a str) -> Option<Self> {
        let mut words = name.strip_prefix("skin_")?.split('_');
        let (body, kind, view) = (words.next()?, words.next()?, words.next()?);
        let is_known = ["head", "close", "sphere10", "sphere25", "ear", "wedge"].contains(&body)
            && ["rw", "burley", "lambert"].contains(&kind);
        (is_known && words.next().is_none()).then_some(Self { body, kind, view })
    }

    /// The same seen without scattering.
    pub(super) fn lambert(&self) -> String {
        format!("skin_{}_lambert_{}", self.body, self.view)
    }

    /// Of our picture, which is that of every kind.
    pub(super) fn picture(&self, method: SkinDiffuse) -> String {
        format!("skin_{}_{}.{}", self.body, self.view, word(method))
    }

    /// Whether pictures by this method are compared with it.
    pub(super) fn is_for(&self, method: SkinDiffuse) -> bool {
        self.kind != "lambert" || method == SkinDiffuse::Lambert
    }

    /// How light comes through: ears and wedges have no baked thickness, and their shadow maps know it.
    fn transmission(&self) -> Transmission {
        if self.is_thin() {
            Transmission::Thick
        } else {
            Transmission::Thin
        }
    }

    /// Whether it is there for the light that comes through.
    fn is_thin(&self) -> bool {
        ["ear", "wedge"].contains(&self.body)
    }
}

/// The material of a reference.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Clay {
    albedo_linear: [f32; 3],
    #[serde(rename = "hdrpScatteringDistanceMm_d")]
    distance_mm: Option<[f32; 3]>,
}

/// A method as look files write it.
pub(super) fn word(method: SkinDiffuse) -> String {
    serde_json::to_value(method).ok().and_then(|v| Some(v.as_str()?.to_owned())).unwrap_or_default()
}

/// What is drawn of a reference: its model, all of one colour that mirrors nothing.
pub(super) fn shot(
    dir: &Path,
    of: &Reference,
    name: &Name<'_>,
    method: SkinDiffuse,
    transmission: Option<Transmission>,
) -> Result<Shot, String> {
    let clay: Clay = serde_json::from_value(of.material.clone()).map_err(|e| format!("material: {e}"))?;
    let (file, _) = of.model.split_once(".glb").ok_or_else(|| format!("model {:?}: expected a .glb", of.model))?;
    let profile = DiffusionProfile {
        scattering_distance_mm: clay.distance_mm.unwrap_or(DiffusionProfile::default().scattering_distance_mm),
        transmission: transmission.unwrap_or(name.transmission()),
        ..DiffusionProfile::default()
    };
    let numbers = Skin {
        // What does not scatter lets nothing through.
        transmission: if method == SkinDiffuse::Lambert { 0.0 } else { 1.0 },
        transmission_of_volume: name.is_thin(),
        ..Skin::default()
    };
    let [r, g, b] = clay.albedo_linear;
    let mut scene = hikage::import::load(dir.join("models").join(format!("{file}.glb"))).map_err(|e| e.to_string())?;
    for material in &mut scene.materials {
        *material = Material {
            name: std::mem::take(&mut material.name),
            base: Base { color: [r, g, b, 1.0], texture: None },
            double_sided: material.double_sided,
            skin: Some(Skin { diffuse: method, profile, specular_strength: 0.0, ..numbers }),
            cast_shadow: Some(CastShadow::default()),
            ..Material::default()
        };
    }
    scene.self_shadow = Some(if method == SkinDiffuse::PreIntegrated {
        PENUMBRA
    } else {
        SHADOW
    });
    Ok(Shot::of(of, vec![scene], SCALE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_that_show_something_else_are_left_out() {
        for name in ["skin_head_rw_yaw060", "skin_wedge_burley_back", "skin_sphere10_lambert_yaw090"] {
            assert!(Name::of(name).is_some(), "{name}");
        }
        for name in
            ["skin_head_rw_gi4_yaw060", "skin_head_rw_yaw060_seed2", "skin_head_spec_yaw000", "skin_head_albedo"]
        {
            assert!(Name::of(name).is_none(), "{name}");
        }
    }

    #[test]
    fn one_picture_serves_every_reference_of_a_view() {
        let [walk, disc] = ["skin_ear_rw_back", "skin_ear_burley_back"].map(|n| Name::of(n).expect("a scene"));
        assert_eq!(walk.picture(SkinDiffuse::PreIntegrated), "skin_ear_back.pre-integrated");
        assert_eq!(walk.picture(SkinDiffuse::Wrapped), disc.picture(SkinDiffuse::Wrapped));
        assert_eq!(disc.lambert(), "skin_ear_lambert_back");
        assert!(!Name::of("skin_ear_lambert_back").expect("a scene").is_for(SkinDiffuse::Wrapped));
    }
}
