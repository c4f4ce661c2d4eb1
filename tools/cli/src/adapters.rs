//! `hikage adapters`.

use hikage::Gpu;

use crate::failure::Failure;
use crate::output::{Table, print, print_json};
use crate::{deadline, spinner::Spinner};

/// Arguments of `hikage adapters`.
#[derive(clap::Args)]
#[command(after_help = "Any part of a name selects the adapter: hikage render MODEL -o OUT.png --adapter llvmpipe")]
pub(crate) struct Args {
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    deadline::enter_gpu();
    let spinner = Spinner::new();
    spinner.step("asking the drivers");
    let adapters = Gpu::adapters();
    drop(spinner);
    if args.json {
        let list: Vec<_> = adapters
            .iter()
            .map(|a| serde_json::json!({"name": a.name, "backend": a.backend, "kind": a.kind, "driver": a.driver}))
            .collect();
        print_json(&list)?;
    } else {
        let mut table = Table::new(&["name", "backend", "kind", "driver"]);
        for a in &adapters {
            table.row([a.name.clone(), a.backend.clone(), a.kind.clone(), a.driver.clone()]);
        }
        print(&table.text())?;
    }
    if adapters.is_empty() {
        return Err(Failure::gpu(
            "no graphics adapter; on Debian or Ubuntu `apt-get install mesa-vulkan-drivers libvulkan1` brings one",
        ));
    }
    Ok(())
}
