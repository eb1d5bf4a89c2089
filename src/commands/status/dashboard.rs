//! `treadmill status --watch` on a terminal: draws the state of runs and handles keys.

use std::{
    io::{self, IsTerminal},
    sync::mpsc::{Receiver, sync_channel},
    time::{Duration, Instant},
};

use anyhow::Context;
use ratatui::{Frame, crossterm::event};
use rustix::event::{PollFd, PollFlags, Timespec};
use tokio::signal::unix::{SignalKind, signal};
use treadmill_bus::Role;
use treadmill_runtime::{machine, shutdown::Shutdown};

use super::{
    draw,
    fleet::Fleet,
    follow::{Follower, NEWS_QUEUED_MAX, News},
    keys::{self, KeyAction},
};
use crate::{
    launch::{signals, terminal_screen::TerminalScreen},
    shared::learner_address::{self, ReachArgs},
};

/// Interval of redrawing without key presses.
const TICK: Duration = Duration::from_millis(250);

/// Time after a signal in which the dashboard ends by itself.
const EXIT_AFTER: Duration = Duration::from_secs(1);
/// Exit code otherwise: 128 + SIGHUP, the convention of shells.
const EXIT_CUT_OFF: i32 = 129;

/// Shows the dashboard until a key or a signal ends it.
pub fn run(reach: &ReachArgs) -> anyhow::Result<()> {
    let options = reach.options(Role::Observer)?;
    learner_address::connect(reach, Role::Observer, async |link| {
        let (sender, news) = sync_channel(NEWS_QUEUED_MAX);
        let follower = Follower::new(reach.clone(), options.clone(), link.bus.clone(), sender)?;
        let shutdown = Shutdown::default();
        exit_on_signals(shutdown.clone())?;
        let following = tokio::spawn(follower.run());
        let shown = tokio::task::spawn_blocking(move || show(&news, &shutdown)).await;
        following.abort();
        shown.context("the dashboard ended unexpectedly")?
    })
}

/// Turns signals into a regular exit, which restores the terminal.
fn exit_on_signals(shutdown: Shutdown) -> std::io::Result<()> {
    let (mut terminate, mut interrupt) = (signal(SignalKind::terminate())?, signal(SignalKind::interrupt())?);
    let mut hangup = signals::hangup()?;
    tokio::spawn(async move {
        tokio::select! {
            _ = terminate.recv() => {}
            _ = interrupt.recv() => {}
            () = signals::received(&mut hangup) => {}
        }
        shutdown.ask();
        // What reads the keys of a terminal that is gone may never return.
        tokio::time::sleep(EXIT_AFTER).await;
        std::process::exit(EXIT_CUT_OFF);
    });
    Ok(())
}

/// Waits for a key on standard input, a terminal, for at most `timeout`. Returns false if it was closed: what reads keys
/// would then read for ever, and not wait.
fn wait_for_key(timeout: Duration) -> bool {
    let mut polled = [PollFd::from_borrowed_fd(rustix::stdio::stdin(), PollFlags::IN)];
    let timeout = Timespec { tv_sec: 0, tv_nsec: timeout.subsec_nanos().into() };
    let gone = PollFlags::HUP | PollFlags::ERR | PollFlags::NVAL;
    // A signal, such as that of another size, interrupts it.
    rustix::event::poll(&mut polled, Some(&timeout)).is_err() || !polled[0].revents().intersects(gone)
}

fn show(news: &Receiver<News>, shutdown: &Shutdown) -> anyhow::Result<()> {
    const UNUSABLE: &str = "the terminal cannot be used; plain text appears without --watch, or in a pipe";
    let (is_coloured, is_unicode) = (draw::is_coloured(), machine::is_utf8_locale());
    let has_keyboard = io::stdin().is_terminal();
    let mut screen = TerminalScreen::open().context(UNUSABLE)?;
    let mut fleet = Fleet::new(Instant::now());
    while !shutdown.asked() {
        for _ in 0..NEWS_QUEUED_MAX {
            match news.try_recv() {
                Ok(News::Answers(answers)) => fleet.apply_statuses(answers, Instant::now()),
                Ok(News::Silence(why)) => fleet.silence = Some(why),
                Ok(News::Metric(metric)) => fleet.apply_metric(&metric),
                Ok(News::Past(metrics)) => metrics.iter().for_each(|metric| fleet.apply_metric(metric)),
                Err(_) => break,
            }
        }
        let draw = |frame: &mut Frame| {
            draw::draw(frame, &mut fleet, Instant::now());
            if !is_coloured {
                draw::remove_colours(frame.buffer_mut());
            }
            if !is_unicode {
                draw::replace_unicode(frame.buffer_mut());
            }
        };
        screen.draw(draw).context(UNUSABLE)?;
        let mut timeout = TICK;
        if has_keyboard {
            if !wait_for_key(TICK) {
                break;
            }
            timeout = Duration::ZERO;
        }
        while event::poll(timeout).context(UNUSABLE)? {
            match keys::action(&event::read().context(UNUSABLE)?, fleet.shows_help) {
                Some(KeyAction::Quit) => return Ok(()),
                Some(action) => fleet.act(action),
                None => {}
            }
            timeout = Duration::ZERO;
        }
    }
    Ok(())
}
