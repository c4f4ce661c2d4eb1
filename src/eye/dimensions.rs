//! Measures of an eye: ball, cornea, limbus, iris.

use crate::material::out_of_range;
use crate::{Error, Result};

crate::part! {
    /// Measures of an eye, mm of a human one: an eye of another size is scaled to its ball.
    ///
    /// A ball and a smaller sphere, the cornea, meet in a circle, the limbus; behind it lies the plane of the iris, and between
    /// is water. The defaults are an adult's; HDRP's eye has the same index.
    #[derive(Copy)]
    EyeDimensions {
        /// Radius of the ball, mm.
        eyeball_radius_mm: f32 = 12.0, in 1.0..=100.0;
        /// Radius of the cornea's sphere, mm; at most the ball's, or nothing would bulge.
        cornea_radius_mm: f32 = 7.8, in 1.0..=100.0;
        /// Radius of the limbus, where cornea and white meet, mm; below that of the cornea.
        limbus_radius_mm: f32 = 5.9, in 0.1..=100.0;
        /// Radius of the iris, mm; at most that of the limbus.
        iris_radius_mm: f32 = 5.9, in 0.1..=100.0;
        /// Depth of the iris behind the plane of the limbus, mm. The default leaves 3.2 mm to the top of the cornea.
        iris_depth_mm: f32 = 0.5, in 0.0..=100.0;
        /// Index of refraction of cornea and water together; 1 refracts nothing.
        ior: f32 = 1.376, in 1.0..=3.0;
    }
}

impl EyeDimensions {
    /// Whether there is such an eye.
    ///
    /// # Errors
    /// [`Error::Argument`] that names the field: a number out of its range, an index below 1, radii that contradict each other.
    pub fn check(&self) -> Result<()> {
        if let Some((key, message)) = out_of_range(&mut self.clone()) {
            return fault(&key, message);
        }
        let Self { eyeball_radius_mm: ball, cornea_radius_mm: cornea, limbus_radius_mm: limbus, .. } = *self;
        if cornea > ball {
            return fault("cornea_radius_mm", format!("is {cornea}; expected at most eyeball_radius_mm, {ball}"));
        }
        if limbus >= cornea {
            return fault("limbus_radius_mm", format!("is {limbus}; expected less than cornea_radius_mm, {cornea}"));
        }
        let iris = self.iris_radius_mm;
        if iris > limbus {
            return fault("iris_radius_mm", format!("is {iris}; expected at most limbus_radius_mm, {limbus}"));
        }
        let (depth, most) = (self.iris_depth_mm, self.limbus_z_mm());
        if depth >= most {
            return fault(
                "iris_depth_mm",
                format!("is {depth}; expected less than {most}, where the ball's centre is"),
            );
        }
        Ok(())
    }

    /// Height of the limbus' plane above the ball's centre, mm.
    #[must_use]
    pub fn limbus_z_mm(&self) -> f32 {
        leg(self.eyeball_radius_mm, self.limbus_radius_mm)
    }

    /// Height of the iris above the ball's centre, mm.
    #[must_use]
    pub fn iris_z_mm(&self) -> f32 {
        self.limbus_z_mm() - self.iris_depth_mm
    }

    /// Height of the centre of the cornea's sphere above the ball's, mm.
    #[must_use]
    pub fn cornea_centre_z_mm(&self) -> f32 {
        self.limbus_z_mm() - leg(self.cornea_radius_mm, self.limbus_radius_mm)
    }
}

/// The other leg of a right triangle.
fn leg(hypotenuse: f32, leg: f32) -> f32 {
    ((hypotenuse - leg) * (hypotenuse + leg)).max(0.0).sqrt()
}

fn fault(key: &str, message: String) -> Result<()> {
    Err(Error::Argument { what: format!("eye dimensions: {key}"), message })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_eye_has_the_heights_of_the_vectors() {
        let eye = EyeDimensions::default();
        eye.check().expect("a human eye");
        let found = [eye.limbus_z_mm(), eye.iris_z_mm(), eye.cornea_centre_z_mm()];
        for (found, expected) in found.iter().zip([10.449_402, 9.949_402, 5.347_441]) {
            assert!((found - expected).abs() < 1e-5, "{found} {expected}");
        }
        let chamber = eye.cornea_centre_z_mm() + eye.cornea_radius_mm - eye.iris_z_mm();
        assert!((2.5..=3.2).contains(&chamber), "{chamber}");
    }

    #[test]
    fn measures_that_contradict_each_other_are_named() {
        let human = EyeDimensions::default();
        for (eye, key, word) in [
            (EyeDimensions { ior: 0.9, ..human }, "ior", "1..3"),
            (EyeDimensions { ior: f32::NAN, ..human }, "ior", "NaN"),
            (EyeDimensions { iris_depth_mm: -0.1, ..human }, "iris_depth_mm", "0..100"),
            (EyeDimensions { cornea_radius_mm: 12.5, ..human }, "cornea_radius_mm", "eyeball_radius_mm, 12"),
            (EyeDimensions { limbus_radius_mm: 7.8, ..human }, "limbus_radius_mm", "cornea_radius_mm, 7.8"),
            (EyeDimensions { iris_radius_mm: 6.0, ..human }, "iris_radius_mm", "limbus_radius_mm, 5.9"),
            (EyeDimensions { iris_depth_mm: 10.5, ..human }, "iris_depth_mm", "less than 10.4"),
        ] {
            let error = eye.check().expect_err(key).to_string();
            assert!(error.contains(key) && error.contains(word) && !error.contains('\n'), "{error}");
        }
        // A ball without a bulge is an eye, too.
        EyeDimensions { cornea_radius_mm: 12.0, ..human }.check().expect("a plain sphere");
    }
}
