//! The page in a real browser: with the humanoid it is another picture than without.

mod support;

use std::path::PathBuf;

use support::{
    browser::{Browser, Page},
    picture::{Part, Picture},
    *,
};

/// Where the body is: the view of space, without its frame.
const SPACE: Part = Part { x: 0.05..0.58, y: 0.15..0.85 };
/// Where the body stands in it, and what it leaves behind when the camera goes along.
const MIDDLE: Part = Part { x: 0.22..0.42, y: 0.35..0.75 };
const LEFT: Part = Part { x: 0.0..0.03, y: 0.35..0.6 };
/// Where the curves are.
const CURVES: Part = Part { x: 0.65..0.98, y: 0.12..0.85 };

/// The page of a viewer that plays the policy that comes along.
fn serve(folder: &tempfile::TempDir, episodes: &str) -> (Running, String) {
    let mut command = viewer(folder.path());
    command.arg(policy()).args(["--episodes", episodes, "--web-port", "0", "--data-port", "0"]);
    let running = Running::start(command);
    let line = running.wait_for("watch at ");
    let url = line.split_once("watch at ").expect("as waited for").1.to_string();
    running.wait_for("all is shown");
    // Whatever this machine has, the browser draws with WebGL, and its processor does the work.
    (running, format!("{url}&renderer=webgl"))
}

/// A floor is there when the view of space is neither one colour nor the black of a page that has not begun.
fn is_drawn(picture: &Picture) -> bool {
    let floor = picture.share(&SPACE, |[r, g, b]| (40..140).contains(&r) && r.abs_diff(g) < 16 && g.abs_diff(b) < 16);
    picture.colours(&SPACE) > 50 && floor > 0.3
}

/// Looks until nothing changes any more.
fn look_until_still(browser: &mut Browser, page: &Page, what: &str) -> Picture {
    let mut before: Option<Picture> = None;
    let mut same = 0;
    browser.look_until(page, what, |picture| {
        let is_same = before.as_ref().is_some_and(|before| picture.difference(before, &SPACE) == 0.0);
        same = if is_same && is_drawn(picture) { same + 1 } else { 0 };
        before = Some(Picture::decode(picture.png()));
        same >= 3
    })
}

/// Keeps a picture where TREADMILL_PICTURES names a folder.
fn keep(picture: &Picture, name: &str) {
    if let Some(folder) = std::env::var_os("TREADMILL_PICTURES") {
        picture.save(&PathBuf::from(folder).join(name));
    }
}

#[test]
fn the_page_shows_the_humanoid() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(mut browser) = Browser::start() else { return };
    let (_nobody, url) = serve(&folder, "0");
    let page = browser.open(&url);
    let empty = look_until_still(&mut browser, &page, "an empty stage that stays as it is");
    keep(&empty, "empty.png");
    let again = browser.open(&url);
    let again = look_until_still(&mut browser, &again, "an empty stage that stays as it is");
    let noise = empty.difference(&again, &SPACE);
    assert!(noise < 0.001, "two pages of the same differ in {noise} of their pixels");

    // So long that it is not over before everything was tried.
    let (_humanoid, url) = serve(&folder, "4");
    let page = browser.open(&url);
    // Legs of two colours: those of the left and those of the right side.
    let orange = |[r, g, b]: [u8; 3]| r > 110 && r > g.saturating_add(25) && g > b.saturating_add(15);
    let green = |[r, g, b]: [u8; 3]| g > r.saturating_add(25) && b > r.saturating_add(25);
    let walking = browser.look_until(&page, "a humanoid on the floor and curves beside it", |picture| {
        let differs = |part| picture.difference(&empty, part) > 0.01;
        let sides = [picture.share(&SPACE, orange), picture.share(&SPACE, green)];
        is_drawn(picture) && differs(&SPACE) && differs(&CURVES) && sides.iter().all(|share| *share > 0.001)
    });
    // It plays by itself: the picture goes on changing.
    let moves = |browser: &mut Browser, what: &str, from: &Picture| {
        browser.look_until(&page, what, |picture| is_drawn(picture) && picture.difference(from, &SPACE) > 0.005)
    };
    moves(&mut browser, "motion", &walking);
    // The camera goes along: the body is where it was, and its trail leaves the picture behind it.
    let trail = |[r, g, b]: [u8; 3]| r > 200 && g > 160 && b < 120;
    browser.look_until(&page, "a runner in the middle and the trail to the border", |picture| {
        let is_there = |colour: &dyn Fn([u8; 3]) -> bool| picture.share(&MIDDLE, colour) > 0.005;
        is_drawn(picture) && picture.share(&LEFT, trail) > 0.0 && is_there(&orange) && is_there(&green)
    });
    // Keys go to the page once it was clicked, here into the sky.
    browser.click(&page, (300, 100));
    browser.press(&page, " ", "Space");
    let paused = look_until_still(&mut browser, &page, "a humanoid that was stopped");
    keep(&paused, "watch.png");
    browser.press(&page, "ArrowRight", "ArrowRight");
    let stepped = browser
        .look_until(&page, "the next moment", |picture| is_drawn(picture) && picture.difference(&paused, &SPACE) > 0.0);
    let stepped_still = look_until_still(&mut browser, &page, "a humanoid that stands still again");
    assert!(stepped_still.difference(&stepped, &SPACE) < 0.005, "one step, and no more");
    browser.press(&page, " ", "Space");
    moves(&mut browser, "motion once more", &stepped_still);
}
