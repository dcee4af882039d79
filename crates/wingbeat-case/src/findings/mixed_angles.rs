//! Wings whose angles come partly from the case and partly from a set of measured ones.

use crate::loaded::LoadedCase;
use crate::motion::carrier::rides_on_wing;
use crate::raw::{ANGLES, AdjustCase, AngleCase, WingCase, WingMotionCase};

/// A wing with angles of its own, and with others from a shipped set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MixedAngles {
    /// Name of the wing.
    pub wing: String,
    /// Its angles that the case gives: `phi`, `theta`, `psi`.
    pub given: Vec<&'static str>,
    /// Those that it leaves to the set.
    pub from_set: Vec<&'static str>,
    /// The key that names the set, and its name.
    pub set: [String; 2],
}

impl LoadedCase {
    /// The wings of which some angles are given and others come from `motion.data` or `wing.NAME.motion.data`.
    pub fn mixed_angles(&self) -> Vec<MixedAngles> {
        let shared = self.raw.motion.data.as_ref();
        let shared = shared.map(|set| ["motion.data".to_owned(), set.clone()]);
        let wings = self.raw.wing.iter();
        let motions = wings.filter_map(|(name, wing)| Some((name, wing.motion.as_ref()?)));
        let shared = |name: &str| shared.clone().filter(|_| !rides_on_wing(&self.raw, name));
        motions
            .filter_map(|(name, motion)| mixed(name, motion, shared(name)))
            .collect()
    }
}

impl LoadedCase {
    /// What `[motion.adjust]` and `[motion.difference]` add to angles that wings are given as tables, as `key = value`;
    /// none where no wing has a table.
    pub fn adjusted_tables(&self) -> Vec<String> {
        let has_table = |(name, wing): (&String, &WingCase)| {
            let motion = wing
                .motion
                .as_ref()
                .filter(|_| !rides_on_wing(&self.raw, name));
            let mut angles = motion.into_iter().flat_map(WingMotionCase::angles);
            angles.any(|(_, law)| matches!(law, AngleCase::Table(_)))
        };
        if !self.raw.wing.iter().any(has_table) {
            return vec![];
        }
        let motion = &self.raw.motion;
        let parts = [
            ("adjust", &motion.adjust),
            ("difference", &motion.difference),
        ];
        parts
            .into_iter()
            .flat_map(|(part, by)| changed(part, by))
            .collect()
    }
}

/// The adjustments that are not 0.
fn changed(part: &str, by: &AdjustCase) -> Vec<String> {
    let values = [
        ("stroke_amplitude", by.stroke_amplitude),
        ("stroke_offset_deg", by.stroke_offset_deg),
        ("feathering_amplitude", by.feathering_amplitude),
        ("feathering_offset_deg", by.feathering_offset_deg),
        ("feathering_lead", by.feathering_lead),
        ("deviation_offset_deg", by.deviation_offset_deg),
        ("stroke_plane_deg", by.stroke_plane_deg),
    ];
    let changes = values.into_iter().filter(|(_, value)| *value != 0.0);
    changes
        .map(|(key, value)| format!("motion.{part}.{key} = {value}"))
        .collect()
}

fn mixed(name: &str, motion: &WingMotionCase, shared: Option<[String; 2]>) -> Option<MixedAngles> {
    let own = motion.data.as_ref();
    let own = own.map(|set| [format!("wing.{name}.motion.data"), set.clone()]);
    let set = own.or(shared)?;
    let given: Vec<&'static str> = motion.angles().map(|(angle, _)| angle).collect();
    let from_set = ANGLES.into_iter().filter(|angle| !given.contains(angle));
    let from_set: Vec<&'static str> = from_set.collect();
    (!given.is_empty() && !from_set.is_empty()).then_some(MixedAngles {
        wing: name.to_owned(),
        given,
        from_set,
        set,
    })
}
