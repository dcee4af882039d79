//! The shapes of wings that deform, one after the other: those of elastic wings from the frames, or, where there are
//! none, as rows of the history tell four sections; prescribed ones from the case, at every row.

use wingbeat_math::DVec3;

use crate::export::source::Source;
use crate::snapshots::frames::{self, Frame, Mesh};
use crate::snapshots::poses::{Poses, picture};
use wingbeat_case::IoError;

/// The wings that deform, and where their shapes come from.
pub(super) struct Shapes {
    /// Of every such wing: its number among the surfaces, and whether frames have its shapes.
    wings: Vec<(usize, bool)>,
    /// Steps of the frames that are read.
    steps: Vec<usize>,
}

impl Shapes {
    /// Of the wings of a result.
    ///
    /// # Errors
    /// Frames that are missing.
    pub fn of(source: &Source) -> Result<Self, IoError> {
        let wings = source.case.setup.animal.wings.iter().enumerate();
        let mut steps = frames::steps(source.dir.path())?;
        let deforming = wings.filter(|(_, w)| w.deformation.is_some() || w.structure.is_some());
        let wings: Vec<_> = deforming
            .map(|(k, w)| (k, w.structure.is_some() && !steps.is_empty()))
            .collect();
        if !wings.iter().any(|w| w.1) {
            steps.clear();
        }
        Ok(Self { wings, steps })
    }

    /// Numbers of the wings among the surfaces.
    pub fn surfaces(&self) -> impl Iterator<Item = usize> {
        self.wings.iter().map(|w| w.0)
    }

    /// Hands over all shapes in the order of their times: number of the wing in [`Shapes::surfaces`], time
    /// \[s\], displacements of its nodes from rest, wing axes \[m\].
    ///
    /// # Errors
    /// A history or frames that cannot be read; what `take` answers.
    pub fn each(
        &self,
        source: &Source,
        poses: &Poses,
        mut take: impl FnMut(usize, f64, Vec<DVec3>) -> Result<(), IoError>,
    ) -> Result<(), IoError> {
        let mut rows = source.rows()?;
        while !self.wings.is_empty()
            && let Some(row) = rows.next_row()?
        {
            let step = row[0] as usize;
            let frame = match self.steps.binary_search(&step) {
                Ok(_) => Some(Frame::part(source.dir.path(), step, 0)?),
                Err(_) => None,
            };
            for (k, &(surface, is_framed)) in self.wings.iter().enumerate() {
                let nodes = match (&frame, is_framed) {
                    (Some(frame), true) => framed(source, poses, row, (frame, surface))?,
                    (None, true) => continue,
                    (_, false) => poses.shape(row, surface),
                };
                let at_rest = &poses.surfaces[surface].nodes;
                let shape = nodes.iter().zip(at_rest).map(|(x, rest)| *x - *rest);
                take(k, row[1], shape.collect())?;
            }
        }
        Ok(())
    }
}

/// Nodes of a wing in a frame, wing axes \[m\].
fn framed(
    source: &Source,
    poses: &Poses,
    row: &[f64],
    (frame, surface): (&Mesh, usize),
) -> Result<Vec<DVec3>, IoError> {
    let own = &poses.surfaces[surface];
    let before = poses.surfaces[..surface].iter();
    let first: usize = before.map(|s| s.nodes.len()).sum();
    let nodes = frame.points.get(first..first + own.nodes.len());
    let nodes = nodes.ok_or_else(|| IoError::Damaged {
        path: Frame::paths(source.dir.path(), row[0] as usize)[0].clone(),
        problem: format!(
            "this frame lacks nodes of the wing `{}`: it belongs to another animal than case.toml",
            own.name
        ),
    })?;
    let (p, r) = poses.pose(row, own.body);
    // Picture axes from N turn back as they turn.
    let in_n = |x: &[f64; 3]| DVec3::from_array(picture(DVec3::from_array(*x)));
    let place = |x: &[f64; 3]| r.transpose() * (in_n(x) - p);
    Ok(nodes.iter().map(place).collect())
}
