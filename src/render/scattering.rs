//! Light that scatters in skin, over the picture: what falls on it is drawn apart, spread, and read by its colour.

use super::clock::{Clock, Timed};
use super::draw_list::Actors;
use super::pass::irradiance::{self, IrradianceInputs, IrradianceTargets, SKIN_LIGHT_FORMAT};
use super::pass::scatter::{ScatterGroups, ScatterPass, ScatterTaps, ScatterTargets};
use super::pass::{HDR_FORMAT, Sight};
use super::uploads::Uploads;
use super::{Renderer, View, targets};
use crate::Result;

/// What it is drawn with and into.
#[derive(Debug)]
pub(super) struct Scattering {
    irradiance: IrradianceTargets,
    pass: ScatterPass,
    groups: ScatterGroups,
    across: wgpu::TextureView,
    /// What skin reads.
    pub scattered: wgpu::TextureView,
}

impl Scattering {
    /// Makes it where there is none of this size.
    pub fn fit(made: &mut Option<Self>, r: &Renderer, size: [u32; 2]) -> Result<()> {
        if made.as_ref().is_some_and(|s| s.irradiance.size == size) {
            return Ok(());
        }
        let pass = match made.take() {
            Some(known) => known.pass,
            None => ScatterPass::new(&r.variants)?,
        };
        let irradiance = IrradianceTargets::new(r.gpu(), size);
        let across = targets::sampled(r.gpu(), "scattered across", size, SKIN_LIGHT_FORMAT);
        let scattered = targets::sampled(r.gpu(), "scattered", size, HDR_FORMAT);
        *made = Some(Self { groups: pass.groups(r.gpu(), &irradiance, &across), irradiance, pass, across, scattered });
        Ok(())
    }

    /// Draws the light that falls on skin, and spreads it.
    pub fn encode(
        &self,
        r: &Renderer,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        actors: Actors<'_>,
        (view, sight): (&View, Sight<'_>),
        clock: &Clock,
    ) -> Result<()> {
        let troupes = &actors.bodies.troupes;
        let all = troupes.iter().map(|t| t.data().irradiances(&r.variants, sight)).collect::<Result<Vec<_>>>()?;
        let drawn = &|troupe: usize, draw: usize| all[troupe][draw].as_ref();
        let taps = ScatterTaps::most(troupes.iter().map(|t| t.data().scatter));
        let inputs = IrradianceInputs { actors, targets: &self.irradiance, drawn };
        irradiance::encode(encoder, &inputs, clock.render(Timed::Irradiance));
        let into = ScatterTargets { depth: &self.irradiance.depth, across: &self.across, scattered: &self.scattered };
        self.pass.encode(uploads, encoder, &self.groups, (view, taps), &into, clock);
        Ok(())
    }
}
