//! Wings as they are flown: elastic ones with the shapes that loads give them, deforming ones with those prescribed.

use crate::animal::{Animal, Wing};
use crate::contact::bent::{Bending, Column, bend};
use crate::contact::sheet::{LINES, Pose, Sheet};
use crate::motion::WingMotion;
use wingbeat_math::DVec3;

/// The wings of an animal.
#[derive(Clone, Debug)]
pub struct FlownSheets {
    pub sheets: Vec<Sheet>,
    motions: Vec<WingMotion>,
    /// Of elastic wings.
    columns: Vec<Option<Vec<Column>>>,
}

impl FlownSheets {
    pub fn new(animal: &Animal) -> Self {
        let elastic = |w: &Wing| {
            let is_elastic = w.structure.is_some();
            is_elastic.then(|| Column::all(&w.mesh, LINES))
        };
        Self {
            sheets: animal.wings.iter().map(Sheet::new).collect(),
            motions: animal.wings.iter().map(|w| w.motion.clone()).collect(),
            columns: animal.wings.iter().map(elastic).collect(),
        }
    }

    /// Nodes of all wings \[m\] whose hinges are here with these attitudes, how the elastic ones are bent in their order;
    /// of wings without a pose none, of elastic ones of which no shape is left that at rest. `phase` of the beat of a wing
    /// of some motion \[wingbeats\].
    pub fn placed(
        &self,
        poses: impl Iterator<Item = Option<Pose>>,
        mut bent: impl Iterator<Item = Bending>,
        phase: impl Fn(&WingMotion) -> f64,
    ) -> Vec<Option<Vec<DVec3>>> {
        let wings = self.sheets.iter().zip(&self.motions).zip(&self.columns);
        let placed = wings.zip(poses).map(|(((sheet, motion), columns), pose)| {
            let bending = columns.as_ref().and_then(|c| Some((c, bent.next()?)));
            let pose = pose?;
            let Some((columns, bending)) = bending else {
                return Some(sheet.placed(pose, phase(motion)));
            };
            let mut nodes = sheet.nodes.clone();
            bend(&mut nodes, columns, &bending);
            Some(nodes.iter().map(|x| pose.0 + pose.1 * *x).collect())
        });
        placed.collect()
    }
}
