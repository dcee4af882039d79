//! What the free filaments were gathered from, so that passes of one step gather them once.

use crate::lattice::{Identity, Lattice};
use crate::state::{AirState, WakeSheet};
use wingbeat_vortex::Points;

/// All that free filaments follow from, but for their nodes, which they have, and the cores of these.
#[derive(Clone, Debug, Default)]
pub(super) struct Gathered {
    lattice: Option<Identity>,
    /// Time [s].
    time: f64,
    /// Columns of each sheet, and whether it is closed.
    sheets: Vec<(usize, bool)>,
    /// Of one sheet after the other.
    gamma: Vec<f64>,
    shed_time: Vec<f64>,
    converted: Vec<usize>,
}

impl Gathered {
    /// Whether these are the wakes of this lattice and state at time `t` [s] with their nodes at `nodes` [m].
    pub fn is(&self, lattice: &Lattice, state: &AirState, t: f64, nodes: &Points) -> bool {
        let sheets = || state.sheets.iter();
        let of_places = |of: fn(&Points) -> &[f64]| are(of(nodes), sheets().map(|s| of(&s.nodes)));
        (self.lattice.as_ref()).is_some_and(|known| known.is(lattice.identity()))
            && self.time == t
            && self.sheets.iter().copied().eq(sheets().map(shape))
            && are(&self.gamma, sheets().map(|s| &s.gamma[..]))
            && are(&self.shed_time, sheets().map(|s| &s.shed_time[..]))
            && are(&self.converted, sheets().map(|s| &s.converted[..]))
            && of_places(|p| &p.x)
            && of_places(|p| &p.y)
            && of_places(|p| &p.z)
    }

    /// Notes these.
    pub fn take(&mut self, lattice: &Lattice, state: &AirState, t: f64) {
        self.lattice = Some(lattice.identity().clone());
        self.time = t;
        self.sheets.clear();
        self.gamma.clear();
        self.shed_time.clear();
        self.converted.clear();
        for sheet in &state.sheets {
            self.sheets.push(shape(sheet));
            self.gamma.extend_from_slice(&sheet.gamma);
            self.shed_time.extend_from_slice(&sheet.shed_time);
            self.converted.extend_from_slice(&sheet.converted);
        }
    }
}

fn shape(sheet: &WakeSheet) -> (usize, bool) {
    (sheet.columns, sheet.is_closed)
}

/// Whether the parts one after the other are all there is.
fn are<'a, T: PartialEq + 'a>(all: &[T], mut parts: impl Iterator<Item = &'a [T]>) -> bool {
    let rest = parts.try_fold(all, |rest, part| rest.strip_prefix(part));
    rest.is_some_and(<[T]>::is_empty)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AirSettings, NodeMotion, Surface};
    use wingbeat_math::DVec3;

    /// Two sheets of two rows; the rows, rings and nodes of one are not taken for those of the other.
    #[test]
    fn exact_wakes_are_known_until_anything_of_them_changes() {
        let nodes = (0..9).map(|k| DVec3::new((k / 3) as f64, (k % 3) as f64, 0.0));
        let motion = NodeMotion {
            position: nodes.collect(),
            velocity: vec![DVec3::ZERO; 9],
        };
        let lattice = || {
            let settings = AirSettings::accurate(1.0, DVec3::X);
            Lattice::new(vec![Surface::grid("wing", 2, 2)], settings).unwrap()
        };
        let (own, other) = (lattice(), lattice());
        let mut state = own.initial_state(&motion);
        let sheet = WakeSheet {
            columns: 2,
            nodes: motion.position[..6].iter().copied().collect(),
            gamma: vec![1.0, 2.0, 3.0, 4.0],
            shed_time: vec![0.1, 0.2],
            converted: vec![0; 2],
            ..WakeSheet::default()
        };
        state.sheets = vec![sheet.clone(), sheet];
        let nodes: Points = state.sheets.iter().flat_map(|s| s.nodes.iter()).collect();
        let mut gathered = Gathered::default();
        assert!(!gathered.is(&own, &state, 0.3, &nodes));
        gathered.take(&own, &state, 0.3);
        assert!(gathered.is(&own, &state, 0.3, &nodes));
        assert!(gathered.is(&own.clone(), &state, 0.3, &nodes));
        assert!(!gathered.is(&other, &state, 0.3, &nodes));
        assert!(!gathered.is(&own, &state, 0.4, &nodes));
        let changes: [fn(&mut AirState); 8] = [
            |s| s.sheets[1].gamma[3] = 5.0,
            |s| s.sheets[0].shed_time[0] = 0.0,
            |s| s.sheets[0].converted[1] = 1,
            |s| s.sheets[1].nodes.y[5] += 1e-12,
            |s| s.sheets[0].is_closed = true,
            |s| s.sheets[0].columns = 1,
            |s| drop(s.sheets.pop()),
            |s| s.sheets.push(s.sheets[0].clone()),
        ];
        for (k, change) in changes.into_iter().enumerate() {
            let mut changed = state.clone();
            change(&mut changed);
            assert!(!gathered.is(&own, &changed, 0.3, &nodes), "{k}");
        }
    }
}
