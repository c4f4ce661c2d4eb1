//! Where nodes stand: position, rotation and scale of each, without matrices.

use glam::{Mat4, Quat, Vec3};

use super::rotation::{mul, turn, unit};
use crate::scene::Transform;

/// Where a node stands. Scales multiply by axis: exact where they are even, which VRM asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub position: Vec3,
    pub rotation: Quat,
    pub scale: Vec3,
}

impl Place {
    pub const ORIGIN: Self = Self { position: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::ONE };

    /// That of a matrix without shear; mirrored ones as if they were not.
    pub fn of(matrix: &Mat4) -> Self {
        let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
        let scale = Vec3::new(length(x), length(y), length(z)).max(Vec3::splat(1e-12));
        let (y, z) = (y / scale.y, z / scale.z);
        let x = if x.dot(y.cross(z)) < 0.0 {
            y.cross(z)
        } else {
            x / scale.x
        };
        let rotation = unit(Quat::from_mat3(&glam::Mat3::from_cols(x, y, z)));
        Self { position: matrix.w_axis.truncate(), rotation, scale }
    }

    /// A node below this one.
    pub fn below(&self, local: &Transform) -> Self {
        Self {
            position: self.point(local.translation),
            rotation: mul(self.rotation, local.rotation),
            scale: by_axis(self.scale, local.scale),
        }
    }

    /// A point of its space, outside.
    pub fn point(&self, p: Vec3) -> Vec3 {
        let turned = turn(self.rotation, by_axis(self.scale, p));
        Vec3::new(self.position.x + turned.x, self.position.y + turned.y, self.position.z + turned.z)
    }

    /// A point outside, in its space.
    pub fn inverse_point(&self, p: Vec3) -> Vec3 {
        let back = Quat::from_xyzw(-self.rotation.x, -self.rotation.y, -self.rotation.z, self.rotation.w);
        let v = turn(back, Vec3::new(p.x - self.position.x, p.y - self.position.y, p.z - self.position.z));
        Vec3::new(v.x / self.scale.x, v.y / self.scale.y, v.z / self.scale.z)
    }
}

fn length(v: Vec3) -> f32 {
    (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()
}

fn by_axis(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(a.x * b.x, a.y * b.y, a.z * b.z)
}

/// Places of all nodes, parents before children, below `root`.
pub(crate) fn place_all(parents: &[Option<usize>], locals: &[Transform], root: &Place, places: &mut Vec<Place>) {
    places.clear();
    for (parent, local) in parents.iter().zip(locals) {
        let above = parent.and_then(|p| places.get(p)).unwrap_or(root);
        let place = above.below(local);
        places.push(place);
    }
}

/// The place of one node, the character's own space.
pub(crate) fn place_of(parents: &[Option<usize>], locals: &[Transform], node: usize) -> Place {
    let mut place = Place::ORIGIN.below(&locals[node]);
    let mut above = parents[node];
    while let Some(at) = above {
        let Transform { translation, rotation, scale } = locals[at];
        let parent = Place { position: translation, rotation, scale };
        place = Place {
            position: parent.point(place.position),
            rotation: mul(rotation, place.rotation),
            scale: by_axis(scale, place.scale),
        };
        above = parents[at];
    }
    place
}

/// Places of some nodes anew, parents before children.
pub(crate) fn place_some(
    nodes: &[u32],
    parents: &[Option<usize>],
    locals: &[Transform],
    root: &Place,
    places: &mut [Place],
) {
    for &node in nodes {
        let node = node as usize;
        let above = parents[node].map_or(*root, |p| places[p]);
        places[node] = above.below(&locals[node]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_those_of_matrices() {
        let locals = [0.3f32, -1.2, 2.0].map(|a| Transform {
            translation: Vec3::new(a, 0.2, -a),
            rotation: Quat::from_rotation_x(a) * Quat::from_rotation_z(0.4),
            scale: Vec3::splat(1.0 + a * 0.1),
        });
        let root = Mat4::from_scale_rotation_translation(Vec3::splat(2.0), Quat::from_rotation_y(0.7), Vec3::X);
        let mut places = Vec::new();
        place_all(&[None, Some(0), Some(1)], &locals, &Place::of(&root), &mut places);
        let mut matrix = root;
        for (local, place) in locals.iter().zip(&places) {
            matrix *= local.matrix();
            let p = Vec3::new(0.1, 0.2, 0.3);
            assert!(place.point(p).abs_diff_eq(matrix.transform_point3(p), 1e-5));
            assert!(place.inverse_point(place.point(p)).abs_diff_eq(p, 1e-5));
            let again = Place::of(&matrix);
            assert!(again.rotation.dot(place.rotation).abs() > 1.0 - 1e-6);
            assert!(again.scale.abs_diff_eq(place.scale, 1e-5));
        }
    }
}
