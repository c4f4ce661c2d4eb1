//! Where keys come from: a project's file or single drawings, and what arguments change of it.

use std::path::{Path, PathBuf};

use hikage::sdf::{Blend, CapFront, DrawnKey, Layout, MaskChannel, Profile, Project, ProjectKey};

use crate::failure::Failure;

/// Keys.
#[derive(clap::Args)]
pub(super) struct Input {
    /// Project (face.sdf.toml).
    #[arg(required_unless_present = "keys", conflicts_with = "keys")]
    pub(super) project: Option<PathBuf>,
    /// A key drawing, PNG or WebP, white where the face is lit; once for each angle in degrees.
    #[arg(long = "key", id = "keys", value_name = "ANGLE=FILE", value_parser = key)]
    keys: Vec<(f32, PathBuf)>,
    /// What of the drawings says how much is lit.
    #[arg(long, value_name = "luma|alpha", value_parser = channel, requires = "keys")]
    channel: Option<MaskChannel>,
    /// Value from which on a texel is lit [default: 0.5].
    #[arg(long, value_name = "0..1", requires = "keys")]
    threshold: Option<f32>,
    /// Bits of a value [default: 16].
    #[arg(long, value_name = "8|16", value_parser = bits)]
    pub(super) bits: Option<u8>,
    /// Spread the rounding of 8 bits over a pattern, so that no steps show.
    #[arg(long)]
    dither: bool,
    /// Channels: liltoon, single, or four of left, right, a number and a grey picture, as left,right,area.png,1
    /// [default: liltoon].
    #[arg(long, value_name = "LAYOUT")]
    layout: Option<Layout>,
    /// What the shader compares with: linear (angle / 180), genshin ((1 - cos) / 2), liltoon (60 to 120 degrees), or points
    /// as 0:0,90:1 [default: linear].
    #[arg(long, value_name = "PROFILE", value_parser = profile)]
    profile: Option<Profile>,
    /// How the border runs between two drawings: at an even pace, or without a change of pace at a key [default: linear].
    #[arg(long, value_name = "linear|smooth", value_parser = blend)]
    blend: Option<Blend>,
    /// Light from the right is the mirror image.
    #[arg(long)]
    mirror: bool,
    /// Before a first key at another angle than 0: everything lit, or nothing more than there [default: lit].
    #[arg(long, value_name = "lit|none", value_parser = cap_front)]
    cap_front: Option<CapFront>,
}

impl Input {
    pub(super) fn project(&self) -> Result<Project, Failure> {
        let mut project = match &self.project {
            Some(path) => Project::read(path)?,
            None => Project {
                mirror: false,
                keys: self.keys.iter().map(|(angle, file)| ProjectKey::Drawn(self.drawn(*angle, file))).collect(),
                ..Project::default()
            },
        };
        project.mirror |= self.mirror;
        project.dither |= self.dither;
        project.bits = self.bits.unwrap_or(project.bits);
        project.layout = self.layout.clone().unwrap_or(project.layout);
        project.profile = self.profile.clone().unwrap_or(project.profile);
        project.blend = self.blend.unwrap_or(project.blend);
        project.cap_front = self.cap_front.unwrap_or(project.cap_front);
        project.check()?;
        Ok(project)
    }

    fn drawn(&self, angle: f32, file: &Path) -> DrawnKey {
        let (channel, threshold) = (self.channel.unwrap_or_default(), self.threshold.unwrap_or(0.5));
        DrawnKey { angle, file: file.to_owned(), channel, threshold }
    }
}

fn key(text: &str) -> Result<(f32, PathBuf), String> {
    let (angle, file) = text.split_once('=').ok_or("expected ANGLE=FILE, as 22.5=b.png")?;
    let angle = angle.trim().parse().ok().filter(|a| (-180.0..=180.0).contains(a));
    Ok((angle.ok_or("expected an angle from -180 to 180 degrees before =")?, file.into()))
}

fn channel(text: &str) -> Result<MaskChannel, String> {
    match text {
        "luma" => Ok(MaskChannel::Luma),
        "alpha" => Ok(MaskChannel::Alpha),
        _ => Err("expected luma or alpha".into()),
    }
}

fn blend(text: &str) -> Result<Blend, String> {
    match text {
        "linear" => Ok(Blend::Linear),
        "smooth" => Ok(Blend::Smooth),
        _ => Err("expected linear or smooth".into()),
    }
}

fn cap_front(text: &str) -> Result<CapFront, String> {
    match text {
        "lit" => Ok(CapFront::Lit),
        "none" => Ok(CapFront::None),
        _ => Err("expected lit or none".into()),
    }
}

pub(super) fn bits(text: &str) -> Result<u8, String> {
    match text {
        "8" => Ok(8),
        "16" => Ok(16),
        _ => Err("expected 8 or 16".into()),
    }
}

pub(super) fn profile(text: &str) -> Result<Profile, String> {
    let expected = "expected linear, genshin, liltoon or points ANGLE:VALUE with commas between, as 0:0,90:1";
    let point = |point: &str| {
        let (angle, value) = point.split_once(':')?;
        Some([angle.trim().parse().ok()?, value.trim().parse().ok()?])
    };
    let profile = match text {
        "linear" => Profile::Linear,
        "genshin" => Profile::Genshin,
        "liltoon" => Profile::Liltoon,
        _ => Profile::Points(text.split(',').map(point).collect::<Option<_>>().ok_or(expected)?),
    };
    profile.check().map_err(|e| e.to_string())?;
    Ok(profile)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_profiles_are_read_and_faults_named() {
        assert_eq!(key("22.5=a=b.png"), Ok((22.5, "a=b.png".into())));
        for text in ["a.png", "=a.png", "nan=a.png", "181=a.png"] {
            assert!(key(text).unwrap_err().contains("expected"), "{text}");
        }
        assert_eq!(profile("0:0,90:1"), Ok(Profile::Points(vec![[0.0, 0.0], [90.0, 1.0]])));
        for text in ["", "cos", "0:0", "0:0,x:1", "0:0,0:1"] {
            assert!(profile(text).unwrap_err().contains("expected"), "{text}");
        }
    }
}
