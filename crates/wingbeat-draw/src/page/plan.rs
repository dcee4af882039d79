//! How a flight is thinned so that its page stays within its size.

use std::path::Path;

use super::pack::wake_bytes;
use wingbeat_case::IoError;
use wingbeat_results::frames::Frame;

/// Bytes of the page per byte of the `.vtp` files: 8 bytes for a point and its cell instead of 24
/// for the point, 64 for the cell with its corners and numbers (or 8 instead of 80 for a particle),
/// all in base64 on both sides.
const PAGE_PER_FILE: f64 = 0.1;
/// Fewer frames than this are not shown for the sake of complete wakes.
const FEWEST_FRAMES: usize = 120;

/// What is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Steps of the frames that are shown.
    pub steps: Vec<usize>,
    /// Frames there are.
    pub of: usize,
    /// Most bytes a frame may take; older wake rows are left out beyond that.
    pub frame_bytes: usize,
}

impl Plan {
    /// For frames of the given size \[bytes of page data\] within a budget: every frame if they
    /// fit; else every second, third, ..., but at least 120 of them, with the oldest wake rows
    /// left out; `fixed` bytes are in every frame.
    pub fn new(steps: &[usize], sizes: &[usize], fixed: usize, budget: usize) -> Self {
        let n = steps.len();
        let cost = |stride: usize| sizes.iter().step_by(stride).sum::<usize>();
        let affordable = (budget / fixed.max(1)).max(1);
        let fewest = FEWEST_FRAMES.min(affordable);
        let widest = n.div_ceil(fewest).max(1);
        let stride = (1..=widest).find(|s| cost(*s) <= budget).unwrap_or(widest);
        let shown: Vec<usize> = steps.iter().step_by(stride).copied().collect();
        let frame_bytes = if cost(stride) <= budget {
            usize::MAX
        } else {
            budget / shown.len().max(1)
        };
        Self {
            steps: shown,
            of: n,
            frame_bytes,
        }
    }

    /// For a flight without frames, drawn from its history, every frame of `own` bytes: about `enough` of these steps,
    /// evenly spaced, or as many as the budget takes.
    pub fn of_steps(steps: &[usize], enough: usize, own: usize, budget: usize) -> Self {
        let n = steps.len();
        let affordable = (budget / own.max(1)).max(1);
        let stride = (n / enough.max(1)).max(n.div_ceil(affordable)).max(1);
        Self {
            steps: steps.iter().step_by(stride).copied().collect(),
            of: n,
            frame_bytes: usize::MAX,
        }
    }

    /// For the frames of a result directory, by the sizes of their files; `fixed` bytes are in every
    /// frame, of wakes at most `most_rows` rows.
    ///
    /// # Errors
    /// A frame that cannot be read.
    pub fn of_directory(
        dir: &Path,
        steps: &[usize],
        (fixed, most_rows): (usize, usize),
        budget: usize,
    ) -> Result<Self, IoError> {
        let most = match steps.last() {
            Some(last) => most_bytes(dir, *last, (fixed, most_rows))?,
            None => fixed,
        };
        let mut sizes = Vec::with_capacity(steps.len());
        for &step in steps {
            let mut size = 0;
            for path in Frame::files(dir, step) {
                size += std::fs::metadata(&path)
                    .map_err(IoError::read(&path))?
                    .len();
            }
            sizes.push(((size as f64 * PAGE_PER_FILE) as usize).clamp(fixed, most));
        }
        Ok(Self::new(steps, &sizes, fixed, budget))
    }
}

/// What a frame with the wake of the last one, but at most so many rows, takes \[bytes\].
fn most_bytes(
    dir: &Path,
    last: usize,
    (fixed, most_rows): (usize, usize),
) -> Result<usize, IoError> {
    let frame = Frame::read(dir, last)?;
    match frame.particles.is_empty() {
        true => Ok(fixed + wake_bytes(&frame.wakes, most_rows)),
        false => Ok(usize::MAX),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_plans_stay_within_their_budget() {
        let steps: Vec<usize> = (0..1000).collect();
        let all = Plan::new(&steps, &vec![10; 1000], 5, 10_000);
        assert_eq!((all.steps.len(), all.frame_bytes), (1000, usize::MAX));
        let third = Plan::new(&steps, &vec![10; 1000], 5, 3_400);
        assert_eq!((third.steps.len(), third.frame_bytes), (334, usize::MAX));
        // 120 frames of 10 do not fit into 600: their wakes are cut.
        let cut = Plan::new(&steps, &vec![10; 1000], 2, 600);
        assert!(cut.steps.len() <= 120 && cut.steps.len() * cut.frame_bytes <= 600);
        // Not even the surfaces of 120 frames fit.
        let few = Plan::new(&steps, &vec![10; 1000], 8, 80);
        assert!(few.steps.len() <= 10 && few.frame_bytes >= 8);
        // Without frames: no more than is enough, and no more than the budget takes.
        let steps: Vec<usize> = (0..30_001).collect();
        for (enough, budget, shown) in [
            (12_000, 1_000_000, 15_001),
            (12_000, 100_000, 7_501),
            (40_000, 1_000_000, 30_001),
        ] {
            let plan = Plan::of_steps(&steps, enough, 10, budget);
            assert_eq!((plan.steps.len(), plan.of), (shown, 30_001));
            assert!(10 * plan.steps.len() <= budget);
        }
        let none = Plan::new(&[], &[], 0, 100);
        assert!(none.steps.is_empty());
    }
}
