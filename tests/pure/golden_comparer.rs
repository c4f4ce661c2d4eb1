//! The golden comparer is tested itself: what it must reject, and what it must let pass.

use std::fs;
use std::path::PathBuf;

use hikage::golden::{Goldens, Report, Tolerance, compare, largest_blob};
use hikage::picture::{encode_png, read_png, write_atomic, write_png};
use hikage::scene::Image;

const SIDE: u32 = 192;

fn picture(pixel: impl Fn(u32, u32) -> [u8; 4]) -> Image {
    let pixels = (0..SIDE * SIDE).flat_map(|i| pixel(i % SIDE, i / SIDE)).collect();
    Image { width: SIDE, height: SIDE, pixels, ..Image::default() }
}

/// A disc of two tones with a thin dark line around it and one across.
fn drawing(outline: bool, shift_x: f32) -> Image {
    picture(|x, y| {
        let (dx, dy) = (x as f32 - shift_x - 96.0, y as f32 - 96.0);
        let radius = dx.hypot(dy);
        let line = outline && (radius - 70.0).abs() < 0.8 || radius < 60.0 && (dx + dy * 0.3).abs() < 0.7;
        match radius {
            _ if line => [40, 20, 24, 255],
            r if r > 70.0 => [128, 128, 128, 255],
            _ if dx + dy > 0.0 => [214, 150, 140, 255],
            _ => [250, 216, 204, 255],
        }
    })
}

fn judge(expected: &Image, actual: &Image, tolerance: &Tolerance) -> (Report, Option<String>) {
    let report = compare(expected, actual, tolerance).expect("same size");
    let fault = report.fault(tolerance);
    (report, fault)
}

fn rejects(expected: &Image, actual: &Image) -> String {
    judge(expected, actual, &Tolerance::default()).1.expect("must be rejected")
}

/// A deterministic scatter of numbers.
fn scatter(seed: u32) -> u32 {
    let mut h = seed.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995;
    h = (h ^ (h >> 15)).wrapping_mul(0x85eb_ca6b);
    (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35) ^ (h >> 7)
}

fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("golden_comparer").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(path.join("expected")).expect("temporary folder");
    path
}

#[test]
fn the_same_picture_passes_exactly() {
    let (report, fault) = judge(&drawing(true, 0.0), &drawing(true, 0.0), &Tolerance::EXACT);
    assert_eq!(fault, None);
    assert_eq!((report.mean_abs, report.max_abs, report.outliers, report.largest_blob), (0.0, 0, 0, None));
}

#[test]
fn noise_of_another_driver_passes() {
    let mut noisy = drawing(true, 0.0);
    for (i, value) in noisy.pixels.iter_mut().enumerate().filter(|(i, _)| i % 4 != 3) {
        *value = value.saturating_add_signed((scatter(i as u32) % 5) as i8 - 2);
    }
    // A few edge pixels that another rasteriser covers differently.
    for i in 0..12u32 {
        let at = (scatter(i + 7000) % (SIDE * SIDE)) as usize * 4;
        noisy.pixels[at] ^= 0x60;
    }
    let (report, fault) = judge(&drawing(true, 0.0), &noisy, &Tolerance::default());
    assert_eq!(fault, None, "{report:?}");
    assert!(report.outliers >= 10);
}

#[test]
fn a_shift_by_one_pixel_is_rejected() {
    let fault = rejects(&drawing(true, 0.0), &drawing(true, 1.0));
    assert!(fault.contains("lie together"), "{fault}");
}

#[test]
fn a_lost_outline_is_rejected_though_the_mean_is_small() {
    let (with, without) = (drawing(true, 0.0), drawing(false, 0.0));
    let fault = rejects(&with, &without);
    assert!(fault.contains("lie together"), "{fault}");

    // One hair-thin stroke alone: 24 pixels of 36,864, far below any mean, and below the share of outliers too.
    let mut stroke = with.clone();
    for y in 4..28usize {
        stroke.pixels[(y * SIDE as usize + 8) * 4] = 30;
    }
    let loose = Tolerance { outliers: 0.01, ..Tolerance::default() };
    let (report, fault) = judge(&stroke, &with, &loose);
    assert!(report.mean_abs < 0.03 && report.outlier_share() < 0.01);
    assert!(fault.is_some_and(|f| f.contains("(8, 4)..=(8, 27)")));
}

#[test]
fn a_hue_change_of_three_steps_is_rejected_even_where_each_pixel_is_within_tolerance() {
    let right = drawing(true, 0.0);
    let mut wrong = right.clone();
    for pixel in wrong.pixels.chunks_exact_mut(4).filter(|p| p[..3] == [250, 216, 204]) {
        pixel[1] += 3;
    }
    rejects(&right, &wrong);
    let coarse = Tolerance { channel: 8, outliers: 0.05, ..Tolerance::default() };
    let (report, fault) = judge(&right, &wrong, &coarse);
    assert_eq!(report.outliers, 0);
    assert!(fault.is_some_and(|f| f.contains("mean of the tile")));
}

#[test]
fn a_change_of_alpha_is_rejected_and_the_colour_under_alpha_0_is_not() {
    let right = picture(|x, _| [200, 100, 50, if x < 96 { 0 } else { 255 }]);
    let faded = picture(|x, _| [200, 100, 50, if x < 96 { 0 } else { 250 }]);
    let hidden = picture(|x, _| if x < 96 { [9, 9, 9, 0] } else { [200, 100, 50, 255] });
    rejects(&right, &faded);
    assert_eq!(judge(&right, &hidden, &Tolerance::EXACT).1, None);
}

#[test]
fn another_size_an_empty_picture_and_the_picture_itself_are_errors() {
    let right = drawing(true, 0.0);
    let mut cut = right.clone();
    cut.height -= 1;
    cut.pixels.truncate((SIDE * (SIDE - 1) * 4) as usize);
    let error = |a: &Image, b: &Image| compare(a, b, &Tolerance::default()).expect_err("must fail").to_string();
    assert!(error(&right, &cut).contains("192 x 191, expected 192 x 192"));
    assert!(error(&right, &right).contains("itself"));
    assert!(error(&Image::default(), &Image { name: "b".into(), ..Image::default() }).contains("itself"));
    let short = Image { pixels: vec![0; 8], ..right.clone() };
    assert!(error(&right, &short).contains("8 bytes"));
}

#[test]
fn blobs_join_over_corners_and_not_around_the_picture() {
    let mask: Vec<bool> = "x...x.x...xx........".bytes().map(|b| b == b'x').collect();
    let blob = largest_blob(&mask, 5).expect("something is set");
    // Row 0: columns 0 and 4; row 1: column 1; row 2: columns 0 and 1. Column 4 touches nothing.
    assert_eq!((blob.pixels, blob.min, blob.max), (4, [0, 0], [1, 2]));
    assert_eq!(largest_blob(&[false; 20], 5), None);
}

#[test]
fn a_missing_golden_fails_leaves_the_picture_and_is_not_blessed() {
    let folder = folder("missing");
    let goldens = Goldens { bless_command: "bless {name}".into(), ..Goldens::new(&folder) };
    for _ in 0..2 {
        let message =
            goldens.check("new", &drawing(true, 0.0), &Tolerance::default()).expect_err("no golden").to_string();
        assert!(message.contains("no such golden") && message.contains("bless new"), "{message}");
    }
    assert_eq!(read_png(folder.join("actual/new.png")).expect("saved").pixels, drawing(true, 0.0).pixels);
    assert_eq!(fs::read_dir(folder.join("expected")).expect("still there").count(), 0);
}

#[test]
fn a_failed_check_leaves_evidence_and_a_passed_one_removes_it() {
    let folder = folder("evidence");
    let goldens = Goldens::new(&folder);
    write_png(folder.join("expected/disc.png"), &drawing(true, 0.0)).expect("written");

    let error = goldens.check("disc", &drawing(false, 0.0), &Tolerance::default()).expect_err("lost outline");
    let diff = folder.join("actual/disc.diff.png");
    assert!(error.to_string().contains(&diff.display().to_string()), "{error}");
    let sheet = read_png(&diff).expect("diff");
    assert!(sheet.width > 3 * sheet.height - 100, "{} x {}", sheet.width, sheet.height);
    let red = sheet.pixels.chunks_exact(4).filter(|p| p[0] > 240 && p[1] < 64).count();
    assert!(red > 500, "the largest blob has a frame");

    goldens.check("disc", &drawing(true, 0.0), &Tolerance::EXACT).expect("same picture");
    assert_eq!(fs::read_dir(folder.join("actual")).expect("there").count(), 0);
}

#[test]
fn a_size_change_fails_with_a_sheet_of_both() {
    let folder = folder("size");
    write_png(folder.join("expected/a.png"), &drawing(true, 0.0)).expect("written");
    let small = Image { width: 4, height: 4, pixels: vec![255; 64], ..Image::default() };
    let error = Goldens::new(&folder).check("a", &small, &Tolerance::default()).expect_err("sizes differ");
    assert!(error.to_string().contains("is 4 x 4, expected 192 x 192"), "{error}");
    assert!(folder.join("actual/a.diff.png").is_file());
}

#[test]
fn one_folder_for_both_and_names_that_leave_it_are_refused() {
    let folder = folder("refused");
    let same = Goldens { actual: folder.join("expected/../expected"), ..Goldens::new(&folder) };
    write_png(folder.join("expected/a.png"), &drawing(true, 0.0)).expect("written");
    let check = |g: &Goldens, name: &str| g.check(name, &drawing(true, 0.0), &Tolerance::default()).is_err();
    assert!(check(&same, "a"));
    for name in ["", "../a", "a/b", "a\\b", ".a", "ä", "a\n"] {
        assert!(check(&Goldens::new(&folder), name), "{name:?}");
    }
}

#[test]
fn png_keeps_every_byte_and_is_always_the_same() {
    let odd = picture(|x, y| [x as u8, y as u8, (x ^ y) as u8, (x * y) as u8]);
    let path = folder("png").join("odd.png");
    write_png(&path, &odd).expect("written");
    assert_eq!(read_png(&path).expect("read").pixels, odd.pixels);
    assert_eq!(fs::read(&path).expect("bytes"), encode_png(&odd).expect("bytes"));
    assert!(encode_png(&Image::default()).is_err());
}

#[test]
fn atomic_writing_replaces_only_files_and_leaves_nothing_behind() {
    let folder = folder("atomic");
    let file = folder.join("file");
    write_atomic(&file, b"one").expect("new");
    write_atomic(&file, b"two").expect("replaced");
    assert_eq!(fs::read(&file).expect("read"), b"two");

    let error = write_atomic(folder.join("none/file"), b"x").expect_err("no folder").to_string();
    assert!(error.contains("none does not exist"), "{error}");
    write_atomic(folder.join("expected"), b"x").expect_err("a folder is no file");
    assert_eq!(fs::read_dir(&folder).expect("there").count(), 2);
}
