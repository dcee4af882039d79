//! The case reader: any text is refused with a message or becomes a setup that can be built, and
//! the case with its defaults filled in reads back as the same case.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use wingbeat_flight::{AirModel, Simulation};
use wingbeat_case::LoadedCase;

/// Panels above which a case is read but no flight is begun.
const CHEAP: usize = 120;

fn read(text: &str) -> Option<LoadedCase> {
    let folder = Path::new("/nonexistent");
    match LoadedCase::from_text("fuzzed.toml", text, folder, &[]) {
        Ok(case) => Some(case),
        Err(e) => {
            assert!(!e.to_string().is_empty());
            None
        }
    }
}

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    let Some(case) = read(text) else { return };
    let resolved = case.resolved();
    let again = read(&resolved).expect("a case with its defaults filled in is a case");
    assert_eq!(resolved, again.resolved());
    let animal = &case.setup.animal;
    let wings: usize = animal.wing_reports().iter().map(|w| w.panels).sum();
    let body: usize = animal.parts.iter().map(|p| p.mesh.quads.len()).sum();
    let external = matches!(case.setup.air, AirModel::External(_));
    if wings + body <= CHEAP && !external {
        if let Ok(mut flight) = Simulation::new(case.setup) {
            let _ = flight.step();
        }
    }
});
