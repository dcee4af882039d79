//! A real browser without a window, driven over its debugging pipe (Chrome DevTools Protocol): pages
//! are opened, keys are pressed, programs are run in them.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// A browser with one page.
pub struct Browser {
    child: Child,
    to: File,
    from: BufReader<File>,
    session: String,
    sent: usize,
    /// What went wrong in the page.
    pub complaints: Vec<String>,
}

/// Chromium or what stands for it.
fn program() -> Option<PathBuf> {
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    let path = std::env::var_os("PATH")?;
    let places: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let files = names
        .iter()
        .flat_map(|n| places.iter().map(move |p| p.join(n)));
    files.into_iter().find(|f| f.is_file())
}

const FLAGS: [&str; 12] = [
    "--headless",
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-sync",
    "--disable-background-networking",
    "--disable-component-update",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--window-size=500,600",
    "--remote-debugging-pipe",
    "about:blank",
];

impl Browser {
    /// Starts one that keeps its things in `folder`; none where there is no browser.
    pub fn start(folder: &Path, more: &[&str]) -> Option<Self> {
        let program = program()?;
        let [inbox, outbox] = ["to-browser", "from-browser"].map(|n| folder.join(n));
        for pipe in [&inbox, &outbox] {
            assert!(Command::new("mkfifo").arg(pipe).status().unwrap().success());
        }
        let child = Command::new("sh")
            .arg("-c")
            .arg(r#"exec "$@" 3<"$0/to-browser" 4>"$0/from-browser""#)
            .arg(folder)
            .arg(program)
            .args(more)
            .arg(format!(
                "--user-data-dir={}",
                folder.join("profile").display()
            ))
            .args(FLAGS)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut browser = Self {
            child,
            to: OpenOptions::new().write(true).open(inbox).unwrap(),
            from: BufReader::new(File::open(outbox).unwrap()),
            session: String::new(),
            sent: 0,
            complaints: vec![],
        };
        let targets = browser.call("Target.getTargets", json!({}));
        let page = targets["targetInfos"].as_array().unwrap().iter();
        let page = page.clone().find(|t| t["type"] == "page").unwrap()["targetId"].clone();
        let session = browser.call(
            "Target.attachToTarget",
            json!({ "targetId": page, "flatten": true }),
        );
        browser.session = session["sessionId"].as_str().unwrap().to_owned();
        for domain in ["Page.enable", "Runtime.enable", "Log.enable"] {
            browser.call(domain, json!({}));
        }
        Some(browser)
    }

    fn call(&mut self, method: &str, params: Value) -> Value {
        self.sent += 1;
        let mut message = json!({ "id": self.sent, "method": method, "params": params });
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        let mut line = message.to_string().into_bytes();
        line.push(0);
        self.to.write_all(&line).unwrap();
        loop {
            let mut answer = vec![];
            self.from.read_until(0, &mut answer).unwrap();
            assert_eq!(answer.pop(), Some(0), "the browser has ended");
            let answer: Value = serde_json::from_slice(&answer).unwrap();
            if answer["id"] == json!(self.sent) {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].clone();
            }
            let event = answer["method"].as_str().unwrap_or("");
            if event == "Runtime.exceptionThrown"
                || event == "Log.entryAdded" && answer["params"]["entry"]["level"] == "error"
            {
                self.complaints.push(answer.to_string());
            }
        }
    }

    /// Opens a page, and waits until it is there.
    pub fn open(&mut self, page: &Path, hash: &str) {
        self.call("Page.navigate", json!({ "url": "about:blank" }));
        let url = format!("file://{}#{hash}", page.display());
        self.call("Page.navigate", json!({ "url": url }));
        self.wait("document.readyState === 'complete' && !!document.getElementById('state')");
    }

    /// Value of an expression in the page; of a promise, what it is kept with.
    pub fn value(&mut self, expression: &str) -> Value {
        let params =
            json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let result = self.call("Runtime.evaluate", params);
        assert!(
            result["exceptionDetails"].is_null(),
            "{expression}: {result}"
        );
        result["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub fn wait(&mut self, expression: &str) {
        let begun = Instant::now();
        while self.value(expression) != json!(true) {
            let patient = begun.elapsed() < Duration::from_secs(60);
            assert!(patient, "in vain: {expression}; {:?}", self.complaints);
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// What the page says of itself.
    pub fn state(&mut self, name: &str) -> String {
        let of = format!("document.getElementById('state').dataset.{name}");
        self.value(&of).as_str().unwrap_or("").to_owned()
    }

    /// Prints the page.
    pub fn print(&mut self, landscape: bool) {
        self.call("Page.printToPDF", json!({ "landscape": landscape }));
    }

    /// Presses and lets go of a key.
    pub fn press(&mut self, key: &str, code: &str, number: u32) {
        let text = if key.len() == 1 { key } else { "" };
        for kind in ["keyDown", "keyUp"] {
            let text = if kind == "keyDown" { text } else { "" };
            let params = json!({
                "type": kind, "key": key, "code": code, "windowsVirtualKeyCode": number, "text": text,
            });
            self.call("Input.dispatchKeyEvent", params);
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
