//! Colours with their transfer function in the type: the only place that encodes or decodes sRGB.

use serde::{Deserialize, Serialize};

/// Linear-light RGB with the sRGB primaries. Scene-referred: may exceed 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LinearRgb(pub [f32; 3]);

/// sRGB-encoded colour, 8 bits a channel, as artists and web colours write it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Srgb(pub [u8; 3]);

impl LinearRgb {
    /// Black.
    pub const BLACK: Self = Self([0.0; 3]);
    /// White at luminance 1.
    pub const WHITE: Self = Self([1.0; 3]);

    /// The same value in all three channels.
    #[must_use]
    pub const fn splat(value: f32) -> Self {
        Self([value; 3])
    }

    /// Encodes to 8-bit sRGB; values outside 0..=1 are clamped.
    #[must_use]
    pub fn to_srgb(self) -> Srgb {
        Srgb(self.0.map(|c| (srgb_from_linear(c) * 255.0).round() as u8))
    }

    /// Luminance of the sRGB primaries (Rec. 709): 1 for white.
    #[must_use]
    pub fn luminance(self) -> f32 {
        let [r, g, b] = self.0;
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// Multiplies every channel by `factor`.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        Self(self.0.map(|c| c * factor))
    }
}

impl Srgb {
    /// Decodes to linear light.
    #[must_use]
    pub fn to_linear(self) -> LinearRgb {
        LinearRgb(self.0.map(|c| linear_from_srgb(f32::from(c) / 255.0)))
    }

    /// Reads `#RRGGBB` (the `#` may be missing).
    ///
    /// Returns `None` where the text is not six hexadecimal digits.
    #[must_use]
    pub fn from_hex(text: &str) -> Option<Self> {
        let digits = text.strip_prefix('#').unwrap_or(text);
        if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
            return None;
        }
        let value = u32::from_str_radix(digits, 16).ok()?;
        Some(Self([(value >> 16) as u8, (value >> 8) as u8, value as u8]))
    }
}

/// Turns the hue of linear colours about the axis of greys by an angle, radians (from red towards yellow), and multiplies
/// their saturation; luminance stays. Columns of a matrix. A colour may leave the gamut by it.
#[must_use]
pub(crate) fn hue_saturation(hue_rad: f32, saturation: f32) -> [[f32; 3]; 3] {
    let luminance = glam::Vec3::new(0.2126, 0.7152, 0.0722);
    let axis = glam::Vec3::ONE.normalize();
    let turn = glam::Mat3::from_axis_angle(axis, hue_rad);
    [glam::Vec3::X, glam::Vec3::Y, glam::Vec3::Z].map(|unit| {
        let y = luminance.dot(unit);
        let turned = turn * (unit - y) * saturation;
        // The turn keeps the mean of the three, not the luminance.
        (turned + y - luminance.dot(turned)).to_array()
    })
}

/// [`hue_saturation`] as a matrix of WGSL: each column fills four numbers.
pub(crate) fn hue_saturation_columns(hue_rad: f32, saturation: f32) -> [[f32; 4]; 3] {
    hue_saturation(hue_rad, saturation).map(|[x, y, z]| [x, y, z, 0.0])
}

/// sRGB decoding (IEC 61966-2-1): encoded 0..=1 to linear 0..=1.
#[must_use]
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// sRGB encoding (IEC 61966-2-1): linear, clamped to 0..=1, to encoded 0..=1.
#[must_use]
pub fn srgb_from_linear(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_8_bit_code_survives_the_round_trip() {
        for code in 0..=255u8 {
            let srgb = Srgb([code, 255 - code, code]);
            assert_eq!(srgb.to_linear().to_srgb(), srgb);
        }
    }

    #[test]
    fn a_turn_of_hue_keeps_luminance_and_greys() {
        let apply = |m: [[f32; 3]; 3], c: [f32; 3]| {
            let at = |i: usize| m[0][i] * c[0] + m[1][i] * c[1] + m[2][i] * c[2];
            [at(0), at(1), at(2)]
        };
        let luminance = |c: [f32; 3]| 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
        let color = [0.6, 0.3, 0.2];
        for (hue, saturation) in [(0.0, 1.0), (0.4, 1.0), (-1.2, 1.5), (0.0, 0.0), (3.0, 0.5)] {
            let matrix = hue_saturation(hue, saturation);
            let turned = apply(matrix, color);
            assert!((luminance(turned) - luminance(color)).abs() < 1e-5, "{hue}, {saturation}: {turned:?}");
            assert!(apply(matrix, [0.5; 3]).iter().all(|c| (c - 0.5).abs() < 1e-5));
        }
        let same = apply(hue_saturation(0.0, 1.0), color);
        assert!(same.iter().zip(color).all(|(a, b)| (a - b).abs() < 1e-6), "{same:?}");
        let grey = apply(hue_saturation(1.0, 0.0), color);
        assert!(grey.iter().all(|c| (c - luminance(color)).abs() < 1e-5), "{grey:?}");
        // Red turns towards yellow.
        let yellow = apply(hue_saturation(0.5, 1.0), [0.6, 0.1, 0.1]);
        assert!(yellow[1] > yellow[2] + 0.1, "{yellow:?}");
    }

    #[test]
    fn mid_grey_has_the_known_linear_value() {
        let linear = Srgb::from_hex("#808080").expect("six digits").to_linear();
        assert!((linear.0[0] - 0.215_860_5).abs() < 1e-6);
    }

    #[test]
    fn hex_refuses_what_is_not_six_digits() {
        for text in ["", "#", "#12345", "#1234567", "#gg0000", "+12345", "ü12345"] {
            assert_eq!(Srgb::from_hex(text), None, "{text}");
        }
    }
}
