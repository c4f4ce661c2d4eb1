//! Vertices and what deforms them, as the shaders' buffers hold them: whole lists, which no name could reach one by one.
//! A test compares the structs with those of `wgsl/pass/deform.wgsl`.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3};

/// `DeformVertex` of `wgsl/bind/actor.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct DeformVertex {
    pub position: [f32; 3],
    pub normal: u32,
    pub tangent: u32,
    pub outline_normal: u32,
}

/// `DeformGroup` of `wgsl/pass/deform.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct DeformGroup {
    pub first_vertex: u32,
    pub first_influence: u32,
    pub influences_per_vertex: u32,
    pub first_joint: u32,
    pub first_weight: u32,
}

/// `MorphEntry` of `wgsl/pass/deform.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct MorphEntry {
    pub target_index: u32,
    pub position: [f32; 3],
    pub normal: [f32; 3],
}

/// Rows of an affine matrix: `Joint` of `wgsl/pass/deform.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct AffineRows {
    pub row_x: [f32; 4],
    pub row_y: [f32; 4],
    pub row_z: [f32; 4],
}

impl From<Mat4> for AffineRows {
    fn from(m: Mat4) -> Self {
        let rows = m.transpose();
        Self { row_x: rows.x_axis.to_array(), row_y: rows.y_axis.to_array(), row_z: rows.z_axis.to_array() }
    }
}

impl AffineRows {
    /// A point that it moves.
    pub fn transform_point(&self, p: Vec3) -> Vec3 {
        let at = |row: &[f32; 4]| row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
        Vec3::new(at(&self.row_x), at(&self.row_y), at(&self.row_z))
    }

    /// How far it stretches lengths at most.
    pub fn scale(&self) -> f32 {
        let column = |i: usize| self.row_x[i].powi(2) + self.row_y[i].powi(2) + self.row_z[i].powi(2);
        column(0).max(column(1)).max(column(2)).sqrt()
    }
}

/// First stream of every draw: what does not move.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct StaticVertex {
    pub uv: [f32; 4],
    pub color: [u8; 4],
    pub part: u32,
    /// Of skin: curvature, 1/m, thickness, m, and occlusion, 0 to 1, as half floats, character space; the last is 0. Of an eye: its
    /// place there over 2 as snorm16, and the vertex that is the eye.
    pub shape: [u16; 4],
}

/// Second stream of every draw: what an instance stands for, as `wgsl/bind/vertex.wgsl` reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Instance {
    /// `world_from_character`.
    pub world: AffineRows,
    pub actor: u32,
    /// Its first vertex among those of all actors.
    pub first_vertex: u32,
    /// By the pass: the shell of a coat, or the actor whose map is drawn.
    pub extra: u32,
}

/// Octahedral snorm16 pair of a unit vector; the CPU side of `wgsl/lib/normal.wgsl`.
pub fn pack_unit(v: [f32; 3]) -> u32 {
    let n = Vec3::from(v).normalize_or(Vec3::Z);
    let p = n / (n.x.abs() + n.y.abs() + n.z.abs());
    let sign = |x: f32| if x >= 0.0 { 1.0 } else { -1.0 };
    let (x, y) = if p.z < 0.0 {
        ((1.0 - p.y.abs()) * sign(p.x), (1.0 - p.x.abs()) * sign(p.y))
    } else {
        (p.x, p.y)
    };
    let quantize = |x: f32| u32::from((x.clamp(-1.0, 1.0) * 32767.0).round() as i16 as u16);
    quantize(x) | quantize(y) << 16
}

/// Inverse of [`pack_unit`].
pub(crate) fn unpack_unit(packed: u32) -> Vec3 {
    let [x, y] = [packed as u16, (packed >> 16) as u16].map(|c| f32::from(c as i16) / 32767.0);
    let z = 1.0 - x.abs() - y.abs();
    let t = (-z).max(0.0);
    let towards = |c: f32| if c >= 0.0 { c - t } else { c + t };
    Vec3::new(towards(x), towards(y), z).normalize_or(Vec3::Z)
}

#[cfg(test)]
mod tests {
    use std::mem::offset_of;

    use super::*;
    use crate::render::layout::Layout;
    use crate::render::shaders::file;

    #[test]
    fn structs_match_their_wgsl() {
        let text = [file("bind/actor"), file("pass/deform")].concat();
        let check = |name: &str, size: usize, members: &[(&str, usize)]| {
            let layout = Layout::of(&text, name);
            assert_eq!(layout.size, size, "size of {name}");
            for (member, offset) in members {
                assert_eq!(layout.offset(member), Some(*offset), "{name}.{member}");
            }
        };
        check(
            "DeformGroup",
            size_of::<DeformGroup>(),
            &[
                ("first_vertex", offset_of!(DeformGroup, first_vertex)),
                ("first_influence", offset_of!(DeformGroup, first_influence)),
                ("influences_per_vertex", offset_of!(DeformGroup, influences_per_vertex)),
                ("first_joint", offset_of!(DeformGroup, first_joint)),
                ("first_weight", offset_of!(DeformGroup, first_weight)),
            ],
        );
        check(
            "Joint",
            size_of::<AffineRows>(),
            &[
                ("row_x", offset_of!(AffineRows, row_x)),
                ("row_y", offset_of!(AffineRows, row_y)),
                ("row_z", offset_of!(AffineRows, row_z)),
            ],
        );
        // Vectors of the CPU are single numbers in these, because WGSL would align them to 16 bytes.
        check(
            "DeformVertex",
            size_of::<DeformVertex>(),
            &[
                ("x", offset_of!(DeformVertex, position)),
                ("normal", offset_of!(DeformVertex, normal)),
                ("tangent", offset_of!(DeformVertex, tangent)),
                ("outline_normal", offset_of!(DeformVertex, outline_normal)),
            ],
        );
        check(
            "MorphEntry",
            size_of::<MorphEntry>(),
            &[
                ("target_index", offset_of!(MorphEntry, target_index)),
                ("dx", offset_of!(MorphEntry, position)),
                ("nx", offset_of!(MorphEntry, normal)),
            ],
        );
    }
}
