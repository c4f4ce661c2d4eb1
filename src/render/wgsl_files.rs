//! The files of `wgsl/`, as texts and as the linker reads them.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock};

use wesl::syntax::{GlobalDeclaration, Ident, TranslationUnit};
use wesl::{Diagnostic, ModulePath, ResolveError, Resolver};

use super::made::lock;
use crate::material::About;

/// The files of `wgsl/` by module: `lib/color`.
const EMBEDDED: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/tree.rs"));

/// Names a folder whose files take the place of the embedded ones: shaders can be written without building anew.
pub const FOLDER_VARIABLE: &str = "HIKAGE_WGSL";

/// The files of `wgsl/` by module: `lib/color`; those of the folder in `HIKAGE_WGSL`, read once, where it is set.
pub fn tree() -> &'static [(&'static str, &'static str)] {
    static TREE: OnceLock<Vec<(&'static str, &'static str)>> = OnceLock::new();
    TREE.get_or_init(|| {
        let folder = std::env::var_os(FOLDER_VARIABLE).map(PathBuf::from);
        let of_folder = |module: &str| {
            let text = std::fs::read_to_string(folder.as_ref()?.join(module).with_extension("wgsl")).ok()?;
            Some(&*text.leak())
        };
        let chosen = |(module, text): &(&'static str, &'static str)| {
            let found = of_folder(module);
            if folder.is_some() && found.is_none() {
                tracing::warn!("{FOLDER_VARIABLE}: there is no {module}.wgsl; the embedded one is taken");
            }
            (*module, found.unwrap_or(text))
        };
        EMBEDDED.iter().map(chosen).collect()
    })
}

/// The text of a file of `wgsl/`.
pub(crate) fn file(module: &str) -> &'static str {
    tree().iter().find(|(name, _)| *name == module).map_or("", |(_, text)| text)
}

/// Files that were parsed already, by module: most shaders need most of them.
pub(super) type Parsed = Mutex<HashMap<String, Arc<TranslationUnit>>>;

/// Files as the linker of one shader finds them.
pub(super) struct Tree<'a> {
    /// The module `package::material`.
    pub page: String,
    /// Sections of applications.
    pub own: &'a [&'static About],
    pub parsed: &'a Parsed,
}

impl Resolver for Tree<'_> {
    fn resolve_source<'a>(&'a self, path: &ModulePath) -> Result<Cow<'a, str>, ResolveError> {
        let module = path.components.join("/");
        if module == "material" {
            return Ok(Cow::Borrowed(&self.page));
        }
        let own = self.own.iter().find(|a| module == format!("look/{}", a.key)).and_then(|a| a.wgsl);
        let text = own.or_else(|| tree().iter().find(|(name, _)| *name == module).map(|(_, text)| *text));
        text.map(Cow::Borrowed)
            .ok_or_else(|| ResolveError::ModuleNotFound(path.clone(), "there is no such file in wgsl/".to_owned()))
    }

    fn resolve_module(&self, path: &ModulePath) -> Result<TranslationUnit, ResolveError> {
        let module = path.components.join("/");
        // Others go on while this one copies.
        let found = lock(self.parsed).get(&module).cloned();
        if let Some(found) = found {
            return Ok(with_own_names(&found));
        }
        let source = self.resolve_source(path)?;
        let parsed = source.parse().map_err(|e| {
            Diagnostic::from(e).with_module_path(path.clone(), self.display_name(path)).with_source(source.to_string())
        })?;
        // The page is another one for each shader.
        if module != "material" {
            lock(self.parsed).insert(module, Arc::new(with_own_names(&parsed)));
        }
        Ok(parsed)
    }
}

/// A copy whose declarations have names of their own: by how often a name is held the linker knows what is used.
fn with_own_names(parsed: &TranslationUnit) -> TranslationUnit {
    let mut copy = parsed.clone();
    for declaration in &mut copy.global_declarations {
        let name = match declaration.node_mut() {
            GlobalDeclaration::Declaration(d) => &mut d.ident,
            GlobalDeclaration::TypeAlias(d) => &mut d.ident,
            GlobalDeclaration::Struct(d) => &mut d.ident,
            GlobalDeclaration::Function(d) => &mut d.ident,
            GlobalDeclaration::Void | GlobalDeclaration::ConstAssert(_) => continue,
        };
        let text = name.name().clone();
        *name = Ident::new(text);
    }
    copy
}
