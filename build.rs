//! Links every entry file of `wgsl/pass/` with its imports into one plain WGSL text, embedded by `src/render/shaders.rs`.

use std::{error::Error, fs, path::Path};

use wesl::{ManglerKind, ModulePath, Wesl};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=wgsl");
    let out = std::env::var("OUT_DIR")?;
    let mut compiler = Wesl::new("wgsl");
    // Names are unique over the whole tree, so linked texts keep them: overrides are set and errors read by name.
    compiler.set_mangler(ManglerKind::None).keep_all_entrypoints();
    for entry in fs::read_dir("wgsl/pass")? {
        let path = entry?.path();
        let stem = path.file_stem().and_then(|s| s.to_str()).ok_or("a shader's file name is not UTF-8")?;
        let module: ModulePath = format!("package::pass::{stem}").parse().map_err(|e| format!("{stem}: {e}"))?;
        let linked = compiler.compile(&module).map_err(|e| format!("wgsl/pass/{stem}.wgsl: {e}"))?;
        fs::write(Path::new(&out).join(format!("{stem}.wgsl")), linked.to_string())?;
    }
    Ok(())
}
