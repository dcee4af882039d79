//! Readers of cases, checkpoints, frames and histories are fed with damaged input: they may refuse
//! it, they must not panic. Mutations are made from a counter, so every run is the same. This is the
//! quick one; `scripts/fuzz.sh` lets coverage guide the damage, and what it finds stays in its corpus,
//! which is read and damaged here, too.

use std::path::Path;

use wingbeat_case::{LoadedCase, presets::PRESETS};
use wingbeat_flight::{FlightState, Simulation};
use wingbeat_math::SplitMix64;
use wingbeat_results::History;
use wingbeat_results::checkpoint::{self, Header};
use wingbeat_results::frames::Mesh;
use wingbeat_results::vtp::PolyData;

/// Numbers that look random, the same ones in every run.
struct Chance(SplitMix64);

impl Chance {
    fn below(&mut self, n: usize) -> usize {
        (self.0.bits() % n.max(1) as u64) as usize
    }
}

/// Words that are put into the input.
const WORDS: [&str; 20] = [
    "0",
    "-1",
    "1e308",
    "1e-308",
    "nan",
    "inf",
    "-0.0",
    "99999999999999999999",
    "[",
    "]",
    "{",
    "}",
    "=",
    "\n",
    "\"",
    "\u{fc}",
    "[[load]]\n",
    "true",
    "scale = 0\n",
    ",",
];

/// One to four damages.
fn damage(input: &[u8], chance: &mut Chance) -> Vec<u8> {
    let mut data = input.to_vec();
    for _ in 0..=chance.below(4) {
        let at = chance.below(data.len());
        let length = 1 + chance.below(24).min(data.len().saturating_sub(at + 1));
        let end = (at + length).min(data.len());
        match chance.below(7) {
            0 if at < data.len() => data[at] ^= 1 << chance.below(8),
            1 => drop(data.drain(at..end)),
            2 => {
                let part = data[at..end].to_vec();
                data.splice(at..at, part);
            }
            3 => data.truncate(at),
            4 => {
                let from = chance.below(data.len());
                let part = data[from..(from + length).min(data.len())].to_vec();
                data.splice(at..end, part);
            }
            _ => {
                let word = WORDS[chance.below(WORDS.len())];
                let replaced = if chance.below(2) == 0 {
                    at..end
                } else {
                    at..at
                };
                data.splice(replaced, word.bytes());
            }
        }
    }
    data
}

/// What fuzzing keeps of a kind of input.
fn committed(kind: &str) -> Vec<Vec<u8>> {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fuzz/corpus");
    let files = std::fs::read_dir(Path::new(root).join(kind)).unwrap();
    let mut files: Vec<_> = files.map(|f| f.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty(), "the corpus `{kind}` is empty");
    files.iter().map(|f| std::fs::read(f).unwrap()).collect()
}

/// The inputs that are damaged.
struct Corpus {
    cases: Vec<Vec<u8>>,
    kept: Vec<Vec<u8>>,
    checkpoint: Vec<u8>,
    header: Header,
    frame: Vec<u8>,
    history: Vec<u8>,
}

fn corpus() -> Corpus {
    let set = [
        "time.beats=0.1",
        "air.body=false",
        "wing.right.mesh.spanwise=3",
    ]
    .map(str::to_owned);
    let case = LoadedCase::find("fruit-fly-hover", &set).unwrap();
    let mut flight = Simulation::new(case.setup).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let header = Header {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        case_sha256: "0".repeat(64),
        step: flight.state().step,
        history_bytes: 1,
        history_sha256: "1".repeat(64),
        pending: vec![],
        each_step: vec![],
    };
    let presets = PRESETS.iter().map(|p| p.text.as_bytes().to_vec());
    Corpus {
        cases: presets.chain(committed("case")).collect(),
        kept: committed("checkpoint"),
        checkpoint: checkpoint::encode(&header, flight.state()),
        header,
        frame: PolyData::wakes(&flight.snapshot()).to_vtp().into_bytes(),
        history: b"step_count,time_s,body_x_m\n0,0,-1.5e-3\n1,1e-4,2\n2,2e-4,nan\n".to_vec(),
    }
}

/// A checkpoint whose content was damaged and whose checksum is right all the same.
fn signed(content: &[u8]) -> Vec<u8> {
    let sum = wingbeat_results::manifest::sha256(content);
    let first = format!("wingbeat-checkpoint {} {sum}\n", checkpoint::FORMAT);
    [first.as_bytes(), content].concat()
}

/// A frame whose content was damaged and whose checksum is right all the same.
fn signed_frame(frame: &[u8], chance: &mut Chance) -> String {
    let text = String::from_utf8_lossy(frame);
    let (content, _) = text.split_once("<!-- SHA-256").unwrap();
    let content = damage(content.as_bytes(), chance);
    let content = String::from_utf8_lossy(&content);
    let sum = wingbeat_results::manifest::sha256(content.as_bytes());
    format!("{content}<!-- SHA-256 of the lines above: {sum} -->\n")
}

fn read_case(text: &[u8], scratch: &Path) -> bool {
    let text = String::from_utf8_lossy(text);
    let read = LoadedCase::from_text("damaged.toml", &text, scratch, &[]);
    if let Err(e) = &read {
        assert!(!e.to_string().is_empty());
    }
    read.is_ok()
}

/// As the target `checkpoint` of fuzzing reads its inputs: the first byte says what follows.
fn read_kept(bytes: &[u8], case_sha256: &str) {
    let Some((kind, bytes)) = bytes.split_first() else {
        return;
    };
    let path = Path::new("checkpoint.bin");
    let _ = checkpoint::decode(path, bytes, case_sha256);
    let _ = checkpoint::decode(path, &signed(bytes), case_sha256);
    if *kind != u8::MAX {
        let _ = postcard::from_bytes::<FlightState>(bytes);
    }
}

/// Feeds every reader once; returns how many of the six accepted.
fn feed(corpus: &Corpus, chance: &mut Chance, scratch: &Path) -> usize {
    let case = &corpus.cases[chance.below(corpus.cases.len())];
    let mut accepted = usize::from(read_case(&damage(case, chance), scratch));
    let path = Path::new("checkpoint.bin");
    let case_sha256 = &corpus.header.case_sha256;
    let kept = &corpus.kept[chance.below(corpus.kept.len())];
    read_kept(&damage(kept, chance), case_sha256);
    let raw = damage(&corpus.checkpoint, chance);
    accepted += usize::from(checkpoint::decode(path, &raw, case_sha256).is_ok());
    let body = corpus.checkpoint.iter().position(|b| *b == b'\n').unwrap() + 1;
    let forged = signed(&damage(&corpus.checkpoint[body..], chance));
    accepted += usize::from(checkpoint::decode(path, &forged, case_sha256).is_ok());
    let frame = damage(&corpus.frame, chance);
    accepted += usize::from(Mesh::parse(&String::from_utf8_lossy(&frame)).is_ok());
    let frame = Mesh::parse(&signed_frame(&corpus.frame, chance));
    accepted += usize::from(frame.is_ok_and(|m| m.sheets().len() < 1000));
    let history = scratch.join("history.csv");
    std::fs::write(&history, damage(&corpus.history, chance)).unwrap();
    accepted + usize::from(History::read(&history).is_ok())
}

fn scratch(name: &str) -> std::path::PathBuf {
    let path = std::env::temp_dir().join(format!("wingbeat-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&path).unwrap();
    path
}

#[test]
fn refuses_damaged_input_without_panic() {
    let (corpus, folder) = (corpus(), scratch("mutations"));
    let mut chance = Chance(SplitMix64::new(1));
    let rounds = 400;
    let accepted: usize = (0..rounds)
        .map(|_| feed(&corpus, &mut chance, &folder))
        .sum();
    std::fs::remove_dir_all(&folder).unwrap();
    // Some damage is harmless (a comment, a digit); most is not.
    assert!(
        accepted > 0 && accepted < 5 * rounds,
        "{accepted} of {}",
        6 * rounds
    );
}

/// What fuzzing found once, and what it reached most with.
#[test]
fn regress_the_corpus_of_fuzzing_is_read_without_panic() {
    let folder = scratch("corpus");
    for text in committed("case") {
        read_case(&text, &folder);
    }
    for bytes in committed("checkpoint") {
        read_kept(&bytes, &"0".repeat(64));
    }
    for bytes in committed("frame") {
        let _ = Mesh::parse(&String::from_utf8_lossy(&bytes));
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
