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

use crate::{
    picture::Screenshot,
    support::{TIMEOUT, await_that, skip},
};

/// Width and height of a page on a desk, and on a phone, in pixels.
pub const WIDE: [u32; 2] = [960, 600];
pub const NARROW: [u32; 2] = [360, 740];

/// Running browser.
pub struct Browser {
    child: Child,
    input: ChildStdin,
    messages: Receiver<Value>,
    sent: u64,
    /// Events that came between answers.
    events: Vec<Value>,
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
        command.arg(format!("--window-size={},{}", WIDE[0], WIDE[1]));
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
        Some(Self { child, input, messages, sent: 0, events: Vec::new(), _profile: profile })
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
            if !answer["method"].is_null() {
                self.events.push(answer);
            }
        }
    }

    /// Opens an address in a page of this size.
    pub fn open(&mut self, url: &str, size: [u32; 2]) -> Page {
        let target = self.call(None, "Target.createTarget", &json!({"url": "about:blank"}));
        let attached =
            self.call(None, "Target.attachToTarget", &json!({"targetId": target["targetId"], "flatten": true}));
        let page = Page { session: attached["sessionId"].as_str().expect("a session").to_string() };
        let [width, height] = size;
        let size = json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
        self.of_page(&page, "Emulation.setDeviceMetricsOverride", &size);
        for domain in ["Runtime", "Log", "Network", "Page"] {
            self.of_page(&page, &format!("{domain}.enable"), &json!({}));
        }
        // Without focus it receives no keys.
        self.of_page(&page, "Emulation.setFocusEmulationEnabled", &json!({"enabled": true}));
        self.of_page(&page, "Page.navigate", &json!({"url": url}));
        page
    }

    fn of_page(&mut self, page: &Page, method: &str, params: &Value) -> Value {
        self.call(Some(&page.session), method, params)
    }

    /// Returns the value of an expression in the page; null where it fails.
    pub fn value(&mut self, page: &Page, expression: &str) -> Value {
        let asked = json!({"expression": expression, "returnByValue": true});
        self.of_page(page, "Runtime.evaluate", &asked)["result"]["value"].clone()
    }

    /// Waits until an expression of the page is true.
    pub fn wait_for(&mut self, page: &Page, expression: &str) {
        await_that(expression, || (self.value(page, expression) == true).then_some(()));
    }

    /// Presses and releases a key; `code` is the browser's name of its position on the keyboard.
    pub fn press(&mut self, page: &Page, key: &str, code: &str) {
        for kind in ["rawKeyDown", "keyUp"] {
            self.of_page(page, "Input.dispatchKeyEvent", &json!({"type": kind, "key": key, "code": code}));
        }
    }

    /// Clicks in the middle of an element.
    pub fn click(&mut self, page: &Page, selector: &str) {
        let middle = format!(
            "(() => {{ const box = document.querySelector('{selector}').getBoundingClientRect(); \
             return [box.x + box.width / 2, box.y + box.height / 2]; }})()"
        );
        let at = self.value(page, &middle);
        for kind in ["mousePressed", "mouseReleased"] {
            let click = json!({"type": kind, "x": at[0], "y": at[1], "button": "left", "clickCount": 1});
            self.of_page(page, "Input.dispatchMouseEvent", &click);
        }
    }

    /// Closes a page.
    pub fn close(&mut self, page: &Page) {
        self.of_page(page, "Page.close", &json!({}));
    }

    /// Returns the addresses that pages asked for.
    pub fn requests(&self) -> Vec<String> {
        let sent = self.events.iter().filter(|event| {
            ["Network.requestWillBeSent", "Network.webSocketCreated"].contains(&event["method"].as_str().unwrap_or(""))
        });
        sent.filter_map(|event| {
            let params = &event["params"];
            Some(params["request"]["url"].as_str().or(params["url"].as_str())?.to_string())
        })
        .collect()
    }

    /// Returns errors in the consoles of pages.
    pub fn errors(&self) -> Vec<String> {
        let of = |event: &Value| {
            let params = &event["params"];
            match event["method"].as_str()? {
                "Runtime.exceptionThrown" => Some(params.to_string()),
                "Runtime.consoleAPICalled" if params["type"] == "error" => Some(params["args"].to_string()),
                "Log.entryAdded" if params["entry"]["level"] == "error" => Some(params["entry"].to_string()),
                _ => None,
            }
        };
        self.events.iter().filter_map(of).collect()
    }

    /// Takes a screenshot.
    pub fn screenshot(&mut self, page: &Page) -> Screenshot {
        let answer = self.of_page(page, "Page.captureScreenshot", &json!({"format": "png"}));
        let png = BASE64_STANDARD.decode(answer["data"].as_str().expect("a picture")).expect("base64");
        Screenshot::decode(&png)
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
