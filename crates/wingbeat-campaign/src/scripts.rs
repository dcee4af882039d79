//! What other engines need: an array of jobs for SLURM, a rule for Snakemake.

use crate::campaign::Campaign;

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
    /// A script for `sbatch`: an array of jobs, a shard each, then one that merges.
    pub fn slurm(&self, campaign: &Campaign, time: &str) -> String {
        let Self {
            file,
            out,
            shards,
            jobs,
        } = self;
        let name = &campaign.name;
        let points = campaign.plan.points();
        format!(
            r#"#!/bin/bash
# {points} points in {shards} jobs of {jobs} processors: sbatch this file, again after a time limit or a lost node.
# Points that are done are not flown again. Afterwards: wingbeat campaign merge {file} --out {out}
#SBATCH --job-name={name:?}
#SBATCH --array=1-{shards}
#SBATCH --cpus-per-task={jobs}
#SBATCH --time={time}
#SBATCH --output=slurm-%A_%a.log
#SBATCH --signal=TERM@60
#SBATCH --requeue
exec wingbeat campaign run "{file}" --out "{out}" --shard "$SLURM_ARRAY_TASK_ID/{shards}" --jobs "${{SLURM_CPUS_PER_TASK:-{jobs}}}"
"#
        )
    }

    /// A Snakefile: a rule for each shard, one that merges.
    pub fn snakemake(&self) -> String {
        let Self {
            file,
            out,
            shards,
            jobs,
        } = self;
        format!(
            r#"# snakemake --cores all --snakefile THIS_FILE
SHARDS = range(1, {shards} + 1)

rule points:
    input: "{file}", expand("{out}/shards/{{k}}.done", k=SHARDS)
    output: "{out}/points.csv", "{out}/points.parquet", "{out}/points.nc", "{out}/failed.csv"
    shell: "wingbeat campaign merge {file:?} --out {out:?}"

rule shard:
    input: "{file}"
    output: touch("{out}/shards/{{k}}.done")
    threads: {jobs}
    shell: "wingbeat campaign run {file:?} --out {out:?} --shard {{wildcards.k}}/{shards} --jobs {{threads}} --quiet"
"#
        )
    }
}
