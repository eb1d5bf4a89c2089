//! What was understood of a robot, as lines and as JSON.

use std::{collections::BTreeMap, fmt::Write, path::Path};

use serde_json::{Value, json};
use treadmill_humanoid::{
    HomePose, Mirror, Model, Physics,
    card::BodySize,
    model::{Geometry, Hinge, HingeControl, Motor},
};

/// Difference between the sides of a robot that is worth a word (m).
const APART_NOTED_M: f64 = 1e-4;

/// Returns the report of a model that was read from `file`, which has so many visual meshes; `walker` is the same with a
/// card.
pub fn lines(model: &Model, walker: &Model, text: &str, file: &Path, meshes: usize, home: Option<&HomePose>) -> String {
    let mut lines = String::new();
    let mut line = |name: &str, what: String| {
        let _ = writeln!(lines, "{name:<10} {what}");
    };
    let name = file.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
    let height_m = match &model.robot {
        Some(robot) => robot.default_position[2],
        None => model.bodies[0].pose.translation.z,
    };
    line("robot", format!("{name}: {:.2} kg, root `{}` at {height_m:.3} m", model.mass_kg(), model.links[0].name));
    line(
        "tree",
        format!("{} rigid bodies, {} hinges, {} motors", model.bodies.len(), model.hinges.len(), model.motors.len()),
    );
    let on_ground = model.pairs.iter().filter(|pair| pair.second.is_none()).count();
    let between = model.pairs.len() - on_ground;
    line("contacts", format!("{}; {on_ground} pairs with the ground, {between} with each other", shapes(model)));
    let ground = match &model.ground.height_field {
        None => "level plane".to_owned(),
        Some(field) => {
            let (x_m, y_m) = (2.0 * field.half_x_m, 2.0 * field.half_y_m);
            format!("height field of {} × {} points, {x_m} m × {y_m} m", field.rows, field.columns)
        }
    };
    line("ground", format!("{ground}, friction {}", model.ground.friction));
    if !model.keyframes.is_empty() {
        line("keyframes", model.keyframes.iter().map(|key| key.name.as_str()).collect::<Vec<_>>().join(", "));
    }
    for coupling in &model.couplings {
        let of = coupling.follows.map(|(other, ratio)| format!(" + {ratio} × `{}`", model.hinges[other].name));
        let what = format!(
            "`{}` = {:.3} rad{}",
            model.hinges[coupling.hinge].name,
            coupling.offset_rad,
            of.unwrap_or_default()
        );
        line("coupled", what);
    }
    for connection in &model.connections {
        let [one, other] = connection.links.map(|link| &model.links[link].name);
        line("loop", format!("`{one}` and `{other}` stay together in one point"));
    }
    if let Some(robot) = &model.robot {
        let feet: Vec<&str> = robot.feet.iter().map(|foot| model.links[*foot].name.as_str()).collect();
        line("feet", feet.join(", "));
    }
    if let Ok(size) = BodySize::of(walker) {
        line("legs", format!("{:.3} m from the ground to the hips, for {:.0} N", size.leg_length_m, size.weight_n));
    }
    if let Some(home) = home {
        let forward = home.forward.map(|axis| format!("{axis} forward, ")).unwrap_or_default();
        line("axes", format!("of the base: {forward}{} up", home.up));
        line("at home", format!("on the ground: {}", joined(&home.touching)));
        home.faults.iter().for_each(|what| line("fault", what.clone()));
        home.warnings.iter().for_each(|what| line("warning", what.clone()));
    }
    let names: Vec<&str> = model.links.iter().map(|link| link.name.as_str()).collect();
    line("bodies", joined(&names));
    match Mirror::of(walker) {
        Ok(mirror) => {
            let differ = match mirror.apart_m > APART_NOTED_M {
                true => format!("; its sides differ by up to {:.1} mm, which is neglected", 1000.0 * mirror.apart_m),
                false => String::new(),
            };
            line("symmetry", format!("each hinge has a mirror image{differ}"));
        }
        Err(why) => line("symmetry", format!("none: {why}")),
    }
    for note in &model.simplifications {
        line("simplified", note.clone());
    }
    let mut ignored: Vec<String> =
        Model::ignored_elements(text).into_iter().map(|(tag, count)| format!("{count} <{tag}>")).collect();
    if meshes > 0 {
        ignored.push(format!("{meshes} visual meshes, which `watch --model` shows"));
    }
    if !ignored.is_empty() {
        line("ignored", ignored.join(", "));
    }
    lines.push('\n');
    lines + &table(model)
}

fn joined<S: AsRef<str>>(names: &[S]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// Counts colliding shapes by kind.
fn shapes(model: &Model) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut corners = 0;
    for shape in model.bodies.iter().flat_map(|body| &body.shapes) {
        let kind = match &shape.geometry {
            Geometry::Sphere { .. } => "spheres",
            Geometry::Capsule { .. } => "capsules",
            Geometry::Cylinder { .. } => "cylinders",
            Geometry::Box { .. } => "boxes",
            Geometry::Ellipsoid { .. } => "ellipsoids",
            Geometry::Hull { vertices_m } => {
                corners += vertices_m.len();
                "hulls of meshes"
            }
        };
        *counts.entry(kind).or_default() += 1;
    }
    let mut all: Vec<String> = counts.into_iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    if corners > 0 {
        all.push(format!("{corners} corners"));
    }
    all.join(", ")
}

/// Returns the table of hinges.
fn table(model: &Model) -> String {
    let width = model.hinges.iter().map(|hinge| hinge.name.len()).max().unwrap_or(0).max(5);
    let mut table = format!(
        "{:<width$} {:>16} {:>9} {:>9} {:>9} {:>9} {:>8} {:>7}\n",
        "hinge", "range (rad)", "effort", "armature", "kp", "kd", "default", "scale"
    );
    for (index, hinge) in model.hinges.iter().enumerate() {
        let facts = HingeFacts::of(model, index);
        let range = match hinge.min_rad.is_finite() || hinge.max_rad.is_finite() {
            true => format!("{:.3} {:.3}", hinge.min_rad, hinge.max_rad),
            false => "free".to_owned(),
        };
        let number =
            |value: Option<f64>, digits: usize| value.map_or("-".to_owned(), |value| format!("{value:.digits$}"));
        let held = if facts.is_held { " held" } else { "" };
        let _ = writeln!(
            table,
            "{:<width$} {range:>16} {:>9} {:>9} {:>9} {:>9} {:>8} {:>7}{held}",
            hinge.name,
            number(facts.effort_nm, 1),
            number(Some(hinge.armature_kgm2), 4),
            number(facts.kp, 1),
            match (facts.kd.unwrap_or(0.0), hinge.damping_nmsprad) {
                (0.0, of_joint) if of_joint > 0.0 => format!("{of_joint:.2} j"),
                _ => number(facts.kd, 2),
            },
            number(facts.default_rad, 3),
            number(facts.action_scale_rad, 3),
        );
    }
    if table.contains(" j ") {
        table.push_str("j: damping of the joint itself, whose servo has none\n");
    }
    table
}

/// Servo of a hinge, by its card or by its motor.
struct HingeFacts {
    kp: Option<f64>,
    kd: Option<f64>,
    effort_nm: Option<f64>,
    default_rad: Option<f64>,
    action_scale_rad: Option<f64>,
    is_held: bool,
}

impl HingeFacts {
    fn of(model: &Model, index: usize) -> Self {
        if let Some(robot) = &model.robot {
            let HingeControl { kp, kd, effort_nm, action_scale_rad, is_held } = robot.hinges[index];
            return Self {
                kp: Some(kp),
                kd: Some(kd),
                effort_nm: Some(effort_nm),
                default_rad: Some(robot.default_position[7 + index]),
                action_scale_rad: Some(action_scale_rad).filter(|_| !is_held),
                is_held,
            };
        }
        let motor: Option<&Motor> = model.motors.iter().find(|motor| motor.hinge == index);
        let gain =
            |number: usize| motor.map(|motor| -motor.bias[number] * motor.gear_nm.powi(2)).filter(|gain| *gain != 0.0);
        Self {
            kp: gain(1),
            kd: gain(2),
            effort_nm: model.effort_nm(index),
            default_rad: None,
            action_scale_rad: None,
            is_held: false,
        }
    }
}

/// Returns the report as JSON; poses are those of all hinges at zero, in the world. `walker` is the model with a card.
pub fn json(physics: &Physics, walker: &Model, text: &str, meshes: usize, home: Option<&HomePose>) -> Value {
    let model = physics.model();
    let links: Vec<Value> = model
        .links
        .iter()
        .map(|link| {
            let body = physics.body_motion(link.body).pose;
            let turn = body.rotation.to_rotation_matrix();
            let inertia = turn.matrix() * link.inertia_kgm2 * turn.matrix().transpose();
            let rows: Vec<Vec<f64>> = inertia.row_iter().map(|row| row.iter().copied().collect()).collect();
            json!({
                "name": link.name,
                "mass_kg": link.mass_kg,
                "centre_of_mass_m": (body * link.centre_of_mass_m).coords.as_slice(),
                "inertia_kgm2": rows,
            })
        })
        .collect();
    let of_hinge = |(index, hinge): (usize, &Hinge)| {
        let pose = physics.body_motion(model.body_of_hinge(index)).pose;
        let facts = HingeFacts::of(model, index);
        let limit = |limit_rad: f64| limit_rad.is_finite().then_some(limit_rad);
        json!({
            "name": hinge.name,
            "axis": (pose.rotation * hinge.axis.into_inner()).as_slice(),
            "anchor_m": (pose * hinge.anchor_m).coords.as_slice(),
            "min_rad": limit(hinge.min_rad),
            "max_rad": limit(hinge.max_rad),
            "armature_kgm2": hinge.armature_kgm2,
            "damping_nmsprad": hinge.damping_nmsprad,
            "damping_powers": hinge.damping_powers,
            "stiffness_nmprad": hinge.stiffness_nmprad,
            "stiffness_powers": hinge.stiffness_powers,
            "friction_loss_nm": hinge.friction_loss_nm,
            "kp": facts.kp,
            "kd": facts.kd,
            "effort_nm": facts.effort_nm,
            "default_rad": facts.default_rad,
            "action_scale_rad": facts.action_scale_rad,
            "held": facts.is_held,
        })
    };
    json!({
        "mass_kg": model.mass_kg(),
        "root": model.links[0].name,
        "height_m": model.nominal_position()[2],
        "leg_length_m": BodySize::of(walker).ok().map(|size| size.leg_length_m),
        "bodies": model.bodies.len(),
        "motors": model.motors.iter().map(|motor| motor.name.as_str()).collect::<Vec<_>>(),
        "shapes": model.bodies.iter().map(|body| body.shapes.len()).sum::<usize>(),
        "pairs": model.pairs.len(),
        "keyframes": model.keyframes.iter().map(|key| key.name.as_str()).collect::<Vec<_>>(),
        "feet": walker.robot.as_ref().map(|robot| {
            robot.feet.iter().map(|foot| model.links[*foot].name.as_str()).collect::<Vec<_>>()
        }),
        "axes": home.map(|home| json!({"forward": home.forward, "up": home.up})),
        "on_ground_at_home": home.map(|home| &home.touching),
        "faults": home.map(|home| &home.faults),
        "warnings": home.map(|home| &home.warnings),
        "couplings": model.couplings.len(),
        "connections": model.connections.len(),
        "hinges": model.hinges.iter().enumerate().map(of_hinge).collect::<Vec<_>>(),
        "links": links,
        "simplified": model.simplifications,
        "ignored": Model::ignored_elements(text),
        "visual_meshes": meshes,
    })
}
