//! Images to GPU textures: mip chains made on all cores, averaged in linear light where the image is a colour.

use std::{
    borrow::Cow,
    collections::{BTreeMap, BTreeSet, HashMap, hash_map::Entry},
    time::Duration,
};

use rayon::prelude::*;

use super::pass::fibre::{self, FibreInputs};
use super::targets::array_view;
use super::variants::Variants;
use crate::skin::{TABLE_SIZE, skin_table};
use crate::{
    Error, Gpu, Result,
    color::{linear_from_srgb, srgb_from_linear},
    gpu::MAX_TEXTURE_SIDE,
    material::{Encoding, Generated, Read},
    scene::{Filter, Image, Sampler, Texture, Wrap},
    sdf::FaceMap,
};

/// GPU textures and samplers of a scene, each made once.
#[derive(Debug)]
pub(crate) struct TextureSet {
    views: HashMap<(usize, Encoding), wgpu::TextureView>,
    samplers: HashMap<Sampler, wgpu::Sampler>,
    /// White, sRGB: stands where a material has no texture.
    pub white: wgpu::TextureView,
    /// The same where a shader expects layers.
    pub white_array: wgpu::TextureView,
    pub default_sampler: wgpu::Sampler,
    clamped_sampler: wgpu::Sampler,
    face_maps: Vec<wgpu::TextureView>,
    generated: HashMap<Generated, wgpu::TextureView>,
    /// Texel bytes of all textures, mips included.
    pub bytes: u64,
}

impl TextureSet {
    /// Uploads every image once for each encoding in `uses` (texture index, encoding). `take` hands over an image; it is
    /// asked once for each.
    pub fn new<'a>(
        gpu: &Gpu,
        textures: &[Texture],
        uses: &[(usize, Encoding)],
        face_maps: &[FaceMap],
        mut take: impl FnMut(usize) -> Option<Cow<'a, Image>>,
    ) -> Result<Self> {
        let mut wanted: BTreeMap<usize, BTreeSet<Encoding>> = BTreeMap::new();
        for (texture, encoding) in uses {
            if let Some(texture) = textures.get(*texture) {
                wanted.entry(texture.image).or_default().insert(*encoding);
            }
        }
        let tables = Tables::new();
        let mut views = HashMap::new();
        let mut bytes = 0;
        let wanted: Vec<(usize, BTreeSet<Encoding>)> = wanted.into_iter().collect();
        // A few at a time: mip chains are made on all cores, and only those of one batch live at once.
        for batch in wanted.chunks(rayon::current_num_threads().max(1)) {
            let images: Vec<(usize, Cow<'_, Image>, &BTreeSet<Encoding>)> =
                batch.iter().filter_map(|(index, encodings)| Some((*index, take(*index)?, encodings))).collect();
            images.iter().try_for_each(|(_, image, _)| check(image))?;
            let chains: Vec<(usize, &Image, Encoding, Vec<Level>)> = images
                .par_iter()
                .flat_map_iter(|(index, image, encodings)| encodings.iter().map(|e| (*index, &**image, *e)))
                .map(|(index, image, encoding)| (index, image, encoding, mip_chain(image, encoding, &tables)))
                .collect();
            for (index, image, encoding, mips) in &chains {
                views.insert((*index, *encoding), upload(gpu, image, mips, *encoding));
                bytes += image.pixels.len() as u64 + mips.iter().map(|l| l.pixels.len() as u64).sum::<u64>();
            }
            // Gives the staging memory of this batch back before the next one asks for more.
            gpu.queue.submit([]);
            gpu.wait(UPLOAD_TIMEOUT)?;
        }
        let white = Image { width: 1, height: 1, pixels: vec![255; 4], ..Image::default() };
        let mut samplers = HashMap::new();
        for texture in textures {
            samplers.entry(texture.sampler).or_insert_with(|| sampler(gpu, texture.sampler));
        }
        let white = upload(gpu, &white, &[], Encoding::Srgb);
        let clamp = Sampler { wrap_u: Wrap::Clamp, wrap_v: Wrap::Clamp, ..Sampler::default() };
        Ok(Self {
            views,
            samplers,
            white_array: array_view(white.texture()),
            white,
            generated: HashMap::new(),
            default_sampler: sampler(gpu, Sampler::default()),
            clamped_sampler: sampler(gpu, clamp),
            face_maps: face_maps.iter().map(|map| face_map(gpu, map)).collect::<Result<_>>()?,
            bytes: bytes + face_maps.iter().map(FaceMap::bytes).sum::<u64>(),
        })
    }

    /// Makes the textures that these numbers ask for.
    pub fn generate(&mut self, variants: &Variants, wanted: impl IntoIterator<Item = Generated>) -> Result<()> {
        for generated in wanted {
            if let Entry::Vacant(place) = self.generated.entry(generated) {
                let made = match generated {
                    Generated::Fibre { width, ior, is_gaussian } => {
                        let (width, ior) = (f32::from_bits(width), f32::from_bits(ior));
                        fibre::table(variants, FibreInputs { width, ior, is_gaussian })?
                    }
                    Generated::Skin(of) => {
                        let (profile, speculars) = of.numbers();
                        half_floats(&variants.gpu, "skin", TABLE_SIZE, &skin_table(&profile, &speculars))
                    }
                };
                place.insert(made);
            }
        }
        Ok(())
    }

    /// View and sampler of a generated texture, or white.
    pub fn generated(&self, generated: Generated) -> (&wgpu::TextureView, &wgpu::Sampler) {
        (self.generated.get(&generated).unwrap_or(&self.white), &self.clamped_sampler)
    }

    /// View and sampler of a face map, or white.
    pub fn face(&self, map: usize) -> (&wgpu::TextureView, &wgpu::Sampler) {
        (self.face_maps.get(map).unwrap_or(&self.white_array), &self.clamped_sampler)
    }

    /// View and sampler of a scene's texture, or white.
    pub fn get(&self, textures: &[Texture], texture: usize, read: Read) -> (&wgpu::TextureView, &wgpu::Sampler) {
        let texture = textures.get(texture);
        let found =
            texture.and_then(|t| Some((self.views.get(&(t.image, read.encoding))?, self.samplers.get(&t.sampler)?)));
        let (view, sampler) = found.unwrap_or((&self.white, &self.default_sampler));
        (view, if read.clamped { &self.clamped_sampler } else { sampler })
    }
}

/// A table of half floats.
fn half_floats(gpu: &Gpu, label: &str, [width, height]: [u32; 2], texels: &[[f32; 4]]) -> wgpu::TextureView {
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let bytes: Vec<u8> = texels.iter().flatten().flat_map(|c| half::f16::from_f32(*c).to_le_bytes()).collect();
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * 8), rows_per_image: None };
    gpu.queue.write_texture(texture.as_image_copy(), &bytes, layout, size);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Threshold maps of a face as one texture array; texels outside its border repeat it.
pub(crate) fn face_map(gpu: &Gpu, map: &FaceMap) -> Result<wgpu::TextureView> {
    map.check()?;
    if map.width.max(map.height) > MAX_TEXTURE_SIDE {
        return Err(Error::Argument {
            what: format!("face map {:?}", map.name),
            message: format!("is {}x{}; expected at most {MAX_TEXTURE_SIDE} texels a side", map.width, map.height),
        });
    }
    let layers: Vec<&[[u16; 4]]> = map.layers().collect();
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&map.name),
        size: wgpu::Extent3d { width: map.width, height: map.height, depth_or_array_layers: layers.len() as u32 },
        mip_level_count: map.width.max(map.height).ilog2() + 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        // 16-bit normalised formats are optional; half floats hold 11 bits of the upper half of the range and more below.
        format: if map.is_8_bit {
            wgpu::TextureFormat::Rgba8Unorm
        } else {
            wgpu::TextureFormat::Rgba16Float
        },
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (layer, texels) in (0..).zip(layers) {
        let (mut width, mut height) = (map.width, map.height);
        let mut level = Cow::Borrowed(texels);
        for mip_level in 0.. {
            let bytes: Vec<u8> = if map.is_8_bit {
                level.iter().flatten().map(|c| ((u32::from(*c) + 128) / 257) as u8).collect()
            } else {
                level
                    .iter()
                    .flatten()
                    .flat_map(|c| half::f16::from_f32(f32::from(*c) / 65535.0).to_le_bytes())
                    .collect()
            };
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &texture,
                    mip_level,
                    origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
                    aspect: wgpu::TextureAspect::All,
                },
                &bytes,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(width * if map.is_8_bit { 4 } else { 8 }),
                    rows_per_image: None,
                },
                wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            );
            if width == 1 && height == 1 {
                break;
            }
            level = Cow::Owned(halve_wide(&level, width, height));
            (width, height) = ((width / 2).max(1), (height / 2).max(1));
        }
    }
    Ok(array_view(&texture))
}

/// Box filter to half size.
fn halve_wide(source: &[[u16; 4]], width: u32, height: u32) -> Vec<[u16; 4]> {
    let (w, h) = ((width / 2).max(1), (height / 2).max(1));
    let at = |x: u32, y: u32| source[(y.min(height - 1) * width + x.min(width - 1)) as usize];
    let texel = |x: u32, y: u32| {
        let four = [at(2 * x, 2 * y), at(2 * x + 1, 2 * y), at(2 * x, 2 * y + 1), at(2 * x + 1, 2 * y + 1)];
        std::array::from_fn(|c| ((four.iter().map(|t| u32::from(t[c])).sum::<u32>() + 2) / 4) as u16)
    };
    (0..h).flat_map(|y| (0..w).map(move |x| (x, y))).map(|(x, y)| texel(x, y)).collect()
}

/// Longest wait for a batch of textures.
const UPLOAD_TIMEOUT: Duration = Duration::from_secs(120);

struct Level {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

/// Lookup tables of the transfer function: mips of a character's textures are tens of millions of conversions.
struct Tables {
    linear: [u16; 256],
    srgb: Vec<u8>,
}

impl Tables {
    fn new() -> Self {
        Self {
            linear: std::array::from_fn(|code| (linear_from_srgb(code as f32 / 255.0) * 65535.0).round() as u16),
            srgb: (0..=0xffffu32)
                .map(|linear| (srgb_from_linear(linear as f32 / 65535.0) * 255.0).round() as u8)
                .collect(),
        }
    }
}

/// All levels below the full size.
fn mip_chain(image: &Image, encoding: Encoding, tables: &Tables) -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    let (mut width, mut height) = (image.width, image.height);
    while width > 1 || height > 1 {
        let source = levels.last().map_or(image.pixels.as_slice(), |l| l.pixels.as_slice());
        let next = halve(source, width, height, encoding, tables);
        (width, height) = (next.width, next.height);
        levels.push(next);
    }
    levels
}

/// Box filter to half size; an odd last row or column counts twice in its own texel only.
fn halve(source: &[u8], width: u32, height: u32, encoding: Encoding, tables: &Tables) -> Level {
    let (w, h) = ((width / 2).max(1), (height / 2).max(1));
    let stride = width as usize * 4;
    let mut pixels = vec![0u8; w as usize * h as usize * 4];
    for (y, row) in pixels.chunks_exact_mut(w as usize * 4).enumerate() {
        let top = &source[(2 * y).min(height as usize - 1) * stride..][..stride];
        let bottom = &source[(2 * y + 1).min(height as usize - 1) * stride..][..stride];
        for (x, out) in row.chunks_exact_mut(4).enumerate() {
            let left = (2 * x).min(width as usize - 1) * 4;
            let right = (2 * x + 1).min(width as usize - 1) * 4;
            let texels =
                [&top[left..left + 4], &top[right..right + 4], &bottom[left..left + 4], &bottom[right..right + 4]];
            for c in 0..3 {
                out[c] = match encoding {
                    Encoding::Srgb => {
                        let sum: u32 = texels.iter().map(|t| u32::from(tables.linear[t[c] as usize])).sum();
                        tables.srgb[((sum + 2) / 4) as usize]
                    }
                    Encoding::Linear => average(texels.map(|t| t[c])),
                };
            }
            out[3] = average(texels.map(|t| t[3]));
        }
    }
    Level { width: w, height: h, pixels }
}

fn average(values: [u8; 4]) -> u8 {
    ((values.iter().map(|&v| u32::from(v)).sum::<u32>() + 2) / 4) as u8
}

/// A texture of one image alone.
pub(crate) fn single(gpu: &Gpu, image: &Image, encoding: Encoding) -> Result<wgpu::TextureView> {
    check(image)?;
    Ok(upload(gpu, image, &mip_chain(image, encoding, &Tables::new()), encoding))
}

/// Refuses an image whose bytes do not fit its size.
fn check(image: &Image) -> Result<()> {
    let side = image.width.max(image.height);
    if side > MAX_TEXTURE_SIDE || image.pixels.len() as u64 != u64::from(image.width) * u64::from(image.height) * 4 {
        return Err(Error::Argument {
            what: format!("image {:?}", image.name),
            message: format!(
                "is {}x{} with {} bytes; expected width * height * 4 bytes and at most {MAX_TEXTURE_SIDE} texels a side",
                image.width,
                image.height,
                image.pixels.len()
            ),
        });
    }
    Ok(())
}

fn upload(gpu: &Gpu, image: &Image, mips: &[Level], encoding: Encoding) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&image.name),
        size: wgpu::Extent3d { width: image.width, height: image.height, depth_or_array_layers: 1 },
        mip_level_count: mips.len() as u32 + 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: match encoding {
            Encoding::Srgb => wgpu::TextureFormat::Rgba8UnormSrgb,
            Encoding::Linear => wgpu::TextureFormat::Rgba8Unorm,
        },
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let full = (image.width, image.height, image.pixels.as_slice());
    let levels = std::iter::once(full).chain(mips.iter().map(|l| (l.width, l.height, l.pixels.as_slice())));
    for (mip_level, (width, height, pixels)) in levels.enumerate() {
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &texture,
                mip_level: mip_level as u32,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            pixels,
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * 4), rows_per_image: None },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn sampler(gpu: &Gpu, s: Sampler) -> wgpu::Sampler {
    let wrap = |w| match w {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    };
    let filter = |f| match f {
        Filter::Nearest => wgpu::FilterMode::Nearest,
        Filter::Linear => wgpu::FilterMode::Linear,
    };
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: None,
        address_mode_u: wrap(s.wrap_u),
        address_mode_v: wrap(s.wrap_v),
        mag_filter: filter(s.mag),
        min_filter: filter(s.min),
        mipmap_filter: match s.mip {
            Some(Filter::Linear) => wgpu::MipmapFilterMode::Linear,
            _ => wgpu::MipmapFilterMode::Nearest,
        },
        lod_max_clamp: if s.mip.is_some() { 32.0 } else { 0.0 },
        ..Default::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_mips_average_light_and_masks_average_numbers() {
        let image = Image { width: 2, height: 1, pixels: vec![0, 0, 0, 0, 255, 255, 255, 255], ..Image::default() };
        let tables = Tables::new();
        let srgb = mip_chain(&image, Encoding::Srgb, &tables);
        assert_eq!(srgb[0].pixels, [188, 188, 188, 128]);
        let linear = mip_chain(&image, Encoding::Linear, &tables);
        assert_eq!(linear[0].pixels, [128, 128, 128, 128]);
    }

    #[test]
    fn chains_end_at_one_texel_for_any_shape() {
        for (width, height) in [(1, 1), (1, 7), (5, 3), (64, 2)] {
            let image = Image { width, height, pixels: vec![200; (width * height * 4) as usize], ..Image::default() };
            let chain = mip_chain(&image, Encoding::Srgb, &Tables::new());
            assert_eq!(chain.len() as u32, width.max(height).ilog2());
            assert!(chain.iter().all(|l| l.pixels.iter().all(|&p| p == 200)), "flat colour stays flat");
        }
    }
}
