//! Typed reading of JSON with the pointer of the element in every error. Own reading rather than derived types, because
//! those know lines and columns but not which element is at fault.

use serde_json::Value;

use super::fault::{Fault, Result, quoted};

/// A JSON value and its place in the file.
#[derive(Clone, Debug)]
pub(super) struct Json<'a> {
    value: &'a Value,
    pointer: String,
}

/// Stands for a missing value in lenient reading.
static NULL: Value = Value::Null;

impl<'a> Json<'a> {
    /// The root, which must be an object.
    pub(super) fn root(value: &'a Value) -> Result<Self> {
        Self { value, pointer: String::new() }.expect_object()
    }

    pub(super) fn pointer(&self) -> &str {
        if self.pointer.is_empty() { "/" } else { &self.pointer }
    }

    fn child(&self, key: &str, value: &'a Value) -> Self {
        let key = if key.len() > 100 { "…" } else { key };
        let key = key.replace('~', "~0").replace('/', "~1");
        Self { value, pointer: format!("{}/{key}", self.pointer) }
    }

    /// An error at this place.
    pub(super) fn fault(&self, message: impl AsRef<str>) -> Fault {
        Fault::new(self.pointer(), message)
    }

    fn expected(&self, what: &str) -> Fault {
        self.fault(format!("found {}, expected {what}", describe(self.value)))
    }

    fn expect_object(self) -> Result<Self> {
        if self.value.is_object() {
            Ok(self)
        } else {
            Err(self.expected("an object"))
        }
    }

    /// The value under a key, if there is one.
    pub(super) fn get(&self, key: &str) -> Option<Self> {
        Some(self.child(key, self.value.as_object()?.get(key)?))
    }

    /// The value under a key, which must be there.
    pub(super) fn need(&self, key: &str) -> Result<Self> {
        self.get(key).ok_or_else(|| self.fault(format!("{key} is missing")))
    }

    /// The object under a key, if there is one.
    pub(super) fn object(&self, key: &str) -> Result<Option<Self>> {
        self.get(key).map(Self::expect_object).transpose()
    }

    /// Whether this is an object.
    pub(super) fn is_object(&self) -> bool {
        self.value.is_object()
    }

    /// Whether this is null, or not there at all.
    pub(super) fn is_null(&self) -> bool {
        self.value.is_null()
    }

    /// The extension object of this name, if the element has it.
    pub(super) fn extension(&self, name: &str) -> Result<Option<Self>> {
        match self.object("extensions")? {
            Some(extensions) => extensions.object(name),
            None => Ok(None),
        }
    }

    /// Entries of the array under a key; none where the key is missing.
    pub(super) fn array(&self, key: &str) -> Result<Vec<Self>> {
        self.get(key).map_or_else(|| Ok(Vec::new()), |array| array.items())
    }

    /// Objects of the array under a key.
    pub(super) fn objects(&self, key: &str) -> Result<Vec<Self>> {
        self.array(key)?.into_iter().map(Self::expect_object).collect()
    }

    /// Entries of this array.
    pub(super) fn items(&self) -> Result<Vec<Self>> {
        let array = self.value.as_array().ok_or_else(|| self.expected("an array"))?;
        Ok(array.iter().enumerate().map(|(i, v)| self.child(&i.to_string(), v)).collect())
    }

    /// Entries of this object.
    pub(super) fn entries(&self) -> Result<Vec<(&'a str, Self)>> {
        let object = self.value.as_object().ok_or_else(|| self.expected("an object"))?;
        Ok(object.iter().map(|(k, v)| (k.as_str(), self.child(k, v))).collect())
    }

    /// A non-negative integer. `5.0` counts as one: several exporters write it.
    pub(super) fn as_u64(&self) -> Result<u64> {
        let float = || self.value.as_f64().filter(|f| f.fract() == 0.0 && (0.0..9e15).contains(f)).map(|f| f as u64);
        self.value.as_u64().or_else(float).ok_or_else(|| self.expected("a non-negative integer"))
    }

    /// A finite number that an `f32` holds.
    pub(super) fn as_f32(&self) -> Result<f32> {
        let number = self.value.as_f64().ok_or_else(|| self.expected("a number"))?;
        let number = number as f32;
        if number.is_finite() {
            Ok(number)
        } else {
            Err(self.expected("a finite number"))
        }
    }

    pub(super) fn as_str(&self) -> Result<&'a str> {
        self.value.as_str().ok_or_else(|| self.expected("a string"))
    }

    pub(super) fn as_bool(&self) -> Result<bool> {
        self.value.as_bool().ok_or_else(|| self.expected("true or false"))
    }

    /// `N` finite numbers.
    pub(super) fn as_floats<const N: usize>(&self) -> Result<[f32; N]> {
        let items = self.items()?;
        if items.len() != N {
            return Err(self.fault(format!("found an array of length {}, expected {N} numbers", items.len())));
        }
        let mut out = [0.0; N];
        for (slot, item) in out.iter_mut().zip(&items) {
            *slot = item.as_f32()?;
        }
        Ok(out)
    }

    /// An index below `count`.
    pub(super) fn as_index(&self, count: usize, of: &str) -> Result<usize> {
        let index = self.as_u64()?;
        usize::try_from(index).ok().filter(|i| *i < count).ok_or_else(|| {
            self.fault(format!("found index {index}, expected an index below {count}, the number of {of}"))
        })
    }

    pub(super) fn u64(&self, key: &str) -> Result<Option<u64>> {
        self.get(key).map(|v| v.as_u64()).transpose()
    }

    pub(super) fn index(&self, key: &str, count: usize, of: &str) -> Result<Option<usize>> {
        self.get(key).map(|v| v.as_index(count, of)).transpose()
    }

    pub(super) fn f32(&self, key: &str) -> Result<Option<f32>> {
        self.get(key).map(|v| v.as_f32()).transpose()
    }

    pub(super) fn floats<const N: usize>(&self, key: &str) -> Result<Option<[f32; N]>> {
        self.get(key).map(|v| v.as_floats()).transpose()
    }

    pub(super) fn str(&self, key: &str) -> Result<Option<&'a str>> {
        self.get(key).map(|v| v.as_str()).transpose()
    }

    pub(super) fn bool(&self, key: &str) -> Result<Option<bool>> {
        self.get(key).map(|v| v.as_bool()).transpose()
    }

    /// The name of an element, shortened to 1,000 characters; empty where it has none.
    pub(super) fn name(&self) -> Result<String> {
        Ok(self.str("name")?.unwrap_or_default().chars().take(1000).collect())
    }

    /// An index, or `None` where it is missing, negative or out of range: for the lenient reading of VRM data.
    pub(super) fn maybe_index(&self, key: &str, count: usize) -> Option<usize> {
        self.get(key)?.as_index(count, "").ok()
    }

    /// A finite number, or the default: for the lenient reading of VRM data.
    pub(super) fn f32_or(&self, key: &str, default: f32) -> f32 {
        self.f32(key).ok().flatten().unwrap_or(default)
    }

    /// Numbers, or the default: for the lenient reading of VRM data.
    pub(super) fn floats_or<const N: usize>(&self, key: &str, default: [f32; N]) -> [f32; N] {
        self.floats(key).ok().flatten().unwrap_or(default)
    }

    /// A flag, or `false`.
    pub(super) fn flag(&self, key: &str) -> bool {
        self.bool(key).ok().flatten().unwrap_or(false)
    }

    /// Text, or empty text.
    pub(super) fn text(&self, key: &str) -> &'a str {
        self.str(key).ok().flatten().unwrap_or_default()
    }

    /// Entries of the array under a key; none where it is not an array.
    pub(super) fn list(&self, key: &str) -> Vec<Self> {
        self.array(key).unwrap_or_default()
    }

    /// The value under a key, null where there is none.
    pub(super) fn at(&self, key: &str) -> Self {
        self.get(key).unwrap_or_else(|| self.child(key, &NULL))
    }

    /// The scalar value as text, for meta data.
    pub(super) fn display(&self) -> Option<String> {
        match self.value {
            Value::String(s) => Some(s.clone()),
            Value::Bool(b) => Some(b.to_string()),
            Value::Number(n) => Some(n.to_string()),
            _ => None,
        }
    }
}

/// What a value is, for messages.
fn describe(value: &Value) -> String {
    match value {
        Value::Null => "null".into(),
        Value::Bool(b) => format!("the boolean {b}"),
        Value::Number(n) => format!("the number {n}"),
        Value::String(s) => format!("the string {}", quoted(s)),
        Value::Array(a) => format!("an array of {}", a.len()),
        Value::Object(_) => "an object".into(),
    }
}
