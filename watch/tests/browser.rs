//! The page in a real browser, with and without the humanoid.

mod support;

use std::path::PathBuf;

use support::{
    browser::{Browser, Page},
    picture::{Region, Screenshot},
    *,
};

/// The 3D view, without its frame.
const SPACE: Region = Region { x: 0.05..0.58, y: 0.15..0.85 };
/// Position of the body in the 3D view, and the edge that its trail reaches when the camera follows.
const MIDDLE: Region = Region { x: 0.22..0.42, y: 0.35..0.75 };
const LEFT: Region = Region { x: 0.0..0.03, y: 0.35..0.6 };
/// The curves.
const CURVES: Region = Region { x: 0.65..0.98, y: 0.12..0.85 };

/// Starts a viewer that plays the included policy, and returns the address of its page.
fn serve(folder: &tempfile::TempDir, episodes: &str) -> (Running, String) {
    let mut command = viewer(folder.path());
    command.arg(policy()).args(["--episodes", episodes, "--web-port", "0", "--data-port", "0"]);
    let running = Running::start(command);
    let line = running.wait_for("watch at ");
    let url = line.split_once("watch at ").expect("as waited for").1.to_string();
    running.wait_for("all is shown");
    // WebGL on the CPU works on every machine.
    (running, format!("{url}&renderer=webgl"))
}

/// Whether the floor is drawn: the 3D view has many colours, and much of it is grey.
fn is_drawn(picture: &Screenshot) -> bool {
    let floor = picture.share(&SPACE, |[r, g, b]| (40..140).contains(&r) && r.abs_diff(g) < 16 && g.abs_diff(b) < 16);
    picture.colours(&SPACE) > 50 && floor > 0.3
}

/// Takes screenshots until four in a row are equal.
fn wait_until_still(browser: &mut Browser, page: &Page, what: &str) -> Screenshot {
    let mut before: Option<Screenshot> = None;
    let mut same = 0;
    browser.wait_until(page, what, |picture| {
        let is_same = before.as_ref().is_some_and(|before| picture.difference(before, &SPACE) == 0.0);
        same = if is_same && is_drawn(picture) { same + 1 } else { 0 };
        before = Some(Screenshot::decode(picture.png()));
        same >= 3
    })
}

/// Saves a screenshot if TREADMILL_PICTURES names a folder.
fn keep(picture: &Screenshot, name: &str) {
    if let Some(folder) = std::env::var_os("TREADMILL_PICTURES") {
        picture.save(&PathBuf::from(folder).join(name));
    }
}

#[test]
fn the_page_shows_the_humanoid() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(mut browser) = Browser::start() else { return };
    let (_empty_viewer, url) = serve(&folder, "0");
    let page = browser.open(&url);
    let empty = wait_until_still(&mut browser, &page, "an empty floor that does not change");
    keep(&empty, "empty.png");
    let again = browser.open(&url);
    let again = wait_until_still(&mut browser, &again, "an empty floor that does not change");
    let noise = empty.difference(&again, &SPACE);
    assert!(noise < 0.001, "two equal pages differ in {noise} of their pixels");

    // Four episodes last longer than this test.
    let (_viewer, url) = serve(&folder, "4");
    let page = browser.open(&url);
    // Colours of left and right limbs.
    let orange = |[r, g, b]: [u8; 3]| r > 110 && r > g.saturating_add(25) && g > b.saturating_add(15);
    let green = |[r, g, b]: [u8; 3]| g > r.saturating_add(25) && b > r.saturating_add(25);
    let walking = browser.wait_until(&page, "a humanoid on the floor and curves beside it", |picture| {
        let differs = |part| picture.difference(&empty, part) > 0.01;
        let sides = [picture.share(&SPACE, orange), picture.share(&SPACE, green)];
        is_drawn(picture) && differs(&SPACE) && differs(&CURVES) && sides.iter().all(|share| *share > 0.001)
    });
    // It plays automatically: the picture keeps changing.
    let moves = |browser: &mut Browser, what: &str, from: &Screenshot| {
        browser.wait_until(&page, what, |picture| is_drawn(picture) && picture.difference(from, &SPACE) > 0.005)
    };
    moves(&mut browser, "motion", &walking);
    // The camera follows: the body stays in the middle, and its trail reaches the edge.
    let trail = |[r, g, b]: [u8; 3]| r > 200 && g > 160 && b < 120;
    browser.wait_until(&page, "a runner in the middle and its trail to the edge", |picture| {
        let has_colour = |colour: &dyn Fn([u8; 3]) -> bool| picture.share(&MIDDLE, colour) > 0.005;
        is_drawn(picture) && picture.share(&LEFT, trail) > 0.0 && has_colour(&orange) && has_colour(&green)
    });
    // The page receives keys after a click, here into the sky.
    browser.click(&page, (300, 100));
    browser.press(&page, " ", "Space");
    let paused = wait_until_still(&mut browser, &page, "a paused humanoid");
    keep(&paused, "watch.png");
    browser.press(&page, "ArrowRight", "ArrowRight");
    let stepped = browser
        .wait_until(&page, "the next moment", |picture| is_drawn(picture) && picture.difference(&paused, &SPACE) > 0.0);
    let stepped_still = wait_until_still(&mut browser, &page, "the humanoid, paused again");
    assert!(stepped_still.difference(&stepped, &SPACE) < 0.005, "the key must advance one step only");
    browser.press(&page, " ", "Space");
    moves(&mut browser, "motion once more", &stepped_still);
}
