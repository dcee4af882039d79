//! Where growth changes its sign between speeds.

use super::condition::Condition;
use crate::vibration::realisation::Vibration;

/// A speed at which flutter begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onset {
    /// Speed [m/s].
    pub speed: f64,
    /// Angular frequency there [rad/s].
    pub frequency: f64,
    /// Whether growth rises with speed: flutter begins.
    pub begins: bool,
    /// Speeds between which it was interpolated [m/s].
    pub between: [f64; 2],
}

/// Most that the frequencies of a mode at neighbouring speeds differ, over the larger \[1\]: modes of beams and
/// plates are at least so far apart unless they flutter together.
const NEAR: f64 = 0.25;

/// Conditions of rising speed, wing by wing.
pub fn by_wing(conditions: &[Condition]) -> Vec<Vec<Condition>> {
    let mut wings: Vec<Vec<Condition>> = vec![];
    for c in conditions {
        match wings.iter_mut().find(|w| w[0].steady.wing == c.steady.wing) {
            Some(wing) => wing.push(c.clone()),
            None => wings.push(vec![c.clone()]),
        }
    }
    wings
}

/// Zero crossings of growth along `conditions` of one wing, of rising speed, interpolated linearly. Modes of two speeds go
/// together by the distance of their eigenvalues, the nearest first: where two come close, speeds are to be
/// closer than they. An onset counts where growth differs from zero by more than its uncertainty on both
/// sides; speeds between, at which the mode is neutral within what is known, are passed over.
pub fn crossings(conditions: &[Condition]) -> Vec<Onset> {
    let mut found = vec![];
    for track in tracks(conditions) {
        let mut known: Option<(usize, usize, bool)> = None;
        for (c, m) in track {
            let Some(grows) = conditions[c].grows(m) else {
                continue;
            };
            if let Some((c0, m0, grew)) = known.filter(|k| k.2 != grows) {
                let sides = [(c0, m0), (c, m)].map(|(c, m)| (&conditions[c], m));
                found.push(interpolated(sides, !grew));
            }
            known = Some((c, m, grows));
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    found
}

/// Onsets of modes that are neutral within what is known at the first of `conditions` and up to where they
/// grow: flutter begins at about the speed where their growth, as far as it is known, is zero, or may have
/// begun at the last speed at which they are neutral.
pub fn likely(conditions: &[Condition]) -> Vec<Onset> {
    let onset = |track: Vec<(usize, usize)>| {
        let first = (track.iter()).position(|&(c, m)| conditions[c].grows(m).is_some())?;
        let (c, m) = track[first];
        let begins = track[0].0 == 0 && first > 0 && conditions[c].grows(m) == Some(true);
        let sides = [track[first.checked_sub(1)?], (c, m)];
        begins.then(|| interpolated(sides.map(|(c, m)| (&conditions[c], m)), true))
    };
    let mut found: Vec<_> = (tracks(conditions).into_iter()).filter_map(onset).collect();
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    found
}

/// Modes whose growth is above zero, by more than its uncertainty, at all of `conditions`: at the first and at
/// the last of them.
pub fn growing(conditions: &[Condition]) -> Vec<[Vibration; 2]> {
    let through = |track: &Vec<(usize, usize)>| {
        let grows = |&(c, m): &(usize, usize)| conditions[c].grows(m) == Some(true);
        track.len() == conditions.len() && track.iter().all(grows)
    };
    let ends = |track: Vec<(usize, usize)>| {
        let ends = [track[0], track[track.len() - 1]];
        ends.map(|(c, m)| conditions[c].modes[m])
    };
    let all = tracks(conditions).into_iter();
    all.filter(through).map(ends).collect()
}

fn interpolated([(a, i), (b, j)]: [(&Condition, usize); 2], begins: bool) -> Onset {
    let (v, next, between) = (&a.modes[i], &b.modes[j], [a.speed, b.speed]);
    // Within the two, where the first is neutral and its growth above zero as found.
    let s = (v.growth / (v.growth - next.growth)).clamp(0.0, 1.0);
    let s = if v.growth * next.growth > 0.0 { 0.0 } else { s };
    Onset {
        speed: between[0] + s * (between[1] - between[0]),
        frequency: v.frequency + s * (next.frequency - v.frequency),
        begins,
        between,
    }
}

/// Each mode along speeds: number of the condition and of the mode in it.
fn tracks(conditions: &[Condition]) -> Vec<Vec<(usize, usize)>> {
    let mut all: Vec<Vec<(usize, usize)>> = vec![];
    for (c, here) in conditions.iter().enumerate() {
        let pairs = match c {
            0 => vec![],
            _ => together(&conditions[c - 1].modes, &here.modes),
        };
        for m in 0..here.modes.len() {
            let before = pairs.iter().find(|p| p.1 == m).map(|p| (c - 1, p.0));
            let follows =
                |t: &&mut Vec<(usize, usize)>| before.is_some() && t.last().copied() == before;
            match all.iter_mut().find(follows) {
                Some(track) => track.push((c, m)),
                None => all.push(vec![(c, m)]),
            }
        }
    }
    all
}

/// Pairs of nearest eigenvalues, each in one pair at most.
fn together(a: &[Vibration], b: &[Vibration]) -> Vec<(usize, usize)> {
    let is_near = |&(i, j): &(usize, usize)| {
        let (v, w) = (a[i].frequency, b[j].frequency);
        (v - w).abs() <= NEAR * v.max(w)
    };
    let all = (0..a.len()).flat_map(|i| (0..b.len()).map(move |j| (i, j)));
    let mut all: Vec<_> = all.filter(is_near).collect();
    all.sort_by(|p, q| {
        let apart = |p: &(usize, usize)| a[p.0].distance(&b[p.1]);
        apart(p).total_cmp(&apart(q))
    });
    let (mut left, mut right) = (vec![true; a.len()], vec![true; b.len()]);
    all.retain(|&(i, j)| {
        let free = left[i] && right[j];
        if free {
            (left[i], right[j]) = (false, false);
        }
        free
    });
    all
}
