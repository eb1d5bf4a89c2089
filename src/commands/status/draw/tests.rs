//! Screens of terminals of many sizes, for sound and for hostile statuses.

use std::time::{Duration, Instant};

use proptest::prelude::*;
use ratatui::{
    Terminal,
    backend::TestBackend,
    buffer::{Buffer, Cell},
    style::Color,
};
use treadmill_proto::{Phase, RunStatus, json::Metric};

use super::*;
use crate::commands::status::{fleet::CURVES, keys::KeyAction, samples};

/// Returns a fleet after some seconds of statuses of these runs.
fn fleet(runs: &[RunStatus], now: Instant) -> Fleet {
    let mut fleet = Fleet::new(now - Duration::from_secs(4));
    for (ago_s, done) in [(4, 0.5), (2, 0.75), (0, 1.0)] {
        let earlier = |run: &RunStatus| RunStatus {
            accepted: (run.accepted as f64 * done) as u64,
            accepted_bytes: (run.accepted_bytes as f64 * done) as u64,
            env_steps: (run.env_steps as f64 * done) as u64,
            ..run.clone()
        };
        fleet.apply_statuses(runs.iter().map(earlier).collect(), now - Duration::from_secs(ago_s));
    }
    fleet
}

fn draw_to_buffer(fleet: &mut Fleet, width: u16, height: u16, now: Instant) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| draw(frame, fleet, now)).unwrap();
    terminal.backend().buffer().clone()
}

fn lines(buffer: &Buffer) -> Vec<String> {
    let width = usize::from(buffer.area.width);
    buffer.content.chunks(width).map(|row| row.iter().map(|cell| cell.symbol()).collect()).collect()
}

fn screen(fleet: &mut Fleet, width: u16, height: u16) -> String {
    lines(&draw_to_buffer(fleet, width, height, Instant::now())).join("\n")
}

fn assert_shows(screen: &str, parts: &[&str]) {
    for part in parts {
        assert!(screen.contains(part), "`{part}` is missing in\n{screen}");
    }
}

#[test]
fn eighty_columns_show_the_run_its_curves_and_its_actors() {
    let now = Instant::now();
    let screen = screen(&mut fleet(&[samples::run("walk-1", 3)], now), 80, 24);
    assert_shows(&screen, &["walk-1  training", "on workhorse", "process 4711", "version 0.1.0"]);
    assert_shows(&screen, &["52 %", "4,194,304 of 8,000,000 steps", "3 min elapsed", "3 min to go"]);
    // Half of 970 fragments and of 970 MB came in 4 s.
    assert_shows(&screen, &["22.9k steps/s", "121 fragments/s", "121 MB/s", "512 updates"]);
    assert_shows(&screen, &["return 5892", "18.3 m at 1.30 m/s", "2.10M", "4.19M"]);
    assert_shows(&screen, &["lag 1.02 mean", "970 accepted", "5 too old", "actors 2 alive", "1 in quarantine"]);
    assert_shows(&screen, &["name", "host", "version", "policy", "lag", "steps/s", "contact", "state"]);
    for row in [
        ["actor-0", "host-0", "0.1.0", "512", "1000", "0.0 s", "alive"],
        ["actor-1", "host-0", "0.1.0", "511", "1001", "0.2 s", "quarantined"],
        ["actor-2", "host-0", "0.1.0", "510", "1002", "0.5 s", "gone"],
    ] {
        let line = screen.lines().find(|line| line.starts_with(row[0])).expect(row[0]);
        assert_shows(line, &row);
    }
    assert_shows(&screen, &["q quit  ? help  ↑↓ scroll  s order  Tab run", "1–3 of 3"]);
}

#[test]
fn forty_columns_show_values_instead_of_curves() {
    let now = Instant::now();
    let screen = screen(&mut fleet(&[samples::run("walk-1", 200)], now), 40, 10);
    assert_shows(&screen, &["walk-1  training", "52 %", "4.19M of 8.00M", "3 min to go"]);
    assert_shows(&screen, &["22.9k steps/s  121 frag/s  121 MB/s", "return 5892  18.3 m  1.30 m/s"]);
    assert_shows(&screen, &["actor-0", "1000", "alive", "q quit  ? help", "1–4 of 200"]);
}

#[test]
fn a_large_terminal_shows_more() {
    let now = Instant::now();
    let screen = screen(&mut fleet(&[samples::run("walk-1", 20)], now), 200, 60);
    assert_shows(&screen, &["distance 18.3 m", "velocity 1.30 m/s"]);
    assert_shows(&screen, &["dropped", "resent", "MB", "envs", "actor-19", "1–20 of 20"]);
}

#[test]
fn two_hundred_actors_can_be_scrolled_and_ordered() {
    let now = Instant::now();
    let mut fleet = fleet(&[samples::run("walk-1", 200)], now);
    assert_shows(&screen(&mut fleet, 80, 24), &["actor-0 ", "1–8 of 200"]);
    fleet.act(KeyAction::PageDown);
    fleet.act(KeyAction::Down);
    assert_shows(&screen(&mut fleet, 80, 24), &["10–17 of 200"]);
    fleet.act(KeyAction::Last);
    fleet.act(KeyAction::Down);
    let last = screen(&mut fleet, 80, 24);
    assert_shows(&last, &["actor-99 ", "193–200 of 200"]);
    fleet.act(KeyAction::PageUp);
    assert_shows(&screen(&mut fleet, 80, 24), &["185–192 of 200"]);
    fleet.act(KeyAction::First);
    fleet.act(KeyAction::Order);
    fleet.act(KeyAction::Order);
    let laggards = screen(&mut fleet, 80, 24);
    assert_shows(&laggards, &["by lag", "actor-103 ", "actor-107 ", "1–8 of 200"]);
    // Actors that leave while they are shown leave no gap.
    fleet.act(KeyAction::Last);
    fleet.apply_statuses(vec![samples::run("walk-1", 2)], now);
    assert_shows(&screen(&mut fleet, 80, 24), &["1–2 of 2", "actor-0"]);
}

#[test]
fn tab_selects_runs_and_new_runs_keep_the_selection() {
    let now = Instant::now();
    let mut fleet = fleet(&[samples::run("run-b", 1), samples::run("run-d", 2)], now);
    assert_shows(&screen(&mut fleet, 80, 24), &["run-b", "run 1 of 2"]);
    fleet.act(KeyAction::NextRun);
    assert_shows(&screen(&mut fleet, 80, 24), &["run-d", "run 2 of 2"]);
    fleet.apply_statuses(vec![samples::run("run-a", 1), samples::run("run-c", 1)], now);
    assert_shows(&screen(&mut fleet, 80, 24), &["run-d", "run 4 of 4"]);
    fleet.act(KeyAction::NextRun);
    assert_shows(&screen(&mut fleet, 80, 24), &["run-a", "run 1 of 4"]);
    fleet.act(KeyAction::PreviousRun);
    assert_shows(&screen(&mut fleet, 80, 24), &["run-d"]);
}

#[test]
fn silent_learner_is_shown_as_gone_until_it_answers() {
    let begun = Instant::now();
    let mut fleet = fleet(&[samples::run("walk-1", 2)], begun);
    let at = |fleet: &mut Fleet, now| lines(&draw_to_buffer(fleet, 80, 24, now)).join("\n");
    assert_shows(&at(&mut fleet, begun), &["walk-1  training"]);
    fleet.silence = Some("no learner answers".into());
    let later = begun + Duration::from_secs(42);
    assert_shows(&at(&mut fleet, later), &["walk-1  learner gone, silent for 42 s", "return 5892", "actor-1"]);
    fleet.apply_statuses(vec![RunStatus { phase: Phase::Paused.into(), ..samples::run("walk-1", 2) }], later);
    assert_shows(&at(&mut fleet, later), &["walk-1  paused"]);
    // This run is silent even if others answer.
    assert_shows(&at(&mut fleet, later + Duration::from_secs(10)), &["learner gone, silent for 10 s"]);
}

#[test]
fn alarms_are_shown_below_the_progress() {
    let mut run = samples::run("walk-1", 4);
    (run.used_share, run.idle_share) = (Some(0.64), Some(0.25));
    run.alarms = vec!["64 % of the simulated steps are learnt from".into(), "3 updates were undone".into()];
    let mut fleet = fleet(&[run], Instant::now());
    assert_shows(&screen(&mut fleet, 120, 30), &["64 % of the simulated steps", "3 updates were undone", "64 % used"]);
    assert_shows(&screen(&mut fleet, 120, 10), &["64 % of the simulated steps", "64 % used", "steps/s"]);
}

#[test]
fn help_lists_keys_and_small_terminals_show_the_size_needed() {
    let now = Instant::now();
    let mut fleet = fleet(&[samples::run("walk-1", 2)], now);
    fleet.act(KeyAction::Help);
    for (width, height) in [(40, 10), (80, 24), (200, 60)] {
        let screen = screen(&mut fleet, width, height);
        HELP.iter().for_each(|(keys, what)| assert_shows(&screen, &[keys, what]));
    }
    fleet.act(KeyAction::Back);
    assert!(!screen(&mut fleet, 80, 24).contains("Shift-Tab"));
    assert_shows(&screen(&mut fleet, 39, 24), &["This needs 40×10", "39×24"]);
    assert_shows(&screen(&mut fleet, 80, 9), &["This needs 40×10", "80×9"]);
    assert_shows(&screen(&mut Fleet::new(now), 80, 24), &["asking the learners", "q quit"]);
}

#[test]
fn colours_can_be_removed() {
    let now = Instant::now();
    let mut fleet = fleet(&[samples::run("walk-1", 3)], now);
    for (width, height) in [(40, 10), (80, 24), (200, 60)] {
        let mut buffer = draw_to_buffer(&mut fleet, width, height, now);
        let is_coloured = |cell: &Cell| cell.fg != Color::Reset || cell.bg != Color::Reset;
        assert!(buffer.content.iter().any(is_coloured));
        remove_colours(&mut buffer);
        assert!(!buffer.content.iter().any(is_coloured));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn hostile_statuses_are_drawn_without_control_characters(
        runs in prop::collection::vec(samples::hostile(), 0..4),
        values in prop::collection::vec((any::<u64>(), any::<u64>().prop_map(f64::from_bits), 0..CURVES.len()), 0..40),
        (width, height) in (0..250u16, 0..80u16),
        shows_help in any::<bool>(),
        seconds in 0..100_000u64,
    ) {
        let now = Instant::now() + Duration::from_secs(seconds);
        let mut fleet = fleet(&runs, now);
        for (step, value, tag) in values {
            for run in &runs {
                let metric = Metric { run: run.run.clone(), tag: CURVES[tag].into(), step, value, time_unix_s: value };
                fleet.apply_metric(&metric);
            }
        }
        if shows_help {
            fleet.act(KeyAction::Help);
        }
        for action in [KeyAction::Last, KeyAction::NextRun, KeyAction::Order, KeyAction::PageDown] {
            let buffer = draw_to_buffer(&mut fleet, width, height, now);
            for cell in &buffer.content {
                let moves = cell.symbol().chars().any(|c| c.is_control() || ('\u{202a}'..='\u{202e}').contains(&c));
                prop_assert!(!moves, "{:?}", cell.symbol());
            }
            if let (Some((run, ..)), true) = (fleet.selected(), width >= WIDTH_MIN && height >= HEIGHT_MIN && !shows_help) {
                let screen = lines(&buffer).join("\n");
                let (front, back) = (run.status.run.chars().next().unwrap(), run.status.run.chars().last().unwrap());
                let first = screen.lines().next().unwrap();
                prop_assert!(first.starts_with(front) && first.contains(back), "{}", first);
                prop_assert!(screen.contains("steps/s") && screen.contains("q quit"), "{}", screen);
            }
            fleet.act(action);
        }
    }
}
