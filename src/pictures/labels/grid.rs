//! Occupancy of a part of the sheet.

use super::{Extent, Point};

/// Distance between the points at which a line is sampled [px]; shorter than a cell.
const STEP: f64 = 0.4;

/// Content of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::pictures) enum Cell {
    /// Nothing.
    Free,
    /// Curve or outline of one body.
    Of(usize),
    /// Curves of several bodies.
    Shared,
    /// A label.
    Label,
}

/// Cells of one pixel, with what is drawn in each.
#[derive(Debug)]
pub(in crate::pictures) struct Grid {
    field: Extent,
    columns: usize,
    cells: Vec<Cell>,
}

impl Grid {
    /// A grid of free cells.
    pub(in crate::pictures) fn over(field: Extent) -> Self {
        let columns = (field.right - field.left).max(0.0) as usize;
        let rows = (field.bottom - field.top).max(0.0) as usize;
        Self {
            field,
            columns,
            cells: vec![Cell::Free; columns * rows],
        }
    }

    /// The part of the sheet.
    pub(in crate::pictures) fn field(&self) -> Extent {
        self.field
    }

    /// Adds the curve of a body.
    pub(in crate::pictures) fn trace(&mut self, curve: &[Point], body: usize) {
        let mut mark = |at| {
            let Some(index) = self.index(at) else { return };
            self.cells[index] = match self.cells[index] {
                Cell::Free => Cell::Of(body),
                Cell::Of(other) if other != body => Cell::Shared,
                same => same,
            };
        };
        if let [only] = curve {
            mark(*only);
        }
        for ends in curve.windows(2) {
            along(ends[0], ends[1]).for_each(&mut mark);
        }
    }

    /// Adds the filled outline of a body, which hides what is below it.
    pub(in crate::pictures) fn fill(&mut self, outline: &[Point], body: usize) {
        let Some(around) = Extent::of(outline) else {
            return;
        };
        let near: Vec<usize> = self.within(around).collect();
        for index in near {
            if is_inside(outline, self.centre(index)) {
                self.cells[index] = Cell::Of(body);
            }
        }
    }

    /// Adds a label.
    pub(in crate::pictures) fn cover(&mut self, label: Extent) {
        let covered: Vec<usize> = self.within(label).collect();
        for index in covered {
            self.cells[index] = Cell::Label;
        }
    }

    /// True if the extent is in the field and all its cells fulfil the condition.
    pub(in crate::pictures) fn all(&self, extent: Extent, is: impl Fn(Cell) -> bool) -> bool {
        let field = &self.field;
        let inside = extent.left >= field.left
            && extent.top >= field.top
            && extent.right <= field.right
            && extent.bottom <= field.bottom;
        inside && self.within(extent).all(|index| is(self.cells[index]))
    }

    /// True if all cells from one point to another fulfil the condition.
    pub(in crate::pictures) fn all_along(
        &self,
        from: Point,
        to: Point,
        is: impl Fn(Cell) -> bool,
    ) -> bool {
        along(from, to).all(|at| self.index(at).is_none_or(|index| is(self.cells[index])))
    }

    /// Centres of the cells in which this body is seen.
    pub(in crate::pictures) fn seen(&self, body: usize) -> impl Iterator<Item = Point> {
        let cells = self.cells.iter().enumerate();
        cells
            .filter(move |(_, cell)| **cell == Cell::Of(body))
            .map(|(index, _)| self.centre(index))
    }

    fn index(&self, (x, y): Point) -> Option<usize> {
        let (column, row) = (x - self.field.left, y - self.field.top);
        let inside = column >= 0.0 && row >= 0.0 && (column as usize) < self.columns;
        let index = row as usize * self.columns + column as usize;
        (inside && index < self.cells.len()).then_some(index)
    }

    fn centre(&self, index: usize) -> Point {
        let (row, column) = (index / self.columns, index % self.columns);
        (
            self.field.left + column as f64 + 0.5,
            self.field.top + row as f64 + 0.5,
        )
    }

    /// Cells that an extent touches.
    fn within(&self, extent: Extent) -> impl Iterator<Item = usize> {
        let clip = |value: f64, end: usize| (value.max(0.0) as usize).min(end);
        let rows = self.cells.len() / self.columns.max(1);
        let (left, top) = (self.field.left, self.field.top);
        let columns = clip(extent.left - left, self.columns)
            ..clip((extent.right - left).ceil(), self.columns);
        let rows = clip(extent.top - top, rows)..clip((extent.bottom - top).ceil(), rows);
        let width = self.columns;
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }
}

/// Points on the way from one point to another, both included.
fn along(from: Point, to: Point) -> impl Iterator<Item = Point> {
    let (x, y) = (to.0 - from.0, to.1 - from.1);
    let steps = (x.hypot(y) / STEP).ceil().max(1.0) as u32;
    (0..=steps).map(move |step| {
        let share = f64::from(step) / f64::from(steps);
        (from.0 + share * x, from.1 + share * y)
    })
}

/// True if a point is within a convex outline.
fn is_inside(outline: &[Point], at: Point) -> bool {
    let turn = |a: Point, b: Point| (b.0 - a.0) * (at.1 - a.1) - (b.1 - a.1) * (at.0 - a.0);
    let edges = || (0..outline.len()).map(|k| turn(outline[k], outline[(k + 1) % outline.len()]));
    outline.len() > 2 && (edges().all(|turn| turn >= 0.0) || edges().all(|turn| turn <= 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        Grid::over(Extent {
            left: 10.0,
            top: 20.0,
            right: 60.0,
            bottom: 50.0,
        })
    }

    #[test]
    fn curves_take_their_cells_and_share_those_where_they_cross() {
        let mut grid = grid();
        grid.trace(&[(10.0, 35.5), (59.0, 35.5)], 0);
        grid.trace(&[(30.5, 20.0), (30.5, 49.0)], 1);
        let at = |x, y| Extent::around((x, y), (2.0, 2.0));
        assert!(grid.all(at(20.0, 30.0), |cell| cell == Cell::Free));
        assert!(!grid.all(at(20.0, 35.5), |cell| cell == Cell::Free));
        let is_own = |cell| matches!(cell, Cell::Free | Cell::Of(0));
        assert!(grid.all(at(20.0, 35.5), is_own));
        assert!(!grid.all(at(30.5, 35.5), is_own));
        assert!(!grid.all(at(60.0, 30.0), |_| true), "it leaves the field");
    }

    #[test]
    fn an_outline_hides_what_is_below_it() {
        let mut grid = grid();
        grid.fill(&[(20.0, 25.0), (40.0, 25.0), (40.0, 45.0), (20.0, 45.0)], 0);
        grid.fill(&[(30.0, 20.0), (55.0, 20.0), (55.0, 50.0), (30.0, 50.0)], 1);
        assert_eq!(grid.seen(0).count(), 10 * 20);
        assert!(grid.seen(0).all(|(x, _)| x < 30.0));
        assert_eq!(grid.seen(1).count(), 25 * 30);
    }
}
