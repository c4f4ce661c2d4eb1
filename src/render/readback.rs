//! Texture to picture.

use std::time::Duration;

use crate::{
    Error, Gpu, Result,
    color::{linear_from_srgb, srgb_from_linear},
    scene::Image,
};

/// Copies rows of a texture to the CPU, without padding.
pub(crate) fn read_texels(gpu: &Gpu, texture: &wgpu::Texture, timeout: Duration) -> Result<Vec<u8>> {
    let (width, height) = (texture.width(), texture.height());
    let texel = texture.format().block_copy_size(None).unwrap_or(4);
    let row = width as usize * texel as usize;
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: padded as u64 * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("readback") });
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded as u32), rows_per_image: None },
        },
        wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
    );
    gpu.queue.submit([encoder.finish()]);
    let (sender, receiver) = std::sync::mpsc::channel();
    buffer.slice(..).map_async(wgpu::MapMode::Read, move |result| {
        // The receiver outlives the wait below; a closed channel means that nobody waits any more.
        let _ = sender.send(result);
    });
    gpu.wait(timeout)?;
    // Another thread may have found the work done, and still be on its way to say so.
    match receiver.recv_timeout(timeout) {
        Ok(Ok(())) => {}
        Ok(Err(e)) => return Err(Error::Gpu(format!("reading the picture back: {e}"))),
        Err(_) => return Err(Error::Gpu("reading the picture back: the adapter gave no answer".to_owned())),
    }
    let mapped =
        buffer.slice(..).get_mapped_range().map_err(|e| Error::Gpu(format!("reading the picture back: {e}")))?;
    let mut texels = Vec::with_capacity(row * height as usize);
    for line in mapped.chunks_exact(padded) {
        texels.extend_from_slice(&line[..row]);
    }
    Ok(texels)
}

/// Reads a texture back as a picture.
pub(crate) fn read(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Image> {
    check(texture.format())?;
    let texels = gpu.scoped(|| read_texels(gpu, texture, super::FRAME_TIMEOUT))??;
    Ok(picture([texture.width(), texture.height()], texture.format(), &texels))
}

/// Reads a texture of floats back.
pub(crate) fn read_linear(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<[f32; 4]>> {
    use wgpu::TextureFormat as F;
    let format = texture.format();
    if !matches!(format, F::Rgba16Float | F::Rgba32Float) {
        let message = format!("is {format:?}; expected Rgba16Float or Rgba32Float");
        return Err(Error::Argument { what: "texture format".to_owned(), message });
    }
    let texels = gpu.scoped(|| read_texels(gpu, texture, super::FRAME_TIMEOUT))??;
    Ok(texels
        .chunks_exact(if format == F::Rgba16Float { 8 } else { 16 })
        .map(|texel| std::array::from_fn(|i| float(format, texel, i)))
        .collect())
}

/// A channel of a texel of floats.
fn float(format: wgpu::TextureFormat, texel: &[u8], i: usize) -> f32 {
    match format {
        wgpu::TextureFormat::Rgba16Float => half::f16::from_le_bytes([texel[2 * i], texel[2 * i + 1]]).to_f32(),
        _ => f32::from_le_bytes(std::array::from_fn(|b| texel[4 * i + b])),
    }
}

/// Refuses a format that no picture is made of.
pub(crate) fn check(format: wgpu::TextureFormat) -> Result<()> {
    use wgpu::TextureFormat as F;
    match format {
        F::Rgba8Unorm | F::Rgba8UnormSrgb | F::Bgra8Unorm | F::Bgra8UnormSrgb | F::Rgba16Float | F::Rgba32Float => {
            Ok(())
        }
        other => Err(Error::Argument {
            what: "output format".to_owned(),
            message: format!(
                "is {other:?}, of which no picture is read back; expected Rgba8Unorm, Bgra8Unorm, Rgba16Float or Rgba32Float"
            ),
        }),
    }
}

/// Makes a picture of premultiplied texels of such a format, eight bits sRGB-encoded and floats linear: straight alpha, as
/// PNG wants it.
pub(crate) fn picture(size: [u32; 2], format: wgpu::TextureFormat, texels: &[u8]) -> Image {
    use wgpu::TextureFormat as F;
    let float = |t: &[u8], i: usize| float(format, t, i);
    let code = |linear: f32| (srgb_from_linear(linear) * 255.0).round() as u8;
    let mut pixels: Vec<u8> = match format {
        F::Rgba16Float | F::Rgba32Float => texels
            .chunks_exact(if format == F::Rgba16Float { 8 } else { 16 })
            .flat_map(|t| {
                let alpha = float(t, 3).clamp(0.0, 1.0);
                let straight = |i: usize| code(float(t, i) / alpha.max(1e-6));
                [straight(0), straight(1), straight(2), (alpha * 255.0).round() as u8]
            })
            .collect(),
        _ => texels.to_vec(),
    };
    for pixel in pixels.chunks_exact_mut(4) {
        if matches!(format, F::Bgra8Unorm | F::Bgra8UnormSrgb) {
            pixel.swap(0, 2);
        }
        let alpha = pixel[3];
        if alpha == 0 {
            pixel.fill(0);
        } else if alpha < 255 && !matches!(format, F::Rgba16Float | F::Rgba32Float) {
            let alpha = f32::from(alpha) / 255.0;
            for c in &mut pixel[..3] {
                *c = code(linear_from_srgb(f32::from(*c) / 255.0) / alpha);
            }
        }
    }
    Image { width: size[0], height: size[1], pixels, format: "png", source_bits: 8, ..Image::default() }
}

/// Sum of premultiplied texels of such a format in linear light, for their mean.
pub(crate) struct Sum {
    format: wgpu::TextureFormat,
    /// Linear light of each code of 8 bits.
    decoded: [f32; 256],
    sum: Vec<[f32; 4]>,
    count: u32,
}

impl Sum {
    pub fn new(format: wgpu::TextureFormat) -> Self {
        let decoded = std::array::from_fn(|code| linear_from_srgb(code as f32 / 255.0));
        Self { format, decoded, sum: Vec::new(), count: 0 }
    }

    /// Adds a picture, of the size of the others.
    pub fn add(&mut self, texels: &[u8]) {
        use wgpu::TextureFormat as F;
        let Self { format, decoded, sum, count } = self;
        let size = match format {
            F::Rgba16Float => 8,
            F::Rgba32Float => 16,
            _ => 4,
        };
        let is_bgra = matches!(format, F::Bgra8Unorm | F::Bgra8UnormSrgb);
        sum.resize(texels.len() / size, [0.0; 4]);
        *count += 1;
        for (sum, t) in sum.iter_mut().zip(texels.chunks_exact(size)) {
            let [r, g, b, a] = match format {
                F::Rgba16Float => std::array::from_fn(|i| half::f16::from_le_bytes([t[2 * i], t[2 * i + 1]]).to_f32()),
                F::Rgba32Float => std::array::from_fn(|i| f32::from_le_bytes([0, 1, 2, 3].map(|b| t[4 * i + b]))),
                _ => {
                    let [r, g, b] =
                        if is_bgra { [2, 1, 0] } else { [0, 1, 2] }.map(|i: usize| decoded[usize::from(t[i])]);
                    [r, g, b, f32::from(t[3]) / 255.0]
                }
            };
            // Light beyond white ends at white, as it does in each picture by itself.
            for (sum, c) in sum.iter_mut().zip([r, g, b, a]) {
                *sum += c.clamp(0.0, 1.0);
            }
        }
    }

    /// The mean: sRGB, straight alpha.
    pub fn picture(&self, [width, height]: [u32; 2]) -> Image {
        let code = |linear: f32| (srgb_from_linear(linear) * 255.0).round() as u8;
        let share = 1.0 / self.count.max(1) as f32;
        let pixel = |sum: &[f32; 4]| {
            let [r, g, b, a] = sum.map(|c| c * share);
            let alpha = (a.min(1.0) * 255.0).round() as u8;
            if alpha == 0 {
                return [0; 4];
            }
            let [r, g, b] = [r, g, b].map(|c| code(c / a));
            [r, g, b, alpha]
        };
        let pixels = self.sum.iter().flat_map(pixel).collect();
        Image { width, height, pixels, format: "png", source_bits: 8, ..Image::default() }
    }
}
