//! The programs that results are read back with, which tests install beside themselves.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of the readers.
pub fn readers() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers")
}

/// Where the readers are installed, once.
pub fn store(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("readers-{name}"))
}

/// What a command prints; the error is what it said.
pub fn works(command: &mut Command) -> Result<String, String> {
    let out = command.output().map_err(|e| format!("{command:?}: {e}"))?;
    let said = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    match out.status.success() {
        true => Ok(said(&out.stdout)),
        false => Err(format!(
            "{command:?}: {}{}",
            said(&out.stdout),
            said(&out.stderr)
        )),
    }
}

/// A Python with the readers, installed by the first test that asks.
pub fn python() -> Result<PathBuf, String> {
    let lock = fs::File::create(store("lock")).map_err(|e| e.to_string())?;
    lock.lock().map_err(|e| e.to_string())?;
    let store = store("python");
    let python = store.join("bin/python");
    let list = readers().join("requirements.txt");
    let wanted = fs::read_to_string(&list).map_err(|e| e.to_string())?;
    if fs::read_to_string(store.join("ready")).ok().as_ref() != Some(&wanted) {
        works(Command::new("python3").args(["-m", "venv"]).arg(&store))?;
        let install = [
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "-r",
        ];
        works(Command::new(&python).args(install).arg(list))?;
        fs::write(store.join("ready"), &wanted).map_err(|e| e.to_string())?;
    }
    Ok(python)
}
