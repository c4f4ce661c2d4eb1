//! Values of look files: what may be written beside plain numbers, how a table is laid over another, and what is said about
//! names that do not exist.

use toml::{Table, Value};

use crate::color::Srgb;
use crate::material::{Field, Kind, all};

/// Lays a table over another. `false` takes a section out. The variants of an enum exclude each other, so that theirs are
/// replaced whole.
pub(super) fn merge(under: &mut Table, over: &Table) {
    for (key, value) in over {
        // Edges may be switched off, too, beside their names.
        let is_switch = matches!(under.get(key), Some(Value::Boolean(_))) || key == "antialias";
        match (under.get_mut(key), value) {
            (Some(Value::Table(a)), Value::Table(b)) => {
                let is_variant = ["shading", "width"].contains(&key.as_str()) && !a.keys().eq(b.keys());
                if is_variant {
                    *a = b.clone();
                } else {
                    merge(a, b);
                }
            }
            (_, Value::Boolean(false)) if !is_switch => {
                under.remove(key);
            }
            _ => {
                under.insert(key.clone(), value.clone());
            }
        }
    }
}

/// Turns degrees, centimetres and millimetres into what sections hold, and written colours into linear numbers.
pub(super) fn units(table: &mut Table, with_alpha: bool) -> Result<(), String> {
    let keys: Vec<String> = table.keys().cloned().collect();
    for key in keys {
        let suffixes = [("_deg", "_rad", std::f64::consts::PI / 180.0), ("_cm", "_m", 0.01), ("_mm", "_m", 0.001)];
        let is_color = key == "color" || key.ends_with("_color") || key == "ambient";
        let in_other_unit = suffixes.iter().find(|(suffix, ..)| key.ends_with(suffix) && !is_field(&key));
        if let Some((suffix, unit, scale)) = in_other_unit {
            let value = table.remove(&key).unwrap_or(Value::Boolean(false));
            let scaled =
                scaled(&value, *scale).ok_or_else(|| format!("{key}: expected a number or a list of numbers"))?;
            table.insert(format!("{}{unit}", key.trim_end_matches(suffix)), scaled);
            continue;
        }
        match table.get_mut(&key) {
            // Its keys are names.
            Some(Value::Table(_)) if key == "expressions" => {}
            Some(Value::Table(inner)) => units(inner, key == "base")?,
            Some(Value::Array(list)) => {
                for inner in list.iter_mut().filter_map(Value::as_table_mut) {
                    units(inner, key == "placed")?;
                }
            }
            Some(value @ Value::String(_)) if is_color => {
                let text = value.as_str().unwrap_or_default();
                let srgb = Srgb::from_hex(text)
                    .ok_or_else(|| format!("{key}: {text:?} is no colour; expected \"#rrggbb\""))?;
                let alpha = with_alpha.then_some(1.0);
                *value =
                    Value::Array(srgb.to_linear().0.into_iter().chain(alpha).map(|c| Value::Float(c.into())).collect());
            }
            _ => {}
        }
    }
    Ok(())
}

/// Whether a section holds this very key, in the unit that it ends in.
fn is_field(key: &str) -> bool {
    fn has(fields: &[Field], key: &str) -> bool {
        fields.iter().any(|f| f.name == key || matches!(f.kind, Kind::Part(inner) if has(inner.fields, key)))
    }
    all().any(|about| has(about.inner.fields, key))
}

fn scaled(value: &Value, by: f64) -> Option<Value> {
    match value {
        Value::Float(x) => Some(Value::Float(x * by)),
        Value::Integer(x) => Some(Value::Float(*x as f64 * by)),
        Value::Array(list) => list.iter().map(|v| scaled(v, by)).collect::<Option<_>>().map(Value::Array),
        _ => None,
    }
}

/// Name of a number that is infinite or none.
pub(super) fn not_finite(table: &Table) -> Option<String> {
    fn bad(value: &Value) -> bool {
        match value {
            Value::Float(x) => !x.is_finite() || x.abs() > f64::from(f32::MAX),
            Value::Array(list) => list.iter().any(bad),
            Value::Table(inner) => not_finite(inner).is_some(),
            _ => false,
        }
    }
    table.iter().find_map(|(key, value)| match value {
        Value::Table(inner) => not_finite(inner).map(|inner| format!("{key}.{inner}")),
        value => bad(value).then(|| key.clone()),
    })
}

/// That a name does not exist, with the nearest that does.
pub(super) fn no_such<'a>(what: &str, name: &str, names: impl Iterator<Item = &'a str>) -> String {
    let near = closest(name, names.filter(|n| !n.is_empty()));
    format!("there is no {what} {name:?}{}", near.map_or(String::new(), |n| format!("; the nearest is {n:?}")))
}

fn closest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    names.min_by_key(|n| strsim::damerau_levenshtein(&name.to_lowercase(), &n.to_lowercase()))
}

/// A message about an unknown key, which lists all that there are, with the nearest of them instead.
pub(super) fn nearest(message: &str) -> String {
    let first = message.lines().next().unwrap_or_default();
    let is_unknown = first.starts_with("unknown field") || first.starts_with("unknown variant");
    let quoted: Vec<&str> = first.split('`').skip(1).step_by(2).collect();
    match (is_unknown, quoted.as_slice()) {
        (true, [name, known @ ..]) if !known.is_empty() => {
            let near = closest(name, known.iter().copied()).unwrap_or_default();
            format!("there is no {name:?}; the nearest is {near:?} (known: {})", known.join(", "))
        }
        _ => first.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_and_colours_are_converted() {
        let mut table: Table = toml::from_str(
            "a_deg = [180, 90.0]\nb_mm = 3\nc_cm = 2.5\nrim_color = \"#ffffff\"\nthickness_remap_mm = [0, 2]\n\
             [base]\ncolor = \"#000000\"",
        )
        .expect("TOML");
        units(&mut table, false).expect("known units");
        let text = table.to_string();
        assert!(text.contains("a_rad = [3.14159265358"), "{text}");
        assert!(text.contains("b_m = 0.003") && text.contains("c_m = 0.025"), "{text}");
        assert!(text.contains("thickness_remap_mm = [0, 2]"), "{text}");
        assert!(
            text.contains("rim_color = [1.0, 1.0, 1.0]") && text.contains("color = [0.0, 0.0, 0.0, 1.0]"),
            "{text}"
        );
        assert!(units(&mut toml::from_str("x_deg = true").expect("TOML"), false).is_err());
        assert!(units(&mut toml::from_str("color = \"red\"").expect("TOML"), false).is_err());
    }
}
