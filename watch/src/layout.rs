//! What stands where in the viewer, and the camera that follows.

use rerun::{
    AsComponents, EntityPath, RecordingStream, RecordingStreamBuilder, RecordingStreamResult,
    blueprint::{
        Blueprint, BlueprintActivation, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel, Spatial3DView,
        TimePanel, TimeSeriesView, Vertical,
        components::{Eye3DKind, PanelState, PlayState},
    },
    datatypes::{TimeInt, TimeRange, TimeRangeBoundary, VisibleTimeRange},
    external::{
        re_log_types::{LogMsg, StoreKind},
        re_sdk_types::blueprint::archetypes::{EyeControls3D, LineGrid3D, VisibleTimeRanges},
    },
};
use treadmill_humanoid::CONTROL_STEP_S;

/// Entities and timelines, by which recorder and layout know each other.
pub mod paths {
    /// Everything in space.
    pub const WORLD: &str = "world";
    /// The bodies of the robot, below the world.
    pub const BODY: &str = "body";
    /// The floor.
    pub const FLOOR: &str = "world/floor";
    /// Where the torso was.
    pub const TRAIL: &str = "world/trail";
    /// What the contacts do.
    pub const FORCES: &str = "world/contacts/forces";
    /// Where they are.
    pub const POINTS: &str = "world/contacts/points";
    /// Terms of the reward.
    pub const REWARD: &str = "reward";
    /// Velocity and distance.
    pub const VELOCITY: &str = "velocity";
    /// Torques of the hinges.
    pub const TORQUES: &str = "torques";
    /// What the camera follows.
    pub const FOLLOWED: &str = "world/followed";
    /// Which episode is shown.
    pub const EPISODES: &str = "episodes";
    /// Timeline of simulated time.
    pub const TIME: &str = "time";
    /// Timeline of control steps.
    pub const STEP: &str = "control step";
}

/// How time goes on at first.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum PlaybackSpeed {
    /// From the beginning, as it happened.
    Played,
    /// With what comes in.
    Live,
}

/// The camera and what it looks at, before anything has moved, in metres.
const EYE_M: [f32; 3] = [1.4, -3.6, 1.7];
const LOOKED_AT_M: [f32; 3] = [0.0, 0.0, 0.95];
/// How much of the curves is to be seen, before the moment that is shown and after it.
const BEFORE_S: i64 = 4;
const AFTER_S: i64 = 1;

/// Two points around which the camera turns where the robot is at (x, y), in metres. Only what is drawn can be followed, and
/// where Rerun 0.36.3 begins to follow, it places the camera by the size of that: with these it stays as far off as it is
/// meant to be. How far apart they are was found by looking.
pub fn followed_m([x, y]: [f32; 2]) -> [[f32; 3]; 2] {
    let [dx, dy, dz] = std::array::from_fn(|axis| EYE_M[axis] - LOOKED_AT_M[axis]);
    let radius = (dx * dx + dy * dy + dz * dz).sqrt() / 3.0;
    [-radius, radius].map(|above| [x, y, LOOKED_AT_M[2] + above])
}

/// Sends the layout; the camera goes along with the robot if it `follows`, or stays where it is.
pub fn send(recording: &RecordingStream, follows: bool, speed: PlaybackSpeed) -> RecordingStreamResult<()> {
    let space = ContainerLike::from(Spatial3DView::new("humanoid").with_origin(paths::WORLD));
    let space_path = path_of(&space);
    let curves = |name: &str, path: &str| ContainerLike::from(TimeSeriesView::new(name).with_origin(path));
    let curves = [
        curves("reward", paths::REWARD),
        curves("velocity and distance", paths::VELOCITY),
        curves("torques (N·m)", paths::TORQUES),
    ];
    let curve_paths = curves.each_ref().map(path_of);
    let beside = Vertical::new(curves);
    let root = Horizontal::new([space, beside.into()]).with_column_shares([1.7, 1.0]);
    let play = if speed == PlaybackSpeed::Live { PlayState::Following } else { PlayState::Playing };
    let blueprint = Blueprint::new(root)
        .with_auto_views(false)
        .with_auto_layout(false)
        .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Collapsed))
        .with_selection_panel(SelectionPanel::from_state(PanelState::Collapsed))
        .with_time_panel(
            TimePanel::new().with_state(PanelState::Collapsed).with_timeline(paths::TIME).with_play_state(play),
        );
    let mut eye = EyeControls3D::new()
        .with_kind(Eye3DKind::Orbital)
        .with_position(EYE_M)
        .with_look_target(LOOKED_AT_M)
        .with_eye_up([0.0, 0.0, 1.0]);
    if follows {
        eye = eye.with_tracking_entity(paths::FOLLOWED);
    }
    let grid = LineGrid3D::new().with_visible(false);
    let around_now = around_now();
    let mut properties: Vec<(EntityPath, &dyn AsComponents)> =
        vec![(space_path.clone() / "EyeControls3D", &eye), (space_path / "LineGrid3D", &grid)];
    properties
        .extend(curve_paths.into_iter().map(|path| (path / "VisibleTimeRanges", &around_now as &dyn AsComponents)));
    send_with(recording, &blueprint, &properties)
}

/// Where the properties of a view are kept.
fn path_of(view: &ContainerLike) -> EntityPath {
    match view {
        ContainerLike::View(view) => view.blueprint_path(),
        _ => EntityPath::root(),
    }
}

/// Curves show what is around the moment: of all that was ever shown one would see no step.
fn around_now() -> VisibleTimeRanges {
    let range = |timeline: &str, [before, after]: [i64; 2]| VisibleTimeRange {
        timeline: timeline.into(),
        range: TimeRange {
            start: TimeRangeBoundary::CursorRelative(TimeInt(-before)),
            end: TimeRangeBoundary::CursorRelative(TimeInt(after)),
        },
    };
    let steps = [BEFORE_S, AFTER_S].map(|seconds| (seconds as f64 / CONTROL_STEP_S) as i64);
    let nanoseconds = [BEFORE_S, AFTER_S].map(|seconds| seconds * 1_000_000_000);
    VisibleTimeRanges::default().with_ranges([range(paths::TIME, nanoseconds), range(paths::STEP, steps)])
}

/// Rerun's builder of layouts knows nothing of the properties of a view yet, so they are added to the messages that it makes.
fn send_with(
    recording: &RecordingStream,
    blueprint: &Blueprint,
    properties: &[(EntityPath, &dyn AsComponents)],
) -> RecordingStreamResult<()> {
    let application =
        recording.store_info().map(|info| info.application_id().clone()).unwrap_or_else(|| "treadmill".into());
    let (made_in, made) = RecordingStreamBuilder::new(application.clone()).memory()?;
    blueprint.send(&made_in, BlueprintActivation::default())?;
    let mut messages = Vec::new();
    let mut activation = None;
    for message in made.take() {
        match message {
            LogMsg::BlueprintActivationCommand(command) => activation = Some(command),
            message if message.store_id().kind() == StoreKind::Blueprint => messages.push(message),
            _ => {}
        }
    }
    let Some(activation) = activation else { return Ok(()) };
    let own = RecordingStreamBuilder::new(application)
        .recording_id(activation.blueprint_id.recording_id().clone())
        .blueprint();
    let (stream, added) = own.memory()?;
    stream.set_time_sequence("blueprint", 0);
    for (path, property) in properties {
        stream.log(path.clone(), *property)?;
    }
    // It says once more which store it is; the first message did.
    messages.extend(added.take().into_iter().filter(|message| !matches!(message, LogMsg::SetStoreInfo(_))));
    recording.send_blueprint(messages, activation);
    Ok(())
}
