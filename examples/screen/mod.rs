//! A window with a device of its own: what any application on wgpu and winit does.

use std::{error::Error, sync::Arc};

use hikage::{Gpu, Output};
use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

pub struct Screen {
    pub window: Arc<Window>,
    pub gpu: Gpu,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
}

impl Screen {
    pub fn open(event_loop: &ActiveEventLoop, [width, height]: [u32; 2]) -> Result<Self, Box<dyn Error>> {
        let attributes = Window::default_attributes().with_title("Hikage");
        let attributes = attributes.with_inner_size(PhysicalSize::new(width, height));
        let window = Arc::new(event_loop.create_window(attributes)?);
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let surface = instance.create_surface(window.clone())?;
        let options = wgpu::RequestAdapterOptions { compatible_surface: Some(&surface), ..Default::default() };
        let adapter = pollster::block_on(instance.request_adapter(&options))?;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_limits: Gpu::required_limits(&adapter),
            required_features: Gpu::wanted_features(&adapter),
            ..Default::default()
        }))?;
        let gpu = Gpu::from_parts(&adapter, device, queue);
        let size = window.inner_size();
        let mut config = surface
            .get_default_config(&adapter, size.width.max(1), size.height.max(1))
            .ok_or("the adapter cannot show this window")?;
        let formats = surface.get_capabilities(&adapter).formats;
        config.format = formats.into_iter().find(wgpu::TextureFormat::is_srgb).unwrap_or(config.format);
        surface.configure(&gpu.device, &config);
        Ok(Self { window, gpu, surface, config })
    }

    /// What a renderer for it writes.
    pub fn output(&self) -> Output {
        Output { format: self.config.format, ..Output::default() }
    }

    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    pub fn resize(&mut self, size: PhysicalSize<u32>) {
        [self.config.width, self.config.height] = [size.width.max(1), size.height.max(1)];
        self.surface.configure(&self.gpu.device, &self.config);
    }

    /// Draws a frame and shows it; none where the window cannot take one now.
    pub fn show(
        &mut self,
        draw: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::TextureView) -> hikage::Result<()>,
    ) -> Result<(), Box<dyn Error>> {
        use wgpu::CurrentSurfaceTexture as Current;
        let frame = match self.surface.get_current_texture() {
            Current::Success(frame) | Current::Suboptimal(frame) => frame,
            Current::Outdated | Current::Lost => {
                self.surface.configure(&self.gpu.device, &self.config);
                return Ok(());
            }
            Current::Timeout | Current::Occluded => return Ok(()),
            Current::Validation => return Err("the window's surface is invalid".into()),
        };
        let target = frame.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        draw(&mut encoder, &target)?;
        self.gpu.queue.submit([encoder.finish()]);
        self.window.pre_present_notify();
        self.gpu.queue.present(frame);
        Ok(())
    }
}
