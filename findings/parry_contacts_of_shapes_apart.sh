#!/usr/bin/env bash
# Parry gives contacts to convex shapes that a plane separates.
#
# One would guess: `contact_manifolds` with a prediction of 0 finds nothing, or points with a positive distance, between two convex
# shapes that are apart.
# Seen with parry3d 0.31.1: of random pairs of hulls, and of hulls and cylinders, of 2 to 5 cm that are 0.2 to 5 mm apart, one or two in
# a thousand have contact points with a negative distance, down to -33 mm. That they are apart is shown by support points: all of one
# shape is on one side of a plane, all of the other on the other side.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "probe"
version = "0.1.0"
edition = "2021"

[dependencies]
parry3d = "=0.31.1"
TOML
cat > "$folder/src/main.rs" <<'RUST'
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::query::{closest_points, ClosestPoints, ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher};
use parry3d::shape::SharedShape;

const PAIRS: usize = 200_000;

/// Linear congruential generator (Knuth's MMIX).
struct Random(u64);

impl Random {
    /// Between -1 and 1.
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 23) as f32 - 1.0
    }

    fn vector(&mut self) -> Vector {
        Vector::new(self.unit(), self.unit(), self.unit())
    }

    fn shape(&mut self, kind: &str) -> Option<SharedShape> {
        let mut size = || 0.02 + 0.03 * self.unit().abs();
        let (a, b, c) = (size(), size(), size());
        if kind == "cylinder" {
            return Some(SharedShape::cylinder(a, b));
        }
        let corners: Vec<_> = (0..20).map(|_| self.vector() * Vector::new(a, b, c)).collect();
        SharedShape::convex_hull(&corners)
    }
}

/// Width of the slab between two shapes along the line of their closest points, if it is empty.
fn slab(one: &SharedShape, other: &SharedShape, pose: &Pose) -> Option<f32> {
    let ClosestPoints::WithinMargin(near, far) = closest_points(&Pose::IDENTITY, &**one, pose, &**other, 1.0).ok()? else {
        return None;
    };
    let between = far - near;
    let along = between / between.length();
    let [left, right] = [one, other].map(|shape| shape.as_support_map().expect("convex"));
    let start = left.support_point(&Pose::IDENTITY, along).dot(along);
    let end = right.support_point(pose, -along).dot(along);
    (end > start).then_some(end - start)
}

fn main() {
    let mut surprises = 0;
    for kinds in [["hull", "hull"], ["hull", "cylinder"], ["cylinder", "cylinder"]] {
        let mut random = Random(1);
        let (mut apart, mut touching, mut deepest) = (0, 0, 0.0f32);
        for _ in 0..PAIRS {
            let [Some(one), Some(other)] = kinds.map(|kind| random.shape(kind)) else { continue };
            let turn = random.vector() * 3.0;
            let pose = Pose::from_parts(random.vector() * 0.08, Rotation::from_scaled_axis(turn));
            if !slab(&one, &other, &pose).is_some_and(|width| (2e-4..5e-3).contains(&width)) {
                continue;
            }
            apart += 1;
            let mut manifolds: Vec<ContactManifold<(), ()>> = Vec::new();
            DefaultQueryDispatcher.contact_manifolds(&pose, &*one, &*other, 0.0, &mut manifolds, &mut None).expect("supported");
            let least = manifolds.iter().flat_map(|manifold| &manifold.points).map(|point| point.dist).fold(0.0, f32::min);
            touching += usize::from(least < 0.0);
            deepest = deepest.min(least);
        }
        println!("{} and {}: {apart} pairs apart, {touching} in contact, down to {:.1} mm", kinds[0], kinds[1], deepest * 1e3);
        surprises += touching;
    }
    assert!(surprises > 0, "parry finds no contacts of shapes that are apart any more");
}
RUST
echo "parry3d 0.31.1, $(rustc --version)"
cargo run --quiet --release --manifest-path "$folder/Cargo.toml"
