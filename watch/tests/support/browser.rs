//! A headless Chromium, driven by the DevTools protocol through a pipe.

use std::{
    ffi::OsString,
    io::{BufRead, BufReader, Write},
    process::{Child, ChildStdin, Command, Stdio},
    sync::mpsc::{Receiver, channel},
    time::Instant,
};

use base64::prelude::{BASE64_STANDARD, Engine};
use serde_json::{Value, json};

use super::{TIMEOUT, picture::Screenshot, skip};

/// Width and height of the page in pixels.
pub const SIZE: (u32, u32) = (1280, 720);

/// Running browser.
pub struct Browser {
    child: Child,
    input: ChildStdin,
    messages: Receiver<Value>,
    sent: u64,
    _profile: tempfile::TempDir,
}

/// Page in a browser.
pub struct Page {
    session: String,
}

/// Returns TREADMILL_CHROMIUM, or a Chromium on the PATH.
fn program() -> Option<OsString> {
    if let Some(named) = std::env::var_os("TREADMILL_CHROMIUM") {
        return Some(named);
    }
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let folders: Vec<_> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
    names
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)))
        .find(|path| path.is_file())
        .map(Into::into)
}

impl Browser {
    /// Starts a browser; skips the test if there is none.
    pub fn start() -> Option<Self> {
        let Some(program) = program() else {
            skip("no Chromium: install the package `chromium`, or set TREADMILL_CHROMIUM");
            return None;
        };
        let profile = tempfile::tempdir().expect("a temporary folder");
        let mut command = Command::new("sh");
        // Chromium reads from file descriptor 3 and writes to 4.
        command.args(["-c", r#"exec "$0" "$@" 3<&0 4>&1 </dev/null >/dev/null 2>&1"#]).arg(program);
        command.args([
            "--headless=new",
            "--remote-debugging-pipe",
            "--no-first-run",
            "--no-sandbox",
            "--hide-scrollbars",
        ]);
        command.arg(format!("--user-data-dir={}", profile.path().display()));
        command.arg(format!("--window-size={},{}", SIZE.0, SIZE.1));
        // Render on the CPU, so that no GPU is needed.
        command.args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"]);
        // Without other hosts, everything that the page needs must come from our binary.
        command.arg("--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1, EXCLUDE localhost");
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the browser starts");
        let (sender, messages) = channel();
        let output = child.stdout.take().expect("piped");
        std::thread::spawn(move || {
            let parts = BufReader::new(output).split(0).map_while(Result::ok);
            let parsed = parts.filter_map(|part| serde_json::from_slice(&part).ok());
            parsed.take_while(|message: &Value| sender.send(message.clone()).is_ok()).for_each(drop);
        });
        let input = child.stdin.take().expect("piped");
        Some(Self { child, input, messages, sent: 0, _profile: profile })
    }

    fn call(&mut self, session: Option<&str>, method: &str, params: &Value) -> Value {
        self.sent += 1;
        let mut message = json!({"id": self.sent, "method": method, "params": params});
        if let Some(session) = session {
            message["sessionId"] = session.into();
        }
        let text = format!("{message}\0");
        self.input.write_all(text.as_bytes()).expect("the browser reads its commands");
        let until = Instant::now() + TIMEOUT;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            let answer = self.messages.recv_timeout(left).unwrap_or_else(|why| panic!("no answer to {method}: {why}"));
            if answer["id"] == self.sent {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].clone();
            }
        }
    }

    /// Opens a page.
    pub fn open(&mut self, url: &str) -> Page {
        let target = self.call(None, "Target.createTarget", &json!({"url": url}));
        let attached =
            self.call(None, "Target.attachToTarget", &json!({"targetId": target["targetId"], "flatten": true}));
        let session = attached["sessionId"].as_str().expect("a session").to_string();
        let (width, height) = SIZE;
        let size = json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
        self.call(Some(&session), "Emulation.setDeviceMetricsOverride", &size);
        Page { session }
    }

    /// Clicks a point of the page, as (x, y) in pixels.
    pub fn click(&mut self, page: &Page, (x, y): (u32, u32)) {
        for kind in ["mousePressed", "mouseReleased"] {
            let event = json!({"type": kind, "x": x, "y": y, "button": "left", "clickCount": 1});
            self.call(Some(&page.session), "Input.dispatchMouseEvent", &event);
        }
    }

    /// Presses and releases a key; `code` is the browser's name of its position on the keyboard.
    pub fn press(&mut self, page: &Page, key: &str, code: &str) {
        for kind in ["rawKeyDown", "keyUp"] {
            let event = json!({"type": kind, "key": key, "code": code});
            self.call(Some(&page.session), "Input.dispatchKeyEvent", &event);
        }
    }

    /// Takes a screenshot.
    pub fn screenshot(&mut self, page: &Page) -> Screenshot {
        let answer = self.call(Some(&page.session), "Page.captureScreenshot", &json!({"format": "png"}));
        let png = BASE64_STANDARD.decode(answer["data"].as_str().expect("a picture")).expect("base64");
        Screenshot::decode(&png)
    }

    /// Takes screenshots until one satisfies a condition, and returns it.
    pub fn wait_until(&mut self, page: &Page, what: &str, mut is_right: impl FnMut(&Screenshot) -> bool) -> Screenshot {
        let until = Instant::now() + TIMEOUT;
        loop {
            let picture = self.screenshot(page);
            if is_right(&picture) {
                return picture;
            }
            if Instant::now() >= until {
                let file = std::env::temp_dir().join("treadmill-watch-failed.png");
                picture.save(&file);
                panic!("the page never showed {what}; the last screenshot is {}", file.display());
            }
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
