//! Sections by name: what a look file may write instead of numbers.

use serde::Serialize;
use toml::{Table, Value};

use super::values::{merge, no_such};
use crate::material::{Diamond, Fire, Fluff, Gem, ShapedHighlight, Sparkle, Stocking};

/// Sections that have presets, with them.
fn presets(section: &str) -> Option<Vec<(&'static str, Table)>> {
    fn named<T: Serialize>(list: &[(&'static str, T)]) -> Vec<(&'static str, Table)> {
        list.iter().map(|(name, value)| (*name, Table::try_from(value).unwrap_or_default())).collect()
    }
    let shape = ShapedHighlight::default();
    Some(match section {
        "gem" => named(&[("amber", Gem::amber()), ("ruby", Gem::ruby()), ("jade", Gem::jade())]),
        "diamond" => named(&[
            ("brilliant", Diamond::default()),
            ("glass", Diamond { ior: [1.51, 1.52, 1.53], bounces: 2, brilliance: 1.2, ..Diamond::default() }),
        ]),
        "fire" => named(&[("orange", Fire::default()), ("blue", Fire::blue())]),
        "fluff" => named(&[
            ("trim", Fluff::default()),
            ("plush", Fluff { length_m: 0.003, density: 260.0, shells: 10, gravity_m: 0.0003, ..Fluff::default() }),
            ("long", Fluff { length_m: 0.015, density: 110.0, shells: 24, gravity_m: 0.006, ..Fluff::default() }),
        ]),
        "shaped_highlight" => named(&[
            ("round", shape),
            ("square", ShapedHighlight { square: 1.0, rotate_rad: 0.4, ..shape }),
            ("window", ShapedHighlight { square: 1.0, split: [0.05, 0.05], size_rad: 0.2, ..shape }),
            ("band", ShapedHighlight { squash: 0.85, split: [0.0, 0.06], rotate_rad: 0.3, ..shape }),
            ("brushed", ShapedHighlight { anisotropy: 0.9, size_rad: 0.14, ..shape }),
        ]),
        "sparkle" => named(&[
            ("glitter", Sparkle::default()),
            ("snow", Sparkle { spacing_px: 12.0, spread: 1.0, size_rad: 0.1, ..Sparkle::default() }),
        ]),
        "stocking" => named(&[
            ("sheer", Stocking { cover: 0.25, ..Stocking::default() }),
            ("opaque", Stocking { cover: 0.8, ..Stocking::default() }),
        ]),
        _ => return None,
    })
}

/// Puts the numbers of presets in the place of their names: `gem = "ruby"`, or `gem = { preset = "ruby", .. }`, where other
/// keys come over it.
pub(super) fn expand(sections: &mut Table) -> Result<(), String> {
    for (section, value) in sections.iter_mut() {
        let Some(known) = presets(section) else { continue };
        let (name, over) = match value {
            Value::String(name) => (name.clone(), Table::new()),
            Value::Table(table) => match table.remove("preset") {
                Some(Value::String(name)) => (name, table.clone()),
                Some(_) => return Err(format!("{section}.preset: expected a name")),
                None => continue,
            },
            _ => continue,
        };
        let found = known.iter().find(|(known, _)| *known == name);
        let Some((_, preset)) = found else {
            return Err(no_such(&format!("preset of {section}"), &name, known.iter().map(|(name, _)| *name)));
        };
        let mut all = preset.clone();
        merge(&mut all, &over);
        *value = Value::Table(all);
    }
    Ok(())
}
