//! A view that is drawn, and what is shown of it.

use super::pass::floor::FloorPass;
use super::pass::{Picture, Sight};
use super::{Background, Output, Renderer, Target, View};
use crate::Stage;
use crate::scene::{Antialias, Post, ToneCurve};

/// What a frame shows.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shown<'a> {
    /// The finished picture, one of those that follow each other in a window.
    Picture,
    /// The finished picture by itself.
    Still,
    /// One of many finished pictures of which the mean is taken.
    Sample,
    /// A debug channel of shading.
    Channel(&'a str),
    /// The floor of benches.
    Floor(&'a FloorPass),
}

/// A view that is drawn.
pub(super) struct Take<'a> {
    pub view: &'a View,
    pub target: &'a Target<'a>,
    pub shown: Shown<'a>,
    /// How it is finished, where it is drawn apart for that.
    pub post: Option<Post>,
    pub picture: Picture<'a>,
}

impl<'a> Take<'a> {
    pub fn new(r: &Renderer, stage: &Stage, view: &'a View, target: &'a Target<'a>, shown: Shown<'a>) -> Self {
        let post = shown.post(stage, view, target, r.output);
        let picture = Picture::new(r.gpu(), r.output, shown.sight(stage, post));
        Self { view, target, shown, post, picture }
    }
}

impl<'a> Shown<'a> {
    /// What its shaders are made for.
    fn sight(self, stage: &Stage, post: Option<Post>) -> Sight<'a> {
        let channel = match self {
            Self::Channel(channel) => Some(channel),
            _ => None,
        };
        let lights = &stage.lights;
        let (punctual, environment) = (!lights.punctual.is_empty(), lights.environment.is_some());
        Sight { channel, punctual, environment, hdr: post.is_some() }
    }

    /// What is done to the whole of it: what is laid over something, a backdrop too, goes the same way.
    fn post(self, stage: &Stage, view: &View, target: &Target<'_>, output: Output) -> Option<Post> {
        let post = stage.post.filter(|_| self.is_finished());
        let post = post.map(|p| Post { antialias: self.antialias(p.antialias), ..p });
        let plain = Post { bloom: None, exposure_ev: 0.0, tone: ToneCurve::None, antialias: Antialias::None };
        let is_painted = self.is_finished() && matches!(view.background, Background::Backdrop(_));
        post.or_else(|| (is_painted || target.is_laid_over(output)).then_some(plain))
    }

    /// Whether it is a picture as a whole.
    pub fn is_finished(self) -> bool {
        matches!(self, Self::Picture | Self::Still | Self::Sample)
    }

    /// How edges are smoothed, where the stage asks for this.
    fn antialias(self, asked: Antialias) -> Antialias {
        match (self, asked) {
            // What is by itself follows nothing.
            (Self::Sample, _) | (Self::Still, Antialias::Temporal) => Antialias::None,
            _ => asked,
        }
    }
}
