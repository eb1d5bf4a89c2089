//! One workspace per thread, for the widest registers of the machine.

use std::cell::RefCell;

use pulp::{Arch, Simd, WithSimd};

use super::group::{Group, Pass, Worlds};
use super::steps::Engine;
use super::world::World;
use crate::articulation::Structure;
use crate::collision::CollisionModel;
use crate::lanes::LANES_MAX;
use crate::model::Solver;

/// What a workspace depends on: the solver, and the numbers of bodies, degrees of freedom, entries of their paths,
/// coordinates, shapes and links.
type Sizes = (Solver, [usize; 6]);

thread_local! {
    /// Workspace of the last model that this thread simulated. It depends on the model's sizes only, so the next model
    /// of the same sizes uses it too.
    static ENGINE: RefCell<Option<(Sizes, Box<dyn Engine>)>> = const { RefCell::new(None) };
}

/// Returns how many worlds one pass simulates on this machine.
#[must_use]
pub fn worlds_per_pass() -> usize {
    struct Count;
    impl WithSimd for Count {
        type Output = usize;
        fn with_simd<S: Simd>(self, _: S) -> usize {
            S::F32_LANES
        }
    }
    Arch::new().dispatch(Count)
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
        collision.shapes.len(),
        structure.link_bodies.len(),
    ];
    let sizes = (structure.solver, numbers);
    let count = worlds_per_pass();
    ENGINE.with_borrow_mut(|slot| {
        let engine = match slot {
            Some((known, engine)) if *known == sizes => engine,
            _ => &mut slot.insert((sizes, Arch::new().dispatch(Build(structure, collision)))).1,
        };
        loop {
            let mut chosen: [Option<&mut World>; LANES_MAX] = Default::default();
            for place in chosen.iter_mut().take(count) {
                *place = worlds.next();
            }
            if chosen[0].is_none() {
                break;
            }
            run(&mut **engine, &mut chosen);
        }
    });
}

/// Builds a workspace for the registers that are given.
struct Build<'a>(&'a Structure, &'a CollisionModel);

impl WithSimd for Build<'_> {
    type Output = Box<dyn Engine>;

    fn with_simd<S: Simd>(self, simd: S) -> Box<dyn Engine> {
        Box::new(Group::new(simd, self.0, self.1))
    }
}
