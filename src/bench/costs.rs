//! What each look of a scene costs: frames with everything and frames without that look take turns.

use std::time::Instant;

use serde::Serialize;

use super::{Bench, BenchOptions, milliseconds, spread};
use crate::material::{Material, all};
use crate::{Gpu, Result, scene::Scene};

/// Cost of one look.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// The section of a look file that it is: `depth_rim`, `post`.
    pub look: String,
    /// Materials that have it; 0 for a section of the scene.
    pub materials: usize,
    /// Median of a frame with everything, milliseconds.
    pub with_ms: f64,
    /// Median of a frame with everything else, milliseconds.
    pub without_ms: f64,
    /// Their ratio.
    pub ratio: f64,
}

/// Takes a section off a scene; whether it was there.
type SceneOff = fn(&mut Scene) -> bool;

const SCENE_LOOKS: &[(&str, SceneOff)] = &[
    ("bangs", |s| s.bangs.take().is_some()),
    ("self_shadow", |s| s.self_shadow.take().is_some()),
    ("eyes_through", |s| s.eyes_through.take().is_some()),
    ("pupils", |s| s.pupils.take().is_some()),
    ("post", |s| s.post.take().is_some()),
];

/// Times every look that a scene has, after all of them together against the scene without looks (`plain`).
///
/// # Errors
/// Those of [`run`](super::run).
pub fn costs(gpu: &Gpu, scene: &Scene, plain: &Scene, options: &BenchOptions) -> Result<Vec<Cost>> {
    let mut with = Bench::new(gpu, scene, options)?;
    let mut list = vec![cost(gpu, options, &mut with, plain, "all", scene.materials.len())?];
    // Lines in the colours of surfaces cost more than lines do.
    let tint = ("outline tint", untint as fn(&mut Material, &str) -> bool);
    let sections = all().map(|about| (about.key, Material::remove as fn(&mut Material, &str) -> bool));
    for (look, off) in sections.chain([tint]) {
        let mut other = scene.clone();
        let materials = other.materials.iter_mut().map(|m| off(m, look)).filter(|had| *had).count();
        if materials > 0 {
            list.push(cost(gpu, options, &mut with, &other, look, materials)?);
        }
    }
    for (look, off) in SCENE_LOOKS {
        let mut other = scene.clone();
        if off(&mut other) {
            list.push(cost(gpu, options, &mut with, &other, look, 0)?);
        }
    }
    Ok(list)
}

fn untint(material: &mut Material, _: &str) -> bool {
    material.outline.as_mut().is_some_and(|o| o.tint.take().is_some())
}

fn cost(
    gpu: &Gpu,
    options: &BenchOptions,
    with: &mut Bench,
    other: &Scene,
    look: &str,
    materials: usize,
) -> Result<Cost> {
    let mut without = Bench::new(gpu, other, options)?;
    let (mut all, mut rest) = (Vec::new(), Vec::new());
    // The first ones warm up.
    for frame in 0..=options.frames {
        let start = Instant::now();
        with.frame()?;
        let middle = Instant::now();
        without.frame()?;
        if frame > 0 {
            all.push((middle - start).as_secs_f64() * 1e3);
            rest.push(milliseconds(middle));
        }
    }
    let (with_ms, without_ms) = (spread(all).median, spread(rest).median);
    Ok(Cost { look: look.to_owned(), materials, with_ms, without_ms, ratio: with_ms / without_ms.max(1e-9) })
}
