//! The edges of a face in its texture, as an overlay for whoever paints masks.

use std::collections::BTreeSet;

use tiny_skia::{Paint, PathBuilder, Pixmap, Stroke, Transform};

use crate::scene::{Image, Role, Scene};

/// The edges of a material's face in its texture coordinates, as thin lines over nothing: an overlay for whoever paints
/// masks. `None` where the material has no face with texture coordinates. Sides at most 8192 texels.
#[must_use]
pub fn wireframe(scene: &Scene, material: usize, size: [u32; 2]) -> Option<Image> {
    let [width, height] = size.map(|side| side.clamp(1, 8192));
    let mut edges = BTreeSet::new();
    let parts =
        scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.material == material && p.role == Role::Face);
    for part in parts {
        let point = |i: u32| {
            let uv = part.uvs[0].get(i as usize)?;
            let near = uv.iter().all(|c| (-4.0..=4.0).contains(c));
            near.then(|| [(uv[0] * width as f32 * 8.0) as i32, (uv[1] * height as f32 * 8.0) as i32])
        };
        for t in part.indices.chunks_exact(3) {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                if let (Some(a), Some(b)) = (point(a), point(b)) {
                    edges.insert(if a < b { (a, b) } else { (b, a) });
                }
            }
        }
    }
    let mut path = PathBuilder::new();
    for ([ax, ay], [bx, by]) in edges {
        path.move_to(ax as f32 / 8.0, ay as f32 / 8.0);
        path.line_to(bx as f32 / 8.0, by as f32 / 8.0);
    }
    let (path, mut pixmap) = (path.finish()?, Pixmap::new(width, height)?);
    let mut paint = Paint::default();
    paint.set_color_rgba8(40, 110, 200, 200);
    paint.anti_alias = true;
    pixmap.stroke_path(&path, &paint, &Stroke { width: 1.0, ..Stroke::default() }, Transform::identity(), None);
    let pixels = pixmap.pixels().iter().flat_map(|p| {
        let p = p.demultiply();
        [p.red(), p.green(), p.blue(), p.alpha()]
    });
    Some(Image { width, height, pixels: pixels.collect(), format: "png", source_bits: 8, ..Image::default() })
}
