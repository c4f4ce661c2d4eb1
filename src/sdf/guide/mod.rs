//! Threshold maps from a face's own mesh: a drawn border on any character, without painting.
//!
//! The face is read as a relief round an upright axis. Smoothed until it has no features it gives the calm line over cheek and
//! forehead; what stands out from that bends the line, so that it runs round nose, lips and chin. [`Landmarks`] say where the
//! shade of the nose, the light under the far eye and the crease of the mouth belong. One number a place holds it all, so that
//! what has turned dark stays dark while the light goes on.

mod contrast;
mod landmarks;
mod raster;
mod relief;
mod thresholds;
mod wireframe;

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use contrast::{Contrast, Feature, KEPT};
pub use landmarks::Landmarks;
pub use wireframe::wireframe;

use super::{FaceMap, Texels};
use crate::scene::{Role, Scene};
use crate::smoothstep::smoothstep;
use raster::{Corner, Raster};
use relief::{REACH, Relief, faces};
use thresholds::Thresholds;

/// Side of a map over the face's texture, texels.
const SIDE: usize = 512;
/// Texels that a map over the face's texture is grown beyond the triangles: over the holes of eyes and mouth, and so far that
/// the end bends no distance on the face.
const GROWN: usize = 40;

/// How the features of a face are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FaceStyle {
    /// A small shade beside the tip of the nose.
    #[default]
    Soft,
    /// A wedge along the nose, as on cels.
    Classic,
    /// No shade of the nose; a mark under its tip where the file paints none.
    Minimal,
}

/// The shadow of a face, made from its mesh.
pub struct Guide {
    relief: Relief,
    landmarks: Option<Landmarks>,
    thresholds: Thresholds,
}

impl Guide {
    /// Of the parts of a material that are a face under the head bone. `None` where there is no such part.
    #[must_use]
    pub fn new(scene: &Scene, material: usize, style: FaceStyle) -> Option<Self> {
        let relief = Relief::new(scene, material)?;
        let landmarks = Landmarks::find(scene, &relief);
        let thresholds = Thresholds::new(&relief, landmarks.as_ref(), style);
        Some(Self { relief, landmarks, thresholds })
    }

    /// What was found of the face; `None` where it has no eyes to start from.
    #[must_use]
    pub fn landmarks(&self) -> Option<&Landmarks> {
        self.landmarks.as_ref()
    }

    /// The map over the face's texture, in the layout of [`FaceShadow`](crate::material::FaceShadow). What does not follow the
    /// head bone, or looks backwards, is left to normal shading. `None` where the face has no texture coordinates, or where both
    /// sides of it share them: one texel cannot hold the angles of two.
    #[must_use]
    pub fn over_texture(&self, scene: &Scene, material: usize) -> Option<FaceMap> {
        let mut raster = Raster::new(SIDE);
        // Where other parts of the material lie, as neck and chest, their own normals shade them.
        let others = scene.meshes.iter().flat_map(|m| &m.primitives);
        for part in others.filter(|p| p.material == material && p.role != Role::Face) {
            let corner = |i: u32| {
                let uv = part.uvs.first()?.get(i as usize)?;
                Some(Corner { uv: Vec2::from(*uv), value: [0.5, 0.5, 0.0] })
            };
            for t in part.indices.chunks_exact(3) {
                if let (Some(a), Some(b), Some(c)) = (corner(t[0]), corner(t[1]), corner(t[2])) {
                    raster.triangle([a, b, c], |_, _| true)?;
                }
            }
        }
        let of_others = raster.texels.iter().flatten().count();
        let mut shared = 0usize;
        for (primitive, matrix, shares) in faces(scene, material)? {
            let uvs = primitive.uvs.first().filter(|set| !set.is_empty())?;
            let corner = |v: usize| {
                let position = matrix.transform_point3(Vec3::from(primitive.positions[v]));
                let (place, _) = self.relief.place(position);
                let uv = uvs.get(v).copied().unwrap_or_default();
                Corner { uv: Vec2::from(uv), value: [place.x, place.y, shares[v]] }
            };
            let corners: Vec<Corner<3>> = (0..primitive.positions.len()).map(corner).collect();
            for t in primitive.indices.chunks_exact(3) {
                let corner = |i: usize| corners.get(t[i] as usize).copied();
                if let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) {
                    let is_front = |v: &[f32; 3]| (v[0] - 0.5).abs() < 0.35 && v[2] > 0.9;
                    raster.triangle([a, b, c], |old, new| {
                        shared += usize::from((old[0] - new[0]).abs() > 0.12 && is_front(old) && is_front(new));
                        true
                    })?;
                }
            }
        }
        if shared * 20 > raster.texels.iter().flatten().count() - of_others {
            return None;
        }
        raster.grow(GROWN);
        let texel = |texel: &Option<[f32; 3]>| {
            let Some([x, y, share]) = texel else { return [0, 0, u16::MAX, u16::MAX] };
            let [right, left, normal] = self.thresholds.at(Vec2::new(*x, *y));
            let below = smoothstep(0.98, 0.75, *share);
            [code(right), code(left), code(normal.max(below)), u16::MAX]
        };
        let rgba = raster.texels.par_iter().map(texel).collect();
        Some(FaceMap::single("from the mesh", texels(SIDE, rgba)))
    }

    /// The map over the relief, which is laid over the second set of texture coordinates ([`Guide::unwrap`]): whatever the face's
    /// own texture shares or mirrors.
    #[must_use]
    pub fn over_relief(&self) -> FaceMap {
        let texel = |[right, left, normal]: [f32; 3]| [code(right), code(left), code(normal), u16::MAX];
        let cells = (0..relief::SIDE * relief::SIDE).into_par_iter();
        let rgba = cells.map(|cell| texel(self.thresholds.of_cell(cell))).collect();
        FaceMap { uv_set: 1, ..FaceMap::single("from the mesh", texels(relief::SIDE, rgba)) }
    }

    /// Texture coordinates on the relief of a point of the world at rest. Behind the head they leave the picture at its upper
    /// edge, so that no seam runs down the back.
    #[must_use]
    pub fn unwrap(&self, position: Vec3) -> [f32; 2] {
        let (place, _) = self.relief.place(position);
        let angle = (place.x - 0.5).abs() * 2.0 * REACH;
        let back = ((angle - 0.85 * REACH) / 0.6).max(0.0);
        // Folded at the edge, where all is left to normals.
        [place.x.clamp(0.0, 1.0), place.y - 2.0 * back]
    }
}

fn code(x: f32) -> u16 {
    (x.clamp(0.0, 1.0) * 65535.0).round() as u16
}

fn texels(side: usize, rgba: Vec<[u16; 4]>) -> Texels {
    Texels { width: side as u32, height: side as u32, rgba, is_8_bit: true }
}
