//! Light that scatters in skin, over the picture: what falls on it is drawn apart, spread, and read by its colour.

use super::draw_list::Actors;
use super::pass::irradiance::{self, IrradianceInputs, IrradianceTargets};
use super::pass::scatter::ScatterPass;
use super::pass::{HDR_FORMAT, Sight};
use super::uploads::Uploads;
use super::{Renderer, View, targets};
use crate::Result;

/// What it is drawn with and into.
#[derive(Debug)]
pub(super) struct Scattering {
    irradiance: IrradianceTargets,
    pass: ScatterPass,
    group: wgpu::BindGroup,
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
        let scattered = targets::sampled(r.gpu(), "scattered", size, HDR_FORMAT);
        *made = Some(Self { group: pass.group(r.gpu(), &irradiance), irradiance, pass, scattered });
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
    ) -> Result<()> {
        let troupes = &actors.bodies.troupes;
        let all = troupes.iter().map(|t| t.data().irradiances(&r.variants, sight)).collect::<Result<Vec<_>>>()?;
        let drawn = &|troupe: usize, draw: usize| all[troupe][draw].as_ref();
        let taps = troupes.iter().map(|t| t.data().scatter_taps).max().unwrap_or(0);
        irradiance::encode(encoder, &IrradianceInputs { actors, targets: &self.irradiance, drawn });
        self.pass.encode(uploads, encoder, &self.group, (view, taps), &self.scattered);
        Ok(())
    }
}
