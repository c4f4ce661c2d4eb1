//! SVG path data, as segments that can be tweened: absolute, and every curve a cubic.

pub(super) const MAX_SEGMENTS: usize = 4096;
pub(super) const MAX_COORDINATE: f32 = 16.0;

/// What may stand between the numbers of a path.
const SEPARATORS: [char; 6] = [' ', '\t', '\n', '\r', '\x0c', ','];

pub(super) type Point = [f32; 2];

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verb {
    Move,
    Line,
    Curve,
    Close,
}

/// A segment of a path: the control points of a curve and where it ends. A line has them too, at its thirds, so that it
/// can be tweened with a curve; a close ends where its subpath begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    pub(super) verb: Verb,
    pub(super) points: [Point; 3],
}

pub(super) fn outside(n: f32) -> bool {
    !(-MAX_COORDINATE..=MAX_COORDINATE).contains(&n)
}

pub(super) fn too_far(n: f32) -> String {
    format!("found the coordinate {n}, expected -{MAX_COORDINATE}..={MAX_COORDINATE}")
}

/// The point a number of thirds on the way.
pub(super) fn mix(from: Point, to: Point, thirds: f32) -> Point {
    [0, 1].map(|i| from[i] + (to[i] - from[i]) * thirds / 3.0)
}

/// What is still unread of path data, and the command that is being read.
struct Reader<'a> {
    text: &'a str,
    rest: &'a str,
    command: char,
}

/// Parses SVG path data.
pub(super) fn segments(text: &str) -> Result<Vec<Segment>, String> {
    let mut out = Vec::new();
    let mut reader = Reader { text, rest: text, command: 'Z' };
    let (mut at, mut start) = ([0.0; 2], [0.0; 2]);
    // The last control points, which S and T mirror; the pen itself after other commands.
    let (mut cubic, mut quad) = (at, at);
    while let Some(letter) = reader.next_command()? {
        if out.len() == MAX_SEGMENTS {
            return Err(format!("found more than the expected {MAX_SEGMENTS} segments"));
        }
        if out.is_empty() && letter != 'M' {
            return Err(format!("found {} at its begin, expected M", reader.command));
        }
        let base = if reader.command.is_ascii_lowercase() {
            at
        } else {
            [0.0; 2]
        };
        let mut controls = (None, None);
        let (verb, points) = match letter {
            'M' => (Verb::Move, [reader.point(base)?; 3]),
            'L' | 'H' | 'V' => {
                let to = match letter {
                    'H' => [reader.coordinate(base[0])?, at[1]],
                    'V' => [at[0], reader.coordinate(base[1])?],
                    _ => reader.point(base)?,
                };
                (Verb::Line, [mix(at, to, 1.0), mix(at, to, 2.0), to])
            }
            'C' | 'S' => {
                let first = if letter == 'S' {
                    reader.mirror(cubic, at)?
                } else {
                    reader.point(base)?
                };
                let second = reader.point(base)?;
                controls.0 = Some(second);
                (Verb::Curve, [first, second, reader.point(base)?])
            }
            'Q' | 'T' => {
                let control = if letter == 'T' {
                    reader.mirror(quad, at)?
                } else {
                    reader.point(base)?
                };
                let to = reader.point(base)?;
                controls.1 = Some(control);
                (Verb::Curve, [mix(at, control, 2.0), mix(to, control, 2.0), to])
            }
            _ => (Verb::Close, [start; 3]),
        };
        at = points[2];
        if verb == Verb::Move {
            start = at;
        }
        (cubic, quad) = (controls.0.unwrap_or(at), controls.1.unwrap_or(at));
        out.push(Segment { verb, points });
    }
    Ok(out)
}

impl Reader<'_> {
    /// The next command as a capital letter; none at the end.
    fn next_command(&mut self) -> Result<Option<char>, String> {
        self.rest = self.rest.trim_start_matches(SEPARATORS);
        let Some(next) = self.rest.chars().next() else { return Ok(None) };
        match next {
            'M' | 'm' | 'L' | 'l' | 'H' | 'h' | 'V' | 'v' | 'C' | 'c' | 'S' | 's' | 'Q' | 'q' | 'T' | 't' | 'Z'
            | 'z' => {
                self.command = next;
                self.rest = &self.rest[1..];
            }
            'A' | 'a' => return Err(format!("{}, which is an arc: arcs are not known, expected curves", self.found())),
            '0'..='9' | '+' | '-' | '.' if !matches!(self.command, 'Z' | 'z') => {
                self.command = match self.command {
                    'M' => 'L',
                    'm' => 'l',
                    other => other,
                }
            }
            _ => return Err(format!("{}, expected a command: M, L, H, V, C, S, Q, T or Z", self.found())),
        }
        Ok(Some(self.command.to_ascii_uppercase()))
    }

    fn point(&mut self, base: Point) -> Result<Point, String> {
        Ok([self.coordinate(base[0])?, self.coordinate(base[1])?])
    }

    fn coordinate(&mut self, base: f32) -> Result<f32, String> {
        self.rest = self.rest.trim_start_matches(SEPARATORS);
        match self.number() {
            Some(number) => self.within(base + number),
            None => Err(format!("{}, expected a number for {}", self.found(), self.command)),
        }
    }

    fn mirror(&self, control: Point, at: Point) -> Result<Point, String> {
        Ok([self.within(2.0 * at[0] - control[0])?, self.within(2.0 * at[1] - control[1])?])
    }

    fn within(&self, n: f32) -> Result<f32, String> {
        if outside(n) {
            Err(format!("{} in {}", too_far(n), self.command))
        } else {
            Ok(n)
        }
    }

    /// A number by the grammar of SVG, which ends where the next sign or second point begins.
    fn number(&mut self) -> Option<f32> {
        let bytes = self.rest.as_bytes();
        let sign = |at: usize| at + usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
        let digits = |at: usize| at + bytes.iter().skip(at).take_while(|b| b.is_ascii_digit()).count();
        let mut end = digits(sign(0));
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if let Some(b'e' | b'E') = bytes.get(end) {
            let from = sign(end + 1);
            end = if digits(from) > from { digits(from) } else { end };
        }
        let number = self.rest[..end].parse().ok()?;
        self.rest = &self.rest[end..];
        Some(number)
    }

    fn found(&self) -> String {
        let place = self.text.len() - self.rest.len();
        match self.rest.chars().next() {
            Some(c) => format!("found {c:?} at byte {place}"),
            None => "found its end".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same segments, all absolute and each of them M, L, C or Z.
    fn same(path: &str, plain: &str) {
        let (path, plain) = (segments(path).unwrap(), segments(plain).unwrap());
        assert_eq!(path.len(), plain.len());
        for (a, b) in path.iter().zip(&plain) {
            assert_eq!(a.verb, b.verb);
            for (a, b) in a.points.as_flattened().iter().zip(b.points.as_flattened()) {
                assert!((a - b).abs() < 1e-5, "{path:?} is not {plain:?}");
            }
        }
    }

    #[test]
    fn commands() {
        same("m1 2 l1 1 h2 v3 z", "M1 2 L2 3 L4 3 L4 6 Z");
        same("M1 2 H5 V7 Z l1 1", "M1 2 L5 2 L5 7 Z L2 3");
        same("M1 1 c1 0 2 1 2 2 s1 3 2 2", "M1 1 C2 1 3 2 3 3 C3 4 4 6 5 5");
        same("M1 1 C2 1 3 2 3 3 S4 6 5 5", "M1 1 C2 1 3 2 3 3 C3 4 4 6 5 5");
        same("M0 0 Q3 0 3 3 T0 6", "M0 0 C2 0 3 1 3 3 C3 5 2 6 0 6");
        same("M0 0 q3 0 3 3 t-3 3", "M0 0 C2 0 3 1 3 3 C3 5 2 6 0 6");
        // Nothing to mirror after another kind of curve.
        same("M0 0 Q3 0 3 3 S6 6 3 6", "M0 0 C2 0 3 1 3 3 C3 3 6 6 3 6");
        same("M0 0 C1 0 3 1 3 3 T6 6", "M0 0 C1 0 3 1 3 3 C3 3 4 4 6 6");
        // Implicit repetition.
        same("M1 1 2 2 3 3", "M1 1 L2 2 L3 3");
        same("m1 1 1 1 1 1", "M1 1 L2 2 L3 3");
        same("M0 0 H1 2 V1 2", "M0 0 L1 0 L2 0 L2 1 L2 2");
        same("M0 0 1 0 Z m1 1 1 1", "M0 0 L1 0 Z M1 1 L2 2");
        // Separators.
        same("M10-5.5.5.25,,1e0\n+1E-1", "M 10 -5.5 L 0.5 0.25 L 1 0.1");
        same("M5.,5.e0", "M 5 5");
        same("\t M10-5L.5.5l1e-1,-.5E+0\r\n", "M 10 -5 L 0.5 0.5 L 0.6 0.0");
        assert_eq!(segments(" , "), Ok(Vec::new()));
    }

    #[test]
    fn faults_of_paths() {
        let fault = |path: &str| segments(path).unwrap_err();
        assert_eq!(fault("L 1 1"), "found L at its begin, expected M");
        assert_eq!(fault("1 1"), "found '1' at byte 0, expected a command: M, L, H, V, C, S, Q, T or Z");
        assert_eq!(fault("M 1"), "found its end, expected a number for M");
        assert_eq!(fault("M 1 1 L 2 x"), "found 'x' at byte 10, expected a number for L");
        assert_eq!(fault("M 1 1 c 1 1 2 é"), "found 'é' at byte 14, expected a number for c");
        assert_eq!(fault("M 1 1 Z 3"), "found '3' at byte 8, expected a command: M, L, H, V, C, S, Q, T or Z");
        assert!(fault("M 1 1 A 1 1 0 0 0 2 2").starts_with("found 'A' at byte 6, which is an arc"));
        assert!(fault("M NaN 1").starts_with("found 'N' at byte 2"));
        assert!(fault("M inf 1").starts_with("found 'i' at byte 2"));
        assert_eq!(fault("M 1e99 1"), "found the coordinate inf, expected -16..=16 in M");
        assert_eq!(fault("M 9 9 l 8 0"), "found the coordinate 17, expected -16..=16 in l");
        assert_eq!(fault("M 0 0 C 0 0 -9 0 9 9 S 0 0 0 0"), "found the coordinate 27, expected -16..=16 in S");
        assert!(fault("M 1 1 L 1e 1").starts_with("found 'e' at byte 9"));
        for number in [".", "-", "+.", ".e1", "--1"] {
            assert!(fault(&format!("M {number}")).contains("expected a number for M"));
        }
        assert_eq!(segments(&format!("M0 0{}", "h0".repeat(4095))).unwrap().len(), 4096);
        assert_eq!(fault(&format!("M0 0{}", "h0".repeat(4096))), "found more than the expected 4096 segments");
    }
}
