//! `cargo xtask goldens`: what differs from the accepted pictures, and accepting by name.

use std::collections::BTreeMap;
use std::path::Path;

use crate::test::{GOLDENS, QUICK_LLVMPIPE};
use crate::{Outcome, Stop, cargo, driver};

const EXPECTED: &str = "tests/golden/expected";
const ACTUAL: &str = "tests/golden/actual";

pub(crate) fn run(args: &[String]) -> Outcome {
    let words: Vec<&str> = args.iter().map(String::as_str).collect();
    match words[..] {
        [] => review(true),
        ["--no-run"] => review(false),
        ["--bless", "--all"] => {
            let names: Vec<String> = findings()?.into_keys().collect();
            bless(&names)
        }
        ["--bless", ref names @ ..] if !names.is_empty() && !names.iter().any(|n| n.starts_with('-')) => {
            bless(&names.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>())
        }
        _ => Err(Stop(2, "usage: cargo xtask goldens [--no-run | --bless NAME… | --bless --all]".into())),
    }
}

/// Runs the tests and lists what they left; never accepts anything.
fn review(run_tests: bool) -> Outcome {
    let mut tests = Ok(());
    if run_tests {
        let vulkan = driver::ensure()?;
        // What an older run left must not be taken for a finding of this one.
        let _ = std::fs::remove_dir_all(ACTUAL);
        let pictures = ["test", "--quiet", "--workspace", "--test", "pictures", "--no-fail-fast", "--"];
        let golden = [&pictures[..], &GOLDENS[..]].concat();
        tests = cargo::run_with(&golden, &vulkan, &QUICK_LLVMPIPE);
    }
    let accepted = names_in(EXPECTED, ".png")?;
    let findings = findings()?;
    let mut all: Vec<&String> = accepted.iter().chain(findings.keys()).collect();
    all.sort();
    all.dedup();
    let widest = all.iter().map(|n| n.len()).max().unwrap_or(0);
    for name in &all {
        match findings.get(*name) {
            None => println!("  ok       {name}"),
            Some(finding) => {
                let state = if accepted.contains(name) { "differs" } else { "missing" };
                println!("  {state}  {name:<widest$}  {finding}");
                for file in [format!("{ACTUAL}/{name}.png"), format!("{ACTUAL}/{name}.diff.png")] {
                    if Path::new(&file).exists() {
                        println!("           {file}");
                    }
                }
            }
        }
    }
    println!("{} accepted, {} to look at", accepted.len(), findings.len());
    if findings.is_empty() {
        return tests.map_err(|Stop(status, _)| Stop(status, "the golden tests failed before they compared".into()));
    }
    Err(Stop(1, "look at the pictures, then: cargo xtask goldens --bless NAME… (or --bless --all)".into()))
}

fn bless(names: &[String]) -> Outcome {
    let findings = findings()?;
    if let Some(unknown) = names.iter().find(|n| !findings.contains_key(*n)) {
        return Err(Stop(1, format!("{unknown}: no failed check left a picture; run `cargo xtask goldens` first")));
    }
    std::fs::create_dir_all(EXPECTED).map_err(|e| Stop(1, format!("{EXPECTED}: {e}")))?;
    for name in names {
        let (from, to) = (format!("{ACTUAL}/{name}.png"), format!("{EXPECTED}/{name}.png"));
        std::fs::rename(&from, &to).map_err(|e| Stop(1, format!("{from}: {e}")))?;
        for rest in ["diff.png", "txt"] {
            let _ = std::fs::remove_file(format!("{ACTUAL}/{name}.{rest}"));
        }
        println!("accepted {to}");
    }
    Ok(())
}

/// Name and finding of every check that failed when it was last run.
fn findings() -> Outcome<BTreeMap<String, String>> {
    let read = |name: String| {
        let finding = std::fs::read_to_string(format!("{ACTUAL}/{name}.txt")).unwrap_or_default();
        (name, finding.trim().to_owned())
    };
    Ok(names_in(ACTUAL, ".txt")?.into_iter().map(read).collect())
}

/// File names in a folder without their ending; none where there is no folder.
fn names_in(folder: &str, ending: &str) -> Outcome<Vec<String>> {
    if !Path::new(folder).exists() {
        return Ok(Vec::new());
    }
    let entries = std::fs::read_dir(folder).map_err(|e| Stop(1, format!("{folder}: {e}")))?;
    let names = entries.flatten().filter_map(|e| e.file_name().into_string().ok());
    let mut names: Vec<String> = names.filter_map(|n| Some(n.strip_suffix(ending)?.to_owned())).collect();
    names.sort();
    Ok(names)
}
