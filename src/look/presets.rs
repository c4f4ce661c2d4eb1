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
    Some(match section {
        "gem" => named(&[("amber", Gem::amber()), ("ruby", Gem::ruby()), ("jade", Gem::jade())]),
        "diamond" => named(&[("brilliant", Diamond::default()), ("glass", Diamond::glass())]),
        "fire" => named(&[("orange", Fire::default()), ("blue", Fire::blue())]),
        "fluff" => named(&[("trim", Fluff::default()), ("plush", Fluff::plush()), ("long", Fluff::long())]),
        "shaped_highlight" => named(&[
            ("round", ShapedHighlight::default()),
            ("square", ShapedHighlight::square()),
            ("window", ShapedHighlight::window()),
            ("strokes", ShapedHighlight::strokes()),
            ("brushed", ShapedHighlight::brushed()),
        ]),
        "sparkle" => named(&[("glitter", Sparkle::default()), ("snow", Sparkle::snow()), ("dust", Sparkle::dust())]),
        "stocking" => named(&[("sheer", Stocking::sheer()), ("opaque", Stocking::opaque())]),
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
