//! Readers of single arguments: each states its range in the message.

use std::path::PathBuf;

use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use hikage::color::Srgb;
use hikage::motion::Stance;
use hikage::render::MOST_ACCUMULATED;
use hikage::scene::Framing;
use hikage::{Background, Channel, Grid, Ground};

/// Longest side of a picture: the size of textures that every adapter has.
pub(crate) const MAX_SIDE: u32 = 8192;

/// `--view`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ViewName {
    /// Head and shoulders.
    Portrait,
    /// Down to the waist.
    Bust,
    /// The whole character.
    Full,
    /// The face.
    Face,
}

impl From<ViewName> for Framing {
    fn from(name: ViewName) -> Self {
        match name {
            ViewName::Portrait => Self::Portrait,
            ViewName::Bust => Self::Bust,
            ViewName::Full => Self::Full,
            ViewName::Face => Self::Face,
        }
    }
}

/// `--look`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum LookName {
    /// As the file describes the materials.
    Plain,
    /// The head of a shipped anime game.
    Anime,
    /// Lit and not drawn.
    Natural,
    /// A look file.
    File(PathBuf),
}

/// What `--look` is for, in every command that has it.
pub(crate) const LOOK_HELP: &str = "What is made of the model: plain as in the file, an anime head, natural light in a studio, or what a look file says \
                                    [default: the look that it brings, in a look file beside it (girl.look.toml beside \
                                    girl.vrm) or anime for the built-in character; else plain]";

/// `plain`, `anime` or a file.
pub(crate) fn look(text: &str) -> Result<LookName, String> {
    match text {
        "plain" => Ok(LookName::Plain),
        "anime" => Ok(LookName::Anime),
        "natural" => Ok(LookName::Natural),
        file if file.ends_with(".toml") => Ok(LookName::File(file.into())),
        _ => Err("expected plain, anime, natural or a look file (NAME.look.toml)".into()),
    }
}

/// `WxH`, pixels.
pub(crate) fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |t: &str| t.parse::<u32>().ok().filter(|s| (1..=MAX_SIDE).contains(s));
    text.split_once(['x', 'X'])
        .and_then(|(w, h)| Some([side(w)?, side(h)?]))
        .ok_or_else(|| format!("expected WIDTHxHEIGHT, each from 1 to {MAX_SIDE}, as 1024x1024"))
}

/// `--pose`.
pub(crate) fn stance(text: &str) -> Result<Stance, String> {
    Stance::from_name(text).ok_or_else(|| {
        let names: Vec<&str> = Stance::ALL.iter().map(|s| s.name()).collect();
        format!("expected one of {}", names.join(", "))
    })
}

/// `--channel`.
pub(crate) fn channel() -> impl TypedValueParser<Value = Channel> {
    let names = Channel::all().map(|(_, name, doc)| PossibleValue::new(name).help(doc));
    PossibleValuesParser::new(names).map(|name| Channel::from_name(&name).unwrap_or_default())
}

/// Samples a pixel: no other numbers are sure to exist on every adapter.
pub(crate) fn samples(text: &str) -> Result<u32, String> {
    match text {
        "1" => Ok(1),
        "4" => Ok(4),
        _ => Err("expected 1 or 4".into()),
    }
}

/// Pictures of which the mean is taken.
pub(crate) fn accumulate(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|count| (1..=MOST_ACCUMULATED).contains(count));
    count.ok_or_else(|| format!("expected a number of pictures from 1 to {MOST_ACCUMULATED}"))
}

/// `#RRGGBB`, `grid` or `shadow`.
pub(crate) fn ground(text: &str) -> Result<Ground, String> {
    Ok(match text {
        "shadow" => Ground { shadow_only: true, ..Ground::default() },
        "grid" => Ground { grid: Some(Grid::default()), ..Ground::default() },
        color => {
            let color = Srgb::from_hex(color).ok_or("expected #RRGGBB, grid or shadow")?;
            Ground { color: color.to_linear(), ..Ground::default() }
        }
    })
}

/// `none`, `environment` or `#RRGGBB`.
pub(crate) fn background(text: &str) -> Result<Background, String> {
    match text {
        "none" => Ok(Background::Transparent),
        "environment" => Ok(Background::Environment),
        color => {
            let color = Srgb::from_hex(color).map(Background::Color);
            color.ok_or_else(|| "expected none, environment or #RRGGBB".into())
        }
    }
}

/// `--environment`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum EnvironmentName {
    /// Light from above and below alone.
    None,
    /// A studio.
    Studio,
    /// A sky.
    Sky,
    /// A picture of radiance.
    File(PathBuf),
}

/// `studio`, `sky`, `none` or a file.
pub(crate) fn environment(text: &str) -> Result<EnvironmentName, String> {
    match text {
        "none" => Ok(EnvironmentName::None),
        "studio" => Ok(EnvironmentName::Studio),
        "sky" => Ok(EnvironmentName::Sky),
        file if file.to_ascii_lowercase().ends_with(".hdr") => Ok(EnvironmentName::File(file.into())),
        _ => Err("expected studio, sky, none or an equirectangular picture (NAME.hdr)".into()),
    }
}

/// Degrees from -360 to 360.
pub(crate) fn yaw(text: &str) -> Result<f32, String> {
    number(text, -360.0, 360.0)
}

/// `YAW,PITCH`, degrees.
pub(crate) fn light(text: &str) -> Result<[f32; 2], String> {
    let (yaw, pitch) = text.split_once(',').ok_or("expected YAW,PITCH in degrees, as 20,35")?;
    Ok([
        number(yaw, -360.0, 360.0).map_err(|e| format!("yaw: {e}"))?,
        number(pitch, -90.0, 90.0).map_err(|e| format!("pitch: {e}"))?,
    ])
}

/// A number from 0 to 1.
pub(crate) fn share(text: &str) -> Result<f32, String> {
    number(text, 0.0, 1.0)
}

/// `NAME=WEIGHT`; a bare name is at full weight.
pub(crate) fn expression(text: &str) -> Result<(String, f32), String> {
    let (name, weight) = text.rsplit_once('=').unwrap_or((text, "1"));
    if name.is_empty() {
        return Err("expected NAME=WEIGHT, as happy=0.8".into());
    }
    Ok((name.to_owned(), number(weight, 0.0, 1.0).map_err(|e| format!("weight: {e}"))?))
}

/// `X,Y,Z`: a point in metres, or a direction times a strength.
pub(crate) fn xyz(text: &str) -> Result<[f32; 3], String> {
    let number = |t: &str| t.trim().parse().ok().filter(|v: &f32| v.is_finite());
    let numbers: Option<Vec<f32>> = text.split(',').map(number).collect();
    let numbers = numbers.and_then(|list| list.try_into().ok());
    numbers.ok_or_else(|| format!("expected three numbers as X,Y,Z, not {text:?}"))
}

/// Seconds of the shown moment.
pub(crate) fn time(text: &str) -> Result<f32, String> {
    number(text, 0.0, 86400.0)
}

/// Seconds of patience.
pub(crate) fn timeout(text: &str) -> Result<f64, String> {
    number(text, 0.001, 86400.0).map(f64::from)
}

/// A finite number in `low..=high`.
fn number(text: &str, low: f32, high: f32) -> Result<f32, String> {
    text.trim()
        .parse::<f32>()
        .ok()
        .filter(|v| (low..=high).contains(v))
        .ok_or_else(|| format!("expected a number from {low} to {high}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_sides_in_range() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        for text in ["", "x", "4x", "x4", "0x5", "5x0", "-1x5", "99999999x1", "1x2x3", "1.5x2", "８x8"] {
            assert!(size(text).is_err(), "{text}");
        }
    }

    #[test]
    fn expressions_keep_equal_signs_in_their_name() {
        assert_eq!(expression("a=b=0.5"), Ok(("a=b".into(), 0.5)));
        assert_eq!(expression("happy"), Ok(("happy".into(), 1.0)));
        for text in ["=1", "a=", "a=nan", "a=1.1", "a=-0.1"] {
            assert!(expression(text).is_err(), "{text}");
        }
    }

    #[test]
    fn lights_are_two_angles() {
        assert_eq!(light("-20, 35"), Ok([-20.0, 35.0]));
        for text in ["", "1", "1,2,3", "inf,0", "0,91"] {
            assert!(light(text).is_err(), "{text}");
        }
    }
}
