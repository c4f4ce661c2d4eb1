//! The camera of a composition, by the measures of the models.

use glam::{Mat4, Quat, Vec3};
use hikage::motion::{Pose, Stance};
use hikage::scene::{Camera, Framing};
use hikage::{Actor, Stage, View};

use super::Shot;
use crate::args::ViewName;

/// Share of the picture above the head.
const ABOVE: f32 = 0.04;
/// Where the knees of a stout figure are, below the middle of its picture, share of half its height.
const KNEES: f32 = 0.72;
/// Distance between the figures of a row, and their height, as shares of the height of the tallest.
const APART: f32 = 0.85;
const ROW: f32 = 1.16;
/// Field of view of a row, degrees: narrow, so that those at its ends are not seen from the side.
const ROW_FOV: f32 = 10.0;

/// Places the figures of a row, which follow each other for each model.
pub(super) fn place(shot: &Shot, actors: &mut [Actor]) {
    if shot.row.is_empty() {
        return;
    }
    let [width, _] = room(actors);
    let middle = (actors.len() as f32 - 1.0) * 0.5;
    for (i, actor) in actors.iter_mut().enumerate() {
        let turn = Mat4::from_rotation_y(shot.row[i % shot.row.len()].to_radians());
        actor.world = Mat4::from_translation(Vec3::X * (i as f32 - middle) * width) * actor.world * turn;
    }
}

/// Width of a figure in a row, and height of the tallest.
fn room(actors: &[Actor]) -> [f32; 2] {
    let measure = |actor: &Actor, size: [u32; 2]| {
        let camera = View::framed_pose(actor.character.scene(), &actor.pose, Framing::Full, 0.0, size).camera;
        let half = (camera.fov_y_rad * 0.5).tan() * camera.eye.distance(camera.target);
        let scale = actor.world.x_axis.truncate().length();
        [2.0 * half * size[0] as f32 / size[1] as f32 * scale, 2.0 * half * scale]
    };
    // A very narrow picture shows the width alone, a very wide one the height.
    let width = actors.iter().map(|a| measure(a, [1, 1000])[0]).fold(0.0, f32::max);
    let height = actors.iter().map(|a| measure(a, [1000, 1])[1]).fold(0.0, f32::max);
    [width.min(height * APART), height]
}

/// The view of a composition; options of the command line take the place of its framing and yaw.
pub(super) fn view(shot: &Shot, stage: &Stage, view: Option<ViewName>, yaw: Option<f32>, size: [u32; 2]) -> View {
    let yaw_rad = yaw.unwrap_or(shot.yaw).to_radians();
    let people = stage.actors.iter().all(is_humanoid);
    let framing = match view {
        None if !people => Framing::Full,
        _ => view.unwrap_or(shot.view).into(),
    };
    let mut seen = View::framed_stage(stage, framing, yaw_rad, size);
    // Several must all fit, and so must what has no face.
    let is_portrait = people && stage.actors.len() == 1;
    if view.is_none() && shot.row.is_empty() && is_portrait {
        zoomed(shot, stage, &mut seen, framing, yaw_rad);
    } else if view.is_none() && !shot.row.is_empty() {
        whole_row(stage, &mut seen.camera, yaw_rad, size);
    }
    let aside = if is_portrait { shot.aside } else { 0.0 };
    tilted(&Shot { aside, ..*shot }, &mut seen.camera, size);
    seen
}

/// Whether it stands at ease when it is told to.
fn is_humanoid(actor: &Actor) -> bool {
    let scene = actor.character.scene();
    let (rest, mut pose) = (Pose::rest(scene), Pose::rest(scene));
    pose.set_stance(scene, Stance::Relaxed);
    pose != rest
}

/// Fits the height alone: arms and hats may be cut at the sides. Feet stay out of the picture, which has no ground.
fn zoomed(shot: &Shot, stage: &Stage, seen: &mut View, framing: Framing, yaw_rad: f32) {
    let half = |camera: &Camera| (camera.fov_y_rad * 0.5).tan() * camera.eye.distance(camera.target);
    let [wide, full] = [framing, Framing::Full].map(|f| View::framed_stage(stage, f, yaw_rad, [4000, 1000]).camera);
    let top = wide.target.y + half(&wide);
    let knees = full.target.y - half(&full) * KNEES;
    let half_now = (half(&wide) * shot.zoom).min((top - knees) * 0.5 / (1.0 - ABOVE));
    let target = wide.target.with_y(top + half_now * (2.0 * ABOVE - 1.0));
    seen.camera = Camera { target, eye: target + (wide.eye - wide.target) * (half_now / half(&wide)), ..wide };
}

/// Fits a row of figures, from farther away.
fn whole_row(stage: &Stage, camera: &mut Camera, yaw_rad: f32, size: [u32; 2]) {
    let [width, height] = room(&stage.actors);
    let aspect = size[0] as f32 / size[1] as f32;
    let tan = (ROW_FOV.to_radians() * 0.5).tan();
    let half = (height * ROW * 0.5).max(width * stage.actors.len() as f32 * 0.5 / aspect);
    camera.fov_y_rad = ROW_FOV.to_radians();
    camera.eye = camera.target + Quat::from_rotation_y(yaw_rad) * Vec3::Z * (half / tan);
}

/// Raises the eye, rolls the picture, and moves the character aside in it.
fn tilted(shot: &Shot, camera: &mut Camera, size: [u32; 2]) {
    let away = camera.eye - camera.target;
    let right = Vec3::Y.cross(away).normalize_or(Vec3::X);
    let away = Quat::from_axis_angle(right, -shot.pitch.to_radians()) * away;
    let wide = 2.0 * (camera.fov_y_rad * 0.5).tan() * away.length() * size[0] as f32 / size[1] as f32;
    camera.target -= right * (shot.aside * wide);
    camera.eye = camera.target + away;
    camera.up = Quat::from_axis_angle(away.normalize_or(Vec3::Z), shot.roll.to_radians()) * Vec3::Y;
}
