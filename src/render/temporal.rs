//! What pictures of a window follow: a history for each number that views name ([`View::history`]).
//!
//! A picture follows the last one of its history where that was as large, its stage has been prepared once since, and the view
//! is no cut; otherwise it is drawn as it is, without jitter, and a new mean begins. So nothing is ever mixed that does not
//! belong together: other stages, pictures that were left out, two views of one number in one frame.

use glam::{Mat4, Vec3};

use super::pass::post::PostPass;
use super::pass::temporal::{Means, Step, TemporalPass};
use super::pass::velocity::VelocityTargets;
use super::uploads::Uploads;
use super::variants::Variants;
use super::{Renderer, View};
use crate::stage::past::StagePast;
use crate::{Gpu, Result};

/// Histories that are kept.
const MOST: usize = 8;
/// Pictures after which their places within a pixel come again.
const PLACES: u32 = 16;

/// What temporal antialiasing keeps.
#[derive(Debug)]
pub(super) struct Temporal {
    pass: TemporalPass,
    /// Of the last picture.
    moved: Option<VelocityTargets>,
    /// The one that was used last at the end.
    histories: Vec<History>,
}

/// Pictures that follow each other.
#[derive(Debug)]
struct History {
    number: u32,
    size: [u32; 2],
    means: [Means; 2],
    /// Which of the two is drawn next.
    next: usize,
    /// How many pictures there have been since the last cut.
    count: u32,
    /// When the stage of the last one was prepared.
    prepared: u64,
    clip_from_world: Mat4,
    eye: Vec3,
    near: f32,
    groups: Option<Groups>,
}

/// How a history is read while the one or the other mean is drawn, and what this was made of.
#[derive(Debug)]
struct Groups {
    made_of: [wgpu::TextureView; 3],
    temporal: [wgpu::BindGroup; 2],
    post: [wgpu::BindGroup; 2],
}

/// A picture on its way.
pub(super) struct Following {
    /// With jitter.
    pub view: View,
    pub step: Step,
}

impl Temporal {
    pub fn new(variants: &Variants) -> Result<Self> {
        Ok(Self { pass: TemporalPass::new(variants)?, moved: None, histories: Vec::new() })
    }

    /// What a view of a stage follows. `reach` is the share of a pixel over which it is moved.
    pub fn begin(&mut self, gpu: &Gpu, view: &View, past: &StagePast, ground_y: Option<f32>, reach: f32) -> Following {
        let known = self.histories.iter().position(|h| h.number == view.history);
        let known = known.map(|at| self.histories.remove(at)).filter(|h| h.size == view.size);
        if self.histories.len() >= MOST {
            self.histories.remove(0);
        }
        if self.moved.as_ref().is_none_or(|moved| moved.size != view.size) {
            self.moved = Some(VelocityTargets::new(gpu, view.size));
        }
        let clip_from_world = View { jitter_px: [0.0; 2], ..view.clone() }.clip_from_world();
        let mut history = known.unwrap_or_else(|| History {
            number: view.history,
            size: view.size,
            means: [Means::new(gpu, view.size), Means::new(gpu, view.size)],
            next: 0,
            count: 0,
            prepared: 0,
            clip_from_world,
            eye: view.camera.eye,
            near: view.camera.near,
            groups: None,
        });
        let follows = history.prepared == past.before && past.before != 0 && history.near == view.camera.near;
        if !follows || view.is_cut {
            history.count = 0;
        }
        let is_continued = history.count > 0;
        let place = history.count.checked_sub(1).map_or([0.0; 2], place);
        let [x, y] = [0, 1].map(|i| (view.jitter_px[i] + place[i] * reach).clamp(-1.0, 1.0));
        let step = Step {
            world_from_clip: clip_from_world.inverse(),
            clip_before: if is_continued {
                history.clip_from_world
            } else {
                clip_from_world
            },
            eye: view.camera.eye,
            near: view.camera.near,
            size: view.size,
            ground_y,
            eye_moved: history.eye.distance(view.camera.eye),
            has_others: past.has_others,
            is_continued,
        };
        let frame = view.frame.wrapping_add(history.count);
        history.count = history.count.saturating_add(1);
        // Two views that share a number in one frame would follow each other in the next one.
        history.prepared = if history.prepared == past.now { 0 } else { past.now };
        (history.clip_from_world, history.eye, history.near) = (clip_from_world, view.camera.eye, view.camera.near);
        self.histories.push(history);
        Following { view: View { jitter_px: [x, y], frame, ..view.clone() }, step }
    }

    /// Forgets a history that is not gone on with.
    pub fn forget(&mut self, number: u32) {
        self.histories.retain(|h| h.number != number);
    }

    /// What movement is drawn into.
    pub fn moved(&self) -> Option<&VelocityTargets> {
        self.moved.as_ref()
    }

    /// Draws the mean of what [`Temporal::begin`] has begun with; gives how post reads it.
    pub fn encode(
        &mut self,
        gpu: &Gpu,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        step: &Step,
        post: &PostPass,
        [picture, spread]: [&wgpu::TextureView; 2],
    ) -> Option<wgpu::BindGroup> {
        let Self { pass, moved: Some(moved), histories } = self else { return None };
        let history = histories.last_mut()?;
        let made_of = [picture, spread, &moved.velocity].map(wgpu::TextureView::clone);
        let groups = history.groups.take().filter(|groups| groups.made_of == made_of);
        let means = &history.means;
        // Without bloom the picture stands for the light that spreads.
        let spread_of = |mean: &Means| {
            if spread == picture {
                mean.color().clone()
            } else {
                spread.clone()
            }
        };
        let groups = groups.unwrap_or_else(|| Groups {
            made_of,
            temporal: [1, 0].map(|before| pass.group(gpu, picture, moved, &means[before])),
            post: [0, 1].map(|now: usize| post.group(gpu, means[now].color(), &spread_of(&means[now]))),
        });
        let next = history.next;
        pass.encode(uploads, encoder, step, &groups.temporal[next], &means[next]);
        history.next = 1 - next;
        let read = groups.post[next].clone();
        history.groups = Some(groups);
        Some(read)
    }
}

/// Place of a picture within a pixel, -0.5..0.5: the first two dimensions of Sobol's sequence, of which each run of 16 has one
/// in each of as many squares.
fn place(index: u32) -> [f32; 2] {
    let index = index % PLACES;
    let (mut second, mut bits, mut direction) = (0u32, index, 1u32 << 31);
    while bits != 0 {
        if bits & 1 == 1 {
            second ^= direction;
        }
        bits >>= 1;
        direction ^= direction >> 1;
    }
    // In the middle of their squares.
    [index.reverse_bits(), second].map(|x| (f64::from(x) / 2f64.powi(32)) as f32 + 0.5 / PLACES as f32 - 0.5)
}

impl Renderer {
    /// How far each pixel of a surface has moved in the picture that was drawn last with
    /// [`Antialias::Temporal`](crate::scene::Antialias::Temporal), pixels to the right and down since the one before and without
    /// jitter: `Rg16Float`, for passes of an application (motion blur). 0 where no surface is. `None` where there was no such
    /// picture.
    #[must_use]
    pub fn motion(&self) -> Option<wgpu::Texture> {
        super::lock(&self.frame).motion()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_come_again_and_fill_a_pixel() {
        let places: Vec<[f32; 2]> = (0..PLACES).map(place).collect();
        assert_eq!(place(PLACES), places[0]);
        for axis in 0..2 {
            assert!(places.iter().map(|p| p[axis]).sum::<f32>().abs() < 1e-6);
        }
        let squares: std::collections::HashSet<[i32; 2]> =
            places.iter().map(|p| p.map(|x| ((x + 0.5) * 4.0) as i32)).collect();
        assert_eq!(squares.len(), 16, "{places:?}");
    }
}
