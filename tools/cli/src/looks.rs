//! `hikage looks`: every section that a material can have, with its fields, ranges and defaults.

use hikage::material::{About, Field, Inner, Kind, all, shown_range};
use toml::Value;

use crate::failure::Failure;
use crate::output::print;

/// Arguments of `hikage looks`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage looks
  hikage looks gem
  hikage looks --markdown > looks.md

A look file sets any of these, by role or by material: `hikage look --help`.")]
pub(crate) struct Args {
    /// One section alone, whole.
    section: Option<String>,
    /// Print Markdown.
    #[arg(long)]
    markdown: bool,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let sections: Vec<&About> = match &args.section {
        Some(name) => {
            let known: Vec<&About> = all().collect();
            let found = known.iter().find(|a| a.key == *name).copied();
            let names: Vec<&str> = known.iter().map(|a| a.key).collect();
            let none = || Failure::input(format!("there is no section {name:?}; there are: {}", names.join(", ")));
            vec![found.ok_or_else(none)?]
        }
        None => all().collect(),
    };
    let is_whole = args.section.is_some();
    let text: String = sections
        .iter()
        .map(|about| {
            if args.markdown {
                markdown(about)
            } else {
                plain(about, is_whole)
            }
        })
        .collect();
    print(&text)
}

/// A field with its path, defaults and range.
struct Row {
    path: String,
    default: String,
    range: String,
    doc: &'static str,
}

fn rows(of: &Inner, before: &str, list: &mut Vec<Row>) {
    let defaults = (of.defaults)();
    for Field { name, doc, kind } in of.fields {
        let path = format!("{before}{name}");
        let default = defaults.get(*name);
        let (range, default) = match (kind, default) {
            (Kind::Texture(_), Some(_)) => ("texture".to_owned(), "required".to_owned()),
            (Kind::Texture(_), None) => ("texture".to_owned(), "none".to_owned()),
            (Kind::Part(_), None) => ("table".to_owned(), "none".to_owned()),
            (Kind::Part(_), Some(_)) => ("table".to_owned(), String::new()),
            (Kind::Number { low, high }, default) => {
                (shown_range(*low, *high), default.map_or("none".to_owned(), shown))
            }
            (Kind::Plain, default) => (String::new(), default.map_or("none".to_owned(), shown)),
        };
        list.push(Row { path: path.clone(), default, range, doc });
        if let Kind::Part(inner) = kind {
            rows(inner, &format!("{path}."), list);
        }
    }
}

/// A value as short as a look file may write it.
fn shown(value: &Value) -> String {
    match value {
        // What was a number of 32 bits has no more digits than those.
        Value::Float(x) => format!("{}", *x as f32),
        Value::Array(list) => format!("[{}]", list.iter().map(shown).collect::<Vec<_>>().join(", ")),
        Value::Table(inner) => {
            let pairs: Vec<_> = inner.iter().map(|(key, value)| format!("{key} = {}", shown(value))).collect();
            format!("{{ {} }}", pairs.join(", "))
        }
        Value::String(text) => format!("{text:?}"),
        other => other.to_string(),
    }
}

fn first_sentence(doc: &str) -> String {
    let doc = doc.split_whitespace().collect::<Vec<_>>().join(" ");
    doc.split_inclusive(". ").next().unwrap_or_default().trim_end().trim_end_matches('.').to_owned()
}

fn plain(about: &About, is_whole: bool) -> String {
    let mut list = Vec::new();
    rows(about.inner, "", &mut list);
    let doc = if is_whole {
        about.doc.lines().map(str::trim).collect::<Vec<_>>().join("\n  ").trim_end().replace("\n  \n", "\n\n")
    } else {
        first_sentence(about.doc)
    };
    let mut text = format!("{}\n  {doc}\n", about.key);
    if !about.presets.is_empty() {
        text.push_str(&format!("  presets: {}\n", about.presets.iter().map(|p| p.name).collect::<Vec<_>>().join(", ")));
    }
    for (name, shows) in about.channels() {
        text.push_str(&format!("  channel {name}: {shows}\n"));
    }
    let width = |column: fn(&Row) -> &str| list.iter().map(|r| column(r).chars().count()).max().unwrap_or(0);
    let (path, range, default) = (width(|r| &r.path), width(|r| &r.range), width(|r| &r.default).min(30));
    for row in &list {
        let Row { path: p, range: r, default: d, doc } = row;
        text.push_str(&format!("    {p:path$}  {r:range$}  {d:default$}  {}\n", first_sentence(doc)));
    }
    text + "\n"
}

fn markdown(about: &About) -> String {
    let mut list = Vec::new();
    rows(about.inner, "", &mut list);
    let mut text = format!("### `{}`\n\n{}.\n\n", about.key, first_sentence(about.doc));
    text.push_str("| field | range | default | |\n|---|---|---|---|\n");
    for Row { path, range, default, doc } in list {
        text.push_str(&format!("| `{path}` | {range} | {default} | {} |\n", first_sentence(doc).replace('|', "\\|")));
    }
    text + "\n"
}
