//! Embeds the files of `wgsl/`; `src/render/shaders.rs` links what a material needs from them.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{error::Error, fs};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=wgsl");
    let root = PathBuf::from(std::env::var("CARGO_MANIFEST_DIR")?).join("wgsl");
    let mut list = String::from("&[\n");
    let mut folders: Vec<_> = fs::read_dir(&root)?.map(|e| e.map(|e| e.path())).collect::<Result<_, _>>()?;
    folders.sort();
    for folder in folders {
        let mut files: Vec<_> = fs::read_dir(&folder)?.map(|e| e.map(|e| e.path())).collect::<Result<_, _>>()?;
        files.sort();
        for file in files {
            let module = file.strip_prefix(&root)?.with_extension("");
            let module = module.to_str().ok_or("a shader's file name is not UTF-8")?.replace('\\', "/");
            writeln!(list, "    ({module:?}, include_str!({:?})),", file.display().to_string())?;
        }
    }
    list.push_str("]\n");
    fs::write(Path::new(&std::env::var("OUT_DIR")?).join("tree.rs"), list)?;
    Ok(())
}
