//! Textures, samplers and images that something uses; nothing else is decoded.

use std::collections::BTreeMap;
use std::path::Path;

use rayon::prelude::*;

use crate::material::{TextureRef, UvTransform};
use crate::scene::{Filter, Image, Sampler, Texture, Wrap};

use super::buffers::{View, image_bytes};
use super::fault::{Limits, Result, within};
use super::files::parse_uri;
use super::image::probe;
use super::json::Json;
use super::warnings::Warnings;

/// Textures of the file, and those of them that materials asked for.
#[derive(Debug)]
pub(super) struct Textures<'a> {
    json: Vec<Json<'a>>,
    samplers: Vec<Sampler>,
    images: Vec<Json<'a>>,
    /// Textures of the scene, by their index in the file.
    by_source: BTreeMap<usize, usize>,
    /// Images of the scene, by their index in the file.
    image_by_source: BTreeMap<usize, usize>,
    used_images: Vec<usize>,
    pub(super) textures: Vec<Texture>,
}

impl<'a> Textures<'a> {
    /// Checks textures, samplers, images and their URIs. Opens nothing.
    pub(super) fn read(root: &Json<'a>, views: usize) -> Result<Self> {
        let samplers = root.objects("samplers")?.iter().map(read_sampler).collect::<Result<Vec<_>>>()?;
        let images = root.objects("images")?;
        for image in &images {
            image.index("bufferView", views, "bufferViews")?;
            if let Some(uri) = image.str("uri")? {
                parse_uri(&format!("{}/uri", image.pointer()), uri)?;
            }
        }
        let json = root.objects("textures")?;
        for texture in &json {
            texture.index("sampler", samplers.len(), "samplers")?;
            texture.index("source", images.len(), "images")?;
        }
        Ok(Self {
            json,
            samplers,
            images,
            by_source: BTreeMap::new(),
            image_by_source: BTreeMap::new(),
            used_images: Vec::new(),
            textures: Vec::new(),
        })
    }

    /// How many textures the file has.
    pub(super) fn len(&self) -> usize {
        self.json.len()
    }

    /// The scene's index of a texture of the file; `None` where it has no image that we read.
    pub(super) fn resolve(&mut self, index: usize, warnings: &mut Warnings) -> Result<Option<usize>> {
        if let Some(known) = self.by_source.get(&index) {
            return Ok(Some(*known));
        }
        let Some(json) = self.json.get(index) else { return Ok(None) };
        let webp = match json.extension("EXT_texture_webp")? {
            Some(webp) => webp.index("source", self.images.len(), "images")?,
            None => None,
        };
        let Some(source) = webp.or(json.index("source", self.images.len(), "images")?) else {
            warnings.add(json.pointer(), "texture without an image in a supported format: left out");
            return Ok(None);
        };
        let used = &mut self.used_images;
        let image = *self.image_by_source.entry(source).or_insert_with(|| {
            used.push(source);
            used.len().saturating_sub(1)
        });
        let sampler = json.index("sampler", self.samplers.len(), "samplers")?;
        let sampler = sampler.and_then(|s| self.samplers.get(s)).copied().unwrap_or_default();
        let slot = self.textures.len();
        self.textures.push(Texture { image, sampler });
        self.by_source.insert(index, slot);
        Ok(Some(slot))
    }

    /// A texture info object (`index`, `texCoord`, `KHR_texture_transform`) under a key.
    ///
    /// `uv_set` is the number of the `TEXCOORD` attribute until the material's sets are gathered.
    pub(super) fn info(&mut self, json: &Json, key: &str, warnings: &mut Warnings) -> Result<Option<TextureRef>> {
        let Some(info) = json.object(key)? else { return Ok(None) };
        let index = info.need("index")?.as_index(self.len(), "textures")?;
        let Some(texture) = self.resolve(index, warnings)? else { return Ok(None) };
        let mut uv_set = info.u64("texCoord")?.unwrap_or(0);
        let mut transform = UvTransform::default();
        if let Some(ext) = info.extension("KHR_texture_transform")? {
            transform.offset = ext.floats("offset")?.unwrap_or(transform.offset);
            transform.rotation_rad = ext.f32("rotation")?.unwrap_or(transform.rotation_rad);
            transform.scale = ext.floats("scale")?.unwrap_or(transform.scale);
            uv_set = ext.u64("texCoord")?.unwrap_or(uv_set);
        }
        let uv_set = u32::try_from(uv_set)
            .map_err(|_| info.fault(format!("found texCoord {uv_set}, expected a small integer")))?;
        Ok(Some(TextureRef { texture, uv_set, transform }))
    }

    /// Decodes the images that textures use, each once, in parallel.
    pub(super) fn decode(
        &self,
        views: &[View<'_>],
        folder: Option<&Path>,
        limits: &Limits,
        warnings: &mut Warnings,
    ) -> Result<Vec<Image>> {
        let sources: Vec<_> = self.used_images.iter().filter_map(|i| self.images.get(*i)).collect();
        let mut files = Vec::with_capacity(sources.len());
        for image in &sources {
            files.push(image_bytes(image, views, folder, limits)?);
        }
        let mut probes = Vec::with_capacity(files.len());
        let mut total = 0u64;
        for (image, bytes) in sources.iter().zip(&files) {
            let name = image.str("uri")?.filter(|u| !u.starts_with("data:")).unwrap_or_default();
            let probe = probe(image.pointer(), bytes, limits).map_err(|fault| named(fault, name))?;
            total = total.saturating_add(probe.texture_bytes());
            within(image.pointer(), total, limits.image_bytes, "bytes of decoded images")?;
            if let Some(mime) = image.str("mimeType")?
                && mime != probe.mime()
            {
                warnings.add(image.pointer(), format!("mimeType does not fit the data, which is {}", probe.mime()));
            }
            probes.push(probe);
        }
        probes
            .into_par_iter()
            .zip(sources)
            .map(|(probe, json)| {
                let mut image = probe.decode(json.pointer(), limits)?;
                let uri = json.str("uri")?.filter(|u| !u.starts_with("data:")).unwrap_or_default();
                image.name = json.name()?;
                if image.name.is_empty() {
                    image.name = uri.chars().take(1000).collect();
                }
                Ok(image)
            })
            .collect()
    }
}

/// Adds the file name to an image's error.
fn named(fault: super::fault::Fault, name: &str) -> super::fault::Fault {
    match fault {
        super::fault::Fault::Input { pointer, message } if !name.is_empty() => {
            super::fault::Fault::new(pointer, format!("{}: {message}", super::fault::quoted(name)))
        }
        other => other,
    }
}

fn read_sampler(json: &Json) -> Result<Sampler> {
    let wrap = |key: &str| -> Result<Wrap> {
        Ok(match json.u64(key)?.unwrap_or(10497) {
            33071 => Wrap::Clamp,
            33648 => Wrap::Mirror,
            10497 => Wrap::Repeat,
            other => return Err(json.fault(format!("found {key} {other}, expected 33071, 33648 or 10497"))),
        })
    };
    let mag = match json.u64("magFilter")?.unwrap_or(9729) {
        9728 => Filter::Nearest,
        9729 => Filter::Linear,
        other => return Err(json.fault(format!("found magFilter {other}, expected 9728 or 9729"))),
    };
    let (min, mip) = match json.u64("minFilter")? {
        None | Some(9987) => (Filter::Linear, Some(Filter::Linear)),
        Some(9728) => (Filter::Nearest, None),
        Some(9729) => (Filter::Linear, None),
        Some(9984) => (Filter::Nearest, Some(Filter::Nearest)),
        Some(9985) => (Filter::Linear, Some(Filter::Nearest)),
        Some(9986) => (Filter::Nearest, Some(Filter::Linear)),
        Some(other) => return Err(json.fault(format!("found minFilter {other}, expected 9728, 9729 or 9984 to 9987"))),
    };
    Ok(Sampler { wrap_u: wrap("wrapS")?, wrap_v: wrap("wrapT")?, mag, min, mip })
}
