//! The sheet of skin.

use hikage::Look;
use hikage::color::Srgb;
use hikage::material::{Base, Material, Skin, SkinDiffuse};
use hikage::scene::{Role, Scene};
use hikage::skin::Transmission;

use super::sheets::{Camera, Change, Panel, Row, Sheet};

/// What skin is made of.
#[derive(Clone, Copy)]
struct Substance {
    name: &'static str,
    skin: Skin,
    /// Albedo, linear; that of the model where `None`.
    albedo: Option<[f32; 3]>,
}

/// The sheet that may show another model.
pub(super) const NAME: &str = "skin";

/// Skin: what scattering changes, ways to find it, other profiles, light through ears, and drawn skin.
pub(super) fn sheet() -> Sheet {
    let of = |name, skin| Substance { name, skin, albedo: None };
    let by = |name, diffuse| of(name, Skin { roughness: 0.5, diffuse, ..Skin::default() });
    let lambert = by("lambert", SkinDiffuse::Lambert);
    let pre_integrated = by("pre-integrated", SkinDiffuse::PreIntegrated);
    let screen_space = by("screen-space", SkinDiffuse::ScreenSpace);
    let methods = [
        lambert,
        by("wrapped", SkinDiffuse::Wrapped),
        pre_integrated,
        screen_space,
        by("screen-space-disc", SkinDiffuse::ScreenSpaceDisc),
        by("texture-space", SkinDiffuse::TextureSpace),
    ];
    let stone = |name, skin, albedo| Substance { name, skin, albedo: Some(albedo) };
    let profiles = [
        of("skin-light", Skin::skin_light()),
        stone("skin-dark", Skin::skin_dark(), [0.16, 0.075, 0.045]),
        stone("jade", Skin::jade(), [0.25, 0.55, 0.3]),
        stone("wax", Skin::wax(), [0.85, 0.72, 0.5]),
        // Jensen et al. 2001.
        stone("milk", Skin::milk(), [0.91, 0.88, 0.76]),
        stone("marble", Skin::marble(), [0.83, 0.79, 0.75]),
    ];
    let ears = [
        ("transmission 0", Transmission::Thin, 0.0),
        ("transmission thin", Transmission::Thin, 1.0),
        ("transmission thick", Transmission::Thick, 1.0),
    ]
    .map(|(name, transmission, share)| {
        let mut ear = of(name, Skin { transmission: share, ..pre_integrated.skin });
        ear.skin.profile.transmission = transmission;
        ear
    });
    let row = |panels| Row { is_plain: true, change: side_lit, panels };
    let each = |camera, light, list: &[Substance]| list.iter().map(|s| made_of(camera, light, &[*s])).collect();
    let splits = |camera, left, right| [-65.0, 0.0, 65.0].map(|light| made_of(camera, light, &[left, right]));
    let face = Camera::Head { yaw: 0.0, height: 1.0 };
    let cheek = Camera::Head { yaw: 0.0, height: 0.5 };
    let drawn = [(0.0, 30.0), (30.0, 75.0), (-60.0, 30.0)].map(|(yaw, light)| Panel {
        caption: format!("drawn, camera {yaw:.0}\u{b0}, light {light:.0}\u{b0}"),
        camera: Camera::Head { yaw, height: 1.0 },
        light_deg: [light, 20.0],
        ..Panel::default()
    });
    Sheet {
        name: NAME,
        title: "Skin",
        caption: "Scattering skin (skin) in light from one side: off in the left half of the picture and on in the right one; every \
                  way of finding it (diffuse), whole and near; a table of curvature and a hard surface, each against spreading \
                  the light of the picture; diffusion profiles (profile), stones in their own colour; an ear from behind \
                  and from the front in back light (transmission); last toon shade with a warm band at its edge (drawn).",
        rows: vec![
            row(splits(face, lambert, screen_space).into()),
            row(each(face, 65.0, &methods)),
            row(each(cheek, 65.0, &methods)),
            row(splits(cheek, pre_integrated, screen_space)
                .into_iter()
                .chain(splits(cheek, lambert, pre_integrated))
                .collect()),
            row(each(face, 65.0, &profiles)),
            row(each(Camera::Head { yaw: 40.0, height: 1.0 }, 150.0, &profiles)),
            row([(140.0, 20.0), (40.0, 160.0)]
                .into_iter()
                .flat_map(|(yaw, light)| ears.map(|e| made_of(Camera::Ear { yaw }, light, &[e])))
                .collect()),
            Row {
                is_plain: true,
                change: |scene| skin_of(scene, |m| m.skin = Some(Skin::drawn())),
                panels: drawn.into(),
            },
        ],
    }
}

/// A panel of one substance, or of two beside each other.
fn made_of(camera: Camera, light: f32, substances: &[Substance]) -> Panel {
    let names: Vec<&str> = substances.iter().map(|s| s.name).collect();
    Panel {
        caption: format!("{}, light {light:.0}\u{b0}", names.join(" | ")),
        camera,
        light_deg: [light, 25.0],
        background: Some(Srgb([0x30, 0x34, 0x3c])),
        variants: substances.iter().map(|&s| Box::new(move |scene: &mut Scene| s.apply(scene)) as Change).collect(),
        ..Panel::default()
    }
}

/// The natural look without hair, in a strong key light and little else, where the edge of light shows.
fn side_lit(scene: &mut Scene) {
    Look::Natural.apply(scene);
    without_hair(scene);
    lit_by_key(scene);
}

pub(super) fn without_hair(scene: &mut Scene) {
    for mesh in &mut scene.meshes {
        mesh.primitives.retain(|p| !matches!(p.role, Role::Hair | Role::HairFront | Role::Accessory));
    }
}

/// Makes the key light strong and leaves little else.
pub(super) fn lit_by_key(scene: &mut Scene) {
    if let Some(lights) = &mut scene.lights {
        lights.directional.intensity = 1.2;
        lights.environment.iter_mut().for_each(|e| e.strength = 0.12);
    }
}

/// Changes what is skin.
fn skin_of(scene: &mut Scene, change: impl Fn(&mut Material)) {
    let parts = scene.meshes.iter().flat_map(|m| &m.primitives);
    for part in parts.filter(|p| matches!(p.role, Role::Face | Role::Skin)) {
        scene.materials.get_mut(part.material).into_iter().for_each(&change);
    }
}

impl Substance {
    /// Makes skin of it.
    fn apply(&self, scene: &mut Scene) {
        skin_of(scene, |m| {
            m.skin = Some(self.skin);
            if let Some([r, g, b]) = self.albedo {
                m.base = Base { color: [r, g, b, 1.0], texture: None };
            }
        });
    }
}
