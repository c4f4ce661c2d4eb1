//! Sections of an application: looks from outside of this library, with keys in look files and channels like ours.

use std::any::Any;
use std::fmt;
use std::sync::{PoisonError, RwLock};

use serde::{Serialize, de::DeserializeOwned};
use toml::Table;

use super::{About, Declared, LISTED, Material, Section};
use crate::render::check_section;
use crate::{Error, Result};

/// A section of an application, in a material.
pub struct OwnSection(Box<dyn Erased>);

/// What a section of any type can do.
trait Erased: Section + Any {
    fn copied(&self) -> Box<dyn Erased>;
    fn equals(&self, other: &dyn Erased) -> bool;
}

impl<S: Section + Clone + PartialEq> Erased for S {
    fn copied(&self) -> Box<dyn Erased> {
        Box::new(self.clone())
    }
    fn equals(&self, other: &dyn Erased) -> bool {
        (other as &dyn Any).downcast_ref::<S>() == Some(self)
    }
}

impl OwnSection {
    pub(crate) fn section(&self) -> &dyn Section {
        &*self.0
    }

    pub(crate) fn section_mut(&mut self) -> &mut dyn Section {
        &mut *self.0
    }

    fn any(&self) -> &dyn Any {
        &*self.0
    }
}

impl Clone for OwnSection {
    fn clone(&self) -> Self {
        Self(self.0.copied())
    }
}

impl PartialEq for OwnSection {
    fn eq(&self, other: &Self) -> bool {
        self.0.equals(&*other.0)
    }
}

impl fmt::Debug for OwnSection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Material {
    /// The section of an application, where the material has it.
    #[must_use]
    pub fn own<S: Section>(&self) -> Option<&S> {
        self.own.iter().find_map(|o| o.any().downcast_ref())
    }

    /// The same to change.
    #[must_use]
    pub fn own_mut<S: Section>(&mut self) -> Option<&mut S> {
        self.own.iter_mut().find_map(|o| (&mut *o.0 as &mut dyn Any).downcast_mut())
    }

    /// Gives the material a section of an application, or takes it away.
    pub fn set_own<S: Section + Clone + PartialEq>(&mut self, section: Option<S>) {
        self.own.retain(|o| !o.any().is::<S>());
        self.own.extend(section.map(|s| OwnSection(Box::new(s))));
    }
}

/// How look files reach a section whose type only the application knows.
#[derive(Clone, Copy)]
pub(crate) struct Registered {
    pub about: &'static About,
    /// Its values in a material, or its defaults.
    pub table: fn(&Material) -> Table,
    /// Puts values into a material; `None` takes the section away.
    pub set: fn(&mut Material, Option<Table>) -> std::result::Result<(), String>,
}

static REGISTERED: RwLock<Vec<Registered>> = RwLock::new(Vec::new());

/// Makes a section of an application known: its key to look files, its shader and channel to renderers that are made from
/// now on. Registering it again changes nothing.
///
/// # Errors
/// [`Error::Input`] where its key or the name of its struct is taken, where it brings no WGSL, or where that is not valid.
pub fn register<S>() -> Result<()>
where
    S: Section + Declared + Clone + Default + PartialEq + Serialize + DeserializeOwned,
{
    let about = S::ABOUT;
    let known = registered();
    if known.iter().any(|r| std::ptr::eq(r.about, about)) {
        return Ok(());
    }
    let fault = |message: &str| {
        Err(Error::Input {
            path: format!("{}.wgsl", about.key),
            pointer: format!("section {}", about.key),
            message: message.to_owned(),
        })
    };
    if LISTED.iter().copied().chain(known.iter().map(|r| r.about)).any(|a| a.key == about.key || a.name == about.name) {
        return fault("there is a section of this name already; please choose another key and struct");
    }
    if about.wgsl.is_none() {
        return fault("has no WGSL; expected wgsl: Some(include_str!(\"…\")) in its declaration");
    }
    check_section::check_section::<S>()?;
    REGISTERED.write().unwrap_or_else(PoisonError::into_inner).push(Registered {
        about,
        table: |material| Table::try_from(material.own::<S>().cloned().unwrap_or_default()).unwrap_or_default(),
        set: |material, table| {
            let section = table.map(|t| toml::Value::Table(t).try_into::<S>()).transpose();
            material.set_own(section.map_err(|e| e.message().to_owned())?);
            Ok(())
        },
    });
    Ok(())
}

/// Sections of the application.
pub(crate) fn registered() -> Vec<Registered> {
    REGISTERED.read().unwrap_or_else(PoisonError::into_inner).clone()
}
