//! Images and how they are sampled.

/// A decoded image: 8-bit RGBA, straight alpha, rows from the top.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Image {
    /// Name or file name in the source; may be empty.
    pub name: String,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// `width * height * 4` bytes. The transfer function depends on the use: colours are sRGB, masks and normal maps
    /// are linear.
    pub pixels: Vec<u8>,
    /// Container in the file: `png`, `jpeg`, `webp`.
    pub format: &'static str,
    /// Bits a channel in the file: 8 or 16.
    pub source_bits: u8,
}

/// An image with its sampler.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Texture {
    /// Index in [`Scene::images`](super::Scene::images).
    pub image: usize,
    /// How it is sampled.
    pub sampler: Sampler,
}

/// Addressing and filtering.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct Sampler {
    /// Addressing along u. Default: repeat.
    pub wrap_u: Wrap,
    /// Addressing along v. Default: repeat.
    pub wrap_v: Wrap,
    /// Magnification filter. Default: linear.
    pub mag: Filter,
    /// Minification filter within a mip level. Default: linear.
    pub min: Filter,
    /// Filter between mip levels, `None` to use the full-size level only. Default: linear.
    pub mip: Option<Filter>,
}

impl Default for Sampler {
    fn default() -> Self {
        Self {
            wrap_u: Wrap::Repeat,
            wrap_v: Wrap::Repeat,
            mag: Filter::Linear,
            min: Filter::Linear,
            mip: Some(Filter::Linear),
        }
    }
}

/// What lies outside 0..1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Wrap {
    /// The texture again.
    #[default]
    Repeat,
    /// The texture mirrored.
    Mirror,
    /// The edge texel.
    Clamp,
}

/// Nearest or linear filtering.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// The nearest sample.
    Nearest,
    /// Weighted by distance.
    #[default]
    Linear,
}
