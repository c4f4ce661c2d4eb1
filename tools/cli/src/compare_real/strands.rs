//! Strands as ribbons that face a camera.

use std::fs::File;
use std::path::Path;

use glam::{DVec3, Vec3};
use hikage::scene::Primitive;
use npyz::NpyFile;
use zip::ZipArchive;

/// Polylines with the root first, metres.
pub(super) struct Strands {
    pub(super) lines: Vec<Vec<Vec3>>,
    pub(super) radius: f32,
}

impl Strands {
    /// Reads a set: points as 16-bit numbers, the first of each strand whole, the second differences of the rest.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let fail = |what: &dyn std::fmt::Display| format!("{}: {what}", path.display());
        let mut archive = ZipArchive::new(File::open(path).map_err(|e| fail(&e))?).map_err(|e| fail(&e))?;
        let steps: Vec<u16> = array(&mut archive, "dq").map_err(|e| fail(&e))?;
        let low: Vec<f64> = array(&mut archive, "lo").map_err(|e| fail(&e))?;
        let high: Vec<f64> = array(&mut archive, "hi").map_err(|e| fail(&e))?;
        let offsets: Vec<i32> = array(&mut archive, "offsets").map_err(|e| fail(&e))?;
        let radius: Vec<f32> = array(&mut archive, "radius").map_err(|e| fail(&e))?;
        let (&[lx, ly, lz], &[hx, hy, hz], &[radius]) = (&low[..], &high[..], &radius[..]) else {
            return Err(fail(&"expected three numbers in lo and hi and one in radius"));
        };
        let (low, size) = (DVec3::new(lx, ly, lz), DVec3::new(hx - lx, hy - ly, hz - lz));
        let steps = steps.as_chunks::<3>().0;
        let mut lines = Vec::with_capacity(offsets.len());
        for pair in offsets.windows(2) {
            let range = usize::try_from(pair[0]).ok().zip(usize::try_from(pair[1]).ok()).map(|(a, b)| a..b);
            let of_line = range.and_then(|r| steps.get(r)).ok_or_else(|| fail(&"offsets lead out of dq"))?;
            let (mut place, mut step) = ([0u16; 3], [0u16; 3]);
            let mut line = Vec::with_capacity(of_line.len());
            for (i, by) in of_line.iter().enumerate() {
                for axis in 0..3 {
                    if i == 0 {
                        place[axis] = by[axis];
                    } else {
                        step[axis] = step[axis].wrapping_add(by[axis]);
                        place[axis] = place[axis].wrapping_add(step[axis]);
                    }
                }
                let share = DVec3::from(place.map(f64::from)) / 65535.0;
                line.push((low + share * size).as_vec3());
            }
            lines.push(line);
        }
        Ok(Self { lines, radius })
    }

    /// Ribbons as wide as the strands, which face `eye`.
    pub(super) fn ribbons(&self, eye: Vec3) -> Primitive {
        let mut made = Primitive::default();
        for line in self.lines.iter().filter(|line| line.len() > 1) {
            let first = made.positions.len() as u32;
            for (i, at) in line.iter().enumerate() {
                let along = (line[(i + 1).min(line.len() - 1)] - line[i.saturating_sub(1)]).normalize_or(Vec3::Y);
                let view = (eye - *at).normalize_or(Vec3::Z);
                let across = along.cross(view).normalize_or(Vec3::X);
                let normal = across.cross(along).normalize_or(view);
                for side in [-1.0, 1.0] {
                    made.positions.push((*at + across * (side * self.radius)).to_array());
                    made.normals.push(normal.to_array());
                    made.strands.push(along.to_array());
                }
            }
            for i in 0..line.len() as u32 - 1 {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| first + 2 * i + k);
                made.indices.extend([a, b, c, b, d, c]);
            }
        }
        made
    }
}

/// An array of a set of them.
pub(super) fn array<T: npyz::Deserialize>(archive: &mut ZipArchive<File>, name: &str) -> Result<Vec<T>, String> {
    let found = archive.by_name(&format!("{name}.npy")).map_err(|e| format!("{name}: {e}"))?;
    NpyFile::new(found).and_then(NpyFile::into_vec).map_err(|e| format!("{name}: {e}"))
}
