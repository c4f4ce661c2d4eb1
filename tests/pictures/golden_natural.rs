//! Pictures of natural light that were looked at: physical surfaces, hair, skin, environments.

use glam::Vec3;
use hikage::Background;
use hikage::material::{
    Base, FibreModel, Hair, HairModel, Material, Shading, Skin, SkinDiffuse, SkinSpecular, Standard, Toon,
};
use hikage::scene::{Environment, Image, Post, Scene, ToneCurve};
use hikage::skin::DiffusionProfile;

use super::golden_looks::{averaged, ball, beside, check, panel_view};
use crate::support::{Lent, Shoot, Shot, gpu, staged, with_renderer};

/// A panel for each scene, in the light of an environment.
fn row(gpu: &Lent, scenes: Vec<Scene>, change: impl Fn(&mut Shot, usize)) -> Image {
    with_renderer(gpu, |renderer| {
        let picture = |(i, mut scene): (usize, Scene)| {
            scene.post = Some(Post { tone: ToneCurve::Filmic, ..Post::default() });
            let mut shot = panel_view();
            shot.lights.environment = Some(Environment { strength: 0.75, ..Environment::studio() });
            change(&mut shot, i);
            averaged(&renderer.shoot(&mut staged(renderer.upload(&scene)), &shot).expect("a picture"))
        };
        let pictures: Vec<Image> = scenes.into_iter().enumerate().map(picture).collect();
        beside(&pictures)
    })
}

/// Gold and red plastic from smooth to rough, in the studio and under the sky.
#[test]
fn physical_surfaces() {
    let gpu = gpu();
    let surfaces = |color: [f32; 3], metallic: f32| {
        let of = |roughness: f32| {
            let [r, g, b] = color;
            ball(Material {
                base: Base { color: [r, g, b, 1.0], texture: None },
                shading: Shading::Standard(Standard { metallic, roughness, ..Standard::default() }),
                ..Material::default()
            })
        };
        [0.0, 0.25, 0.5, 0.75, 1.0].map(of).to_vec()
    };
    let gold = || surfaces([1.0, 0.77, 0.34], 1.0);
    let studio = |shot: &mut Shot, _| shot.background = Background::Environment;
    let sky = |shot: &mut Shot, _| {
        shot.lights.environment = Some(Environment { turn_rad: 0.7, ..Environment::sky() });
        shot.background = Background::Environment;
    };
    let rows = [row(&gpu, gold(), studio), row(&gpu, surfaces([0.7, 0.02, 0.03], 0.0), studio), row(&gpu, gold(), sky)];
    check("physical-surfaces", &rows);
}

/// Strands from pole to pole under light that comes round: presets of fibres, Kajiya-Kay, and from toon to lit.
#[test]
fn strands() {
    let gpu = gpu();
    let balls = |hair: Hair| {
        let material = Material {
            base: Base { color: [0.62, 0.16, 0.1, 1.0], texture: None },
            shading: Shading::Toon(Toon { shade_color: [0.3, 0.06, 0.1], ..Toon::default() }),
            hair: Some(hair),
            ..Material::default()
        };
        vec![ball(material); 5]
    };
    let sweep = |shot: &mut Shot, i: usize| {
        let (sin, cos) = [-60.0f32, -20.0, 30.0, 90.0, 150.0][i].to_radians().sin_cos();
        shot.lights.directional.to_light = Vec3::new(sin, 0.45, cos).normalize();
    };
    let kajiya_kay = Hair { model: HairModel::KajiyaKay, ..Hair::default() };
    let gaussian =
        FibreModel { detector: hikage::material::Detector::Gaussian, longitudinal: 0.15, ..Hair::blond().fibre };
    let rows: Vec<Image> = [
        Hair::black(),
        Hair::brown(),
        Hair { fibre: gaussian, ..Hair::default() },
        Hair::white(),
        Hair::dyed(),
        kajiya_kay,
        Hair { natural: 0.5, ..kajiya_kay },
        Hair::anime_silk(),
    ]
    .into_iter()
    .map(|hair| row(&gpu, balls(hair), sweep))
    .collect();
    check("strands", &rows);
}

/// Balls as if of 30 mm: ways to find scattered light while light comes round; profiles; what is mirrored.
#[test]
fn scattering() {
    let gpu = gpu();
    let of = |color: [f32; 3], skin: Skin| {
        let [r, g, b] = color;
        let profile = DiffusionProfile { world_scale: 0.03, ..skin.profile };
        ball(Material {
            base: Base { color: [r, g, b, 1.0], texture: None },
            shading: Shading::Toon(Toon { shade_color: [0.62, 0.4, 0.36], ..Toon::default() }),
            skin: Some(Skin { profile, ..skin }),
            ..Material::default()
        })
    };
    let light = |shot: &mut Shot, yaw: f32| {
        let (sin, cos) = yaw.to_radians().sin_cos();
        shot.lights.directional.to_light = Vec3::new(sin, 0.3, cos).normalize();
        shot.lights.environment = Some(Environment { strength: 0.1, ..Environment::studio() });
    };
    let skin_color = [0.83, 0.58, 0.48];
    let swept = |skin: Skin| {
        let yaws = [-60.0f32, -20.0, 60.0, 100.0, 150.0];
        row(&gpu, vec![of(skin_color, skin); 5], move |shot, i| light(shot, yaws[i]))
    };
    let side = |scenes: Vec<Scene>| row(&gpu, scenes, |shot, _| light(shot, 70.0));
    let by = |diffuse| Skin { diffuse, ..Skin::default() };
    let profiles = [
        (skin_color, Skin::skin_dark()),
        ([0.4, 0.65, 0.45], Skin::jade()),
        ([0.9, 0.8, 0.55], Skin::wax()),
        ([0.9, 0.88, 0.82], Skin::milk()),
        ([0.85, 0.84, 0.82], Skin::marble()),
    ];
    let profiles = profiles.map(|(color, skin)| of(color, Skin { diffuse: SkinDiffuse::ScreenSpace, ..skin }));
    let speculars = [SkinSpecular::BlinnPhong, SkinSpecular::Kelemen, SkinSpecular::Ggx, SkinSpecular::DualGgx];
    let speculars = speculars.map(|specular| of(skin_color, Skin { specular, ..Skin::default() }));
    let bare = of(skin_color, Skin { specular_strength: 0.0, ..Skin::default() });
    let rows = [
        swept(by(SkinDiffuse::Lambert)),
        swept(by(SkinDiffuse::Wrapped)),
        swept(by(SkinDiffuse::PreIntegrated)),
        swept(by(SkinDiffuse::ScreenSpace)),
        swept(Skin::drawn()),
        side(profiles.into()),
        side(speculars.into_iter().chain([bare]).collect()),
    ];
    check("scattering", &rows);
}
