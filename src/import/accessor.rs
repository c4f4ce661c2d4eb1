//! The one accessor reader: components, normalisation, strides, sparse overrides and accessors without a view.
//!
//! Elements are read at random, so that a primitive fetches only the vertices that it uses from a shared accessor.

pub(super) use gltf::json::accessor::ComponentType as Component;

use super::buffers::View;
use super::fault::{Fault, Limits, Result, quoted, within};
use super::json::Json;

/// Name of a component type in the specification.
fn component_name(component: Component) -> &'static str {
    match component {
        Component::I8 => "BYTE",
        Component::U8 => "UNSIGNED_BYTE",
        Component::I16 => "SHORT",
        Component::U16 => "UNSIGNED_SHORT",
        Component::U32 => "UNSIGNED_INT",
        Component::F32 => "FLOAT",
    }
}

/// A checked accessor: every element lies inside its view.
#[derive(Debug)]
pub(super) struct Accessor<'a> {
    pub(super) pointer: String,
    pub(super) count: u64,
    pub(super) component: Component,
    pub(super) kind: &'static str,
    pub(super) normalized: bool,
    /// First element and distance between elements; `None` reads zeros.
    data: Option<(&'a [u8], u64)>,
    /// Overridden elements, indices strictly growing, with packed values.
    sparse: Option<(Vec<u32>, &'a [u8])>,
}

/// Names of the element types with rows and columns.
const KINDS: [(&str, u64, u64); 7] =
    [("SCALAR", 1, 1), ("VEC2", 2, 1), ("VEC3", 3, 1), ("VEC4", 4, 1), ("MAT2", 2, 2), ("MAT3", 3, 3), ("MAT4", 4, 4)];

fn component(json: &Json) -> Result<Component> {
    let code = json.need("componentType")?;
    Ok(match code.as_u64()? {
        5120 => Component::I8,
        5121 => Component::U8,
        5122 => Component::I16,
        5123 => Component::U16,
        5125 => Component::U32,
        5126 => Component::F32,
        other => return Err(code.fault(format!("found componentType {other}, expected 5120 to 5126"))),
    })
}

/// Reads and checks all accessors.
pub(super) fn read_all<'a>(root: &Json, views: &'a [View<'a>], limits: &Limits) -> Result<Vec<Accessor<'a>>> {
    root.objects("accessors")?.iter().map(|json| read(json, views, limits)).collect()
}

fn view<'a>(json: &Json, views: &'a [View<'a>]) -> Result<Option<(&'a [u8], Option<u64>)>> {
    let Some(index) = json.index("bufferView", views.len(), "bufferViews")? else { return Ok(None) };
    let offset = json.u64("byteOffset")?.unwrap_or(0);
    let view = views.get(index).ok_or_else(|| json.fault("bufferView is missing"))?;
    let bytes = usize::try_from(offset).ok().and_then(|o| view.bytes.get(o..)).ok_or_else(|| {
        json.fault(format!(
            "accessor byteOffset {offset} is out of range of its bufferView of {} bytes",
            view.bytes.len()
        ))
    })?;
    Ok(Some((bytes, view.stride)))
}

fn read<'a>(json: &Json, views: &'a [View<'a>], limits: &Limits) -> Result<Accessor<'a>> {
    let component = component(json)?;
    let kind_name = json.need("type")?.as_str()?;
    let Some(&(kind, rows, columns)) = KINDS.iter().find(|(name, ..)| *name == kind_name) else {
        return Err(json.fault(format!("found type {}, expected SCALAR, VEC2, VEC3, VEC4 or a MAT", quoted(kind_name))));
    };
    let count = json.need("count")?.as_u64()?;
    within(json.pointer(), count, limits.indices.max(limits.vertices), "elements (count of an accessor)")?;
    let packed = element_size(component, rows, columns);
    let normalized = json.bool("normalized")?.unwrap_or(false);
    let data = match view(json, views)? {
        None => {
            // Nothing in the file backs these zeros, so the limit is the only bound.
            within(json.pointer(), count, limits.vertices, "elements (count of an accessor without bufferView)")?;
            None
        }
        Some((bytes, stride)) => {
            let stride = stride.unwrap_or(packed);
            if stride < packed {
                return Err(
                    json.fault(format!("found byteStride {stride}, expected at least the element size {packed}"))
                );
            }
            // The padding of the last column of the last matrix may be missing.
            let padding = if columns > 1 {
                packed.checked_div(columns).unwrap_or(0).saturating_sub(rows.saturating_mul(component.size() as u64))
            } else {
                0
            };
            let needed = needed_bytes(count, stride, packed.saturating_sub(padding))
                .ok_or_else(|| json.fault("accessor range overflows"))?;
            if needed > bytes.len() as u64 {
                return Err(json.fault(format!(
                    "accessor range: count {count} of {packed} bytes at stride {stride} needs {needed} bytes, the bufferView has {}",
                    bytes.len()
                )));
            }
            Some((bytes, stride))
        }
    };
    let sparse = match json.object("sparse")? {
        Some(sparse) => Some(read_sparse(&sparse, views, count, packed)?),
        None => None,
    };
    Ok(Accessor { pointer: json.pointer().to_owned(), count, component, kind, normalized, data, sparse })
}

fn element_size(component: Component, rows: u64, columns: u64) -> u64 {
    let column = rows.saturating_mul(component.size() as u64);
    // Columns of a matrix start at multiples of 4 bytes.
    let column = if columns > 1 {
        column.next_multiple_of(4)
    } else {
        column
    };
    column.saturating_mul(columns)
}

fn needed_bytes(count: u64, stride: u64, packed: u64) -> Option<u64> {
    match count.checked_sub(1) {
        None => Some(0),
        Some(gaps) => gaps.checked_mul(stride)?.checked_add(packed),
    }
}

fn read_sparse<'a>(sparse: &Json, views: &'a [View<'a>], base: u64, packed: u64) -> Result<(Vec<u32>, &'a [u8])> {
    let count = sparse.need("count")?.as_u64()?;
    if count > base {
        return Err(sparse.fault(format!("sparse count {count} is over the accessor's count {base}")));
    }
    let side = |key: &str, size: u64| -> Result<(Json<'_>, &'a [u8])> {
        let json = sparse.need(key)?;
        let (bytes, stride) =
            view(&json, views)?.ok_or_else(|| json.fault("bufferView of the sparse data is missing"))?;
        if stride.is_some_and(|s| s != size) {
            return Err(json.fault("found a byteStride, expected packed sparse data"));
        }
        let needed = count.checked_mul(size).and_then(|n| usize::try_from(n).ok());
        let bytes = needed.and_then(|n| bytes.get(..n)).ok_or_else(|| {
            json.fault(format!(
                "sparse {key}: {count} of {size} bytes are out of range of the bufferView, which has {} left",
                bytes.len()
            ))
        })?;
        Ok((json, bytes))
    };
    let indices_json = sparse.need("indices")?;
    let component = component(&indices_json)?;
    if !matches!(component, Component::U8 | Component::U16 | Component::U32) {
        return Err(indices_json.fault(format!(
            "found sparse indices of componentType {}, expected unsigned integers",
            component_name(component)
        )));
    }
    let (json, bytes) = side("indices", component.size() as u64)?;
    let size = usize::try_from(component.size() as u64).unwrap_or(1);
    let indices: Vec<u32> = bytes.chunks_exact(size).map(unsigned).collect();
    if !indices.is_sorted_by(|a, b| a < b) {
        return Err(json.fault("sparse indices are not in strictly increasing order"));
    }
    if let Some(last) = indices.last().filter(|last| u64::from(**last) >= base) {
        return Err(json.fault(format!("found sparse index {last}, expected an index below the count {base}")));
    }
    Ok((indices, side("values", packed)?.1))
}

/// A little-endian unsigned integer of 1, 2 or 4 bytes.
fn unsigned(bytes: &[u8]) -> u32 {
    match *bytes {
        [a] => u32::from(a),
        [a, b] => u32::from(u16::from_le_bytes([a, b])),
        [a, b, c, d] => u32::from_le_bytes([a, b, c, d]),
        _ => 0,
    }
}

/// One component as a float; integers are scaled where the accessor is normalised.
fn float(bytes: &[u8], component: Component, normalized: bool) -> f32 {
    match (component, bytes) {
        (Component::F32, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
        (Component::I8, &[a]) if normalized => (f32::from(a.cast_signed()) / 127.0).max(-1.0),
        (Component::I8, &[a]) => f32::from(a.cast_signed()),
        (Component::U8, &[a]) if normalized => f32::from(a) / 255.0,
        (Component::I16, &[a, b]) if normalized => (f32::from(i16::from_le_bytes([a, b])) / 32767.0).max(-1.0),
        (Component::I16, &[a, b]) => f32::from(i16::from_le_bytes([a, b])),
        (Component::U16, &[a, b]) if normalized => f32::from(u16::from_le_bytes([a, b])) / 65535.0,
        (Component::U32, &[a, b, c, d]) if normalized => {
            (f64::from(u32::from_le_bytes([a, b, c, d])) / 4_294_967_295.0) as f32
        }
        _ => unsigned(bytes) as f32,
    }
}

impl Accessor<'_> {
    /// An error at this accessor.
    pub(super) fn fault(&self, message: impl AsRef<str>) -> Fault {
        Fault::new(&self.pointer, message)
    }

    /// Refuses an accessor of another type or component than the use allows.
    pub(super) fn expect(&self, what: &str, kinds: &[&str], components: &[Component], pointer: &str) -> Result<()> {
        if !kinds.contains(&self.kind) {
            return Err(Fault::new(
                pointer,
                format!("{what}: found accessor type {}, expected {}", self.kind, kinds.join(" or ")),
            ));
        }
        if !components.contains(&self.component) {
            let names: Vec<&str> = components.iter().copied().map(component_name).collect();
            return Err(Fault::new(
                pointer,
                format!(
                    "{what}: found componentType {}, expected {}",
                    component_name(self.component),
                    names.join(" or ")
                ),
            ));
        }
        Ok(())
    }

    /// Bytes of an element; empty reads as zero.
    fn element(&self, index: u32) -> &[u8] {
        if let Some((indices, values)) = &self.sparse
            && let Ok(at) = indices.binary_search(&index)
        {
            let size = values.len().checked_div(indices.len()).unwrap_or(0);
            let start = at.saturating_mul(size);
            return values.get(start..start.saturating_add(size)).unwrap_or_default();
        }
        let Some((bytes, stride)) = self.data else { return &[] };
        let start = usize::try_from(u64::from(index).saturating_mul(stride)).unwrap_or(usize::MAX);
        bytes.get(start..).unwrap_or_default()
    }

    /// `N` components of the chosen elements as floats. Non-finite values become 0; their number is returned as well.
    pub(super) fn floats<const N: usize>(&self, elements: impl Iterator<Item = u32>) -> (Vec<[f32; N]>, usize) {
        let size = usize::try_from(self.component.size() as u64).unwrap_or(1);
        let mut bad = 0usize;
        let rows = elements
            .map(|index| {
                let bytes = self.element(index);
                let mut row = [0.0f32; N];
                for (slot, chunk) in row.iter_mut().zip(bytes.chunks_exact(size)) {
                    let value = float(chunk, self.component, self.normalized);
                    if value.is_finite() {
                        *slot = value;
                    } else {
                        bad = bad.saturating_add(1);
                    }
                }
                row
            })
            .collect();
        (rows, bad)
    }

    /// [`Self::floats`] of all elements.
    pub(super) fn all_floats<const N: usize>(&self) -> Result<(Vec<[f32; N]>, usize)> {
        let count = u32::try_from(self.count).map_err(|_| self.fault("count is too large"))?;
        Ok(self.floats(0..count))
    }

    /// Elements as unsigned integers: `N` components each.
    pub(super) fn unsigned<const N: usize>(&self, elements: impl Iterator<Item = u32>) -> Vec<[u32; N]> {
        let size = usize::try_from(self.component.size() as u64).unwrap_or(1);
        elements
            .map(|index| {
                let mut row = [0u32; N];
                for (slot, chunk) in row.iter_mut().zip(self.element(index).chunks_exact(size)) {
                    *slot = unsigned(chunk);
                }
                row
            })
            .collect()
    }

    /// Like [`Self::floats`], with integers always scaled to 0..1: skin weights have no other meaning.
    pub(super) fn normalized_floats<const N: usize>(
        &self,
        elements: impl Iterator<Item = u32>,
    ) -> (Vec<[f32; N]>, usize) {
        let (mut rows, bad) = self.floats(elements);
        let scale = match (self.component, self.normalized) {
            (Component::U8, false) => 255.0,
            (Component::U16, false) => 65535.0,
            _ => return (rows, bad),
        };
        for value in rows.as_flattened_mut() {
            *value /= scale;
        }
        (rows, bad)
    }

    /// Whether nothing in the file backs the values: all are zero.
    pub(super) fn is_zero(&self) -> bool {
        self.data.is_none() && self.sparse.is_none()
    }
}
