//! Numbers of a view and of a character for shaders, by the structs in `wgsl/bind`.

use glam::{Mat4, Vec3, Vec4};

use super::environment::LEVELS;
use super::layout::{Block, Filled};
use super::pass::bangs_shadow::{BangsFit, BangsTile};
use super::pass::shadow::ShadowRows;
use super::{Background, View};
use crate::Stage;
use crate::color::Srgb;
use crate::scene::{DepthRange, EyesThrough, MAX_PUNCTUAL_LIGHTS, Post, PunctualLight, ToneCurve};

/// `Frame` of `wgsl/bind/frame.wgsl`.
pub(crate) fn frame_numbers() -> Filled {
    Filled::of("bind/frame", "Frame")
}

/// `Actor` of `wgsl/bind/actor.wgsl`.
pub(crate) fn actor_numbers() -> Filled {
    Filled::of("bind/actor", "Actor")
}

/// `TemporalNumbers` of `wgsl/pass/temporal.wgsl`.
pub(crate) fn temporal_numbers() -> Filled {
    Filled::of("pass/temporal", "TemporalNumbers")
}

/// `PostNumbers` of `wgsl/pass/post.wgsl`.
pub(crate) fn post_numbers() -> Filled {
    Filled::of("pass/post", "PostNumbers")
}

/// Writes the numbers of a view of a stage. `clip_before` is where the last picture of a window was seen from.
pub(crate) fn put_view(gpu: &mut Block<'_>, view: &View, stage: &Stage, clip_before: Mat4) {
    let aspect = view.size[0] as f32 / view.size[1] as f32;
    let camera = &view.camera;
    let view_from_world = camera.view_from_world();
    let lights = &stage.lights;
    let directional = &lights.directional;
    let punctual: [_; MAX_PUNCTUAL_LIGHTS] =
        std::array::from_fn(|i| lights.punctual.get(i).map_or([[0.0; 4]; 3], punctual));
    gpu.put("clip_from_world", view.clip_from_world().to_cols_array_2d());
    gpu.put("view_from_world", view_from_world.to_cols_array_2d());
    gpu.put("clip_before", clip_before.to_cols_array_2d());
    gpu.put("jitter_px", view.jitter_px);
    gpu.put("size_px", view.size.map(|s| s as f32));
    gpu.put("eye", camera.eye.to_array());
    gpu.put("time_s", stage.time_s);
    gpu.put("to_light", directional.to_light.normalize_or(Vec3::Z).to_array());
    gpu.put("aspect", aspect);
    gpu.put("light_color", directional.color.scaled(directional.intensity).0);
    gpu.put("punctual_count", lights.punctual.len().min(MAX_PUNCTUAL_LIGHTS) as u32);
    let ambient = lights.hemisphere();
    gpu.put("ambient_sky", ambient.sky.0);
    gpu.put("near", camera.near);
    gpu.put("ambient_ground", ambient.ground.0);
    gpu.put("coolness", lights.coolness());
    let DepthRange { a, b } = DepthRange::of(camera);
    gpu.put("host_depth", [a, b / camera.near]);
    gpu.put("px_per_m", view.px_per_m(stage.places()));
    gpu.put("number", view.frame);
    gpu.put("nearest_weighed", nearest_weighed(view_from_world, stage).max(camera.near));
    gpu.put("punctual", punctual);
    let environment = lights.environment.as_ref();
    let (strength, turn_rad) = environment.map_or((1.0, 0.0), |e| (e.strength, e.turn_rad));
    let irradiance = environment.map_or([[0.0; 3]; 9], |e| *e.radiance.irradiance());
    gpu.put("irradiance", irradiance.map(|[r, g, b]| [r * strength, g * strength, b * strength, 0.0]));
    gpu.put("environment_turn", [turn_rad.cos(), turn_rad.sin()]);
    gpu.put("environment_strength", strength);
    gpu.put("environment_level", (LEVELS - 1) as f32);
}

/// Distance along a view of the nearest sphere of weighted layers; far away where there is none.
fn nearest_weighed(view_from_world: Mat4, stage: &Stage) -> f32 {
    let middles =
        stage.bodies.list.iter().filter_map(|body| body.weighed().map(|sphere| body.world.transform_point3(sphere.0)));
    middles.map(|middle| -view_from_world.transform_point3(middle).z).fold(f32::MAX, f32::min)
}

/// A `PunctualLight`: three rows of a vector and a number.
fn punctual(light: &PunctualLight) -> [[f32; 4]; 3] {
    let (direction, [spot_scale, spot_offset]) =
        light.spot.map_or((Vec3::Z, [0.0, 1.0]), |spot| (spot.direction, spot.scale_and_offset()));
    let color = Vec3::from(light.color.scaled(light.intensity).0);
    [light.position.extend(light.range), color.extend(spot_scale), direction.extend(spot_offset)].map(|r| r.to_array())
}

/// Where an actor is, and how the light falls on it.
pub(crate) struct ActorState<'a> {
    /// Moves the head from its rest to the pose.
    pub head: Mat4,
    /// Middle of the head at rest, character space.
    pub head_middle: Vec3,
    pub bangs: Option<&'a BangsFit>,
    pub tile: BangsTile,
    pub through: Option<EyesThrough>,
    /// Middle and radius of the sphere that weighted layers are weighed over, character space.
    pub weighed: Option<(Vec3, f32)>,
    /// In her space.
    pub to_light: Vec3,
    pub from_world: Mat4,
    pub shadow: ShadowRows,
    /// Share of the key light that arrives.
    pub key_light: f32,
    /// First layer of the light on its skin.
    pub skin_layer: Option<u32>,
    /// Diameter of its pupils by the light, mm; and share of it, 0 where they do not follow.
    pub pupil_mm: f32,
    pub pupil_reflex: f32,
    /// What their diameter is multiplied by.
    pub pupil_scale: f32,
}

impl ActorState<'_> {
    /// What stands for the whole stage: its shadow map.
    pub fn of_stage(shadow: ShadowRows) -> Self {
        Self {
            head: Mat4::IDENTITY,
            head_middle: Vec3::ZERO,
            bangs: None,
            tile: BangsTile::default(),
            through: None,
            weighed: None,
            to_light: Vec3::Z,
            from_world: Mat4::IDENTITY,
            shadow,
            key_light: 1.0,
            skin_layer: None,
            pupil_mm: 0.0,
            pupil_reflex: 0.0,
            pupil_scale: 1.0,
        }
    }
}

/// Writes the numbers of an actor.
pub(crate) fn put_actor(gpu: &mut Block<'_>, of: &ActorState<'_>) {
    let ActorState { head, bangs, tile, through, shadow, .. } = of;
    let rows = bangs.map_or([Vec4::ZERO; 3], |b| b.rows(*head, of.to_light));
    let [hardness, bias] = bangs.map_or([0.0; 2], BangsFit::test);
    let of_world = rows.map(|row| of.from_world.transpose() * row);
    // A bone that is scaled to nothing has no rotation.
    let axis = |axis: Vec3| head.transform_vector3(axis).normalize_or(axis).to_array();
    gpu.put("face_left", axis(Vec3::X));
    gpu.put("face_up", axis(Vec3::Y));
    gpu.put("face_forward", axis(Vec3::Z));
    gpu.put("bangs_row_u", rows[0].to_array());
    gpu.put("bangs_row_v", rows[1].to_array());
    gpu.put("bangs_row_depth", rows[2].to_array());
    gpu.put("bangs_world_row_u", of_world[0].to_array());
    gpu.put("bangs_world_row_v", of_world[1].to_array());
    gpu.put("bangs_world_row_depth", of_world[2].to_array());
    gpu.put("bangs_hardness", hardness);
    gpu.put("bangs_bias", bias);
    gpu.put("bangs_origin", tile.origin);
    gpu.put("bangs_side", tile.side);
    gpu.put("bangs_layer", tile.layer);
    gpu.put("through_opacity", through.map_or(0.0, |t| t.opacity));
    gpu.put("through_window", through.map_or(0.0, |t| t.window_m));
    gpu.put("through_fade_yaw", through.map_or([0.0; 2], |t| t.fade_yaw_rad));
    gpu.put("through_fade_pitch", through.map_or([0.0; 2], |t| t.fade_pitch_rad));
    gpu.put("head", head.transform_point3(of.head_middle).to_array());
    let (middle, radius) = of.weighed.unwrap_or((Vec3::ZERO, 0.0));
    gpu.put("weigh_middle", middle.to_array());
    gpu.put("weigh_radius", radius / of.from_world.x_axis.truncate().length().max(1e-9));
    gpu.put("shadow_right", shadow.right.to_array());
    gpu.put("shadow_scale", shadow.scale);
    gpu.put("shadow_up", shadow.up.to_array());
    gpu.put("shadow_bias", shadow.bias);
    gpu.put("shadow_to_light", shadow.to_light.to_array());
    gpu.put("shadow_spread", shadow.spread);
    gpu.put("shadow_middle", shadow.middle.to_array());
    gpu.put("key_light", of.key_light);
    gpu.put("skin_layer", of.skin_layer.map_or(-1.0, |layer| layer as f32));
    gpu.put("shadow_layer", shadow.layer.map_or(-1.0, |layer| layer as f32));
    gpu.put("pupil_mm", of.pupil_mm);
    gpu.put("pupil_scale", of.pupil_scale);
    gpu.put("pupil_reflex", of.pupil_reflex);
}

/// Writes the numbers of a finished picture.
pub(crate) fn put_post(gpu: &mut Block<'_>, post: Post, background: Background) {
    let color = match background {
        // The environment is in the picture already.
        Background::Transparent | Background::Environment => [0.0; 4],
        Background::Color(srgb) => {
            let [r, g, b] = srgb.to_linear().0;
            [r, g, b, 1.0]
        }
        Background::Backdrop(_) => [0.0, 0.0, 0.0, 1.0],
    };
    let tone = match post.tone {
        ToneCurve::None => 0u32,
        ToneCurve::Filmic => 1,
        ToneCurve::Neutral => 2,
    };
    gpu.put("background", color);
    gpu.put("bloom", post.bloom.map_or(0.0, |b| b.strength));
    gpu.put("exposure", post.exposure_ev.exp2());
    gpu.put("tone", tone);
    let backdrop = match background {
        Background::Backdrop(backdrop) => Some(backdrop),
        _ => None,
    };
    let of = backdrop.unwrap_or_default();
    // Mixed as they are seen, not as light.
    let seen = |srgb: Srgb| srgb.0.map(|c| f32::from(c) / 255.0);
    gpu.put("backdrop_top", seen(of.top));
    gpu.put("backdrop_middle", seen(of.middle));
    gpu.put("backdrop_bottom", seen(of.bottom));
    gpu.put("backdrop_lit", seen(of.glow));
    gpu.put("backdrop_glow", of.glow_at);
    gpu.put("backdrop_glow_radius", of.glow_radius);
    gpu.put("backdrop_discs", seen(of.discs));
    gpu.put("backdrop_disc_count", of.disc_count.min(64));
    gpu.put("backdrop_disc_radius", of.disc_radius);
    gpu.put("backdrop_seed", of.seed);
    gpu.put("has_backdrop", u32::from(backdrop.is_some()));
}
