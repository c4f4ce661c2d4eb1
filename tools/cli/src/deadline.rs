//! `--timeout`: ends the program from another thread, as neither a hostile file nor a driver can be asked to stop.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::failure::Failure;

static USES_GPU: AtomicBool = AtomicBool::new(false);
static OVER: AtomicBool = AtomicBool::new(false);

/// Starts the clock.
pub(crate) fn start(seconds: f64) {
    std::thread::spawn(move || {
        std::thread::sleep(Duration::from_secs_f64(seconds));
        if OVER.swap(true, Ordering::SeqCst) {
            return;
        }
        let message = format!("not done after {seconds} s (--timeout)");
        let failure = if USES_GPU.load(Ordering::SeqCst) {
            Failure::gpu(message)
        } else {
            Failure::input(message)
        };
        failure.print();
        end(failure.status());
    });
}

/// Ends the program while other threads go on. What a graphics driver does at the exit of a process crashes where one of them is
/// still in it; another program in the place of this one has no such threads.
fn end(status: i32) -> ! {
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt;
        // It only comes back where there is no shell.
        let _ = std::process::Command::new("/bin/sh").args(["-c", &format!("exit {status}")]).exec();
    }
    std::process::exit(status);
}

/// From here on the graphics driver is to blame.
pub(crate) fn enter_gpu() {
    USES_GPU.store(true, Ordering::SeqCst);
}

/// Stops the clock, so that no file is cut off halfway.
pub(crate) fn stop() {
    if OVER.swap(true, Ordering::SeqCst) {
        // The clock won and is ending the program; nothing may be written any more.
        loop {
            std::thread::park();
        }
    }
}
