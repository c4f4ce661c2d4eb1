//! The grid of the face on the net: rows and columns that run round the eyes and the mouth, close where the profile bends.

use std::f32::consts::PI;

use glam::Vec2;

use super::shape::{HAIRLINE_ROW, JAW_ROW, LAST_ROW, locate};
use super::state::{CORNERS, Eye, Mouth};

/// Columns of half a head.
pub(super) const HALF: usize = 41;
/// Columns of the mouth's half, and of the eye.
pub(super) const MOUTH_COLUMNS: usize = 9;
pub(super) const EYE_FIRST: usize = 11;
pub(super) const EYE_LAST: usize = 25;
/// Rows: hairline, upper and lower lid, upper and lower lip, edge of the jaw, last.
pub(super) const HAIRLINE: usize = 4;
pub(super) const LID: usize = 11;
pub(super) const LID_END: usize = LID + 6;
pub(super) const LIP: usize = LID_END + NOSE_ROWS.len() + 1;
pub(super) const LIP_END: usize = LIP + 4;
pub(super) const JAW: usize = LIP_END + CHIN_ROWS.len() + 1;
pub(super) const ROWS: usize = JAW + 10;

/// Heights of the rows on the middle of the face: close where its profile bends, between lower lid and lips, and between
/// lips and jaw.
const NOSE_ROWS: [f32; 13] =
    [1.388, 1.382, 1.3768, 1.3733, 1.3708, 1.3686, 1.3664, 1.364, 1.361, 1.3575, 1.354, 1.351, 1.3482];
const CHIN_ROWS: [f32; 9] = [1.343, 1.3408, 1.3384, 1.3355, 1.332, 1.3285, 1.3252, 1.3218, 1.3187];

/// A vertex of the grid's left half: where it stands on the net, and on the face's front projection.
pub(super) type Grid = Vec<Vec<Vec2>>;

/// Eye openings run from the inner to the outer corner; the sides of the block share a piece at each corner.
const CORNER_SHARE: f32 = 0.07;

fn start() -> Grid {
    let rows = [
        (0, 0.0),
        (HAIRLINE, HAIRLINE_ROW),
        (LID, 6.05),
        (LID_END, 7.6),
        (LIP, 9.85),
        (LIP_END, 10.15),
        (JAW, JAW_ROW),
        (JAW + 3, 14.0),
        (JAW + 6, 16.0),
        (ROWS - 1, LAST_ROW),
    ];
    let columns = [(0, 0.0), (EYE_FIRST, 0.86), (EYE_LAST, 3.2), (EYE_LAST + 4, 4.35), (HALF, 8.0)];
    let at = |table: &[(usize, f32)], i: usize| {
        let k = table.iter().rposition(|(n, _)| *n <= i).unwrap_or(0).min(table.len() - 2);
        let ((a, x), (b, y)) = (table[k], table[k + 1]);
        x + (y - x) * (i - a) as f32 / (b - a) as f32
    };
    (0..ROWS).map(|r| (0..=HALF).map(|c| Vec2::new(at(&columns, c), at(&rows, r))).collect()).collect()
}

/// Places along the lids at which vertices of the grid stand, 0 at the inner and 1 at the outer corner.
pub(super) fn lid_columns() -> impl Iterator<Item = f32> {
    (EYE_FIRST..=EYE_LAST).map(lid_column)
}

fn lid_column(column: usize) -> f32 {
    let across = (column - EYE_FIRST) as f32 / (EYE_LAST - EYE_FIRST) as f32;
    CORNER_SHARE + (1.0 - 2.0 * CORNER_SHARE) * across
}

/// Point of the lids at a place on the border of the eye's block.
fn lid_point(row: usize, column: usize) -> Vec2 {
    let eye = Eye::default();
    let s = lid_column(column);
    let down = (row - LID) as f32 / (LID_END - LID) as f32;
    let on = |s: f32, lower: bool| {
        let x = CORNERS[0].x + (CORNERS[1].x - CORNERS[0].x) * s;
        Vec2::new(x, eye.lids(s)[usize::from(lower)])
    };
    if row == LID || row == LID_END {
        on(s, row == LID_END)
    } else {
        // Through the corner: s falls to 0 (or rises to 1) and comes back on the other lid. Squared, because the lids
        // meet at a round corner. The inner one lies low.
        let corner = if column == EYE_FIRST { 2.0 / 3.0 } else { 0.5 };
        let t = (1.0 - down / corner).max((down - corner) / (1.0 - corner));
        let near = CORNER_SHARE * t * t;
        on(if column == EYE_FIRST { near } else { 1.0 - near }, down > corner)
    }
}

fn lip_point(row: usize, column: usize) -> Vec2 {
    // Denser at the corners, where an open mouth is round.
    let q = (column as f32 / MOUTH_COLUMNS as f32 * PI * 0.5).sin();
    let [x, upper, lower] = Mouth::default().lips(q);
    Vec2::new(x, upper + (lower - upper) * (row - LIP) as f32 / (LIP_END - LIP) as f32)
}

fn in_eye(row: usize, column: usize) -> bool {
    (LID..=LID_END).contains(&row) && (EYE_FIRST..=EYE_LAST).contains(&column)
}

fn in_mouth(row: usize, column: usize) -> bool {
    (LIP..=LIP_END).contains(&row) && column <= MOUTH_COLUMNS
}

/// The grid on the net: its lines are drawn to lids and lips, and evened out between them.
pub(super) fn relaxed() -> Grid {
    let mut grid = start();
    let mut fixed = vec![vec![false; HALF + 1]; ROWS];
    for r in 0..ROWS {
        for c in 0..=HALF {
            fixed[r][c] = r <= HAIRLINE || r >= JAW;
            let border = r == LID || r == LID_END || c == EYE_FIRST || c == EYE_LAST;
            if in_eye(r, c) && border {
                let p = lid_point(r, c);
                grid[r][c] = locate(p.x, p.y);
                fixed[r][c] = true;
            }
            if in_mouth(r, c) {
                let p = lip_point(r, c);
                grid[r][c] = locate(p.x, p.y);
                fixed[r][c] = true;
            }
        }
    }
    let middle = |first: usize, heights: &'static [f32]| heights.iter().enumerate().map(move |(i, y)| (first + i, *y));
    for (r, y) in middle(LID_END + 1, &NOSE_ROWS).chain(middle(LIP_END + 1, &CHIN_ROWS)) {
        grid[r][0] = locate(0.0, y);
        fixed[r][0] = true;
    }
    for _ in 0..400 {
        for r in HAIRLINE + 1..JAW {
            for c in 0..=HALF {
                if fixed[r][c] {
                    continue;
                }
                let mirror = |p: Vec2, axis: f32| Vec2::new(2.0 * axis - p.x, p.y);
                let left = if c == 0 {
                    mirror(grid[r][1], 0.0)
                } else {
                    grid[r][c - 1]
                };
                let right = if c == HALF {
                    mirror(grid[r][HALF - 1], 8.0)
                } else {
                    grid[r][c + 1]
                };
                let mean = (left + right + grid[r - 1][c] + grid[r + 1][c]) * 0.25;
                let here = grid[r][c];
                grid[r][c] = here + (mean - here) * 1.6;
                if (LID..=LID_END).contains(&r) && c < EYE_FIRST {
                    // Columns beside the inner corner, which stands out, would fold over it.
                    grid[r][c].x = grid[r][c].x.min(grid[r][EYE_FIRST].x * c as f32 / EYE_FIRST as f32);
                }
            }
        }
    }
    grid
}
