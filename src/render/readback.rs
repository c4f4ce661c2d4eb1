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

/// Makes a picture of sRGB-encoded premultiplied texels: straight alpha, as PNG wants it.
pub(crate) fn picture(size: [u32; 2], mut pixels: Vec<u8>) -> Image {
    for pixel in pixels.chunks_exact_mut(4) {
        let alpha = pixel[3];
        if alpha == 0 {
            pixel.fill(0);
        } else if alpha < 255 {
            let alpha = f32::from(alpha) / 255.0;
            for c in &mut pixel[..3] {
                let straight = linear_from_srgb(f32::from(*c) / 255.0) / alpha;
                *c = (srgb_from_linear(straight) * 255.0).round() as u8;
            }
        }
    }
    Image { width: size[0], height: size[1], pixels, format: "png", source_bits: 8, ..Image::default() }
}
