//! TODO

use crate::model::Model;

/// Adds it to the character.
pub fn add(_model: &mut Model) {}
