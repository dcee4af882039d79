//! The registry of the columns of history.csv: the one place that says what each column holds, how
//! it is named, in which unit and frame, and where it stands in a [`Record`].
//!
//! `table` holds the quantities; everything else follows from it: the header, the numbers of a row, the record
//! read back from a row and units and frames of the exports. Nobody else writes names of columns. Who reads a
//! history by itself, without its case or record by record, finds families of columns by the beginnings and
//! ends of their names: total force and driving power ([`crate::summary::air_force`],
//! [`crate::summary::driving_power`]), angles of joints in the figures.

use std::path::Path;

use wingbeat_dynamics::{DynamicsError, JointType};
use wingbeat_flight::{FlightSetup, JointCoordinate, Record, joint_coordinates, loop_names};
use wingbeat_model::Animal;

use crate::common::other_build::check_columns;
use crate::series::quantity::{Entry, Fold, Group, HistoryQuantity, Kind, Of, Unit};
use crate::series::table::GROUPS;
use wingbeat_case::{IoError, column_name};

/// Number of the column of the step.
pub const STEP: usize = 0;
/// Number of the column of the time.
pub const TIME: usize = 1;

/// One column of a history.
#[derive(Clone, Debug)]
pub struct Column {
    /// Name, with the unit at its end.
    pub name: String,
    /// Unit, as units are written: `m s-1`.
    pub unit: &'static str,
    /// Frame, in words.
    pub frame: &'static str,
    /// Symbol in NOTATION.md, if it has one.
    pub symbol: &'static str,
    /// What it holds, in words.
    pub about: String,
    /// How a row stands for the steps since the row before it.
    pub fold: Fold,
    /// Whether it holds whole numbers.
    pub is_count: bool,
    of: Of,
    quantity: &'static HistoryQuantity,
    subject: usize,
    component: usize,
}

impl Column {
    /// Where the number of this column stands in a record of its flight.
    fn entry<'a>(&self, record: &'a mut Record) -> Entry<'a> {
        (self.quantity.entry)(record, self.subject, self.component)
    }
}

/// A body, joint or other thing that has quantities.
#[derive(Clone, Debug)]
pub(crate) struct Subject {
    /// Name in names of columns.
    name: String,
    /// Name in words.
    words: String,
    kind: Kind,
    /// Its number in the record.
    index: usize,
}

/// The columns of a flight, in their order.
#[derive(Clone, Debug)]
pub struct Columns {
    list: Vec<Column>,
    /// Numbers of those that hold more than their own step.
    folded: Vec<usize>,
    counts: RecordCounts,
}

/// How many of each there are in a record of the flight.
#[derive(Clone, Copy, Debug)]
struct RecordCounts {
    bodies: usize,
    wings: usize,
    joints: usize,
    loops: usize,
    deforming: usize,
    elastic: usize,
    commanded: usize,
    following: usize,
    holding: usize,
}

/// Names of the bodies in column names: `body`, then `wing_NAME`, then `segment_NAME`.
pub fn column_stems(animal: &Animal) -> Vec<String> {
    bodies(animal).into_iter().map(|s| s.name).collect()
}

/// Numbers of the elastic wings.
fn elastic(animal: &Animal) -> impl Iterator<Item = usize> {
    let wings = animal.wings.iter().enumerate();
    wings.filter(|(_, w)| w.structure.is_some()).map(|(k, _)| k)
}

fn bodies(animal: &Animal) -> Vec<Subject> {
    let wings = animal.wings.iter().map(|w| (Kind::Wing, "wing", &w.name));
    let segments = animal.segments.iter();
    let segments = segments.map(|s| (Kind::Segment, "segment", &s.name));
    let mut list = vec![Subject::new("body".to_owned(), "the body", Kind::Body, 0)];
    for (kind, what, name) in wings.chain(segments) {
        let index = list.len();
        let column = format!("{what}_{}", column_name(name));
        list.push(Subject::new(column, &format!("{what} {name}"), kind, index));
    }
    list
}

impl Subject {
    pub(crate) fn new(name: String, words: &str, kind: Kind, index: usize) -> Self {
        Self {
            name,
            words: words.to_owned(),
            kind,
            index,
        }
    }

    /// The coordinate number `index` among all joints' coordinates.
    fn coordinate(c: &JointCoordinate, index: usize) -> Self {
        let kind = match c.kind {
            JointType::Prismatic { .. } => Kind::Displacement,
            _ => Kind::Rotation,
        };
        let what = match kind {
            Kind::Displacement => "displacement",
            _ => "rotation",
        };
        let number = match c.of {
            1 => String::new(),
            _ => format!("_{}", c.direction + 1),
        };
        let name = format!("{}_{what}{number}", column_name(&c.joint));
        let words = format!("{what}{} of joint {}", number.replace('_', " "), c.joint);
        Self::new(name, &words, kind, index)
    }
}

impl Columns {
    /// The columns of a flight; those of deforming wings only if `deforms`.
    ///
    /// # Errors
    /// Joints that cannot be assembled.
    pub fn new(setup: &FlightSetup, deforms: bool) -> Result<Self, DynamicsError> {
        let coordinates = joint_coordinates(setup)?;
        let loops = loop_names(setup)?;
        let bodies = bodies(&setup.animal);
        let wings = setup.animal.wings.len();
        let counts = RecordCounts {
            bodies: bodies.len(),
            wings,
            joints: coordinates.len(),
            loops: loops.len(),
            deforming: if deforms { wings } else { 0 },
            elastic: elastic(&setup.animal).count(),
            commanded: setup.feedback.as_ref().map_or(0, |_| wings),
            following: (setup.feedback.iter())
                .filter(|f| f.controller.follows())
                .count(),
            holding: (setup.feedback.iter())
                .filter(|f| f.controller.holds_attitude())
                .count(),
        };
        let elastic = elastic(&setup.animal).enumerate();
        let subjects = Subjects {
            elastic: elastic
                .map(|(k, w)| Subject {
                    index: k,
                    ..bodies[w + 1].clone()
                })
                .collect(),
            bodies,
            coordinates,
            loops,
        };
        let mut list = vec![];
        for group in GROUPS {
            for subject in subjects.of(group.of, &counts) {
                subject.columns(group, &mut list);
            }
        }
        let folded = list.iter().enumerate();
        let folded = folded.filter(|(_, c)| c.fold != Fold::Last);
        Ok(Self {
            folded: folded.map(|(k, _)| k).collect(),
            list,
            counts,
        })
    }

    /// The columns of the history in a file with this header, in their order there.
    ///
    /// # Errors
    /// As [`Self::new`], of the case beside it; a history with other columns than these, which another build wrote.
    pub(crate) fn in_file(
        path: &Path,
        setup: &FlightSetup,
        header: &[String],
    ) -> Result<Self, IoError> {
        let columns = |deforms| {
            Self::new(setup, deforms).map_err(|e| IoError::Damaged {
                path: path.with_file_name("case.toml"),
                problem: format!("the joints of this case do not fit together: {e}"),
            })
        };
        let all = columns(true)?;
        let is_there = |c: &Column| c.of == Of::Deforming && header.contains(&c.name);
        let deforms = all.iter().any(is_there);
        let own = if deforms { all } else { columns(false)? };
        check_columns(path, &own.names(), header)?;
        Ok(own)
    }

    /// The columns of the history that this record begins.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of(setup: &FlightSetup, record: &Record) -> Result<Self, DynamicsError> {
        Self::new(setup, !record.deformation_power.is_empty())
    }

    /// The columns.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Column> {
        self.list.iter()
    }

    /// The names of all columns.
    pub fn names(&self) -> Vec<String> {
        self.iter().map(|c| c.name.clone()).collect()
    }

    /// The column of this name.
    pub fn find(&self, name: &str) -> Option<&Column> {
        self.list.iter().find(|c| c.name == name)
    }

    /// A record of the right shape, every number zero.
    pub fn blank(&self) -> Record {
        let s = self.counts;
        let children = s.bodies - 1;
        Record {
            wing_angles: vec![Default::default(); s.wings],
            commands: vec![Default::default(); s.commanded],
            reference: vec![Default::default(); s.following],
            attitude_departure: vec![0.0; s.holding],
            coordinates: vec![0.0; 6 * s.bodies],
            rates: vec![0.0; 6 * s.bodies],
            accelerations: vec![Default::default(); s.bodies],
            multipliers: vec![0.0; 6 * children],
            hinges: vec![Default::default(); children],
            loops: vec![Default::default(); s.loops],
            joints: vec![[0.0; 2]; s.joints],
            deformation_power: vec![0.0; s.deforming],
            elastic: vec![Default::default(); s.elastic],
            air: vec![Default::default(); s.bodies],
            applied: vec![Default::default(); s.bodies],
            ..Record::default()
        }
    }

    /// The numbers of a record in the order of the columns; `scratch` is room for a copy.
    pub fn values(&self, record: &Record, scratch: &mut Record, values: &mut Vec<f64>) {
        scratch.clone_from(record);
        values.clear();
        values.extend(self.list.iter().map(|c| c.entry(scratch).get()));
    }

    /// Joins the numbers of `record` to those of the steps since the last row, `row`, in the columns
    /// that hold more than their own step; `is_first` of these steps.
    pub(crate) fn fold(&self, record: &mut Record, is_first: bool, row: &mut [f64]) {
        for &k in &self.folded {
            let column = &self.list[k];
            let value = column.entry(record).get();
            row[k] = match is_first {
                true => value,
                false => column.fold.join(row[k], value),
            };
        }
    }

    /// Puts the numbers of `record` into the columns of `row` that hold their own step.
    pub(crate) fn hold(&self, record: &mut Record, row: &mut [f64]) {
        let own = self.list.iter().zip(row);
        for (column, value) in own.filter(|(c, _)| c.fold == Fold::Last) {
            *value = column.entry(record).get();
        }
    }

    /// The number of column `k` of a record of its flight, which stays as it is.
    pub fn value(&self, k: usize, record: &mut Record) -> f64 {
        self.list[k].entry(record).get()
    }

    /// Puts the number of column `k` into a record of [`Self::blank`]'s shape.
    pub(crate) fn put(&self, k: usize, value: f64, record: &mut Record) {
        self.list[k].entry(record).set(value);
    }
}

/// Everything that has quantities.
struct Subjects {
    elastic: Vec<Subject>,
    bodies: Vec<Subject>,
    coordinates: Vec<JointCoordinate>,
    loops: Vec<String>,
}

impl Subjects {
    fn of(&self, of: Of, counts: &RecordCounts) -> Vec<Subject> {
        let numbered = |range: std::ops::Range<usize>| {
            let one =
                |k| Subject::new(format!("{}", k + 1), &format!("{}", k + 1), Kind::Flight, k);
            range.map(one).collect()
        };
        let flight = |times| vec![Subject::new(String::new(), "", Kind::Flight, 0); times];
        let half = 3 * (counts.bodies - 1);
        match of {
            Of::Flight => flight(1),
            Of::Steered => flight(counts.commanded.min(1)),
            Of::Following => flight(counts.following),
            Of::Holding => flight(counts.holding),
            Of::Elastic => self.elastic.clone(),
            Of::Bending => flight(counts.elastic.min(1)),
            Of::Jointed => flight(counts.joints.min(1)),
            Of::Bodies => self.bodies.clone(),
            Of::Wings => self.wings(counts.wings),
            Of::Deforming => self.wings(counts.deforming),
            Of::Commanded => self.wings(counts.commanded),
            Of::Children => {
                let shifted = |s: &Subject| Subject {
                    index: s.index - 1,
                    ..s.clone()
                };
                self.bodies[1..].iter().map(shifted).collect()
            }
            Of::Connections => numbered(0..half),
            Of::Orientations => numbered(half..2 * half),
            Of::Coordinates => {
                let all = self.coordinates.iter().enumerate();
                all.map(|(k, c)| Subject::coordinate(c, k)).collect()
            }
            Of::Loops => {
                let one = |(k, name): (usize, &String)| {
                    Subject::new(
                        column_name(name),
                        &format!("joint {name}"),
                        Kind::Segment,
                        k,
                    )
                };
                self.loops.iter().enumerate().map(one).collect()
            }
        }
    }

    fn wings(&self, count: usize) -> Vec<Subject> {
        let wing = |s: &Subject| Subject {
            index: s.index - 1,
            ..s.clone()
        };
        self.bodies[1..=count].iter().map(wing).collect()
    }
}

impl Subject {
    /// Adds the columns of its quantities in a group.
    fn columns(&self, group: &'static Group, list: &mut Vec<Column>) {
        for quantity in group.quantities {
            let letters = quantity.components.names(self.kind);
            for (component, letter) in letters.iter().enumerate() {
                list.push(self.column(group.of, quantity, component, letter));
            }
        }
    }

    /// The column of a component of a quantity of its group.
    pub(crate) fn column(
        &self,
        of: Of,
        q: &'static HistoryQuantity,
        component: usize,
        letter: &str,
    ) -> Column {
        let unit = q.unit.of(self.kind);
        let name = q.name.replace("{s}", &self.name).replace("{c}", letter);
        Column {
            name: name + "_" + unit.suffix(),
            unit: unit.symbol(),
            frame: q.frame.words(self.kind),
            symbol: q.symbol,
            about: q.about.replace("{s}", &self.words).replace("{c}", letter),
            fold: q.fold,
            is_count: unit == Unit::Count,
            of,
            quantity: q,
            subject: self.index,
            component,
        }
    }
}
