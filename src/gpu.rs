//! The graphics device: found headless, or taken from an application that has one.

use std::sync::Arc;

use serde::Serialize;

use crate::{Error, Result};

/// A graphics device and its queue. Clones are the same device; what one renderer uploads, others of the same may draw.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    info: AdapterInfo,
    /// What tells it from others: devices of several instances count as equal.
    identity: Arc<()>,
}

/// What an adapter is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct AdapterInfo {
    /// Name, as the driver states it.
    pub name: String,
    /// Graphics interface: `vulkan`, `metal`, `dx12`.
    pub backend: String,
    /// `discrete-gpu`, `integrated-gpu`, `virtual-gpu`, `cpu` or `other`.
    pub kind: String,
    /// Driver and its version.
    pub driver: String,
}

/// Most texels along one side of a texture or picture that Hikage asks of an adapter.
pub const MAX_TEXTURE_SIDE: u32 = 8192;

impl Gpu {
    /// Opens an adapter without a window.
    ///
    /// `name` is a part of the adapter's name or driver, in any case; without one the fastest kind is taken: discrete,
    /// integrated, virtual, then software.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] where no adapter exists or none has that name (the message lists what exists);
    /// [`Error::Gpu`] where the driver refuses a device.
    pub fn headless(name: Option<&str>) -> Result<Self> {
        let adapters = enumerate();
        let wanted = name.map(str::to_lowercase);
        let found = adapters
            .iter()
            .filter(|a| {
                let info = a.get_info();
                wanted.as_ref().is_none_or(|w| {
                    format!("{} {} {}", info.name, info.driver, info.driver_info).to_lowercase().contains(w.as_str())
                })
            })
            .min_by_key(|a| preference(a.get_info().device_type));
        let Some(adapter) = found else {
            return Err(no_adapter(name, &adapters));
        };
        let limits = wgpu::Limits { max_texture_dimension_2d: MAX_TEXTURE_SIDE, ..Self::required_limits(adapter) };
        let features = Self::wanted_features(adapter);
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("hikage"),
            required_features: features,
            required_limits: limits,
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        }))
        .map_err(|e| Error::Gpu(e.to_string()))?;
        Ok(Self::from_parts(adapter, device, queue))
    }

    /// Takes the device of an application. It needs at least [`Gpu::required_limits`], and should have
    /// [`Gpu::wanted_features`].
    #[must_use]
    pub fn from_parts(adapter: &wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        Self { device, queue, info: describe(&adapter.get_info()), identity: Arc::default() }
    }

    /// Limits that Hikage needs: WebGPU's defaults, with buffers as large as the adapter has them.
    #[must_use]
    pub fn required_limits(adapter: &wgpu::Adapter) -> wgpu::Limits {
        let most = adapter.limits();
        wgpu::Limits {
            max_buffer_size: most.max_buffer_size,
            max_storage_buffer_binding_size: most.max_storage_buffer_binding_size,
            ..wgpu::Limits::default()
        }
    }

    /// Features of the adapter that Hikage uses where a device has them: a stencil beside 32 bits of depth for eyes through
    /// hair, which stays away without it, and timestamps for the times of passes.
    #[must_use]
    pub fn wanted_features(adapter: &wgpu::Adapter) -> wgpu::Features {
        adapter.features() & (wgpu::Features::DEPTH32FLOAT_STENCIL8 | wgpu::Features::TIMESTAMP_QUERY)
    }

    /// Refuses a device with smaller limits than WebGPU's defaults; buffers may be smaller.
    pub(crate) fn check_limits(&self) -> Result<()> {
        let has = self.device.limits();
        let needed = wgpu::Limits {
            max_buffer_size: has.max_buffer_size,
            max_storage_buffer_binding_size: has.max_storage_buffer_binding_size,
            ..wgpu::Limits::default()
        };
        let mut faults = Vec::new();
        needed.check_limits_with_fail_fn(&has, false, |name, needed, has| {
            faults.push(format!("{name} is {has}, {needed} are needed"));
        });
        if faults.is_empty() {
            return Ok(());
        }
        let faults = faults.join("; ");
        Err(Error::Gpu(format!("the device is too small: {faults}; please request it with Gpu::required_limits")))
    }

    /// All adapters of this machine.
    #[must_use]
    pub fn adapters() -> Vec<AdapterInfo> {
        enumerate().iter().map(|a| describe(&a.get_info())).collect()
    }

    /// What the adapter is.
    #[must_use]
    pub fn info(&self) -> &AdapterInfo {
        &self.info
    }

    /// Whether it is a clone of another.
    pub(crate) fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.identity, &other.identity)
    }

    /// Runs `work` and turns the validation and memory errors that it causes into an [`Error::Gpu`].
    pub(crate) fn scoped<T>(&self, work: impl FnOnce() -> T) -> Result<T> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let value = work();
        let faults = [pollster::block_on(validation.pop()), pollster::block_on(memory.pop())];
        match faults.into_iter().flatten().next() {
            Some(_) if self.is_lost() => {
                let message =
                    "the device is lost: destroyed, or its driver was reset; please open another one and upload again";
                Err(Error::Gpu(message.to_owned()))
            }
            Some(error) => Err(Error::Gpu(error.to_string().replace('\n', " "))),
            None => Ok(value),
        }
    }

    /// Whether it makes nothing any more. Its callback for that belongs to the application.
    fn is_lost(&self) -> bool {
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let probe = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("probe"),
            size: wgpu::COPY_BUFFER_ALIGNMENT,
            usage: wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: true,
        });
        let is_lost = probe.get_mapped_range_mut(..).is_err();
        pollster::block_on(scope.pop());
        is_lost
    }

    /// Waits until all submitted work is done.
    pub(crate) fn wait(&self, timeout: std::time::Duration) -> Result<()> {
        let poll = wgpu::PollType::Wait { submission_index: None, timeout: Some(timeout) };
        self.device.poll(poll).map(|_| ()).map_err(|e| Error::Gpu(format!("waiting for the adapter: {e}")))
    }
}

fn enumerate() -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY))
}

fn preference(kind: wgpu::DeviceType) -> u8 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Cpu => 3,
        wgpu::DeviceType::Other => 4,
    }
}

fn describe(info: &wgpu::AdapterInfo) -> AdapterInfo {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete-gpu",
        wgpu::DeviceType::IntegratedGpu => "integrated-gpu",
        wgpu::DeviceType::VirtualGpu => "virtual-gpu",
        wgpu::DeviceType::Cpu => "cpu",
        wgpu::DeviceType::Other => "other",
    };
    AdapterInfo {
        name: info.name.clone(),
        backend: info.backend.to_str().to_owned(),
        kind: kind.to_owned(),
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
    }
}

fn no_adapter(name: Option<&str>, adapters: &[wgpu::Adapter]) -> Error {
    let message = match (name, adapters.is_empty()) {
        (_, true) => "none found; `cargo xtask demo` installs Mesa's software Vulkan driver on Debian and Ubuntu as \
                      root, or run `apt-get install mesa-vulkan-drivers`"
            .to_owned(),
        (name, false) => format!(
            "none is named {:?}; there are: {}",
            name.unwrap_or_default(),
            adapters.iter().map(|a| format!("{:?}", a.get_info().name)).collect::<Vec<_>>().join(", ")
        ),
    };
    Error::NoAdapter { message }
}
