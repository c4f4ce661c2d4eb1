//! Threshold maps as the shader reads them: 16 bits a channel, a stack of layers over the pitch of the light.

use crate::scene::Image;
use crate::{Error, Result};

/// Most pitches of a stack.
pub const MAX_PITCHES: usize = 4;

/// Threshold maps of one face, in lilToon's layout: red is for light from the character's right, green for light from the
/// left: the angle at which a texel turns dark; 0 is never lit, 65535 always. Blue is the share of normal shading (full on
/// the neck, so that no seam shows), alpha the strength of the map.
///
/// [`FaceShadow`](crate::material::FaceShadow) says what the angle is measured in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceMap {
    /// Where it came from.
    pub name: String,
    /// Set of texture coordinates that it lies over: 0 or 1.
    pub uv_set: u32,
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Height of the light over the face for which each map of the stack is painted, radians, growing; at least one, at
    /// most [`MAX_PITCHES`]. Between two of them their thresholds are interpolated.
    pub pitches_rad: Vec<f32>,
    /// Maps for light from the front to the side; one for each pitch.
    pub front: Vec<Vec<[u16; 4]>>,
    /// Maps for light from the side to the back, blended in between 80 and 100 degrees; one for each pitch, or none.
    pub back: Vec<Vec<[u16; 4]>>,
    /// What is lit is multiplied by this where the light stands at the side (red: for light from the right, green: from
    /// the left) and behind (blue: from the right, alpha: from the left); empty for none.
    pub masks: Vec<[u16; 4]>,
    /// Whether the GPU holds it in 8 bits a channel, rounded.
    pub is_8_bit: bool,
}

/// Which channels of a picture hold what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FaceLayout {
    /// Red: light from the character's right, green: from the left, blue: share of normal shading, alpha: strength.
    #[default]
    Liltoon,
    /// One grey channel, painted for light from the character's left (the right of the texture); the other side is its
    /// mirror image across the middle of the texture.
    Mirrored,
}

/// Numbers of a picture as 16 bits a channel, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Texels {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// RGBA.
    pub rgba: Vec<[u16; 4]>,
    /// Whether the picture had 8 bits a channel.
    pub is_8_bit: bool,
}

impl From<&Image> for Texels {
    fn from(image: &Image) -> Self {
        let wide = |c: &u8| u16::from(*c) * 257;
        let rgba = image.pixels.chunks_exact(4).map(|p| [wide(&p[0]), wide(&p[1]), wide(&p[2]), wide(&p[3])]).collect();
        Self { width: image.width, height: image.height, rgba, is_8_bit: true }
    }
}

impl Texels {
    /// The picture in lilToon's layout.
    #[must_use]
    pub fn laid_out(mut self, layout: FaceLayout) -> Self {
        if layout == FaceLayout::Mirrored {
            let width = (self.width as usize).max(1);
            for row in self.rgba.chunks_exact_mut(width) {
                let left: Vec<u16> = row.iter().map(|p| p[0]).collect();
                for (x, p) in row.iter_mut().enumerate() {
                    *p = [left[width - 1 - x], left[x], 0, u16::MAX];
                }
            }
        }
        self
    }
}

impl FaceMap {
    /// A map for every pitch.
    #[must_use]
    pub fn single(name: &str, texels: Texels) -> Self {
        Self {
            name: name.to_owned(),
            width: texels.width,
            height: texels.height,
            pitches_rad: vec![0.0],
            front: vec![texels.rgba],
            is_8_bit: texels.is_8_bit,
            ..Self::default()
        }
    }

    /// Layers in the order in which the shader finds them: the front maps, the back maps, the masks.
    pub(crate) fn layers(&self) -> impl Iterator<Item = &[[u16; 4]]> {
        let masks = (!self.masks.is_empty()).then_some(&self.masks);
        self.front.iter().chain(&self.back).chain(masks).map(Vec::as_slice)
    }

    /// Its numbers alone.
    pub(crate) fn without_texels(&self) -> Self {
        let empty = |list: &[Vec<[u16; 4]>]| vec![Vec::new(); list.len()];
        Self { front: empty(&self.front), back: empty(&self.back), masks: Vec::new(), ..self.clone() }
    }

    /// Bytes on the GPU, mips included.
    pub(crate) fn bytes(&self) -> u64 {
        let texels = self.layers().map(|l| l.len() as u64).sum::<u64>();
        texels * if self.is_8_bit { 4 } else { 8 } * 4 / 3
    }

    /// Refuses a map that no shader could read.
    ///
    /// # Errors
    /// [`Error::Argument`] that names the fault.
    pub fn check(&self) -> Result<()> {
        let fault = |message: String| Err(Error::Argument { what: format!("face map {:?}", self.name), message });
        let pitches = self.pitches_rad.len();
        if !(1..=MAX_PITCHES).contains(&pitches) {
            return fault(format!("has {pitches} pitches; expected 1 to {MAX_PITCHES}"));
        }
        if self.pitches_rad.iter().any(|p| !p.is_finite()) || !self.pitches_rad.is_sorted_by(|a, b| a < b) {
            return fault(format!("has the pitches {:?}; expected growing angles", self.pitches_rad));
        }
        if self.front.len() != pitches || !(self.back.is_empty() || self.back.len() == pitches) {
            return fault(format!(
                "has {} front and {} back maps for {pitches} pitches; expected one of each, or no back maps",
                self.front.len(),
                self.back.len()
            ));
        }
        let texels = u64::from(self.width) * u64::from(self.height);
        if texels == 0 || self.layers().any(|l| l.len() as u64 != texels) {
            return fault(format!("has maps of other sizes than {} x {} texels", self.width, self.height));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirrored_map_holds_both_sides() {
        let rgba = [10u16, 20, 30, 40].map(|c| [c, c, c, 9]).to_vec();
        let texels = Texels { width: 2, height: 2, rgba, is_8_bit: false }.laid_out(FaceLayout::Mirrored);
        assert_eq!(texels.rgba, [[20, 10, 0, 65535], [10, 20, 0, 65535], [40, 30, 0, 65535], [30, 40, 0, 65535]]);
    }

    #[test]
    fn faults_are_named() {
        let texels = Texels { width: 2, height: 1, rgba: vec![[0; 4]; 2], is_8_bit: true };
        let good = FaceMap::single("a", texels);
        assert!(good.check().is_ok());
        let message = |map: FaceMap| map.check().unwrap_err().to_string();
        assert!(message(FaceMap { pitches_rad: vec![], ..good.clone() }).contains("0 pitches"));
        assert!(message(FaceMap { pitches_rad: vec![0.1, 0.0], ..good.clone() }).contains("growing"));
        assert!(message(FaceMap { pitches_rad: vec![0.0, 0.1], ..good.clone() }).contains("1 front"));
        assert!(message(FaceMap { masks: vec![[0; 4]], ..good }).contains("other sizes than 2 x 1"));
    }
}
