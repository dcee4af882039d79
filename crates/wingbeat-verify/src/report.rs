//! The report: all rows of all cases, as a page and as tables for machines.

use std::borrow::Cow;
use std::fmt::Write;

use crate::case::{Case, Part};
use crate::cases::select;
use crate::row::{Comparison, Row, Verdict, VerifyError};

/// Columns of the table for machines.
const COLUMNS: [&str; 11] = [
    "case",
    "quantity",
    "unit",
    "reference",
    "source",
    "computed",
    "error",
    "uncertainty",
    "tolerance",
    "verdict",
    "reason",
];

/// What one case gave.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Entry {
    /// Name of the case.
    pub case: Cow<'static, str>,
    /// What it is about.
    pub about: Cow<'static, str>,
    /// Part of the report.
    pub part: Part,
    /// Its rows.
    pub rows: Vec<Row>,
    /// Why it could not be run, if so: counts as a failed row.
    pub failure: Option<String>,
}

impl Entry {
    /// From the outcome of a case.
    pub fn of(case: &Case, outcome: Result<Vec<Row>, VerifyError>) -> Self {
        let (rows, failure) = match outcome {
            Ok(rows) => (rows, None),
            Err(e) => (Vec::new(), Some(e.to_string())),
        };
        Self {
            case: case.name.into(),
            about: case.about.into(),
            part: case.part,
            rows,
            failure,
        }
    }

    /// The courses behind its rows, for its figure.
    pub fn comparisons(&self) -> impl Iterator<Item = &Comparison> {
        self.rows.iter().filter_map(|r| r.comparison.as_ref())
    }

    /// The figures of the case: comparisons that share their abscissas.
    pub fn figures(&self) -> Vec<Vec<&Comparison>> {
        let shared = |a: &Comparison, b: &Comparison| {
            let abscissas = |c: &Comparison| c.points.iter().map(|p| p[0]).collect::<Vec<_>>();
            a.along == b.along && abscissas(a) == abscissas(b)
        };
        let mut figures: Vec<Vec<&Comparison>> = vec![];
        for c in self.comparisons() {
            match figures.iter_mut().find(|f| shared(f[0], c)) {
                Some(figure) => figure.push(c),
                None => figures.push(vec![c]),
            }
        }
        figures
    }

    /// Name of the file of figure `k`, from 0.
    pub fn figure_name(&self, k: usize) -> String {
        match k {
            0 => format!("{}.svg", self.case),
            _ => format!("{}-{}.svg", self.case, k + 1),
        }
    }

    /// Rows that pass, fail, have no verdict; a case that could not be run is a failed row.
    pub fn counts(&self) -> [usize; 3] {
        let of = |v| self.rows.iter().filter(|r| r.verdict() == v).count();
        let failed = usize::from(self.failure.is_some());
        [
            of(Verdict::Pass),
            of(Verdict::Fail) + failed,
            of(Verdict::Unjudged),
        ]
    }
}

/// All entries of one run of the suite.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Report {
    /// Whether this is the short set.
    pub quick: bool,
    /// One entry a case.
    pub entries: Vec<Entry>,
}

const PARTS: [(Part, &str); 4] = [
    (
        Part::Analytic,
        "Closed forms, theory, conservation, invariance",
    ),
    (Part::Programs, "Published numbers of other programs"),
    (Part::Experiments, "Experiments"),
    (Part::Sensitivity, "Sensitivity to our own choices"),
];

impl Report {
    /// Folder, beside the page, of the figures that the page shows: CASE.svg of every case with
    /// [`Entry::comparisons`].
    pub const FIGURES: &str = "verification";

    /// Rows that pass, fail, have no verdict.
    pub fn counts(&self) -> [usize; 3] {
        self.entries.iter().fold([0; 3], added)
    }

    /// The page, in Markdown; `version` is that of the program.
    pub fn page(&self, version: &str) -> String {
        let [pass, fail, unjudged] = self.counts();
        let (set, command) = if self.quick {
            ("short set", "wingbeat verify --quick --out docs")
        } else {
            ("whole set", "wingbeat verify --out docs")
        };
        let mut text = format!(
            "# Verification\n\nMade by `{command}` of wingbeat {version} ({set}); do not edit. \
             {pass} rows pass, {fail} fail, {unjudged} are reported without a verdict.\n\n\
             The error is the computed value less the reference. The uncertainty is our own, from refinement of mesh \
             and step, or from the spread over wingbeats where it says so. A report compares \
             without judging: experiments are not fitted, all insects fly with one setting. The \
             same rows are in `verification.csv` and `verification.json`, those with the courses that figures show. \
             One case is computed again by `wingbeat verify --only NAME --out DIR`; `wingbeat verify --list` names all.\n"
        );
        self.page_left_out(&mut text);
        self.page_contents(&mut text);
        self.page_failures(&mut text);
        for (part, title) in PARTS {
            let entries = self.entries.iter().filter(|e| e.part == part);
            let body: String = entries.map(section).collect();
            if !body.is_empty() {
                let _ = write!(text, "\n## {title}\n{body}");
            }
        }
        text
    }

    /// The cases of every part, each a link to its section, with the rows that pass, fail, have no verdict.
    fn page_contents(&self, text: &mut String) {
        text.push_str(
            "\n## Contents\n\n| part | cases | pass | fail | reported |\n|---|---|---|---|---|\n",
        );
        for (part, title) in PARTS {
            let of_part = || self.entries.iter().filter(move |e| e.part == part);
            let links: Vec<String> = of_part().map(|e| format!("[{0}](#{0})", e.case)).collect();
            let [pass, fail, unjudged] = of_part().fold([0; 3], added);
            if !links.is_empty() {
                let links = links.join(", ");
                let _ = writeln!(text, "| {title} | {links} | {pass} | {fail} | {unjudged} |");
            }
        }
    }

    /// Cases of the set that were not run, so that a short report does not look whole.
    fn page_left_out(&self, text: &mut String) {
        let all = select(self.quick, "");
        let missing = all
            .iter()
            .filter(|c| self.entries.iter().all(|e| e.case != c.name));
        let names: Vec<&str> = missing.map(|c| c.name).collect();
        if !names.is_empty() {
            let _ = writeln!(text, "\nNot run, and so not here: {}.", names.join(", "));
        }
    }

    fn page_failures(&self, text: &mut String) {
        let has_failed = |e: &&Entry| e.counts()[1] > 0;
        if !self.entries.iter().any(|e| has_failed(&e)) {
            text.push_str("\nNo row fails.\n");
            return;
        }
        text.push_str("\n## Failed rows\n\n");
        for entry in self.entries.iter().filter(has_failed) {
            if let Some(failure) = &entry.failure {
                let _ = writeln!(text, "- {}: did not run: {failure}", entry.case);
            }
            let rows = entry.rows.iter().filter(|r| r.verdict() == Verdict::Fail);
            for r in rows {
                let (error, may) = (number(r.error()), number(r.tolerance.unwrap_or(0.0)));
                let unit = match &*r.unit {
                    "1" => String::new(),
                    unit => format!(" {unit}"),
                };
                let _ = writeln!(
                    text,
                    "- {}, {}: off by {error}{unit}, {may} would pass",
                    entry.case, r.quantity
                );
            }
        }
    }

    /// One row a line, comma separated, with a header.
    pub fn csv(&self) -> String {
        const LOST: &str = "a table in memory takes all rows";
        let mut table = csv::Writer::from_writer(vec![]);
        table.write_record(COLUMNS).expect(LOST);
        for e in &self.entries {
            for r in &e.rows {
                let cells = [
                    e.case.to_string(),
                    r.quantity.clone(),
                    r.unit.to_string(),
                    exact(r.reference),
                    r.source.to_string(),
                    exact(Some(r.computed)),
                    exact(Some(r.error())),
                    exact(r.uncertainty),
                    exact(r.tolerance),
                    word(r.verdict()).to_owned(),
                    r.reason.to_string(),
                ];
                let plain = cells.map(|c| c.replace("**", ""));
                table.write_record(plain).expect(LOST);
            }
            if let Some(failure) = &e.failure {
                let mut cells = [""; COLUMNS.len()];
                let failure = failure.replace("**", "");
                (cells[0], cells[9], cells[10]) = (&e.case, "fail", &failure);
                table.write_record(cells).expect(LOST);
            }
        }
        let text = table.into_inner().expect(LOST);
        String::from_utf8(text).expect("cells are texts")
    }

    /// From JSON that [`Self::json`] wrote.
    ///
    /// # Errors
    /// Text that is no verification report.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }

    /// As JSON.
    pub fn json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("plain data");
        text.push('\n');
        text
    }
}

/// Counts of rows with those of one more case.
fn added(counts: [usize; 3], entry: &Entry) -> [usize; 3] {
    let more = entry.counts();
    std::array::from_fn(|k| counts[k] + more[k])
}

fn section(entry: &Entry) -> String {
    let mut text = format!("\n### {}\n\n{}\n\n", entry.case, entry.about);
    for k in 0..entry.figures().len() {
        let (case, folder, name) = (&entry.case, Report::FIGURES, entry.figure_name(k));
        let _ = writeln!(text, "![{case}]({folder}/{name})\n");
    }
    if let Some(failure) = &entry.failure {
        let _ = writeln!(text, "**Did not run:** {failure}");
        return text;
    }
    text.push_str(
        "| quantity | reference | computed | error | uncertainty | tolerance | verdict |\n",
    );
    text.push_str("|---|---|---|---|---|---|---|\n");
    for r in &entry.rows {
        let or_dash = |x: Option<f64>| x.map_or("-".to_owned(), number);
        let _ = writeln!(
            text,
            "| {} [{}] | {} | {} | {} | {} | {} | {} |",
            r.quantity,
            r.unit,
            or_dash(r.reference),
            number(r.computed),
            r.reference.map_or("-".to_owned(), |_| number(r.error())),
            or_dash(r.uncertainty),
            or_dash(r.tolerance),
            word(r.verdict()),
        );
    }
    notes(entry, &mut text);
    text
}

/// Sources and reasons, each once.
fn notes(entry: &Entry, text: &mut String) {
    let mut seen: Vec<&str> = Vec::new();
    text.push('\n');
    for (label, of) in [
        ("Source", (|r| &r.source) as fn(&Row) -> &str),
        ("Tolerance", |r| &r.reason),
    ] {
        for r in &entry.rows {
            let note = of(r);
            if !note.is_empty() && !seen.contains(&note) {
                seen.push(note);
                let label = match (label, r.tolerance) {
                    ("Tolerance", None) => "Note",
                    _ => label,
                };
                let _ = writeln!(text, "{label}: {note}.  ");
            }
        }
    }
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "**fail**",
        Verdict::Unjudged => "report",
    }
}

/// Four significant digits.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        a if (1e-3..1e5).contains(&a) => {
            let digits = (3 - a.log10().floor() as i32).max(0) as usize;
            format!("{x:.digits$}")
        }
        _ => format!("{x:.2e}"),
    }
}

fn exact(x: Option<f64>) -> String {
    x.map_or(String::new(), |x| format!("{x:e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_committed_page_is_that_of_the_committed_rows() {
        let rows = Report::from_json(include_str!("../../../docs/verification.json")).unwrap();
        let page = include_str!("../../../docs/verification.md");
        assert!(
            rows.page(env!("CARGO_PKG_VERSION")) == page,
            "docs/verification.md is old"
        );
        assert!(page.contains("| [biot-savart-filament](#biot-savart-filament), [vortex-ring]"));
    }

    #[test]
    fn exact_committed_report_is_read_and_written_to_the_last_digit() {
        let text = include_str!("../../../docs/verification.json");
        let report = Report::from_json(text).unwrap();
        assert!(report.json() == text, "a digit was lost");
    }
}
