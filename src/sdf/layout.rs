//! Which channel of a map's picture holds what, in both directions, and its file: a PNG that is always tagged linear.

use std::path::PathBuf;

use png::{BitDepth, ColorType, Compression, Filter, ScaledFloat};
use serde::{Deserialize, Serialize};

use super::{Depth, Mask, Profile, Texels, ThresholdMap};
use crate::{Error, Result};

/// What a channel holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum ChannelSource {
    /// Thresholds for light from the character's left: `left`.
    Left,
    /// Thresholds for light from the character's right: `right`.
    Right,
    /// A number from 0 to 1.
    Value(f64),
    /// A grey picture of the map's size: an area, a strength. Looked for beside the project.
    File(PathBuf),
}

impl TryFrom<String> for ChannelSource {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        match (text.trim(), text.trim().parse::<f64>()) {
            ("left", _) => Ok(Self::Left),
            ("right", _) => Ok(Self::Right),
            (_, Ok(value)) if (0.0..=1.0).contains(&value) => Ok(Self::Value(value)),
            (text, Err(_)) if text.contains('.') => Ok(Self::File(text.into())),
            (text, _) => Err(format!("found {text:?}; expected left, right, a number from 0 to 1 or a picture's file")),
        }
    }
}

impl From<ChannelSource> for String {
    fn from(source: ChannelSource) -> Self {
        match source {
            ChannelSource::Left => "left".into(),
            ChannelSource::Right => "right".into(),
            ChannelSource::Value(value) => value.to_string(),
            ChannelSource::File(path) => path.display().to_string(),
        }
    }
}

/// Channels of a map's picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Layout {
    /// Red: light from the character's right, green: from the left, blue (blend to normal shading): 0, alpha (strength):
    /// full. What lilToon and [`FaceLayout::Liltoon`](super::FaceLayout::Liltoon) read.
    #[default]
    Liltoon,
    /// One grey channel for light from the character's left; the shader mirrors it for the other side.
    Single,
    /// Red, green, blue, alpha.
    #[serde(untagged)]
    Channels([ChannelSource; 4]),
}

impl std::str::FromStr for Layout {
    type Err = String;

    /// `liltoon`, `single`, or four channels with commas between, as `left,right,area.png,1`.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "liltoon" => Ok(Self::Liltoon),
            "single" => Ok(Self::Single),
            _ => {
                let channels: Vec<ChannelSource> =
                    text.split(',').map(|c| ChannelSource::try_from(c.to_owned())).collect::<Result<_, _>>()?;
                let channels = channels.try_into();
                channels.map(Self::Channels).map_err(|_| {
                    format!("found {text:?}; expected liltoon, single or four channels, as left,right,area.png,1")
                })
            }
        }
    }
}

impl Layout {
    /// Its channels: one or four.
    #[must_use]
    pub fn channels(&self) -> Vec<ChannelSource> {
        use ChannelSource::{Left, Right, Value};
        match self {
            Self::Liltoon => vec![Right, Left, Value(0.0), Value(1.0)],
            Self::Single => vec![Left],
            Self::Channels(channels) => channels.to_vec(),
        }
    }

    /// Whether a channel holds thresholds for light from the right.
    #[must_use]
    pub fn has_right(&self) -> bool {
        self.channels().contains(&ChannelSource::Right)
    }
}

/// Thresholds of both sides of a face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sides {
    /// For light from the character's left, which is the right of the texture.
    pub left: ThresholdMap,
    /// For light from the right. `None`: the mirror image of the other across the middle of the texture.
    pub right: Option<ThresholdMap>,
}

impl Sides {
    /// Encodes a map as PNG of 8 or 16 bits, tagged linear (`gAMA` 1). `area` reads the pictures that the layout names.
    ///
    /// # Errors
    /// [`Error::Argument`] where the sides, or a picture, are of other sizes than the left one; those of `area`.
    pub fn encode(&self, layout: &Layout, mut area: impl FnMut(&PathBuf) -> Result<Mask>) -> Result<Vec<u8>> {
        let Self { left, right } = self;
        let (width, height, depth) = (left.width as usize, left.height as usize, left.depth);
        let fault = |message: String| Error::Argument { what: "threshold map".into(), message };
        let sized = |what: &str, w: u32, h: u32| match (w, h) == (left.width, left.height) {
            true => Ok(()),
            false => Err(fault(format!("has {width} x {height} texels and {what} {w} x {h}; expected one size"))),
        };
        if let Some(right) = right {
            sized("its right side", right.width, right.height)?;
        }
        enum Row<'a> {
            Codes(&'a [u16]),
            Mirrored(&'a [u16]),
            Value(u16),
            Area(Mask),
        }
        let max = depth.max();
        let channels = layout.channels().into_iter().map(|source| {
            Ok(match source {
                ChannelSource::Left => Row::Codes(&left.codes),
                ChannelSource::Right => right.as_ref().map_or(Row::Mirrored(&left.codes), |r| Row::Codes(&r.codes)),
                ChannelSource::Value(value) => Row::Value((value * f64::from(max)).round() as u16),
                ChannelSource::File(path) => {
                    let mask = area(&path)?;
                    sized(&path.display().to_string(), mask.width, mask.height)?;
                    Row::Area(mask)
                }
            })
        });
        let channels: Vec<Row> = channels.collect::<Result<_>>()?;
        let negate = if left.profile.is_falling() { max } else { 0 };
        let mut bytes = Vec::new();
        let png = |e: png::EncodingError| fault(e.to_string());
        let mut encoder = png::Encoder::new(&mut bytes, left.width, left.height);
        encoder.set_color(if channels.len() == 1 {
            ColorType::Grayscale
        } else {
            ColorType::Rgba
        });
        encoder.set_depth(if depth == Depth::Eight {
            BitDepth::Eight
        } else {
            BitDepth::Sixteen
        });
        encoder.set_source_gamma(ScaledFloat::new(1.0));
        encoder.set_compression(Compression::Fast);
        encoder.set_filter(Filter::Sub);
        let mut writer = encoder.write_header().map_err(png)?;
        let mut stream = writer.stream_writer().map_err(png)?;
        let mut row = Vec::new();
        for y in 0..height {
            row.clear();
            let mut push = |code: u16| match depth {
                Depth::Eight => row.push(code as u8),
                Depth::Sixteen => row.extend_from_slice(&code.to_be_bytes()),
            };
            if let [Row::Codes(codes)] = channels[..] {
                codes[y * width..(y + 1) * width].iter().for_each(|code| push(code ^ negate));
            } else {
                for x in 0..width {
                    for channel in &channels {
                        push(match channel {
                            Row::Codes(codes) => codes[y * width + x] ^ negate,
                            Row::Mirrored(codes) => codes[(y + 1) * width - 1 - x] ^ negate,
                            Row::Value(value) => *value,
                            Row::Area(mask) => (u32::from(mask.coverage[y * width + x]) * u32::from(max) / 255) as u16,
                        });
                    }
                }
            }
            std::io::Write::write_all(&mut stream, &row).map_err(|e| fault(e.to_string()))?;
        }
        stream.finish().map_err(png)?;
        writer.finish().map_err(png)?;
        Ok(bytes)
    }

    /// The map as [`FaceShadow`](crate::material::FaceShadow) reads it by default: lilToon's channels, linear angles.
    #[must_use]
    pub fn texels(&self) -> Texels {
        let linear = |map: &ThresholdMap| match map.profile {
            Profile::Linear => map.clone(),
            _ => map.converted(&Profile::Linear, map.depth),
        };
        let left = linear(&self.left);
        let right = self.right.as_ref().map_or_else(|| left.flipped(), linear);
        let is_8_bit = left.depth == Depth::Eight;
        let wide = |code: &u16| if is_8_bit { code * 257 } else { *code };
        let both = right.codes.iter().zip(&left.codes);
        let rgba = both.map(|(right, left)| [wide(right), wide(left), 0, u16::MAX]).collect();
        Texels { width: left.width, height: left.height, rgba, is_8_bit }
    }

    /// Takes the thresholds out of a picture.
    ///
    /// # Errors
    /// [`Error::Argument`] where the layout has no channel for light from the left.
    pub fn from_texels(texels: &Texels, layout: &Layout, profile: &Profile) -> Result<Self> {
        let depth = if texels.is_8_bit { Depth::Eight } else { Depth::Sixteen };
        let channels = layout.channels();
        let side = |wanted: ChannelSource| {
            let channel = channels.iter().position(|c| *c == wanted)?;
            let code = |p: &[u16; 4]| {
                let code = if texels.is_8_bit { p[channel] / 257 } else { p[channel] };
                if profile.is_falling() { depth.max() - code } else { code }
            };
            let codes = texels.rgba.iter().map(code).collect();
            let (width, height) = (texels.width, texels.height);
            Some(ThresholdMap { width, height, codes, depth, profile: profile.clone() })
        };
        let left = side(ChannelSource::Left).ok_or_else(|| Error::Argument {
            what: "layout".into(),
            message: "has no channel for light from the left".into(),
        })?;
        Ok(Self { left, right: side(ChannelSource::Right) })
    }
}

impl ThresholdMap {
    /// The same thresholds for another consumer: angles stay what they are, as far as the profile and the bits can say.
    /// Never and always lit texels remain so.
    #[must_use]
    pub fn converted(&self, profile: &Profile, depth: Depth) -> Self {
        let (from, to) = (f64::from(self.depth.max()), f64::from(depth.max()));
        let code = |code: u16| {
            if code == 0 || code == self.depth.max() {
                return if code == 0 { 0 } else { depth.max() };
            }
            let value = if *profile == self.profile {
                f64::from(code) / from
            } else {
                profile.threshold(self.profile.angle_rad(f64::from(code) / from))
            };
            (value * to).round().clamp(1.0, to - 1.0) as u16
        };
        // Each code once, however many texels have it.
        let table: Vec<u16> = (0..=self.depth.max()).map(code).collect();
        let codes = self.codes.iter().map(|c| table[usize::from(*c)]).collect();
        Self { codes, depth, profile: profile.clone(), ..*self }
    }

    /// The other side of the face, mirrored across the middle of the texture.
    #[must_use]
    pub fn flipped(&self) -> Self {
        let rows = self.codes.chunks_exact((self.width as usize).max(1));
        Self { codes: rows.flat_map(|row| row.iter().rev().copied()).collect(), ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sides(depth: Depth) -> Sides {
        let codes = (0..12).map(|i| (i * (usize::from(depth.max()) / 11)) as u16).collect();
        let left = ThresholdMap { width: 4, height: 3, codes, depth, ..ThresholdMap::default() };
        Sides { right: Some(left.flipped()), left }
    }

    fn decoded(bytes: &[u8]) -> (Texels, Option<ScaledFloat>) {
        let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
        let gamma = reader.info().gama_chunk;
        let path = std::env::temp_dir().join(format!("hikage-layout-{}.png", std::process::id()));
        std::fs::write(&path, bytes).expect("writes");
        let texels = crate::import::image::load_texels(&path).expect("reads");
        std::fs::remove_file(&path).expect("removes");
        (texels, gamma)
    }

    #[test]
    fn every_layout_comes_back_and_is_tagged_linear() {
        for depth in [Depth::Eight, Depth::Sixteen] {
            for (text, right) in [("liltoon", true), ("single", false), ("1,left,0.5,right", true)] {
                let layout: Layout = text.parse().expect("a layout");
                let sides = sides(depth);
                let none = |_: &PathBuf| -> Result<Mask> { Ok(Mask::default()) };
                let (texels, gamma) = decoded(&sides.encode(&layout, none).expect("encodes"));
                assert_eq!(gamma, Some(ScaledFloat::new(1.0)));
                let back = Sides::from_texels(&texels, &layout, &Profile::Linear).expect("has a left side");
                assert_eq!((&back.left, back.right.is_some()), (&sides.left, right), "{text}");
                // A left side alone is mirrored.
                let mirrored = Sides { right: None, ..sides.clone() }.encode(&layout, none).expect("encodes");
                assert!(mirrored == sides.encode(&layout, none).expect("encodes"), "{text}");
            }
        }
    }

    #[test]
    fn the_shader_gets_both_sides() {
        let sides = sides(Depth::Sixteen);
        let texels = Sides { right: None, ..sides.clone() }.texels();
        assert_eq!(texels, sides.texels());
        for row in texels.rgba.chunks_exact(4) {
            assert!((0..4).all(|x| row[x][0] == row[3 - x][1]));
        }
    }

    #[test]
    fn conversion_keeps_angles() {
        let map = sides(Depth::Sixteen).left;
        let there = map.converted(&Profile::Genshin, Depth::Sixteen);
        assert!(there != map && there.codes[0] == 0);
        let back = there.converted(&Profile::Linear, Depth::Sixteen);
        assert!(
            map.codes[..11].iter().zip(&back.codes).all(|(a, b)| a.abs_diff(*b) <= 2),
            "{:?}\n{:?}",
            map.codes,
            back.codes
        );
        let eight = map.converted(&Profile::Linear, Depth::Eight).converted(&Profile::Linear, Depth::Sixteen);
        assert!(map.codes.iter().zip(&eight.codes).all(|(a, b)| a.abs_diff(*b) <= 257), "{:?}", eight.codes);
    }

    #[test]
    fn layouts_are_read_and_faults_named() {
        assert!("left,right,area.png,1".parse::<Layout>().is_ok());
        for text in ["", "rgb", "left,right", "left,right,2,1", "up,right,0,1"] {
            assert!(text.parse::<Layout>().unwrap_err().contains("expected"), "{text}");
        }
    }
}
