//! Vertical distances: for every column the nearest texel of a set, kept up to date while rows pass.
//!
//! Each texel has a level. The sets are `level < j` and `level > j` for every `j`. Columns are stored as runs of equal
//! levels, and only where a run ends does anything change, so that a row costs next to nothing however many sets there
//! are. This is the first of the two passes of the exact distance transform (Meijster et al. 2000).

/// Longest side of a picture, texels: rows and sentinels fit 16 bits.
pub const MAX_SIDE: u32 = 16384;

/// "No such texel": beyond every picture, and no overflow when a row is added or taken away.
pub(super) const FAR: i16 = 16384;

/// Levels of a picture, column by column, as runs.
pub(super) struct Columns {
    /// Where the runs of a column begin; one more than there are columns.
    first: Vec<u32>,
    /// First row of each run.
    starts: Vec<u16>,
    /// Level of each run.
    levels: Vec<u8>,
    height: usize,
}

/// Calls back for every place at which two rows differ.
fn differences(above: &[u8], row: &[u8], mut found: impl FnMut(usize)) {
    const BLOCK: usize = 32;
    for (i, (a, b)) in above.chunks(BLOCK).zip(row.chunks(BLOCK)).enumerate() {
        if a != b {
            for (x, _) in a.iter().zip(b).enumerate().filter(|(_, (a, b))| a != b) {
                found(i * BLOCK + x);
            }
        }
    }
}

impl Columns {
    /// Sides at most [`MAX_SIDE`], `levels.len()` a multiple of `width`.
    pub(super) fn new(levels: &[u8], width: usize) -> Self {
        let width = width.max(1);
        let rows = || levels.chunks_exact(width);
        let mut first = vec![0u32; width + 1];
        let runs = &mut first[1..];
        runs.fill(u32::from(!levels.is_empty()));
        for (above, row) in rows().zip(rows().skip(1)) {
            differences(above, row, |x| runs[x] += 1);
        }
        for x in 0..width {
            first[x + 1] += first[x];
        }
        let total = first[width] as usize;
        let mut columns =
            Self { starts: vec![0; total], levels: vec![0; total], height: levels.len() / width, first: Vec::new() };
        let mut next = first.clone();
        let mut push = |x: usize, y: usize, level: u8| {
            let at = next[x] as usize;
            (columns.starts[at], columns.levels[at]) = (y as u16, level);
            next[x] += 1;
        };
        if let Some(top) = rows().next() {
            top.iter().enumerate().for_each(|(x, level)| push(x, 0, *level));
        }
        for (y, (above, row)) in rows().zip(rows().skip(1)).enumerate() {
            differences(above, row, |x| push(x, y + 1, row[x]));
        }
        Self { first, ..columns }
    }

    fn width(&self) -> usize {
        self.first.len() - 1
    }

    /// The row after a run's last one.
    fn end(&self, x: usize, run: usize) -> i16 {
        if run + 1 < self.first[x + 1] as usize {
            self.starts[run + 1] as i16
        } else {
            self.height as i16
        }
    }
}

/// Last and next row of one set in every column, seen from the present row: the distance is
/// `max(0, min(row - last, next - row))`. Inside a run of the set, `last` is already the run's last row.
#[derive(Clone)]
pub(super) struct Nearest {
    pub(super) last: Vec<i16>,
    pub(super) next: Vec<i16>,
}

impl Nearest {
    /// Distance to the set in a column, [`FAR`] where it has none.
    pub(super) fn distance(&self, x: usize, row: i16) -> i16 {
        (row - self.last[x]).min(self.next[x] - row).clamp(0, FAR)
    }

    /// Row of the texel at that distance.
    pub(super) fn row(&self, x: usize, row: i16) -> usize {
        let (up, down) = (row - self.last[x], self.next[x] - row);
        (if up <= 0 {
            row
        } else if up <= down {
            self.last[x]
        } else {
            self.next[x]
        })
        .max(0) as usize
    }
}

/// The sets of all levels at one row.
pub(super) struct Sweep<'a> {
    columns: &'a Columns,
    /// For each `j`, `level < j`.
    pub(super) below: Vec<Nearest>,
    /// For each `j`, `level > j`.
    pub(super) above: Vec<Nearest>,
    /// Run in which each column is.
    runs: Vec<u32>,
}

impl<'a> Sweep<'a> {
    /// Stands at a row; levels are `0..levels`.
    pub(super) fn new(columns: &'a Columns, levels: usize, row: usize) -> Self {
        let width = columns.width();
        let none = Nearest { last: vec![-FAR; width], next: vec![i16::MAX; width] };
        let mut sweep =
            Self { columns, below: vec![none.clone(); levels], above: vec![none; levels], runs: vec![0; width] };
        for x in 0..width {
            let [from, to] = [columns.first[x], columns.first[x + 1]].map(|i| i as usize);
            let here = from + columns.starts[from..to].partition_point(|s| usize::from(*s) <= row).saturating_sub(1);
            sweep.runs[x] = here as u32;
            // What lies above, from here upwards, until every level has been seen.
            let (mut low, mut high) = (levels, 0);
            for run in (from..=here).rev() {
                let (level, end) = (usize::from(columns.levels[run]), columns.end(x, run) - 1);
                (level + 1..low).for_each(|j| sweep.below[j].last[x] = end);
                (high..level).for_each(|j| sweep.above[j].last[x] = end);
                (low, high) = (low.min(level + 1), high.max(level));
            }
            sweep.look_down(x, here, 0, levels);
        }
        sweep
    }

    /// Goes to a row, one below the present one, whose levels and those of the row above are given.
    pub(super) fn advance(&mut self, above: &[u8], row: &[u8]) {
        let levels = self.below.len();
        differences(above, row, |x| {
            self.runs[x] += 1;
            let run = self.runs[x] as usize;
            let (was, level) = (usize::from(above[x]), usize::from(row[x]));
            let end = self.columns.end(x, run) - 1;
            (level + 1..levels).for_each(|j| self.below[j].last[x] = end);
            (0..level).for_each(|j| self.above[j].last[x] = end);
            self.look_down(x, run, was.min(level), was.max(level) + 1);
        });
    }

    /// Finds the next rows of the sets of levels `from..to` that the present run of a column is not in. Each run is
    /// passed once for each level at most: only sets that have just been left are looked for.
    fn look_down(&mut self, x: usize, here: usize, from: usize, to: usize) {
        let columns = self.columns;
        let level = usize::from(columns.levels[here]);
        // Sets below `j <= level` and above `j >= level` are wanted: those of j in (from, low] and [high, to).
        let (mut low, mut high) = (level, level);
        for run in here + 1..columns.first[x + 1] as usize {
            if low <= from && high + 1 >= to {
                return;
            }
            let (level, start) = (usize::from(columns.levels[run]), columns.starts[run] as i16);
            (level.max(from) + 1..=low).for_each(|j| self.below[j].next[x] = start);
            (high..level.min(to)).for_each(|j| self.above[j].next[x] = start);
            (low, high) = (low.min(level.max(from)), high.max(level));
        }
        (from + 1..=low).for_each(|j| self.below[j].next[x] = i16::MAX);
        (high..to).for_each(|j| self.above[j].next[x] = i16::MAX);
    }
}
