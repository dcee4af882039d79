//! What other engines need: an array of jobs for SLURM, a rule for Snakemake.

use crate::campaign::Campaign;
use crate::merge::FILES;
use wingbeat_case::shell;

/// A campaign for other engines.
#[derive(Clone, Copy, Debug)]
pub struct Engine<'a> {
    /// The file.
    pub file: &'a str,
    /// The directory.
    pub out: &'a str,
    /// Jobs.
    pub shards: usize,
    /// Processors of each.
    pub jobs: usize,
}

impl Engine<'_> {
    /// A script for `sbatch`: an array of jobs, a shard each. The notice before the time limit goes to the batch shell,
    /// which the campaign takes the place of.
    pub fn slurm(&self, campaign: &Campaign, time: &str) -> String {
        let Self { shards, jobs, .. } = self;
        let [file, out] = [self.file, self.out].map(shell);
        let name = campaign.name();
        let points = campaign.plan().points();
        format!(
            r#"#!/bin/bash
# {points} points in {shards} jobs of {jobs} processors: sbatch this file, again after a time limit or a lost node.
# Points that are done are not flown again. Afterwards: wingbeat campaign merge {file} --out {out}
#SBATCH --job-name={name:?}
#SBATCH --array=1-{shards}
#SBATCH --cpus-per-task={jobs}
#SBATCH --time={time}
#SBATCH --output=slurm-%A_%a.log
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
exec wingbeat campaign run {file} --out {out} --shard "$SLURM_ARRAY_TASK_ID/{shards}" --jobs "${{SLURM_CPUS_PER_TASK:-{jobs}}}"
"#
        )
    }

    /// A Snakefile: a rule for each shard, one that merges; `inputs` are the files that points follow from beside the
    /// campaign's own ([`Campaign::inputs`]).
    pub fn snakemake(&self, inputs: &[String]) -> String {
        let Self { shards, jobs, .. } = self;
        let out = for_pattern(self.out);
        let files = [self.file]
            .into_iter()
            .chain(inputs.iter().map(String::as_str));
        let files: Vec<_> = files.map(|path| python(&for_pattern(path))).collect();
        let files = files.join(", ");
        let place = |name: &str| python(&format!("{out}/{name}"));
        let tables = FILES.map(place).join(", ");
        // Snakemake makes the folders of outputs: in the campaign's own they would stand in its way.
        let done = python(&format!("{out}.shards/{{k}}.done"));
        let asked = format!("{} --out {}", shell(self.file), shell(self.out));
        let asked = for_pattern(&asked);
        let merge = python(&format!("wingbeat campaign merge {asked}"));
        let run = python(&format!(
            "wingbeat campaign run {asked} --shard {{wildcards.k}}/{shards} --jobs {{threads}} --quiet"
        ));
        format!(
            r#"# snakemake --cores all --snakefile THIS_FILE
SHARDS = range(1, {shards} + 1)

rule points:
    input: {files}, expand({done}, k=SHARDS)
    output: {tables}
    shell: {merge}

rule shard:
    input: {files}
    output: touch({done})
    threads: {jobs}
    shell: {run}
"#
        )
    }
}

/// A word that braces in patterns of Snakemake leave as it is.
fn for_pattern(word: &str) -> String {
    word.replace('{', "{{").replace('}', "}}")
}

/// A string of Python: what JSON writes.
fn python(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn engine(file: &'static str) -> Engine<'static> {
        Engine {
            file,
            out: "all maps",
            shards: 2,
            jobs: 1,
        }
    }

    #[test]
    fn behaves_a_snakefile_quotes_commands_for_python_and_the_shell() {
        let text = engine("map.toml").snakemake(&[]);
        let merge = r#"    shell: "wingbeat campaign merge map.toml --out 'all maps'""#;
        assert!(text.lines().any(|l| l == merge), "{text}");
        let run = r#"    shell: "wingbeat campaign run map.toml --out 'all maps' --shard {wildcards.k}/2 --jobs {threads} --quiet""#;
        assert!(text.lines().any(|l| l == run), "{text}");
    }

    #[test]
    fn behaves_quotes_and_braces_in_names_of_files_stay_in_their_strings() {
        let text = engine(r#"a "b" it's {c}.toml"#).snakemake(&["case.toml".to_owned()]);
        let merge = r#"    shell: "wingbeat campaign merge 'a \"b\" it'\\''s {{c}}.toml' --out 'all maps'""#;
        assert!(text.lines().any(|l| l == merge), "{text}");
        let input = r#"    input: "a \"b\" it's {{c}}.toml", "case.toml", expand("all maps.shards/{k}.done", k=SHARDS)"#;
        assert!(text.lines().any(|l| l == input), "{text}");
    }
}
