//! Checks of the engine's inner numbers.

use super::engine::Build;
use super::group::{Group, Pass};
use super::steps::Engine;
use super::world::World;
use super::{advance, refresh, worlds_per_pass};
use crate::articulation::{Responses, Structure};
use crate::collision::CollisionModel;
use crate::lanes::{LANES_MAX, Scalar, with_registers};
use crate::mjcf::HUMANOID_XML;
use crate::model::{Model, Solver};

const STEP_S: f64 = 0.015 / 4.0;

fn humanoid() -> Model {
    Model::from_mjcf(HUMANOID_XML).expect("valid")
}

/// Falling, rotating humanoid number `number`, with constant torques; the lowest ones touch the floor.
fn world(model: &Model, structure: &Structure, collision: &CollisionModel, number: usize) -> World {
    let mut world = World::new(model);
    let wave = |index: usize, scale: f64| scale * ((index * 7 + number * 3) as f64).sin();
    for (index, angle) in world.position.iter_mut().enumerate().skip(7) {
        *angle = wave(index, 0.2);
    }
    world.position[2] = 1.2 + 0.02 * number as f64;
    for (index, rate) in world.velocity.iter_mut().enumerate() {
        *rate = wave(index, 1.0);
    }
    for (index, drive) in world.drives.iter_mut().enumerate() {
        drive.torque_nm = wave(index, 10.0);
        (drive.min_nm, drive.max_nm) = (f64::NEG_INFINITY, f64::INFINITY);
    }
    refresh(structure, collision, &mut world);
    world
}

#[test]
fn registers_of_all_widths_agree() {
    for solver in [Solver::GaussSeidel, Solver::Newton] {
        compare_widths(Model { solver, ..humanoid() });
    }
}

fn compare_widths(model: Model) {
    let structure = Structure::new(&model);
    let collision = CollisionModel::new(&model, &structure, true);
    let build = || (0..11).map(|number| world(&model, &structure, &collision, number)).collect::<Vec<_>>();
    // Without fused multiply-add, rounding differs: rates of up to 60 rad/s, forces of up to 2000 N.
    let scalar: Box<dyn Engine> = Box::new(Group::new(Scalar, &structure, &collision));
    let others = with_registers(&Build(&structure, &collision)).into_iter().map(|engine| (engine, 0.0));
    let mut others: Vec<_> = others.chain([(scalar, 1.0)]).collect();
    let pass = Pass { structure: &structure, collision: &collision, step_s: STEP_S };
    for (engine, tolerance) in &mut others {
        let (mut wide, mut single, mut touched) = (build(), build(), 0);
        for step in 0..8 {
            advance(pass, &mut wide.iter_mut(), 4);
            for world in &mut single {
                let mut chosen: [Option<&mut World>; LANES_MAX] = Default::default();
                chosen[0] = Some(world);
                engine.advance(pass, &mut chosen, 4);
            }
            for (number, (one, other)) in wide.iter().zip(&single).enumerate() {
                assert!(!one.has_failed && !other.has_failed);
                let numbers = |world: &World| [&world.position[..], &world.velocity, &world.torques_nm].concat();
                for (index, (one, other)) in numbers(one).into_iter().zip(numbers(other)).enumerate() {
                    let off = (one - other).abs();
                    assert!(off <= 1e-3 * *tolerance, "world {number}, step {step}, number {index}: off by {off}");
                }
                assert_eq!(one.contacts.len(), other.contacts.len());
                for (one, other) in one.contacts.iter().zip(&other.contacts) {
                    assert!((one.force_n - other.force_n).norm() <= 0.1 * *tolerance && one.links == other.links);
                }
                touched += usize::from(!one.contacts.is_empty());
            }
        }
        assert!(touched > 20, "{touched} worlds with contacts; {} lanes", worlds_per_pass());
    }
}

#[test]
fn both_solvers_find_the_same_motion() {
    let models = [Solver::GaussSeidel, Solver::Newton].map(|solver| Model { solver, ..humanoid() });
    let mut touched = 0;
    let [sweeps, newton] = models.each_ref().map(|model| {
        let structure = Structure::new(model);
        let collision = CollisionModel::new(model, &structure, true);
        let mut worlds: Vec<_> = (0..11).map(|number| world(model, &structure, &collision, number)).collect();
        let pass = Pass { structure: &structure, collision: &collision, step_s: STEP_S };
        for _ in 0..8 {
            advance(pass, &mut worlds.iter_mut(), 4);
            touched += worlds.iter().filter(|world| !world.contacts.is_empty()).count();
        }
        worlds
    });
    for (number, (one, other)) in sweeps.iter().zip(&newton).enumerate() {
        for (index, (one, other)) in one.position.iter().zip(&other.position).enumerate() {
            assert!((one - other).abs() < 1e-4, "world {number}, number {index}: {one} and {other}");
        }
    }
    assert!(touched > 40, "{touched} worlds with contacts");
}

#[test]
fn responses_equal_mujocos() {
    let model = humanoid();
    let responses = Responses::new(&model, &Structure::new(&model));
    // MuJoCo 4.0's `body_invweight0` of translations, and `dof_invweight0`; it takes means over the root's translations and
    // rotations.
    let links = [
        0.05865113, 0.06712544, 0.05544596, 0.07243824, 0.12313119, 0.23799862, 0.07247012, 0.12294246, 0.23798883,
        0.16116980, 0.54524610, 0.16117939, 0.54524337,
    ];
    let root = [0.05400033, 3.30992747];
    let hinges = [
        11.7844993, 10.5708906, 5.20196316, 4.10890261, 42.0359167, 9.90118005, 16.7388075, 4.10890241, 42.0299786,
        9.77813119, 16.6012814, 11.9656342, 15.9321985, 23.6091492, 11.9636197, 15.9361149, 23.6101558,
    ];
    // Sums over the whole tree in single precision.
    let close = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1e-5;
    assert_eq!((responses.links.len(), responses.dofs.len()), (13, 23));
    for (link, (found, wanted)) in responses.links.iter().zip(links).enumerate() {
        assert!(close(*found, wanted), "link {link}: {found} instead of {wanted}");
    }
    for (part, wanted) in root.into_iter().enumerate() {
        let mean = responses.dofs[part * 3..][..3].iter().sum::<f64>() / 3.0;
        assert!(close(mean, wanted), "root: {mean} instead of {wanted}");
    }
    // The motors' order differs from that of MJCF's joints nowhere but in the names.
    for (hinge, (found, wanted)) in responses.dofs[6..].iter().zip(hinges).enumerate() {
        assert!(close(*found, wanted), "hinge {hinge}: {found} instead of {wanted}");
    }
}
