//! Cameras, and framings that place one in front of a character.

use glam::{Mat4, Vec3};

/// A perspective camera. The far plane is infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position, metres, world space.
    pub eye: Vec3,
    /// Point that is looked at, world space; different from `eye`.
    pub target: Vec3,
    /// Up, world space; not parallel to the view direction. Default: +Y.
    pub up: Vec3,
    /// Vertical field of view, radians. Range above 0, below π. Default: 20°.
    pub fov_y_rad: f32,
    /// Distance of the near plane, metres, above 0. Default: 0.1.
    pub near: f32,
    /// Matrices of a host that stand for all of the above: `view_from_world`, and a perspective `clip_from_view`.
    /// [`View::of_matrices`](crate::View::of_matrices) sets the other fields by them. Default: `None`.
    pub matrices: Option<[Mat4; 2]>,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            eye: Vec3::new(0.0, 1.3, 4.0),
            target: Vec3::new(0.0, 1.3, 0.0),
            up: Vec3::Y,
            fov_y_rad: 20f32.to_radians(),
            near: 0.1,
            matrices: None,
        }
    }
}

impl Camera {
    /// `view_from_world`, right-handed, looking along -Z.
    #[must_use]
    pub fn view_from_world(&self) -> Mat4 {
        let own = || glam::camera::rh::view::look_at_mat4(self.eye, self.target, self.up);
        self.matrices.map_or_else(own, |[view_from_world, _]| view_from_world)
    }

    /// `clip_from_view` with reverse Z (1 at the near plane, 0 at infinity).
    #[must_use]
    #[rustfmt::skip]
    pub fn clip_from_view(&self, aspect: f32) -> Mat4 {
        if let Some([_, mut clip_from_view]) = self.matrices {
            (clip_from_view.z_axis.z, clip_from_view.w_axis.z) = (0.0, self.near);
            return clip_from_view;
        }
        let f = 1.0 / (self.fov_y_rad * 0.5).tan();
        Mat4::from_cols_array(&[
            f / aspect, 0.0, 0.0, 0.0, //
            0.0, f, 0.0, 0.0, //
            0.0, 0.0, 0.0, -1.0, //
            0.0, 0.0, self.near, 0.0,
        ])
    }
}

/// How a perspective projection writes depth: a + b / distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DepthRange {
    pub a: f32,
    pub b: f32,
}

impl DepthRange {
    /// Of a camera.
    pub fn of(camera: &Camera) -> Self {
        let of = |[_, clip_from_view]: [Mat4; 2]| Self { a: -clip_from_view.z_axis.z, b: clip_from_view.w_axis.z };
        camera.matrices.map_or(Self { a: 0.0, b: camera.near }, of)
    }

    /// Whether it is 1 at the near plane.
    pub fn is_reversed(self) -> bool {
        self.b > 0.0
    }

    /// Distance of the near plane, metres.
    pub fn near(self) -> f32 {
        if self.is_reversed() {
            self.b / (1.0 - self.a)
        } else {
            -self.b / self.a
        }
    }
}

/// What of a character fills the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Framing {
    /// The face.
    Face,
    /// Head and shoulders.
    #[default]
    Portrait,
    /// Down to the waist.
    Bust,
    /// The whole character.
    Full,
}
