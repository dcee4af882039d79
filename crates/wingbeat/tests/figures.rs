//! `wingbeat plot`: every figure, in both styles and formats, never over another one unasked; an
//! animation that moves.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::refused_untouched as refused;
use crate::support::{Scratch, flown, wingbeat};
use wingbeat::draw::figures::Kind;

const CASE: [&str; 15] = [
    "run",
    "fruit-fly-hover",
    "--quiet",
    "--out",
    "run",
    "--set",
    "time.beats=1.25",
    "--set",
    "wing.right.mesh.spanwise=6",
    "--set",
    "wing.right.mesh.chordwise=3",
    "--set=air.shed=[\"trailing\"]",
    "--set=air.body=false",
    "--set=air.mirror=false",
    "--set=control={}",
];

/// Draws, and returns the files the program names.
fn plotted(dir: &Path, args: &[&str]) -> Vec<PathBuf> {
    let out = wingbeat(dir, &[&["plot", "run"][..], args].concat());
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{args:?}: {said}");
    let files = String::from_utf8(out.stdout).unwrap();
    files.lines().map(|f| dir.join(f)).collect()
}

/// Width and height of a PNG file.
fn pixels(png: &[u8]) -> [u32; 2] {
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

/// Width and height of an SVG file [points].
fn points(svg: &str) -> [f64; 2] {
    ["width", "height"].map(|name| {
        let tag = format!("{name}=\"");
        let value = svg.split(&tag).nth(1).unwrap().split("pt\"").next();
        value.unwrap().parse().unwrap()
    })
}

#[test]
fn exact_every_figure_is_drawn_in_all_styles_and_formats() {
    let scratch = Scratch::new("figures");
    flown(&scratch.0, &CASE);
    let still: Vec<&str> = Kind::ALL
        .iter()
        .map(|k| k.0)
        .filter(|k| !matches!(*k, "animation" | "bending")) // no wing of this flight is elastic
        .collect();
    for (style, per_point) in [("screen", 2.0), ("paper", 300.0 / 72.0), ("dark", 2.0)] {
        let folder = ["--style", style, "--out", style];
        let svgs = plotted(&scratch.0, &folder);
        let stems: Vec<&str> = svgs
            .iter()
            .map(|f| f.file_stem().unwrap().to_str().unwrap())
            .collect();
        assert_eq!(stems, still);
        let pngs = plotted(&scratch.0, &[&folder[..], &["--format", "png"]].concat());
        for (svg, png) in svgs.iter().zip(&pngs) {
            let text = fs::read_to_string(svg).unwrap();
            assert!(text.starts_with("<svg") && text.ends_with("</svg>\n"));
            assert!(
                !text.contains("NaN") && !text.contains("inf"),
                "{}",
                svg.display()
            );
            assert!(text.contains("</text>"), "no words in {}", svg.display());
            let found = pixels(&fs::read(png).unwrap());
            let wanted = points(&text).map(|p| (p * per_point).ceil());
            for c in [0, 1] {
                assert!(
                    (f64::from(found[c]) - wanted[c]).abs() <= 1.0,
                    "{}",
                    png.display()
                );
            }
        }
    }
    for figure in still {
        let [light, dark] = ["screen", "dark"].map(|style| {
            let file = scratch.0.join(style).join(figure).with_extension("svg");
            fs::read_to_string(file).unwrap()
        });
        assert!(light.contains("fill=\"#ffffff\"") && dark.contains("fill=\"#11161f\""));
        assert!(
            !dark.contains("#ffffff") && !dark.contains("#282828"),
            "{figure}"
        );
        assert_eq!(light.lines().count(), dark.lines().count(), "{figure}");
    }
    let paper = fs::read_to_string(scratch.0.join("paper/forces.svg")).unwrap();
    assert!(paper.contains("width=\"510pt\""), "180 mm are 510 points");
    assert!(!paper.contains("fruit-fly-hover"), "a title in a paper");
    // What the title would say is said for the caption.
    let again = [
        "plot", "run", "wake", "forces", "--style", "paper", "--out", "again",
    ];
    let said = String::from_utf8(wingbeat(&scratch.0, &again).stderr).unwrap();
    for words in [
        "for the caption of again/wake.svg: fruit-fly-hover: wakes after 1.25 wingbeats",
        "for the caption of again/forces.svg: fruit-fly-hover: forces and power (downstroke",
    ] {
        assert!(said.contains(words), "{said}");
    }
    let axes = [
        "force of the air / weight",
        "power of the hinges [µW]",
        "wingbeats",
    ];
    for name in axes {
        assert!(paper.contains(&format!(">{name}<")), "no axis {name}");
    }
    // One downstroke, shaded in both panels; curves differ in their dashes, too.
    assert!(paper.matches("#e9e9ec").count() == 2 && paper.contains("stroke-dasharray"));
}

#[test]
fn refuses_to_replace_figures_unasked() {
    let scratch = Scratch::new("figures-kept");
    let args = ["--set", "time.beats=0.3", "--set=air.model=none"];
    flown(&scratch.0, &[&CASE[..5], &args].concat());
    // The run has drawn this one: the same figure again is no conflict.
    assert_eq!(
        plotted(&scratch.0, &["angles", "angles"]),
        [scratch.0.join("run/figures/angles.svg")]
    );
    let file = scratch.0.join("run/figures/angles.svg");
    let drawn = fs::read(&file).unwrap();
    fs::write(&file, "mine").unwrap();
    refused(
        &scratch.0,
        &["plot", "run", "angles"],
        "exists already and is left untouched",
    );
    assert_eq!(fs::read(&file).unwrap(), b"mine");
    plotted(&scratch.0, &["angles", "--overwrite"]);
    assert_eq!(fs::read(&file).unwrap(), drawn);
    plotted(&scratch.0, &["animation"]);
    refused(&scratch.0, &["plot", "run", "animation"], "exists already");
    let on_paper = ["plot", "run", "animation", "--style", "paper"];
    refused(&scratch.0, &on_paper, "drawn for screen or dark");
    let at_step = ["plot", "run", "trajectory", "--step", "1"];
    refused(&scratch.0, &at_step, "error: --step has no effect");
    let turned = ["plot", "run", "angles", "--from", "0.2", "--to", "0.1"];
    refused(
        &scratch.0,
        &turned,
        "error: --from 0.2 does not lie before --to 0.1",
    );
    // Of options alone, before the run is looked at.
    let moving = ["plot", "nowhere", "angles", "--format", "gif"];
    refused(
        &scratch.0,
        &moving,
        "error: --format gif: angles is written as svg, png or pdf",
    );
    let thrice = [
        "plot", "nowhere", "--from", "1", "--to", "2", "--beats", "1",
    ];
    refused(&scratch.0, &thrice, "error: --beats says too much");
    for (kind, reason) in [
        ("forces", "this flight has no air"),
        ("wake", "no frames were written"),
        ("beats", "no whole wingbeat"),
        ("nonsense", "choose from angles, forces"),
    ] {
        refused(&scratch.0, &["plot", "run", kind], reason);
    }
    assert!(!scratch.0.join("run/figures/forces.svg").exists());
    // Of several kinds those are drawn that there are.
    let several = ["plot", "run", "forces", "trajectory", "--out", "several"];
    let out = wingbeat(&scratch.0, &several);
    let said = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(1), "{said}");
    assert!(
        said.contains("forces.svg` cannot be drawn: this flight has no air"),
        "{said}"
    );
    assert!(scratch.0.join("several/trajectory.svg").exists());
}

#[test]
fn exact_the_animation_moves() {
    let scratch = Scratch::new("figures-animation");
    let args = [
        "--set",
        "time.beats=0.3",
        "--set=air.shed=[\"trailing\"]",
        "--set=air.body=false",
        "--set=motion.start_beats=0.1",
    ];
    flown(&scratch.0, &[&CASE[..5], &args].concat());
    let files = plotted(&scratch.0, &["animation"]);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let file = fs::File::open(&files[0]).unwrap();
    let mut decoder = options.read_info(file).unwrap();
    let mut pictures: Vec<Vec<u8>> = vec![];
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        pictures.push(frame.buffer.to_vec());
    }
    assert_eq!(pictures.len(), 7); // 12 steps, every second one written
    let changed = |a: &[u8], b: &[u8]| {
        let differ = |p: &(&[u8], &[u8])| (0..3).any(|c| p.0[c].abs_diff(p.1[c]) > 60);
        a.chunks(4).zip(b.chunks(4)).filter(differ).count()
    };
    let all = pictures[0].len() / 4;
    for pair in pictures.windows(2) {
        let n = changed(&pair[0], &pair[1]);
        assert!(n > all / 1000 && n < all / 2, "{n} of {all} pixels changed");
    }
}

/// A program in place of ffmpeg that says more than a pipe holds before it takes a picture: the film is made, or its
/// last words are heard. The file is named so that it is no option.
#[cfg(unix)]
#[test]
fn behaves_a_film_is_made_by_a_program_that_says_much() {
    use std::os::unix::fs::PermissionsExt as _;
    let scratch = Scratch::new("figures-film");
    let dir = &scratch.0;
    let args = ["--set", "time.beats=0.1", "--set=air.model=none"];
    flown(dir, &[&CASE[..5], &args].concat());
    let path = std::env::var("PATH").unwrap();
    let path = format!("{}:{path}", dir.join("bin").display());
    fs::create_dir(dir.join("bin")).unwrap();
    for (end, wanted) in [(0, Some(0)), (3, Some(2))] {
        let script = format!(
            "#!/bin/sh\nhead -c 300000 /dev/zero | tr '\\0' x >&2\nfor last; do :; done\ncat > \"${{last#file:}}\"\necho >&2; echo that was all >&2\nexit {end}\n"
        );
        let ffmpeg = dir.join("bin/ffmpeg");
        fs::write(&ffmpeg, script).unwrap();
        fs::set_permissions(&ffmpeg, fs::Permissions::from_mode(0o755)).unwrap();
        let out = std::process::Command::new("timeout")
            .args(["100", env!("CARGO_BIN_EXE_wingbeat"), "plot", "run"])
            .args([
                "animation",
                "--format",
                "mp4",
                "--out",
                "film",
                "--overwrite",
            ])
            .env("PATH", &path)
            .current_dir(dir)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), wanted, "{said}");
        assert_eq!(said.contains("that was all"), end != 0, "{said}");
        assert!(dir.join("film/animation.mp4").exists());
    }
}

/// The part of the flight that is asked for, and no other.
#[test]
fn exact_a_window_of_the_flight_is_drawn() {
    let scratch = Scratch::new("figures-window");
    let args = ["--set", "time.beats=3", "--set=air.model=none"];
    flown(&scratch.0, &[&CASE[..5], &args].concat());
    let curve = |args: &[&str]| {
        let files = plotted(
            &scratch.0,
            &[args, &["--out", "window", "--overwrite"]].concat(),
        );
        let svg = fs::read_to_string(&files[0]).unwrap();
        let longest = svg
            .split("d=\"M")
            .map(|p| p.split('"').next().unwrap().matches('L').count());
        longest.max().unwrap() + 1
    };
    let all = curve(&["angles"]);
    assert_eq!(all % 3, 1, "{all} points"); // three beats and the last step
    let beat = all / 3;
    assert_eq!(
        curve(&["angles", "--from", "1", "--to", "2.5"]),
        beat * 3 / 2 + 1
    );
    assert_eq!(curve(&["angles", "--beats", "1"]), beat + 1);
    assert_eq!(
        curve(&["angles", "--to", "2", "--beats", "0.5"]),
        beat / 2 + 1
    );
    let words = |kind: &str, args: &[&str]| {
        let args = [&[kind], args, &["--out", "words", "--overwrite"]].concat();
        fs::read_to_string(&plotted(&scratch.0, &args)[0]).unwrap()
    };
    let second = ["--from", "1", "--to", "2"];
    for (kind, args, said) in [
        (
            "angles",
            &["--from", "1", "--to", "2.5"][..],
            ", 1 to 2.5 wingbeats<",
        ),
        (
            "lollipop",
            &second,
            "chord of wing right and force of the air in wingbeat 2<",
        ),
        ("lollipop", &[], "in the last wingbeat<"),
        (
            "beats",
            &second,
            "with means (downstroke shaded), 1 to 2 wingbeats<",
        ),
        ("phase", &second, ", 1 to 2 wingbeats<"),
        ("path", &second, ">after 1 beat<"),
        ("path", &[], ">start<"),
        (
            "trajectory",
            &second,
            "position from the start of this part [",
        ),
        ("trajectory", &[], "position from the start ["),
    ] {
        let svg = words(kind, args);
        assert!(svg.contains(said), "{kind} {args:?} does not say: {said}");
    }
    for kind in ["lollipop", "beats"] {
        let half = ["plot", "run", kind, "--from", "2", "--to", "2.5"];
        refused(
            &scratch.0,
            &half,
            "no whole wingbeat from 2 to 2.5 wingbeats",
        );
    }
    for (args, reason) in [
        (
            &["--from", "3.5"][..],
            "which lasts from 0 to 3.0000 wingbeats",
        ),
        (
            &["--from", "0", "--to", "1", "--beats", "1"],
            "leave one of them out",
        ),
        (&["--beats", "-1"], "give a finite number above 0"),
    ] {
        refused(
            &scratch.0,
            &[&["plot", "run", "angles"], args].concat(),
            reason,
        );
    }
}

/// A history of every ninth step is not drawn as if it were all of them.
#[test]
fn behaves_thinned_histories_say_so() {
    let scratch = Scratch::new("figures-thinned");
    let args = ["--set=time.beats=1.25", "--set=output.history_every=9"];
    flown(&scratch.0, &[&CASE[..], &args].concat());
    let stills = [
        "angles",
        "forces",
        "lollipop",
        "beats",
        "trajectory",
        "path",
        "phase",
        "balances",
    ];
    for file in plotted(&scratch.0, &[&stills[..], &["--out", "drawn"]].concat()) {
        let svg = fs::read_to_string(&file).unwrap();
        assert!(svg.contains(", every 9th step<"), "{}", file.display());
    }
    let page = fs::read_to_string(scratch.0.join("run/flight.html")).unwrap();
    assert!(page.contains("plots with every 9th step, as history.csv"));
}
