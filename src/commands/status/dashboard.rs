//! `treadmill status --watch` on a terminal: draws what is known, and does what is typed.

use std::{
    sync::mpsc::{Receiver, sync_channel},
    time::{Duration, Instant},
};

use anyhow::Context;
use ratatui::crossterm::event;
use tokio::signal::unix::{SignalKind, signal};
use treadmill_bus::Role;
use treadmill_runtime::shutdown::Shutdown;

use super::{
    draw::{self, Theme},
    fleet::Fleet,
    follow::{Follower, NEWS_WAITING, News},
    keys::{self, Action},
};
use crate::{
    launch::terminal_screen::TerminalScreen,
    shared::learner_address::{self, ReachArgs},
};

/// Between two drawings where nobody types: what changes on the screen is sent, and nothing else.
const TICK: Duration = Duration::from_millis(250);

/// Shows how the runs go until it is left, by a key or by a signal.
pub fn run(reach: &ReachArgs) -> anyhow::Result<()> {
    let options = reach.options(Role::Observer)?;
    learner_address::connect_with(options.clone(), async |bus| {
        let (sender, news) = sync_channel(NEWS_WAITING);
        let follower = Follower::new(reach.clone(), options, bus, sender)?;
        let shutdown = Shutdown::default();
        leave_on_signals(shutdown.clone())?;
        let following = tokio::spawn(follower.run());
        let shown = tokio::task::spawn_blocking(move || show(&news, &shutdown)).await;
        following.abort();
        shown.context("the dashboard came to an end by itself")?
    })
}

/// The terminal is given back on the way out, so these end what they would otherwise have killed.
fn leave_on_signals(shutdown: Shutdown) -> std::io::Result<()> {
    for kind in [SignalKind::terminate(), SignalKind::interrupt(), SignalKind::hangup()] {
        let (mut signals, shutdown) = (signal(kind)?, shutdown.clone());
        tokio::spawn(async move {
            signals.recv().await;
            shutdown.ask();
        });
    }
    Ok(())
}

fn show(news: &Receiver<News>, shutdown: &Shutdown) -> anyhow::Result<()> {
    const WHAT: &str = "the terminal cannot be used; without --watch, or into a pipe, plain text is told";
    let theme = Theme::of_environment();
    let mut screen = TerminalScreen::open().context(WHAT)?;
    let mut fleet = Fleet::new(Instant::now());
    while !shutdown.asked() {
        for _ in 0..NEWS_WAITING {
            match news.try_recv() {
                Ok(News::Answers(answers)) => fleet.answer(answers, Instant::now()),
                Ok(News::Silence(why)) => fleet.silence = Some(why),
                Ok(News::Metric(metric)) => fleet.measure(&metric),
                Ok(News::Past(metrics)) => metrics.iter().for_each(|metric| fleet.measure(metric)),
                Err(_) => break,
            }
        }
        screen.draw(|frame| draw::draw(frame, &mut fleet, &theme, Instant::now())).context(WHAT)?;
        let mut timeout = TICK;
        while event::poll(timeout).context(WHAT)? {
            match keys::action(&event::read().context(WHAT)?, fleet.helps) {
                Some(Action::Quit) => return Ok(()),
                Some(action) => fleet.act(action),
                None => {}
            }
            timeout = Duration::ZERO;
        }
    }
    Ok(())
}
