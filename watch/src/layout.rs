//! Layout of the viewer, and its camera.

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

use crate::Shown;

/// Paths of entities and names of timelines, shared by recorder and layout.
pub mod paths {
    /// Root of all spatial entities.
    pub const WORLD: &str = "world";
    /// Parent of the robot's bodies, below the world.
    pub const BODY: &str = "body";
    /// Floor.
    pub const FLOOR: &str = "world/floor";
    /// Past positions of the torso.
    pub const TRAIL: &str = "world/trail";
    /// Contact forces.
    pub const FORCES: &str = "world/contacts/forces";
    /// Contact points.
    pub const POINTS: &str = "world/contacts/points";
    /// Terms of the reward.
    pub const REWARD: &str = "reward";
    /// Arrows of the commanded and the actual velocity.
    pub const ARROWS: &str = "world/velocities";
    /// Commands, and the velocities that follow them.
    pub const COMMANDS: &str = "commands";
    /// Velocity and distance.
    pub const VELOCITY: &str = "velocity";
    /// Hinge torques.
    pub const TORQUES: &str = "torques";
    /// Entity that the camera follows.
    pub const FOLLOWED: &str = "world/followed";
    /// Log of shown episodes.
    pub const EPISODES: &str = "episodes";
    /// Timeline of simulated time.
    pub const TIME: &str = "time";
    /// Timeline of control steps.
    pub const STEP: &str = "control step";
}

/// How the timeline plays at first.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum PlayMode {
    /// Plays from the beginning in real time.
    Played,
    /// Follows the latest data.
    Live,
}

/// Initial camera position and target (m).
const EYE_M: [f32; 3] = [1.4, -3.6, 1.7];
const TARGET_M: [f32; 3] = [0.0, 0.0, 0.95];
/// Visible range of the curves before and after the current moment (s).
const BEFORE_S: i64 = 4;
const AFTER_S: i64 = 1;

/// Returns the two points that the camera follows when the robot is at (x, y), in metres.
///
/// Rerun can only follow a drawn entity, and version 0.36.3 sets the camera's distance by the entity's size. The distance of
/// these points keeps the camera at its distance; it was found by trial.
pub fn followed_m([x, y]: [f32; 2]) -> [[f32; 3]; 2] {
    let [dx, dy, dz] = std::array::from_fn(|axis| EYE_M[axis] - TARGET_M[axis]);
    let radius = (dx * dx + dy * dy + dz * dz).sqrt() / 3.0;
    [-radius, radius].map(|dz| [x, y, TARGET_M[2] + dz])
}

/// Sends the layout; if `follows`, the camera follows the robot.
pub fn send(recording: &RecordingStream, follows: bool, mode: PlayMode, shown: &Shown) -> RecordingStreamResult<()> {
    let space = ContainerLike::from(Spatial3DView::new("humanoid").with_origin(paths::WORLD));
    let space_path = path_of(&space);
    let curves = |name: &str, path: &str| ContainerLike::from(TimeSeriesView::new(name).with_origin(path));
    let followed = match shown.has_commands {
        true => curves("commands and velocities", paths::COMMANDS),
        false => curves("velocity and distance", paths::VELOCITY),
    };
    let curves = [curves("reward", paths::REWARD), followed, curves("torques (N·m)", paths::TORQUES)];
    let curve_paths = curves.each_ref().map(path_of);
    let curves = Vertical::new(curves);
    let root = Horizontal::new([space, curves.into()]).with_column_shares([1.7, 1.0]);
    let play = if mode == PlayMode::Live { PlayState::Following } else { PlayState::Playing };
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
        .with_look_target(TARGET_M)
        .with_eye_up([0.0, 0.0, 1.0]);
    if follows {
        eye = eye.with_tracking_entity(paths::FOLLOWED);
    }
    let grid = LineGrid3D::new().with_visible(false);
    let visible_range = visible_range(shown.control_step_s);
    let mut properties: Vec<(EntityPath, &dyn AsComponents)> =
        vec![(space_path.clone() / "EyeControls3D", &eye), (space_path / "LineGrid3D", &grid)];
    properties
        .extend(curve_paths.into_iter().map(|path| (path / "VisibleTimeRanges", &visible_range as &dyn AsComponents)));
    send_with(recording, &blueprint, &properties)
}

/// Returns the path of a view's properties.
fn path_of(view: &ContainerLike) -> EntityPath {
    match view {
        ContainerLike::View(view) => view.blueprint_path(),
        _ => EntityPath::root(),
    }
}

/// Limits curves to a few seconds around the current moment, so that single steps are visible.
fn visible_range(control_step_s: f64) -> VisibleTimeRanges {
    let range = |timeline: &str, [before, after]: [i64; 2]| VisibleTimeRange {
        timeline: timeline.into(),
        range: TimeRange {
            start: TimeRangeBoundary::CursorRelative(TimeInt(-before)),
            end: TimeRangeBoundary::CursorRelative(TimeInt(after)),
        },
    };
    let steps = [BEFORE_S, AFTER_S].map(|seconds| (seconds as f64 / control_step_s) as i64);
    let nanoseconds = [BEFORE_S, AFTER_S].map(|seconds| seconds * 1_000_000_000);
    VisibleTimeRanges::default().with_ranges([range(paths::TIME, nanoseconds), range(paths::STEP, steps)])
}

/// Sends a blueprint with properties of views, which Rerun's blueprint builder cannot set: they are added to its messages.
fn send_with(
    recording: &RecordingStream,
    blueprint: &Blueprint,
    properties: &[(EntityPath, &dyn AsComponents)],
) -> RecordingStreamResult<()> {
    let application =
        recording.store_info().map(|info| info.application_id().clone()).unwrap_or_else(|| "treadmill".into());
    let (buffer, storage) = RecordingStreamBuilder::new(application.clone()).memory()?;
    blueprint.send(&buffer, BlueprintActivation::default())?;
    let mut messages = Vec::new();
    let mut activation = None;
    for message in storage.take() {
        match message {
            LogMsg::BlueprintActivationCommand(command) => activation = Some(command),
            message if message.store_id().kind() == StoreKind::Blueprint => messages.push(message),
            _ => {}
        }
    }
    let Some(activation) = activation else { return Ok(()) };
    let builder = RecordingStreamBuilder::new(application)
        .recording_id(activation.blueprint_id.recording_id().clone())
        .blueprint();
    let (stream, added) = builder.memory()?;
    stream.set_time_sequence("blueprint", 0);
    for (path, property) in properties {
        stream.log(path.clone(), *property)?;
    }
    // The blueprint's first message already holds the store info.
    messages.extend(added.take().into_iter().filter(|message| !matches!(message, LogMsg::SetStoreInfo(_))));
    recording.send_blueprint(messages, activation);
    Ok(())
}
