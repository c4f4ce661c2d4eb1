//! `cargo xtask lint`: format, clippy, docs, and words that must not be in the tree.

use std::path::Path;
use std::process::Command;

use crate::driver::Vulkan;
use crate::{Outcome, Stop, cargo};

pub(crate) fn run() -> Outcome {
    let vulkan = Vulkan::default();
    words()?;
    cargo::run(&["fmt", "--all", "--check"], &vulkan)?;
    cargo::run(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "-D", "warnings"], &vulkan)?;
    cargo::run_with(&["doc", "--workspace", "--no-deps", "--quiet"], &vulkan, &[("RUSTDOCFLAGS", "-D warnings")])
}

/// Unfinished work and paths of somebody's machine do not belong into the tree.
fn words() -> Outcome {
    // Put together from halves, so that this file does not find itself.
    let forbidden = [["TO", "DO"], ["FIX", "ME"], ["/ho", "me/"], ["/ro", "ot/"], ["/wo", "rk/"]].map(|h| h.concat());
    let mut found = Vec::new();
    for file in files()? {
        // Binary files are not text, and the lock file is not ours.
        let Ok(text) = std::fs::read_to_string(&file) else { continue };
        if file == "Cargo.lock" {
            continue;
        }
        for (number, line) in text.lines().enumerate() {
            if let Some(word) = forbidden.iter().find(|w| contains_word(line, w)) {
                found.push(format!("{file}:{}: {word}", number + 1));
            }
        }
    }
    if found.is_empty() {
        Ok(())
    } else {
        Err(Stop(1, format!("words that must not be here:\n{}", found.join("\n"))))
    }
}

/// Whether `word` stands in the line, not as the end of a longer word or path.
fn contains_word(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '-'))
    })
}

/// Files that git knows or would add.
fn files() -> Outcome<Vec<String>> {
    let output = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .output()
        .map_err(|e| Stop(1, format!("git: {e}")))?;
    if !output.status.success() {
        return Err(Stop(1, format!("git ls-files: {}", String::from_utf8_lossy(&output.stderr))));
    }
    let names = String::from_utf8_lossy(&output.stdout).into_owned();
    Ok(names.split('\0').filter(|n| !n.is_empty() && Path::new(n).is_file()).map(str::to_owned).collect())
}

#[cfg(test)]
mod tests {
    use super::contains_word;

    #[test]
    fn words_are_found_at_their_start_only() {
        assert!(contains_word("see /tmp/a", "/tmp/"));
        assert!(contains_word("\"/tmp/a\"", "/tmp/"));
        assert!(!contains_word("../tmp/a", "/tmp/"));
        assert!(!contains_word("frame/tmp/a", "/tmp/"));
    }
}
