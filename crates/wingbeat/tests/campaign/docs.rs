//! The page on campaigns: its file is a campaign, its commands run, in their order.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::Scratch;

/// The blocks of a page in a language.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let start = format!("```{language}\n");
    let rest = page.split(&start[..]).skip(1);
    rest.map(|b| b.split("```").next().unwrap()).collect()
}

#[test]
fn behaves_every_command_of_the_page_runs() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/campaigns.md");
    let page = fs::read_to_string(page).unwrap();
    let scratch = Scratch::new("campaign-docs");
    let dir = &scratch.0;
    fs::write(dir.join("map.toml"), blocks(&page, "toml")[0]).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_wingbeat")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut count = 0;
    for line in blocks(&page, "sh").iter().flat_map(|b| b.lines()) {
        let out = Command::new("sh")
            .args(["-c", line])
            .current_dir(dir)
            .env("PATH", &path)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&out.stderr);
        assert!(out.status.success(), "{line}\n{said}");
        count += 1;
    }
    assert!(count >= 13, "{count} commands");
    assert!(dir.join("results/map/campaign.html").is_file());
    let kept = fs::read_dir(dir.join("results/map/files")).unwrap();
    assert_eq!(kept.count(), 5, "every 20th of 90 points");
    // The script of SLURM is a script, which runs its part; that of Snakemake names the same command.
    let script = fs::read_to_string(dir.join("map.sbatch")).unwrap();
    assert!(script.contains("#SBATCH --array=1-2") && script.contains("--time=00:10:00"));
    let array = Command::new("bash")
        .arg("map.sbatch")
        .current_dir(dir)
        .env("PATH", &path)
        .env("SLURM_ARRAY_TASK_ID", "2")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&array.stderr);
    assert!(
        array.status.success() && said.contains("45 points, 45 of them done"),
        "{said}"
    );
    let rule = fs::read_to_string(dir.join("Snakefile")).unwrap();
    assert!(rule.contains("--shard {wildcards.k}/2"), "{rule}");
}

/// Flights of the pages on the air are cases that `check` takes, and the campaign that varies them has its points.
#[test]
fn behaves_flights_of_the_pages_on_the_air_are_accepted() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let read = |page: &str| fs::read_to_string(docs.join(page)).unwrap();
    let scratch = Scratch::new("air-docs");
    let program = Path::new(env!("CARGO_BIN_EXE_wingbeat")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let accepted = |line: &str| {
        let out = Command::new("sh")
            .args(["-c", line])
            .current_dir(&scratch.0)
            .env("PATH", &path)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&out.stderr);
        assert!(out.status.success(), "{line}\n{said}");
        String::from_utf8_lossy(&out.stdout).into_owned()
    };
    let mut count = 0;
    for page in ["separated-flow.md", "lattice-settings.md"] {
        let page = read(page);
        let is_foil = |b: &&&str| b.contains("name = \"foil\"");
        for foil in blocks(&page, "toml").iter().filter(is_foil) {
            fs::write(scratch.0.join("foil.toml"), foil).unwrap();
        }
        for line in blocks(&page, "sh")
            .iter()
            .flat_map(|b| b.split("wingbeat run ").skip(1))
        {
            accepted(&format!("wingbeat check {line}"));
            count += 1;
        }
    }
    assert_eq!(count, 5, "commands");
    let page = read("choosing-the-air.md");
    fs::write(scratch.0.join("vary.toml"), blocks(&page, "toml")[0]).unwrap();
    let planned = accepted("wingbeat campaign plan vary.toml");
    assert_eq!(planned.lines().count(), 1 + 7, "{planned}");
}
