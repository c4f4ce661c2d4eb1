//! Stills with smooth edges: pictures that are each moved by a share of a pixel, and their mean. Whatever is drawn with hard
//! pixels (cuts, hashed alpha, outlines, one sample a pixel) comes out as if each pixel had as many samples as there are
//! pictures.
//!
//! The mean is taken of finished pictures, in linear light and with premultiplied alpha: after the tone curve, as the mean of a
//! picture that is drawn larger by far would be. The places fill a pixel evenly, so that both come to the same.

use super::readback::{self, Sum};
use super::{Channel, Renderer, Shown, View};
use crate::scene::Image;
use crate::{Error, Result, Stage};

/// Most pictures of which a mean is taken; far beyond what 8 bits can show.
pub const MOST_ACCUMULATED: u32 = 4096;

impl Renderer {
    /// The mean of `frames` pictures of a view, each moved by another share of a pixel: edges as smooth as with so many samples
    /// a pixel, and [`hashed`](crate::material::Alpha::hashed) alpha as it covers. One frame is the picture of
    /// [`Renderer::render`], 16 are good, 64 look like 64 samples. Widths in pixels stay. FXAA is left out. With four samples a
    /// pixel a quarter of the frames does the same. The view's own jitter and frame number are taken as the first.
    ///
    /// # Errors
    /// [`Error::Argument`] for a number of frames outside 1 to [`MOST_ACCUMULATED`], for a channel whose pixels are not colours
    /// ([`Channel::Normal`], [`Channel::Depth`], [`Channel::PartId`]), and those of [`Renderer::render`].
    pub fn render_accumulated(&self, stage: &mut Stage, view: &View, frames: u32) -> Result<Image> {
        view.check()?;
        readback::check(self.output.format)?;
        if !(1..=MOST_ACCUMULATED).contains(&frames) {
            let message = format!("is {frames}; expected 1 to {MOST_ACCUMULATED}");
            return Err(Error::Argument { what: "frames to accumulate".to_owned(), message });
        }
        let shown = match view.channel {
            Channel::Final => Shown::Sample,
            Channel::Look(channel) => Shown::Channel(channel),
            other => {
                let message = format!("is {}, whose pixels have no mean; please render it as it is", other.name());
                return Err(Error::Argument { what: "channel to accumulate".to_owned(), message });
            }
        };
        self.gpu().scoped(|| {
            let reach = self.output.reach();
            let mut sum = Sum::new(self.output.format);
            for (place, frame) in places(frames).into_iter().zip(view.frame..) {
                let [x, y] = [0, 1].map(|i| (view.jitter_px[i] + place[i] * reach).clamp(-1.0, 1.0));
                let view = View { jitter_px: [x, y], frame, ..view.clone() };
                sum.add(&self.texels(stage, &view, shown)?);
            }
            Ok(sum.picture(view.size))
        })?
    }
}

/// So many places within a pixel, -0.5..0.5, that fill it evenly about its middle (Hammersley's).
fn places(count: u32) -> Vec<[f32; 2]> {
    let step = 1.0 / f64::from(count);
    let mirrored = |i: u32| f64::from(i.reverse_bits()) / 2f64.powi(32);
    let middle = (0..count).map(mirrored).sum::<f64>() * step;
    // Where the count is no power of two, the mirrored numbers end a little beside.
    let place = |i: u32| [(f64::from(i) + 0.5) * step - 0.5, (mirrored(i) - middle).clamp(-0.5, 0.5)];
    (0..count).map(|i| place(i).map(|x| x as f32)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_fill_a_pixel_about_its_middle() {
        assert_eq!(places(1), [[0.0; 2]]);
        for count in [2, 3, 16, 50, 64, MOST_ACCUMULATED] {
            let places = places(count);
            for axis in 0..2 {
                let mean = places.iter().map(|p| p[axis]).sum::<f32>() / count as f32;
                assert!(mean.abs() < 2e-3, "{count}: {mean}");
                // Each strip that is as wide as four of them has about as many.
                let strips = count / 4;
                for strip in 0..strips {
                    let at = |p: &&[f32; 2]| ((p[axis] + 0.5) * strips as f32) as u32 == strip;
                    let found = places.iter().filter(at).count();
                    assert!((2..=7).contains(&found), "{count}: {found} in strip {strip} of axis {axis}");
                }
            }
        }
    }
}
