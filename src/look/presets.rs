//! Sections by name: what a look file may write instead of numbers.

use toml::{Table, Value};

use super::values::{merge, no_such};
use crate::material::all;

/// Puts the numbers of presets in the place of their names: `gem = "ruby"`, or `gem = { preset = "ruby", .. }`, where other
/// keys come over it.
pub(super) fn expand(sections: &mut Table) -> Result<(), String> {
    for (section, value) in sections.iter_mut() {
        let Some(known) = all().find(|a| a.key == section.as_str()).map(|a| a.presets).filter(|p| !p.is_empty()) else {
            continue;
        };
        let (name, over) = match value {
            Value::String(name) => (name.clone(), Table::new()),
            Value::Table(table) => match table.remove("preset") {
                Some(Value::String(name)) => (name, table.clone()),
                Some(_) => return Err(format!("{section}.preset: expected a name")),
                None => continue,
            },
            _ => continue,
        };
        let Some(preset) = known.iter().find(|p| p.name == name) else {
            return Err(no_such(&format!("preset of {section}"), &name, known.iter().map(|p| p.name)));
        };
        let mut whole = (preset.values)();
        merge(&mut whole, &over);
        *value = Value::Table(whole);
    }
    Ok(())
}
