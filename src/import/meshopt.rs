//! `EXT_meshopt_compression`: sizes are checked here, the meshopt crate decodes.

use ::meshopt as codec;

use super::fault::Result;
use super::json::Json;

/// What a compressed view says about itself.
#[derive(Debug)]
pub(super) struct Header {
    mode: Mode,
    filter: Filter,
    count: u64,
    stride: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Filter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
}

impl Header {
    /// Reads and checks the extension object.
    pub(super) fn read(json: &Json) -> Result<Self> {
        let mode = match json.need("mode")?.as_str()? {
            "ATTRIBUTES" => Mode::Attributes,
            "TRIANGLES" => Mode::Triangles,
            "INDICES" => Mode::Indices,
            other => {
                return Err(json.fault(format!(
                    "found mode {}, expected ATTRIBUTES, TRIANGLES or INDICES",
                    super::fault::quoted(other)
                )));
            }
        };
        let filter = match json.str("filter")?.unwrap_or("NONE") {
            "NONE" => Filter::None,
            "OCTAHEDRAL" => Filter::Octahedral,
            "QUATERNION" => Filter::Quaternion,
            "EXPONENTIAL" => Filter::Exponential,
            other => {
                return Err(json.fault(format!(
                    "found filter {}, expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL",
                    super::fault::quoted(other)
                )));
            }
        };
        let count = json.need("count")?.as_u64()?;
        let stride = json.need("byteStride")?.as_u64()?;
        let fits = match (mode, filter) {
            (Mode::Attributes, Filter::None | Filter::Exponential) => {
                stride.is_multiple_of(4) && (4..=256).contains(&stride)
            }
            (Mode::Attributes, Filter::Octahedral) => stride == 4 || stride == 8,
            (Mode::Attributes, Filter::Quaternion) => stride == 8,
            (_, Filter::None) => stride == 2 || stride == 4,
            _ => return Err(json.fault("found a filter on indices, expected none")),
        };
        if !fits {
            return Err(json.fault(format!("byteStride {stride} does not fit the mode and filter")));
        }
        if mode == Mode::Triangles && !count.is_multiple_of(3) {
            return Err(json.fault(format!("found count {count}, expected a multiple of 3")));
        }
        Ok(Self { mode, filter, count, stride })
    }

    /// Bytes after decoding; refuses counts that no source of this length can hold.
    pub(super) fn decoded_bytes(&self, json: &Json, source: usize) -> Result<u64> {
        // The densest stream still spends a bit on each block of 16 vertices a byte of stride, or a byte a triangle.
        let most = (source as u64).saturating_mul(256);
        if self.count > most {
            return Err(json.fault(format!("count {} is too large for {source} compressed bytes", self.count)));
        }
        self.count.checked_mul(self.stride).ok_or_else(|| json.fault("count times byteStride overflows"))
    }
}

/// Decodes a view.
pub(super) fn decode(json: &Json, header: &Header, source: &[u8]) -> Result<Vec<u8>> {
    let count = usize::try_from(header.count).map_err(|_| json.fault("count is too large"))?;
    if count == 0 {
        return Ok(Vec::new());
    }
    let decoded = match (header.mode, header.stride) {
        (Mode::Triangles, 2) => {
            codec::decode_index_buffer::<u16>(source, count).map(|v| bytemuck::cast_slice(&v).to_vec())
        }
        (Mode::Triangles, _) => {
            codec::decode_index_buffer::<u32>(source, count).map(|v| bytemuck::cast_slice(&v).to_vec())
        }
        (Mode::Indices, 2) => {
            codec::decode_index_sequence::<u16>(source, count).map(|v| bytemuck::cast_slice(&v).to_vec())
        }
        (Mode::Indices, _) => {
            codec::decode_index_sequence::<u32>(source, count).map(|v| bytemuck::cast_slice(&v).to_vec())
        }
        (Mode::Attributes, stride) => attributes(source, count, stride, header.filter),
    };
    decoded.map_err(|e| json.fault(format!("compressed data is corrupt: {e}")))
}

/// A vertex of `N` words; arrays have no default beyond 32.
#[derive(Clone, Copy)]
struct Row<const N: usize>([u32; N]);

impl<const N: usize> Default for Row<N> {
    fn default() -> Self {
        Self([0; N])
    }
}

/// Calls the codec with the array length that it wants as a type.
macro_rules! by_stride {
    ($stride:expr, $source:expr, $count:expr, [$($words:literal)+]) => {
        match $stride / 4 {
            $($words => {
                let rows = codec::decode_vertex_buffer::<Row<$words>>($source, $count)?;
                rows.into_iter().flat_map(|row| row.0).collect()
            })+
            _ => Vec::new(),
        }
    };
}

fn attributes(source: &[u8], count: usize, stride: u64, filter: Filter) -> codec::Result<Vec<u8>> {
    Ok(match (filter, stride) {
        (Filter::Octahedral, 4) => {
            let mut rows = codec::decode_vertex_buffer::<[i8; 4]>(source, count)?;
            codec::decode_filter_oct(&mut rows);
            bytemuck::cast_slice(rows.as_flattened()).to_vec()
        }
        (Filter::Octahedral, _) => {
            let mut rows = codec::decode_vertex_buffer::<[i16; 4]>(source, count)?;
            codec::decode_filter_oct(&mut rows);
            bytemuck::cast_slice(rows.as_flattened()).to_vec()
        }
        (Filter::Quaternion, _) => {
            let mut rows = codec::decode_vertex_buffer::<[i16; 4]>(source, count)?;
            codec::decode_filter_quat(&mut rows);
            bytemuck::cast_slice(rows.as_flattened()).to_vec()
        }
        _ => {
            let mut words: Vec<u32> = by_stride!(stride, source, count, [
            1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32
            33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64
            ]);
            if filter == Filter::Exponential {
                let (words, _) = words.as_chunks_mut::<1>();
                codec::decode_filter_exp(words);
            }
            bytemuck::cast_slice(&words).to_vec()
        }
    })
}
