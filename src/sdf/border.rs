//! Where in a texel the border of an antialiased mask runs, from its coverage (Gustavson and Strand 2011).

/// Distances from the centres of texels along a border to that border; where none is known, half a texel.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Border {
    /// Where the texels of a row begin; one more than there are rows.
    rows: Vec<u32>,
    /// Column, and distance that is positive outside of the light, from the left.
    texels: Vec<(u16, f32)>,
}

/// What a mask without grey texels has everywhere.
pub(super) const HALF: f32 = 0.5;

impl Border {
    /// Texels of a row in a range of columns.
    fn row(&self, y: usize, left: usize, right: usize) -> &[(u16, f32)] {
        let (Some(from), Some(to)) = (self.rows.get(y), self.rows.get(y + 1)) else { return &[] };
        let row = &self.texels[*from as usize..*to as usize];
        let row = &row[row.partition_point(|t| usize::from(t.0) < left)..];
        &row[..row.partition_point(|t| usize::from(t.0) <= right)]
    }
}

/// What a border says round one texel; kept, as the next texel of a row mostly has the same nearest.
pub(super) struct Around<'a> {
    border: &'a Border,
    site: [usize; 2],
    /// Columns, rows, and what the border lies before them, of texels on the site's side.
    bounds: [[f64; 3]; 9],
    count: usize,
}

impl<'a> Around<'a> {
    pub(super) fn new(border: &'a Border) -> Self {
        Self { border, site: [usize::MAX; 2], bounds: [[0.0; 3]; 9], count: 0 }
    }

    /// Distance from a texel to the border before another one, which is the nearest on its other side: the least that this
    /// one and those round it say, each of which is an upper bound.
    pub(super) fn distance(&mut self, from: [usize; 2], site: [usize; 2]) -> f64 {
        if self.site != site {
            self.site = site;
            self.collect();
        }
        let [x, y] = from.map(|c| c as f64);
        let bounds = self.bounds[..self.count].iter();
        let bounds = bounds.map(|[u, v, before]| ((x - u) * (x - u) + (y - v) * (y - v)).sqrt() - before);
        // Where two borders meet in a texel, they may seem to cross.
        bounds.fold(f64::INFINITY, f64::min).max(0.02)
    }

    fn collect(&mut self) {
        let [x, y] = self.site;
        self.bounds[0] = [x as f64, y as f64, f64::from(HALF)];
        self.count = 1;
        let Some(own) = self.border.row(y, x, x).first().map(|t| t.1) else { return };
        self.count = 0;
        for row in y.saturating_sub(1)..=y + 1 {
            for (column, outside) in self.border.row(row, x.saturating_sub(1), x + 1) {
                if (*outside > 0.0) == (own > 0.0) {
                    self.bounds[self.count] = [f64::from(*column), row as f64, f64::from(outside.abs())];
                    self.count += 1;
                }
            }
        }
    }
}

/// A grey texel.
#[derive(Clone, Copy)]
struct Soft {
    x: u16,
    y: u16,
    /// Direction in which it gets lighter; 0, 0 where none can be told.
    to_light: [f32; 2],
    /// Distance of its centre from the border, positive outside of the light.
    outside: f32,
}

/// Collects the grey texels of a mask whose rows come from the top.
pub(super) struct BorderFinder {
    width: usize,
    most: usize,
    soft: Vec<Soft>,
    /// The last two rows.
    before: Vec<u8>,
    row: Vec<u8>,
    y: usize,
}

impl BorderFinder {
    /// A mask with more than `most` grey texels is no drawing with smooth edges, but a soft brush, and has no border that
    /// could be found.
    pub(super) fn new(width: usize, most: usize) -> Self {
        Self { width, most, soft: Vec::new(), before: Vec::new(), row: Vec::new(), y: 0 }
    }

    /// The next rows.
    pub(super) fn add(&mut self, coverage: &[u8]) {
        let is_soft = |row: &[u8]| row.iter().fold(0u8, |any, c| any | (c.wrapping_add(1) & 0xfe)) != 0;
        for next in coverage.chunks_exact(self.width) {
            if !self.row.is_empty() && is_soft(&self.row) {
                self.find(next);
            }
            self.y += usize::from(!self.row.is_empty());
            std::mem::swap(&mut self.before, &mut self.row);
            self.row.clear();
            self.row.extend_from_slice(next);
            if self.before.is_empty() {
                self.before.extend_from_slice(next);
            }
        }
    }

    /// Finds the grey texels of the present row, which lies over `next`.
    fn find(&mut self, next: &[u8]) {
        let width = self.width;
        for x in (0..width).filter(|x| !matches!(self.row[*x], 0 | 255)) {
            if self.soft.len() > self.most {
                return;
            }
            let (left, right) = (x.saturating_sub(1), (x + 1).min(width - 1));
            let at = |row: &[u8], x: usize| f32::from(row[x]);
            // Sobel's weights, with the middle at sqrt 2.
            let w = std::f32::consts::SQRT_2;
            let across = |x: usize| at(&self.before, x) + w * at(&self.row, x) + at(next, x);
            let down = |row: &[u8]| at(row, left) + w * at(row, x) + at(row, right);
            let [gx, gy] = [across(right) - across(left), down(next) - down(&self.before)];
            let length = gx.hypot(gy);
            let coverage = at(&self.row, x) / 255.0;
            let to_light = if length > 1e-3 {
                [gx / length, gy / length]
            } else {
                [0.0; 2]
            };
            let outside = edge_distance(to_light, coverage);
            self.soft.push(Soft { x: x as u16, y: self.y as u16, to_light, outside });
        }
    }

    /// The border; `None` where no texel is grey, or too many.
    pub(super) fn finish(mut self) -> Option<Border> {
        if !self.row.is_empty() {
            let last = std::mem::take(&mut self.row);
            self.row.clone_from(&last);
            self.find(&last);
            self.y += 1;
        }
        if self.soft.is_empty() || self.soft.len() > self.most {
            return None;
        }
        // Each grey texel, and what it says about those around it: row, column, whether it is another's, distance.
        let mut found: Vec<(u16, u16, bool, f32)> = Vec::with_capacity(self.soft.len() * 9);
        for Soft { x, y, to_light: [nx, ny], outside } in &self.soft {
            found.push((*y, *x, false, *outside));
            if (*nx, *ny) == (0.0, 0.0) {
                continue;
            }
            for (dx, dy) in [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)] {
                let (Some(x), Some(y)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else { continue };
                // The border lies beyond a texel that it does not cut.
                let beside = outside - f32::from(dx) * nx - f32::from(dy) * ny;
                let distance = beside.abs().clamp(HALF, 1.3).copysign(beside);
                if usize::from(x) < self.width && usize::from(y) < self.y {
                    found.push((y, x, true, distance));
                }
            }
        }
        found.sort_unstable_by(|a, b| (a.0, a.1, a.2).cmp(&(b.0, b.1, b.2)).then(a.3.abs().total_cmp(&b.3.abs())));
        found.dedup_by_key(|t| (t.0, t.1));
        let rows = (0..=self.y).map(|y| found.partition_point(|t| usize::from(t.0) < y) as u32).collect();
        Some(Border { rows, texels: found.into_iter().map(|t| (t.1, t.3)).collect() })
    }
}

/// Distance from a texel's centre to a straight border of which `coverage` lies in the texel, positive where the centre is
/// outside; `to_light` is the unit normal.
fn edge_distance(to_light: [f32; 2], coverage: f32) -> f32 {
    let [a, b] = to_light.map(f32::abs);
    let (long, short) = (a.max(b), a.min(b));
    if long == 0.0 {
        return HALF - coverage;
    }
    // Coverage up to which only a corner is cut.
    let corner = 0.5 * short / long;
    if coverage < corner {
        0.5 * (long + short) - (2.0 * long * short * coverage).sqrt()
    } else if coverage <= 1.0 - corner {
        (0.5 - coverage) * long
    } else {
        (2.0 * long * short * (1.0 - coverage)).sqrt() - 0.5 * (long + short)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coverage of a half plane, lit where `x cos + y sin > shift`, by 32 x 32 samples a texel.
    fn half_plane(size: usize, angle: f32, shift: f32) -> Vec<u8> {
        let (sin, cos) = angle.sin_cos();
        let coverage = |i: usize| {
            let (x, y) = ((i % size) as f32, (i / size) as f32);
            let lit = |s: usize| {
                let (u, v) = (((s % 32) as f32 + 0.5) / 32.0, ((s / 32) as f32 + 0.5) / 32.0);
                (x + u) * cos + (y + v) * sin > shift
            };
            ((0..1024).filter(|s| lit(*s)).count() * 255).div_ceil(1024) as u8
        };
        (0..size * size).map(coverage).collect()
    }

    fn find(size: usize, mask: &[u8], band: usize) -> Option<Border> {
        let mut finder = BorderFinder::new(size, 1000);
        mask.chunks(size * band).for_each(|rows| finder.add(rows));
        finder.finish()
    }

    #[test]
    fn straight_borders_are_found_within_the_texel() {
        for angle in [0.0f32, 0.2, 0.6, 0.785, 1.2, 2.5, 4.0] {
            let (sin, cos) = angle.sin_cos();
            let shift = 12.3 * (cos + sin);
            let mask = half_plane(24, angle, shift);
            let border = find(24, &mask, 24).expect("grey texels");
            assert_eq!(Some(&border), find(24, &mask, 5).as_ref(), "in bands");
            let mut checked = 0;
            for (i, coverage) in mask.iter().enumerate() {
                let (x, y) = (i % 24, i / 24);
                if (2..22).contains(&x) && (2..22).contains(&y) && !matches!(coverage, 0 | 255) {
                    let exact = ((x as f32 + 0.5) * cos + (y as f32 + 0.5) * sin - shift).abs();
                    let found = border.row(y, x, x)[0].1.abs();
                    assert!((found - exact).abs() < 0.05, "{found} for {exact} at {x}, {y}, {angle} rad");
                    checked += 1;
                }
            }
            assert!(checked >= 20 || angle == 0.0 && checked >= 18, "{checked} at {angle}");
        }
    }

    #[test]
    fn hard_masks_and_soft_brushes_have_none() {
        let hard: Vec<u8> = (0..576).map(|i| if i % 24 > 7 { 255 } else { 0 }).collect();
        assert_eq!(find(24, &hard, 24), None);
        let mut finder = BorderFinder::new(24, 100);
        finder.add(&[100; 576]);
        assert_eq!(finder.finish(), None);
    }
}
