//! Plots side by side, and plots with the same scale along and upward.

use crate::figures::axes::plot::{self, Area, Axes, Plot};
use crate::figures::drawing::Drawing;
use crate::figures::drawing::style::Look;

/// Draws plots in rows of `columns`, each `height` high.
pub(crate) fn grid(
    plots: &[Plot],
    columns: usize,
    height: f64,
    title: &str,
    look: &Look,
) -> (Drawing, Vec<Axes>) {
    let margins = plots.iter().map(|p| p.margin(height, look));
    let margin = margins.fold(0.0, f64::max);
    let gap = 1.6 * look.font;
    let cell = (look.width - gap) / columns as f64;
    let width = cell - margin - gap;
    let rows = || plots.chunks(columns);
    let above = |row: &[Plot]| row.iter().map(|p| p.head(width, look)).fold(0.0, f64::max);
    let below = |row: &[Plot]| row.iter().map(|p| p.foot(look)).fold(0.0, f64::max);
    let space = 0.4 * look.font;
    let heights = rows().map(|r| above(r) + height + below(r) + space);
    let mut drawing = Drawing::new([look.width, look.head() + heights.sum::<f64>()]);
    plot::title(&mut drawing, title, look);
    let (mut axes, mut top) = (vec![], look.head());
    for row in rows() {
        top += above(row);
        for (k, plot) in row.iter().enumerate() {
            let area = Area {
                left: gap / 2.0 + margin + k as f64 * cell,
                top,
                width,
                height,
            };
            axes.push(plot.draw(&mut drawing, area, look));
        }
        top += height + below(row) + space;
    }
    (drawing, axes)
}

/// Widens one of two ranges so that a plot `width` wide has one scale; its height \[points\] is
/// between `least` and `most`.
pub(crate) fn one_scale(
    x: &mut [f64; 2],
    y: &mut [f64; 2],
    width: f64,
    [least, most]: [f64; 2],
) -> f64 {
    let [dx, dy] = [x[1] - x[0], y[1] - y[0]];
    let height = width / dx * dy;
    if height > most {
        widen(x, dy * width / most);
        return most;
    }
    if height < least {
        widen(y, dx * least / width);
        return least;
    }
    height
}

fn widen(range: &mut [f64; 2], to: f64) {
    let middle = 0.5 * (range[0] + range[1]);
    *range = [middle - 0.5 * to, middle + 0.5 * to];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_one_scale_along_and_upward() {
        for [dx, dy] in [[1.0, 1.0], [10.0, 1.0], [1.0, 10.0]] {
            let (mut x, mut y) = ([0.0, dx], [0.0, dy]);
            let height = one_scale(&mut x, &mut y, 100.0, [50.0, 200.0]);
            let [along, upward] = [100.0 / (x[1] - x[0]), height / (y[1] - y[0])];
            assert!((along - upward).abs() < 1e-12 * along);
            assert!((50.0..=200.0).contains(&height) && x[1] - x[0] >= dx && y[1] - y[0] >= dy);
        }
    }
}
