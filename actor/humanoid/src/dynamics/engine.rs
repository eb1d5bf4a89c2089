//! Workspaces of a thread, for all kinds of registers of the machine.

use std::{cell::RefCell, sync::OnceLock};

use super::group::{Group, Pass, Worlds};
use super::steps::Engine;
use super::world::World;
use crate::articulation::Structure;
use crate::collision::CollisionModel;
use crate::lanes::{LANES_MAX, Simd, WithRegisters, with_registers};
use crate::model::Solver;

/// What a workspace depends on: the solver, and the numbers of bodies, degrees of freedom, entries of their paths,
/// coordinates, connections, shapes and links.
type Sizes = (Solver, [usize; 7]);

/// Workspaces for all kinds of registers, widest first.
type Engines = Vec<Box<dyn Engine>>;

thread_local! {
    /// Workspaces of the last model that this thread simulated. They depend on the model's sizes only, so the next model
    /// of the same sizes uses them too.
    static ENGINES: RefCell<Option<(Sizes, Engines)>> = const { RefCell::new(None) };
}

/// Returns how many worlds one pass simulates on this machine.
#[must_use]
pub fn worlds_per_pass() -> usize {
    struct Count;
    impl WithRegisters for Count {
        type Output = usize;
        fn run<S: Simd>(&self, _: S) -> usize {
            S::F32_LANES
        }
    }
    static WIDEST: OnceLock<usize> = OnceLock::new();
    *WIDEST.get_or_init(|| with_registers(&Count)[0])
}

/// Simulates physics steps of all worlds of one model, as many at once as the machine can.
pub(crate) fn advance(pass: Pass<'_>, worlds: &mut dyn Iterator<Item = &mut World>, steps: u32) {
    each_pass(pass, worlds, |engine, chosen| engine.advance(pass, chosen, steps));
}

/// Updates the bodies of a world from its position and velocity.
pub(crate) fn refresh(structure: &Structure, collision: &CollisionModel, world: &mut World) {
    let pass = Pass { structure, collision, step_s: 0.0 };
    each_pass(pass, &mut std::iter::once(world), |engine, chosen| engine.refresh(pass, chosen));
}

fn each_pass(
    Pass { structure, collision, .. }: Pass<'_>,
    worlds: &mut dyn Iterator<Item = &mut World>,
    run: impl Fn(&mut dyn Engine, Worlds<'_, '_>),
) {
    let numbers = [
        structure.nodes.len(),
        structure.dofs(),
        structure.path_entries(),
        structure.coordinates.len(),
        structure.connections.len(),
        collision.shapes.len(),
        structure.link_bodies.len(),
    ];
    let sizes = (structure.solver, numbers);
    let most = worlds_per_pass();
    ENGINES.with_borrow_mut(|slot| {
        let engines = match slot {
            Some((known, engines)) if *known == sizes => engines,
            _ => &mut slot.insert((sizes, with_registers(&Build(structure, collision)))).1,
        };
        loop {
            let mut chosen: [Option<&mut World>; LANES_MAX] = Default::default();
            for place in chosen.iter_mut().take(most) {
                *place = worlds.next();
            }
            let count = chosen.iter().flatten().count();
            // The narrowest registers that suffice take the least time.
            match engines.iter_mut().rev().find(|engine| count <= engine.lanes()) {
                Some(engine) if count > 0 => run(&mut **engine, &mut chosen),
                _ => break,
            }
        }
    });
}

/// Builds a workspace.
pub(super) struct Build<'a>(pub(super) &'a Structure, pub(super) &'a CollisionModel);

impl WithRegisters for Build<'_> {
    type Output = Box<dyn Engine>;

    fn run<S: Simd>(&self, simd: S) -> Box<dyn Engine> {
        Box::new(Group::new(simd, self.0, self.1))
    }
}
