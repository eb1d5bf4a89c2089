//! `treadmill status --watch` on a pseudo-terminal: what it shows, and that it restores the terminal.

use std::{
    fs::File,
    io::{Read, Write},
    num::NonZeroU16,
    os::{
        fd::{AsRawFd, FromRawFd, OwnedFd},
        unix::process::CommandExt,
    },
    path::Path,
    process::{Child, Command, ExitStatus},
    sync::{Arc, Mutex},
};

use treadmill_rl::launch::terminal_screen::TerminalScreen;

use crate::support::*;

fn length(characters: u16) -> NonZeroU16 {
    NonZeroU16::new(characters).expect("a terminal has characters")
}

/// Opens a pseudo-terminal of 80 × 24 characters. Returns the test's end and the program's end.
fn pseudo_terminal() -> [OwnedFd; 2] {
    let size = libc::winsize { ws_row: 24, ws_col: 80, ws_xpixel: 0, ws_ypixel: 0 };
    // Not for other processes that start meanwhile: they would keep the terminal open.
    let flags = libc::O_RDWR | libc::O_NOCTTY | libc::O_CLOEXEC;
    let mut name = [0; 128];
    // SAFETY: the calls read and write structures of this function; both descriptors are open and owned here.
    unsafe {
        let outer = OwnedFd::from_raw_fd(libc::posix_openpt(flags));
        let fd = outer.as_raw_fd();
        assert!(libc::grantpt(fd) == 0 && libc::unlockpt(fd) == 0);
        assert_eq!(libc::ptsname_r(fd, name.as_mut_ptr(), name.len()), 0);
        let inner = OwnedFd::from_raw_fd(libc::open(name.as_ptr(), flags));
        assert_eq!(libc::ioctl(inner.as_raw_fd(), libc::TIOCSWINSZ, &raw const size), 0);
        [outer, inner]
    }
}

/// Sets what a program does at a hang-up, whatever the tests were started by: what it inherits as ignored stays ignored.
fn at_hangup(command: &mut Command, action: libc::sighandler_t) {
    // SAFETY: a system call that takes two numbers.
    unsafe {
        command.pre_exec(move || {
            libc::signal(libc::SIGHUP, action);
            Ok(())
        });
    }
}

/// Starts a program on a new terminal, whose other end is returned.
fn spawn_on_terminal(mut command: Command) -> (File, Child) {
    let [outer, inner] = pseudo_terminal();
    command.env("TERM", "xterm-256color");
    command.stdin(inner.try_clone().unwrap()).stdout(inner.try_clone().unwrap()).stderr(inner);
    // SAFETY: two system calls that take numbers; the second makes standard input the controlling terminal.
    unsafe {
        command.pre_exec(|| match libc::setsid() < 0 || libc::ioctl(0, libc::TIOCSCTTY, 0) < 0 {
            true => Err(std::io::Error::last_os_error()),
            false => Ok(()),
        });
    }
    let child = command.spawn().expect("the binary starts");
    // The command's copies of the descriptors close here: they would keep the terminal open.
    (File::from(outer), child)
}

/// Terminal with the program on it.
struct Terminal {
    keyboard: File,
    screen: Arc<Mutex<vt100::Parser>>,
    child: Child,
}

impl Terminal {
    /// Starts on 80 × 24 characters.
    fn start(folder: &Path, args: &[&str], variables: &[(&str, &str)]) -> Self {
        let mut command = treadmill(folder);
        command.args(args).env_remove("NO_COLOR").envs(variables.iter().copied());
        Self::start_this(command)
    }

    fn start_this(command: Command) -> Self {
        let (keyboard, child) = spawn_on_terminal(command);
        let screen = Arc::new(Mutex::new(vt100::Parser::new(length(24), length(80), 0)));
        std::thread::spawn({
            let (mut output, screen) = (keyboard.try_clone().unwrap(), screen.clone());
            move || {
                let mut bytes = [0; 4096];
                // A read fails once no process has the terminal open.
                while let Ok(count @ 1..) = output.read(&mut bytes) {
                    screen.lock().unwrap().process(&bytes[..count]);
                }
            }
        });
        Self { keyboard, screen, child }
    }

    fn types(&mut self, keys: &str) {
        self.keyboard.write_all(keys.as_bytes()).unwrap();
    }

    /// Changes the size; the kernel notifies the program by a signal.
    fn resize(&self, rows: u16, columns: u16) {
        self.screen.lock().unwrap().screen_mut().set_size(length(rows), length(columns));
        let size = libc::winsize { ws_row: rows, ws_col: columns, ws_xpixel: 0, ws_ypixel: 0 };
        // SAFETY: the descriptor is open, and the kernel reads one structure.
        assert_eq!(unsafe { libc::ioctl(self.keyboard.as_raw_fd(), libc::TIOCSWINSZ, &raw const size) }, 0);
    }

    fn text(&self) -> String {
        self.screen.lock().unwrap().screen().contents()
    }

    /// Waits until the screen shows all parts, and returns its text.
    fn shows(&self, parts: &[&str]) -> String {
        let mut seen = String::new();
        let found = || {
            seen = self.text();
            parts.iter().all(|part| seen.contains(part)).then_some(())
        };
        let waited =
            std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| await_that(&format!("{parts:?}"), found)));
        assert!(waited.is_ok(), "not all of {parts:?} are in\n{seen}");
        seen
    }

    fn is_coloured(&self) -> bool {
        let screen = self.screen.lock().unwrap();
        let mut cells = (0..24).flat_map(|row| (0..80).map(move |column| (row, column)));
        cells.any(|(row, column)| {
            screen.screen().cell(row, column).is_some_and(|cell| cell.fgcolor() != vt100::Color::Default)
        })
    }

    fn is_raw(&self) -> bool {
        let mut settings = std::mem::MaybeUninit::<libc::termios>::uninit();
        // SAFETY: the descriptor is open, and the call fills the structure if it succeeds.
        let settings = unsafe {
            assert_eq!(libc::tcgetattr(self.keyboard.as_raw_fd(), settings.as_mut_ptr()), 0);
            settings.assume_init()
        };
        settings.c_lflag & (libc::ICANON | libc::ECHO) == 0
    }

    /// Waits for the end, and asserts that the terminal was restored.
    fn end_restored(mut self) -> ExitStatus {
        let status = await_that("the end", || self.child.try_wait().unwrap());
        await_that("the screen from before", || {
            let screen = self.screen.lock().unwrap();
            (!screen.screen().alternate_screen() && !screen.screen().hide_cursor()).then_some(())
        });
        assert!(!self.is_raw(), "typed characters are echoed again");
        status
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_dashboard_and_a_training_end_with_their_terminal() {
    let (folder, run) = folders();
    let training = train(folder.path(), &["--preset", "smoke", "--run-dir", "run"]);
    await_steps(&run, 512);
    for ignores_hangups in [false, true] {
        let mut command = treadmill(folder.path());
        command.args(["status", "run", "--watch"]);
        // As `nohup` does.
        at_hangup(&mut command, if ignores_hangups { libc::SIG_IGN } else { libc::SIG_DFL });
        let (mut keyboard, mut child) = spawn_on_terminal(command);
        // Once it draws on the other screen, it reads keys.
        let (mut seen, mut bytes) = (Vec::<u8>::new(), [0; 256]);
        while !seen.windows(8).any(|part| part == b"\x1b[?1049h") {
            let count = keyboard.read(&mut bytes).unwrap();
            seen.extend(&bytes[..count]);
        }
        drop(keyboard);
        await_that("the end of the dashboard", || child.try_wait().unwrap());
    }

    drop(training);
    let run = folder.path().join("other");
    let mut command = treadmill(folder.path());
    command.args(["train", "--steps", ENDLESS, "--preset", "smoke", "--run-dir", "other", "--no-progress"]);
    at_hangup(&mut command, libc::SIG_DFL);
    // What it prints until then fits into the terminal's buffer.
    let (keyboard, mut child) = spawn_on_terminal(command);
    await_steps(&run, 1024);
    drop(keyboard);
    let status = await_that("the end of the training", || child.try_wait().unwrap());
    assert_eq!(status.code(), Some(0));
    let resumed = done(folder.path(), &["eval", "other", "--checkpoint", "latest", "--episodes", "1", "--json"]);
    assert_eq!(last_json(&resumed)["checkpoint_env_steps"], last_step(&run), "saved");
}

fn train(folder: &Path, args: &[&str]) -> Running {
    let mut command = treadmill(folder);
    command.args(["train", "--steps", ENDLESS]).args(args);
    Running::start(command)
}

#[test]
fn the_dashboard_shows_a_run_follows_its_size_explains_keys_and_quits() {
    let (folder, run) = folders();
    let _training = train(folder.path(), &["--preset", "smoke", "--run-dir", "run"]);
    await_steps(&run, 512);
    let mut terminal = Terminal::start(folder.path(), &["status", "run", "--watch"], &[]);
    // Rates appear with the second status.
    let seen =
        terminal.shows(&["run  training", "of 1.00G steps", "actor-0", "actor-1", "alive", "return ", "lag 0.00 mean"]);
    assert!(terminal.is_coloured() && terminal.is_raw() && terminal.screen.lock().unwrap().screen().alternate_screen());
    // None in a picture that is half drawn.
    let steps = |seen: &str| -> Option<u64> {
        let (before, _) = seen.split_once(" of 1.00G steps")?;
        before.rsplit_once("%  ")?.1.replace(',', "").parse().ok()
    };
    let before = steps(&seen).expect("the steps");
    await_that("steps that grow", || steps(&terminal.text()).filter(|now| *now > before));
    let seen = terminal.shows(&[" MB/s", " fragments/s"]);
    assert!(!seen.contains('\u{1b}') && seen.lines().count() <= 24, "{seen}");

    terminal.types("?");
    terminal.shows(&["quit; runs continue"]);
    terminal.types("\u{1b}");
    await_that("the end of the help", || (!terminal.text().contains("quit; runs continue")).then_some(()));
    terminal.resize(10, 40);
    terminal.shows(&["run  training", "of 1.00G", "actor-0", "frag/s"]);
    terminal.resize(5, 30);
    terminal.shows(&["This needs 40×10 characters;", "30×5"]);
    terminal.resize(24, 80);
    terminal.shows(&["of 1.00G steps"]);
    terminal.types("q");
    assert_eq!(terminal.end_restored().code(), Some(0));
}

#[test]
fn a_learner_restarted_at_another_endpoint_is_found() {
    let (folder, run) = folders();
    let training = train(folder.path(), &["--preset", "smoke", "--run-dir", "run"]);
    await_steps(&run, 512);
    let terminal = Terminal::start(folder.path(), &["status", "run", "--watch"], &[("NO_COLOR", "1"), ("LC_ALL", "C")]);
    let seen = terminal.shows(&["run  training", "actor-0", "scroll"]);
    assert!(!seen.contains("gone") && seen.is_ascii(), "{seen}");
    assert!(!terminal.is_coloured());
    let first = endpoint(&run);
    training.signal(libc::SIGTERM);
    assert!(training.wait().0.success());
    terminal.shows(&["run  learner gone, silent for"]);
    let _resumed = train(folder.path(), &["--resume", "run"]);
    await_that("another endpoint", || (endpoint(&run) != first).then_some(()));
    terminal.shows(&["run  training", "actor-0"]);
    // A signal also ends it with the terminal restored.
    send_signal(terminal.child.id(), libc::SIGTERM);
    assert_eq!(terminal.end_restored().code(), Some(0));
}

#[test]
fn a_pipe_gets_plain_lines_and_errors_leave_the_terminal_unchanged() {
    let (folder, run) = folders();
    let _training = train(folder.path(), &["--preset", "smoke", "--run-dir", "run"]);
    await_steps(&run, 512);
    let mut command = treadmill(folder.path());
    command.args(["status", "run", "--watch"]);
    let piped = Running::start(command);
    for _ in 0..2 {
        let line = piped.wait_for("run `run` trains: ");
        assert!(!line.contains('\u{1b}') && line.contains(" steps/s, actors: "), "{line:?}");
    }
    let unanswered = Terminal::start(folder.path(), &["status", "--watch", "--connect", "tcp/127.0.0.1:1"], &[]);
    unanswered.shows(&["waiting: no answer: no process listens at tcp/127.0.0.1:1"]);
    send_signal(unanswered.child.id(), libc::SIGTERM);
    assert_eq!(unanswered.end_restored().code(), None, "a signal ended it");
}

/// Variable that makes this test program open the screen and panic.
const PANICS: &str = "TREADMILL_TEST_PANICS";

#[test]
fn a_panic_message_appears_on_the_restored_terminal() {
    if std::env::var_os(PANICS).is_some() {
        let mut screen = TerminalScreen::open().expect("a terminal");
        screen.draw(|frame| frame.render_widget("drawn before", frame.area())).expect("it is drawn");
        let mut answer = String::new();
        std::io::stdin().read_line(&mut answer).expect("the test types a line");
        panic!("as planned");
    }
    let mut command = Command::new(std::env::current_exe().unwrap());
    command
        .args(["--exact", "dashboard::a_panic_message_appears_on_the_restored_terminal", "--nocapture"])
        .env(PANICS, "yes");
    let mut terminal = Terminal::start_this(command);
    terminal.shows(&["drawn before"]);
    assert!(terminal.is_raw() && terminal.screen.lock().unwrap().screen().alternate_screen());
    terminal.types("\n");
    let seen = terminal.shows(&["as planned"]);
    assert!(!seen.contains("drawn before"), "{seen}");
    assert_ne!(terminal.end_restored().code(), Some(0));
}
