//! Pictures of the built-in character that were looked at.

mod golden_character;
