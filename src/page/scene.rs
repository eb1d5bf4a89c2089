//! Meshes of robots and ground, as the page draws them.

use std::iter;

use treadmill_humanoid::{
    Model,
    mjcf::VisualMesh,
    model::{Link, Robot},
};
use treadmill_proto::page::{PageBody, PageFoot, PageHinge, PageMesh, PageRobot};
use treadmill_render::{TriangleMesh, look};

/// Colour of ground that is not level.
const GROUND: [f64; 3] = [0.55, 0.56, 0.58];

/// Returns a robot by the meshes of its file, or by its colliding shapes if there are none.
#[must_use]
pub fn robot(name: &str, model: &Model, visuals: &[VisualMesh], reward_terms: Vec<String>) -> PageRobot {
    let mut parts = look::parts(model, visuals);
    // Meshes of files have edges where their triangles meet at an angle.
    parts.iter_mut().for_each(|part| part.mesh.is_faceted |= !visuals.is_empty());
    let body = |(index, body): (usize, &treadmill_humanoid::model::Body)| PageBody {
        name: body.name.clone(),
        meshes: parts.iter().filter(|part| part.body == index).map(|part| mesh(&part.mesh, part.colour)).collect(),
    };
    let hinge = |hinge: &treadmill_humanoid::model::Hinge| PageHinge {
        name: hinge.name.clone(),
        low_rad: hinge.min_rad as f32,
        high_rad: hinge.max_rad as f32,
        effort_nm: 0.0,
        is_servo: false,
    };
    let mut hinges: Vec<PageHinge> = model.hinges.iter().map(hinge).collect();
    for motor in model.motors.iter().rev() {
        let [low_nm, high_nm] = model.hinges[motor.hinge].torque_nm;
        let force = motor.force.map(|force| (force * motor.gear_nm).abs()).into_iter().fold(0.0, f64::max);
        let control =
            motor.control.map(|control| (control * motor.gain * motor.gear_nm).abs()).into_iter().fold(0.0, f64::max);
        // A servo's control is an angle, so that only its force limits the torque.
        let own = if motor.bias == [0.0; 3] { control.min(force) } else { force };
        hinges[motor.hinge].is_servo = motor.bias[1] != 0.0;
        hinges[motor.hinge].effort_nm = own.min(low_nm.abs().max(high_nm.abs())) as f32;
    }
    PageRobot {
        name: name.to_string(),
        bodies: model.bodies.iter().enumerate().map(body).collect(),
        hinges,
        reward_terms,
        feet: feet(model),
    }
}

/// Returns the origins of the feet's links: of those of the robot's card, else of those whose names say so.
fn feet(model: &Model) -> Vec<PageFoot> {
    let named = || model.links.iter().filter(|link| link.name.ends_with("foot")).collect();
    let of_card = |robot: &Robot| robot.feet.iter().map(|foot| &model.links[*foot]).collect();
    let feet: Vec<&Link> = model.robot.as_ref().filter(|robot| !robot.feet.is_empty()).map_or_else(named, of_card);
    let foot = |link: &&Link| PageFoot {
        body: link.body as u32,
        at_m: link.pose.translation.vector.iter().map(|part| *part as f32).collect(),
    };
    feet.iter().map(foot).collect()
}

/// Returns the ground of a model; `None` if it is the plane z = 0.
#[must_use]
pub fn ground(model: &Model) -> Option<PageMesh> {
    model.ground.height_field.as_deref().map(|field| mesh(&TriangleMesh::of_field(field), GROUND))
}

fn mesh(triangles: &TriangleMesh, colour: [f64; 3]) -> PageMesh {
    let TriangleMesh { corners_m, triangles, is_faceted } = triangles;
    let bytes = colour.map(|share| (share.clamp(0.0, 1.0) * 255.0).round() as u32);
    let colour = iter::zip(bytes, [16, 8, 0]).map(|(byte, shift)| byte << shift).sum();
    PageMesh { colour, is_faceted: *is_faceted, ..PageMesh::packed(corners_m, triangles) }
}

#[cfg(test)]
mod tests {
    use treadmill_humanoid::HUMANOID_XML;

    use super::*;

    #[test]
    fn a_robot_has_its_shapes_and_hinges() {
        let model = Model::from_mjcf(HUMANOID_XML).unwrap();
        let found = robot("walk", &model, &[], Vec::new());
        assert_eq!((found.bodies.len(), found.hinges.len()), (model.bodies.len(), 17));
        for (found, body) in iter::zip(&found.bodies, &model.bodies) {
            assert_eq!(found.meshes.len(), body.shapes.len(), "{}", body.name);
        }
        let hip = found.hinges.iter().find(|hinge| hinge.name == "right_hip_y").unwrap();
        // Gymnasium's humanoid: gear 300, controls of ±0.4.
        assert!((hip.effort_nm - 120.0).abs() < 1e-3 && !hip.is_servo, "{hip:?}");
        // The feet are welded to the shins, 0.39 and 0.45 m below the knees.
        let feet: Vec<_> = found.feet.iter().map(|foot| &found.bodies[foot.body as usize].name[..]).collect();
        assert_eq!(feet, ["right_shin", "left_shin"]);
        let below_m = found.feet.iter().map(|foot| foot.at_m[2]);
        assert!(below_m.clone().all(|z_m| (-0.5..-0.35).contains(&z_m)), "{:?}", below_m.collect::<Vec<_>>());
        assert!(ground(&model).is_none());
        let thigh = &found.bodies.iter().find(|body| body.name == "left_thigh").unwrap().meshes[0];
        assert_eq!(thigh.colour, 0xed_8c_3d);
        assert!(thigh.corners.len().is_multiple_of(6) && thigh.triangles.len().is_multiple_of(6));
    }
}
