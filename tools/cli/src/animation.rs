//! Animations of a few seconds, written frame by frame: GIF for the places that show nothing else, and lossless
//! animated WebP, which keeps every colour and the soft edges.

use std::cell::Cell;
use std::io::{self, Write};
use std::rc::Rc;

use image::codecs::gif::{GifEncoder, Repeat};
use image::codecs::webp::WebPEncoder;
use image::{Delay, ExtendedColorType, Frame, RgbaImage};

/// How fast the colours of a GIF frame are picked, from 1 (best) to 30: at 3 the colours are as close as at 1 to the
/// eye, in less than half the time.
const GIF_SPEED: i32 = 3;

/// The most that a RIFF file may say its size is (the header of eight bytes does not count).
const MAX_RIFF: usize = (u32::MAX - 9) as usize;

/// What an animation is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// 256 colours a frame; a pixel is either opaque or absent (alpha below one half). Delays are whole hundredths of
    /// a second.
    Gif,
    /// Lossless, with the alpha kept.
    Webp,
}

/// Frames of one size, RGBA8, straight alpha, rows from the top.
pub(crate) struct Animation {
    width: u32,
    height: u32,
    frame_ms: u32,
    frames: u32,
    writer: Writer,
}

/// What was encoded so far.
enum Writer {
    Gif { encoder: Box<GifEncoder<Sink>>, bytes: Sink },
    Webp { chunks: Vec<u8>, alpha: bool },
}

impl Animation {
    /// An animation without frames, in which each frame is to stay for `frame_ms` milliseconds.
    pub(crate) fn new(kind: Kind, width: u32, height: u32, frame_ms: u32) -> Result<Self, String> {
        let most = match kind {
            Kind::Gif => 65_535,
            Kind::Webp => 16_384,
        };
        if !(1..=most).contains(&width) || !(1..=most).contains(&height) {
            return Err(format!("an animation of {width}x{height} pixels: each side has to be from 1 to {most}"));
        }
        if !(10..=60_000).contains(&frame_ms) {
            return Err(format!("{frame_ms} ms a frame: has to be from 10 to 60000"));
        }
        let writer = match kind {
            Kind::Gif => {
                let bytes = Sink::default();
                let mut encoder = Box::new(GifEncoder::new_with_speed(bytes.clone(), GIF_SPEED));
                encoder.set_repeat(Repeat::Infinite).map_err(|error| error.to_string())?;
                Writer::Gif { encoder, bytes }
            }
            Kind::Webp => Writer::Webp { chunks: Vec::new(), alpha: false },
        };
        Ok(Self { width, height, frame_ms, frames: 0, writer })
    }

    /// Appends a frame. It is encoded at once, so that frames need not stay in memory.
    pub(crate) fn add(&mut self, rgba: &[u8]) -> Result<(), String> {
        let Self { width, height, frame_ms, .. } = *self;
        if rgba.len() as u64 != u64::from(width) * u64::from(height) * 4 {
            return Err(format!("a frame of {} bytes does not hold {width}x{height} RGBA pixels", rgba.len()));
        }
        match &mut self.writer {
            Writer::Gif { encoder, .. } => {
                let pixels = rgba.as_chunks().0.iter().flat_map(|&[r, g, b, a]| match a {
                    0..128 => [0; 4],
                    _ => [r, g, b, 255],
                });
                let image = RgbaImage::from_raw(width, height, pixels.collect()).ok_or("a frame of the wrong size")?;
                let delay = Delay::from_numer_denom_ms((frame_ms + 5) / 10 * 10, 1);
                encoder.encode_frame(Frame::from_parts(image, 0, 0, delay)).map_err(|error| error.to_string())?;
            }
            Writer::Webp { chunks, alpha } => {
                let mut file = Vec::new();
                WebPEncoder::new_lossless(&mut file)
                    .encode(rgba, width, height, ExtendedColorType::Rgba8)
                    .map_err(|error| error.to_string())?;
                let mut image = find_chunk(&file, b"VP8L").ok_or("the WebP encoder wrote no VP8L chunk")?.to_vec();
                let opaque = rgba.as_chunks().0.iter().all(|&[_, _, _, a]| a == 255);
                // The bit after the two sizes of 14 bits says whether the alpha is used.
                if let (true, Some(byte)) = (opaque, image.get_mut(4)) {
                    *byte &= !0x10;
                }
                let mut payload = Vec::with_capacity(image.len() + 26);
                payload.extend([0; 6]); // the position
                payload.extend(u24(width - 1));
                payload.extend(u24(height - 1));
                payload.extend(u24(frame_ms));
                payload.push(0b10); // replaces what is below, and stays
                push_chunk(&mut payload, b"VP8L", &image)?;
                push_chunk(chunks, b"ANMF", &payload)?;
                *alpha |= !opaque;
            }
        }
        self.frames += 1;
        Ok(())
    }

    /// The bytes of the file, which plays for ever. An animation without frames is an error.
    pub(crate) fn finish(self) -> Result<Vec<u8>, String> {
        if self.frames == 0 {
            return Err("an animation needs at least one frame".to_owned());
        }
        match self.writer {
            Writer::Gif { encoder, bytes } => {
                drop(encoder); // writes the trailer
                Ok(bytes.0.take())
            }
            Writer::Webp { chunks, alpha } => {
                let mut canvas = vec![0x02 | if alpha { 0x10 } else { 0 }, 0, 0, 0];
                canvas.extend(u24(self.width - 1));
                canvas.extend(u24(self.height - 1));
                let mut head = b"WEBP".to_vec();
                push_chunk(&mut head, b"VP8X", &canvas)?;
                push_chunk(&mut head, b"ANIM", &[0; 6])?; // the background; plays for ever
                let size = riff_size(head.len() + chunks.len())?;
                Ok([b"RIFF".as_slice(), &size.to_le_bytes(), &head, &chunks].concat())
            }
        }
    }
}

/// Bytes that an encoder writes to and that can be had once the encoder, which keeps its writer, is gone.
#[derive(Clone, Default)]
struct Sink(Rc<Cell<Vec<u8>>>);

impl Write for Sink {
    fn write(&mut self, data: &[u8]) -> io::Result<usize> {
        let mut bytes = self.0.take();
        bytes.extend_from_slice(data);
        self.0.set(bytes);
        Ok(data.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The low 24 bits of a number.
fn u24(value: u32) -> [u8; 3] {
    let [a, b, c, _] = value.to_le_bytes();
    [a, b, c]
}

/// A size, where a RIFF file can say it.
fn riff_size(size: usize) -> Result<u32, String> {
    if size > MAX_RIFF {
        return Err("the animation is larger than a WebP file can be (4 GiB)".to_owned());
    }
    u32::try_from(size).map_err(|error| error.to_string())
}

/// Appends a RIFF chunk, with the byte that makes its length even.
fn push_chunk(out: &mut Vec<u8>, name: &[u8; 4], payload: &[u8]) -> Result<(), String> {
    let size = riff_size(payload.len())?;
    riff_size(out.len().saturating_add(payload.len()).saturating_add(9))?;
    out.extend_from_slice(name);
    out.extend_from_slice(&size.to_le_bytes());
    out.extend_from_slice(payload);
    if payload.len() % 2 == 1 {
        out.push(0);
    }
    Ok(())
}

/// The payload of the first chunk of that name in a WebP file.
fn find_chunk<'a>(file: &'a [u8], name: &[u8; 4]) -> Option<&'a [u8]> {
    let mut rest = file.get(12..)?;
    loop {
        let (head, body) = rest.split_first_chunk::<8>()?;
        let [a, b, c, d, size @ ..] = *head;
        let size = usize::try_from(u32::from_le_bytes(size)).ok()?;
        if [a, b, c, d] == *name {
            return body.get(..size);
        }
        rest = body.get(size.checked_add(size % 2)?..)?;
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use image::codecs::webp::WebPDecoder;
    use image::metadata::LoopCount;

    use super::*;

    /// A disc of colour ramps with a soft edge (or none: opaque to the border), lit from a side that turns.
    fn frame(width: u32, height: u32, step: u32, opaque: bool) -> Vec<u8> {
        let mut out = Vec::new();
        for y in 0..height {
            for x in 0..width {
                let from_centre =
                    (f64::from(2 * x + 1) - f64::from(width)).hypot(f64::from(2 * y + 1) - f64::from(height));
                let alpha = if opaque {
                    255.0
                } else {
                    (f64::from(width.min(height)) - from_centre) * 64.0
                };
                let lit = if x * 8 > step * width { 1 } else { 2 };
                out.extend([(x * 7 % 256 / lit) as u8, (y * 5 % 256) as u8, (step * 30) as u8, alpha as u8]);
            }
        }
        out
    }

    fn write(kind: Kind, (width, height): (u32, u32), ms: u32, frames: &[Vec<u8>]) -> Vec<u8> {
        let mut animation = Animation::new(kind, width, height, ms).unwrap();
        for frame in frames {
            animation.add(frame).unwrap();
        }
        animation.finish().unwrap()
    }

    fn frames(size: (u32, u32), opaque: bool) -> Vec<Vec<u8>> {
        (0..5).map(|step| frame(size.0, size.1, step, opaque)).collect()
    }

    #[test]
    fn webp_gives_back_every_frame() {
        for size in [(64, 48), (33, 21), (1, 1), (5, 300)] {
            for opaque in [true, false] {
                let frames = frames(size, opaque);
                let file = write(Kind::Webp, size, 83, &frames);
                assert_eq!(file.len() % 2, 0);
                assert_eq!(file[4..8], (file.len() as u32 - 8).to_le_bytes());
                let alpha = frames.iter().flatten().skip(3).step_by(4).any(|&a| a < 255);
                assert_eq!(file[20] & 0x10 != 0, alpha);

                let decoder = WebPDecoder::new(Cursor::new(&file)).unwrap();
                assert!(decoder.has_animation());
                assert!(matches!(decoder.loop_count(), LoopCount::Infinite));
                let decoded = decoder.into_frames().collect_frames().unwrap();
                assert_eq!(decoded.len(), frames.len());
                for (decoded, frame) in decoded.into_iter().zip(&frames) {
                    assert_eq!(decoded.delay().numer_denom_ms(), (83, 1));
                    assert_eq!(decoded.buffer().dimensions(), size);
                    assert!(decoded.into_buffer().into_raw() == *frame, "{size:?} opaque: {opaque}");
                }
            }
        }
    }

    #[test]
    fn gif_keeps_size_count_delay_and_outline() {
        let size = (64, 48);
        let frames = frames(size, false);
        for (ms, written) in [(10, 10), (83, 80), (86, 90), (60_000, 60_000)] {
            let file = write(Kind::Gif, size, ms, &frames);
            assert_eq!(file.last(), Some(&0x3b));
            let decoder = GifDecoder::new(Cursor::new(&file)).unwrap();
            assert!(matches!(decoder.loop_count(), LoopCount::Infinite));
            let decoded = decoder.into_frames().collect_frames().unwrap();
            assert_eq!(decoded.len(), frames.len());
            for (decoded, frame) in decoded.into_iter().zip(&frames) {
                assert_eq!(decoded.delay().numer_denom_ms(), (written, 1));
                assert_eq!(decoded.buffer().dimensions(), size);
                let mut error = 0;
                for (decoded, pixel) in decoded.buffer().pixels().zip(frame.as_chunks::<4>().0) {
                    assert_eq!(decoded.0[3], if pixel[3] < 128 { 0 } else { 255 });
                    if pixel[3] >= 128 {
                        error += (0..3).map(|i| u32::from(decoded.0[i].abs_diff(pixel[i]))).sum::<u32>();
                    }
                }
                assert!(error < size.0 * size.1 * 3 * 8, "far from the frame: {error}");
            }
        }
    }

    #[test]
    fn few_colours_stay_exact_in_a_gif() {
        let frame = [[255, 0, 0, 255], [0, 255, 0, 255], [1, 2, 3, 255], [0; 4]].concat();
        let file = write(Kind::Gif, (2, 2), 100, std::slice::from_ref(&frame));
        let decoded = GifDecoder::new(Cursor::new(&file)).unwrap().into_frames().collect_frames().unwrap();
        assert_eq!(decoded[0].buffer().as_raw(), &frame);
    }

    #[test]
    fn same_frames_give_the_same_bytes() {
        for kind in [Kind::Gif, Kind::Webp] {
            let frames = frames((40, 30), false);
            assert!(write(kind, (40, 30), 50, &frames) == write(kind, (40, 30), 50, &frames));
        }
    }

    #[test]
    fn refuses_what_no_file_can_hold() {
        for (kind, most) in [(Kind::Gif, 65_535), (Kind::Webp, 16_384)] {
            for (width, height) in [(0, 1), (1, 0), (most + 1, 1), (1, most + 1), (u32::MAX, u32::MAX)] {
                assert!(Animation::new(kind, width, height, 50).is_err());
            }
            assert!(Animation::new(kind, most, most, 50).is_ok());
            for ms in [0, 9, 60_001, u32::MAX] {
                assert!(Animation::new(kind, 1, 1, ms).is_err());
            }
            let mut animation = Animation::new(kind, 4, 4, 50).unwrap();
            for length in [0, 63, 65, 48] {
                assert!(animation.add(&vec![0; length]).is_err());
            }
            assert!(animation.finish().is_err(), "no frame was added");
            let longest = vec![9; 4 * most as usize];
            assert!(!write(kind, (most, 1), 50, std::slice::from_ref(&longest)).is_empty());
        }
    }

    #[test]
    fn sizes_stop_at_what_riff_can_say() {
        assert_eq!(riff_size(MAX_RIFF), Ok(u32::MAX - 9));
        assert!(riff_size(MAX_RIFF + 1).is_err());
        assert!(riff_size(usize::MAX).is_err());
    }
}
