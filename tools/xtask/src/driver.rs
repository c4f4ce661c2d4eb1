//! Makes sure that a graphics driver is there: on a bare Linux machine the Vulkan loader and Mesa's software driver.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{Outcome, Stop, apt, cargo};

/// Folders in which drivers announce themselves to the Vulkan loader.
const ICD_FOLDERS: [&str; 4] =
    ["/etc/vulkan/icd.d", "/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/local/etc/vulkan/icd.d"];

/// Variables that name drivers in place of those folders, the newer one first.
const OVERRIDES: [&str; 2] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"];

const APT_PACKAGES: [&str; 2] = ["libvulkan1", "mesa-vulkan-drivers"];

/// Where browsers bring SwiftShader, a second software driver.
const SWIFTSHADER: [&str; 3] = [
    "/usr/lib/chromium/libvk_swiftshader.so",
    "/usr/lib/chromium-browser/libvk_swiftshader.so",
    "/opt/google/chrome/libvk_swiftshader.so",
];

const REMEDY: &str = "\
no Vulkan driver was found, and it cannot be installed from here; please run

  Debian, Ubuntu:  sudo apt-get update && sudo apt-get install -y --no-install-recommends mesa-vulkan-drivers libvulkan1
  Fedora:          sudo dnf install mesa-vulkan-drivers vulkan-loader
  Arch:            sudo pacman -S vulkan-swrast vulkan-icd-loader
  Alpine:          sudo apk add mesa-vulkan-swrast vulkan-loader

and try again. They bring a software driver: no graphics card is needed.";

/// How children find the driver.
#[derive(Default)]
pub(crate) struct Vulkan {
    /// Variables that point nowhere and must not reach them.
    unset: Vec<&'static str>,
    /// One more driver beside those of the system: a variable and its value.
    added: Option<(&'static str, OsString)>,
}

impl Vulkan {
    /// Prepares a child.
    pub(crate) fn apply(&self, command: &mut Command) {
        // Mesa's device selection complains on standard error where it is missing.
        if cfg!(target_os = "linux") && std::env::var_os("XDG_RUNTIME_DIR").is_none() {
            command.envs(runtime_folder().map(|folder| ("XDG_RUNTIME_DIR", folder)));
        }
        for name in &self.unset {
            command.env_remove(name);
        }
        command.envs(self.added.iter().map(|(name, value)| (name, value)));
    }

    /// The same with SwiftShader beside the others.
    pub(crate) fn with_swiftshader(self, library: &Path) -> Outcome<Self> {
        Ok(self.with_driver(&manifest(library)?))
    }

    /// The same with one more driver, by its manifest.
    fn with_driver(self, manifest: &Path) -> Self {
        let is_set = |name: &&str| !self.unset.contains(name) && std::env::var_os(name).is_some_and(|v| !v.is_empty());
        // The loader looks at the second variable only where the first ones are missing.
        let name = OVERRIDES.into_iter().find(is_set).unwrap_or("VK_ADD_DRIVER_FILES");
        let present = std::env::var_os(name).unwrap_or_default();
        let paths = std::env::split_paths(&present).filter(|p| !p.as_os_str().is_empty()).chain([manifest.to_owned()]);
        // A path with a colon in it cannot be named at all.
        let added = std::env::join_paths(paths).ok().map(|value| (name, value));
        Self { added, ..self }
    }
}

/// SwiftShader's library, where a browser brought it.
pub(crate) fn swiftshader() -> Option<&'static Path> {
    SWIFTSHADER.into_iter().map(Path::new).find(|library| library.is_file())
}

/// Writes the file that names the library to the Vulkan loader.
fn manifest(library: &Path) -> Outcome<PathBuf> {
    let path = cargo::target().join("swiftshader_icd.json");
    let text = format!(
        r#"{{"file_format_version": "1.0.0", "ICD": {{"library_path": "{}", "api_version": "1.1.0"}}}}"#,
        library.display()
    );
    std::fs::write(&path, text)
        .and_then(|()| std::path::absolute(&path))
        .map_err(|e| Stop(1, format!("{}: {e}", path.display())))
}

/// Finds a driver, installing Mesa's where that can be done without asking.
pub(crate) fn ensure() -> Outcome<Vulkan> {
    // macOS has Metal and Windows has Direct3D 12; both come with the system.
    if !cfg!(target_os = "linux") {
        return Ok(Vulkan::default());
    }
    let vulkan = Vulkan { unset: dead_overrides(), ..Vulkan::default() };
    for name in &vulkan.unset {
        eprintln!("xtask: {name} points to no driver; it is left out of what is run from here");
    }
    let is_named =
        OVERRIDES.iter().any(|n| !vulkan.unset.contains(n) && std::env::var_os(n).is_some_and(|v| !v.is_empty()));
    if (is_named || has_icd()) && has_loader() {
        return Ok(vulkan);
    }
    install()?;
    if has_icd() && has_loader() {
        Ok(vulkan)
    } else {
        Err(Stop(3, REMEDY.into()))
    }
}

/// A folder below `target` in place of the one that a login session would have; `None` where it cannot be made.
fn runtime_folder() -> Option<PathBuf> {
    let folder = std::path::absolute(cargo::target().join("runtime")).ok()?;
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder)
}

/// Override variables that are set and name not one file that exists.
fn dead_overrides() -> Vec<&'static str> {
    let is_dead = |value: OsString| !std::env::split_paths(&value).any(|path| has_json(&path));
    OVERRIDES.into_iter().filter(|name| std::env::var_os(name).filter(|v| !v.is_empty()).is_some_and(is_dead)).collect()
}

/// Whether this is a driver's manifest, or a folder with one.
fn has_json(path: &Path) -> bool {
    let is_json = |p: &Path| p.extension().is_some_and(|e| e == "json") && p.is_file();
    is_json(path) || std::fs::read_dir(path).is_ok_and(|entries| entries.flatten().any(|e| is_json(&e.path())))
}

fn has_icd() -> bool {
    let data_home = std::env::var_os("XDG_DATA_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(PathBuf::from(std::env::var_os("HOME")?).join(".local/share")));
    let data_dirs = std::env::var_os("XDG_DATA_DIRS").unwrap_or_default();
    let shared = std::env::split_paths(&data_dirs).chain(data_home).map(|p| p.join("vulkan/icd.d"));
    ICD_FOLDERS.iter().map(PathBuf::from).chain(shared).any(|folder| has_json(&folder))
}

/// Whether the dynamic linker finds the Vulkan loader.
fn has_loader() -> bool {
    let named = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    let mut folders: Vec<PathBuf> = std::env::split_paths(&named).collect();
    for base in ["/lib", "/usr/lib", "/usr/local/lib", "/lib64", "/usr/lib64"] {
        folders.push(base.into());
        folders.push(Path::new(base).join(format!("{}-linux-gnu", std::env::consts::ARCH)));
    }
    if folders.iter().any(|folder| folder.join("libvulkan.so.1").exists()) {
        return true;
    }
    // Elsewhere only the linker's own list knows.
    let list = Command::new("ldconfig").arg("-p").output().map(|o| o.stdout).unwrap_or_default();
    String::from_utf8_lossy(&list).contains("libvulkan.so.1")
}

/// Fetches the loader and Mesa's drivers.
fn install() -> Outcome {
    if !apt::is_usable() {
        return Err(Stop(3, REMEDY.into()));
    }
    eprintln!("xtask: no Vulkan driver");
    apt::install(&APT_PACKAGES).map_err(|Stop(_, message)| Stop(3, format!("{message}\n{REMEDY}")))
}
