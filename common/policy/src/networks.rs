//! Actor and critic with the parameters that are learnt: those of dense networks, or of networks that are equivariant to a
//! mirror.
//!
//! Let `P`, `Q` and `R` be the reflections of observations, actions and hidden units; `R` exchanges the two halves of a
//! layer. Equivariant networks satisfy π(P o) = Q π(o) and V(P o) = V(o), because each weight commutes with the reflections:
//! `W = R W P`. Such a weight maps even parts of its input to even parts of its output, and odd ones to odd ones. These two
//! blocks are the parameters, so there are half as many, and a layer costs half of the multiplications: the even and odd
//! parts of a hidden layer are sums and differences of its halves. Biases have even parts only.
//! (Finzi, Welling & Wilson 2021, arXiv:2104.09459, for equivariant layers of any group.)

use std::{borrow::Cow, ops::Range};

use serde::{Deserialize, Serialize};

use crate::{
    Dense, Mlp, NetworkShape,
    mirror::{self, Part, Parts, PolicyMirror, Reflection},
    mlp::{Block, BlockLayer, Reflected},
};

/// Largest distance of dense parameters from those of equivariant networks that counts as rounding, relative to their norm.
const ROUNDING: f64 = 1e-5;

/// Actor and critic. Their parameters are one flat vector: the actor's layers, `log_std`, the critic's layers. A layer is
/// its even block, its odd block, its bias.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Networks {
    shape: NetworkShape,
    mirror: Option<PolicyMirror>,
}

impl From<NetworkShape> for Networks {
    /// Returns dense networks, whose parameters are in [`NetworkShape::tensors`]'s order.
    fn from(shape: NetworkShape) -> Self {
        Self { shape, mirror: None }
    }
}

impl Networks {
    /// Returns networks that are equivariant to a mirror; dense ones without one.
    ///
    /// # Errors
    /// If a hidden width is odd, or the mirror does not fit the shape.
    pub fn new(shape: NetworkShape, mirror: Option<PolicyMirror>) -> Result<Self, String> {
        if let Some(PolicyMirror { observation, action }) = &mirror {
            if let Some(width) = shape.hidden.iter().find(|width| !width.is_multiple_of(2)) {
                return Err(format!(
                    "policy.hidden has a layer of {width} units, and the mirror exchanges two halves of each"
                ));
            }
            mirror::check("observation", observation, shape.observation)?;
            mirror::check("action", action, shape.action)?;
            let seen = shape.seen_by_actor();
            if let Some(entry) = (0..seen).find(|entry| observation[*entry].0 >= seen) {
                return Err(format!(
                    "the mirror image of entry {entry} of an observation is one that only the critic sees"
                ));
            }
        }
        Ok(Self { shape, mirror })
    }

    /// Returns the shape of the dense networks.
    pub fn shape(&self) -> &NetworkShape {
        &self.shape
    }

    /// Returns the mirror that the networks are equivariant to.
    pub fn mirror(&self) -> Option<&PolicyMirror> {
        self.mirror.as_ref()
    }

    /// Returns the actor, which sees the first entries of an observation and outputs the action means.
    pub fn actor(&self) -> Mlp {
        match &self.mirror {
            None => Mlp::new(self.shape.actor()),
            Some(mirror) => Self::equivariant(mirror, 0, &self.sides()[0]),
        }
    }

    /// Returns the critic, which outputs the value.
    pub fn critic(&self) -> Mlp {
        match &self.mirror {
            None => Mlp::new(self.shape.critic()),
            Some(mirror) => Self::equivariant(mirror, self.log_std_range().end, &self.sides()[1]),
        }
    }

    /// Returns the parts of each row of numbers in actor and critic, from input to output; none in dense networks.
    pub(crate) fn sides(&self) -> [Vec<Parts>; 2] {
        let Some(PolicyMirror { observation, action }) = &self.mirror else { return [const { Vec::new() }; 2] };
        let ends = [(&observation[..self.shape.seen_by_actor()], &action[..]), (observation, &[(0, 1.0)])];
        ends.map(|(input, output)| {
            let hidden = self.shape.hidden.iter().map(|width| Parts::of_halves(*width));
            [Parts::of(input)].into_iter().chain(hidden).chain([Parts::of(output)]).collect()
        })
    }

    /// Returns the network with these sides, whose parameters begin at `start`.
    fn equivariant(mirror: &PolicyMirror, start: usize, sides: &[Parts]) -> Mlp {
        let observation = Parts::of(&mirror.observation);
        let mut end = 0;
        let mut take = |count: usize| {
            end += count;
            end - count..end
        };
        let layer = |pair: &[Parts]| {
            let (from, to) = (&pair[0], &pair[1]);
            let even = Block { input: 0..from.even.len(), output: 0..to.even.len(), weight: 0..0 };
            let odd = Block { input: from.even.len()..from.width(), output: to.even.len()..to.width(), weight: 0..0 };
            let blocks = [even, odd].map(|block| {
                let weight = take(block.input.len() * block.output.len());
                Block { weight, ..block }
            });
            BlockLayer { input: from.width(), output: to.width(), blocks: blocks.into(), bias: take(to.even.len()) }
        };
        let layers: Vec<BlockLayer> = sides.windows(2).map(layer).collect();
        let output = sides[sides.len() - 1].clone();
        let seen = [0, observation.even.len()];
        Mlp::equivariant(start..start + end, layers, Reflected { observation, seen, output })
    }

    /// Returns the range of the logarithms of standard deviations: one per action, or one per action and its mirror image.
    pub fn log_std_range(&self) -> Range<usize> {
        match &self.mirror {
            None => self.shape.log_std(),
            Some(mirror) => {
                let start = self.actor().range().end;
                start..start + orbits(&mirror.action).len()
            }
        }
    }

    /// Returns the length of the flat vector.
    pub fn parameter_count(&self) -> usize {
        match &self.mirror {
            None => self.shape.parameter_count(),
            Some(_) => self.critic().range().end,
        }
    }

    /// Returns the logarithm of the standard deviation of each action, `[action]`.
    pub fn log_std<'a>(&self, parameters: &'a [f32]) -> Cow<'a, [f32]> {
        let learnt = &parameters[self.log_std_range()];
        let Some(mirror) = &self.mirror else { return Cow::Borrowed(learnt) };
        let mut log_std = vec![0.0; self.shape.action];
        for (part, number) in orbits(&mirror.action).into_iter().zip(learnt) {
            log_std[part.entry] = *number;
            log_std[part.image] = *number;
        }
        Cow::Owned(log_std)
    }

    /// Returns the gradient by the learnt `log_std` from that of each action.
    pub fn fold_log_std(&self, gradient: &[f64]) -> Vec<f32> {
        let narrow = |number: f64| number as f32;
        let Some(mirror) = &self.mirror else { return gradient.iter().copied().map(narrow).collect() };
        let sum = |part: Part| gradient[part.entry] + if part.is_pair() { gradient[part.image] } else { 0.0 };
        orbits(&mirror.action).into_iter().map(|part| narrow(sum(part))).collect()
    }

    /// Returns the parameters of the equal dense networks, in [`NetworkShape::tensors`]'s order.
    pub fn dense<'a>(&self, parameters: &'a [f32]) -> Cow<'a, [f32]> {
        if self.mirror.is_none() {
            return Cow::Borrowed(parameters);
        }
        let mut dense = vec![0.0; self.shape.parameter_count()];
        self.each_term(|learnt, at, coefficient, _| dense[at] += coefficient * parameters[learnt]);
        dense[self.shape.log_std()].copy_from_slice(&self.log_std(parameters));
        Cow::Owned(dense)
    }

    /// Returns the gradient by the learnt parameters from that by the parameters of the dense networks.
    pub fn fold(&self, dense: &[f32]) -> Vec<f32> {
        if self.mirror.is_none() {
            return dense.to_vec();
        }
        let mut gradient = vec![0.0; self.parameter_count()];
        self.each_term(|learnt, at, coefficient, _| gradient[learnt] += coefficient * dense[at]);
        let log_std: Vec<f64> = dense[self.shape.log_std()].iter().copied().map(f64::from).collect();
        gradient[self.log_std_range()].copy_from_slice(&self.fold_log_std(&log_std));
        gradient
    }

    /// Returns the learnt parameters of dense ones.
    ///
    /// # Errors
    /// The distance of the dense networks from equivariant ones, relative to their norm, if they are not equivariant.
    pub fn learnt(&self, dense: Vec<f32>) -> Result<Vec<f32>, f64> {
        let Some(mirror) = &self.mirror else { return Ok(dense) };
        let mut learnt = vec![0.0; self.parameter_count()];
        self.each_term(|to, at, coefficient, terms| learnt[to] += coefficient * dense[at] / terms);
        let log_std = self.log_std_range().zip(orbits(&mirror.action));
        log_std.for_each(|(to, part)| learnt[to] = dense[self.shape.log_std()][part.entry]);
        let square = |number: f32| f64::from(number) * f64::from(number);
        let apart = self.dense(&learnt).iter().zip(&dense).map(|(near, number)| square(near - number)).sum::<f64>();
        let distance = (apart / dense.iter().copied().map(square).sum::<f64>().max(f64::MIN_POSITIVE)).sqrt();
        if distance < ROUNDING { Ok(learnt) } else { Err(distance) }
    }

    /// Calls `each` for each weight and bias of the dense networks that a learnt parameter is part of: with the index of the
    /// learnt parameter, that of the dense one, the coefficient, and the number of dense ones that it is part of.
    fn each_term(&self, mut each: impl FnMut(usize, usize, f32, f32)) {
        let [actor_sides, critic_sides] = self.sides();
        let actor = (self.actor(), self.shape.actor(), actor_sides);
        let critic = (self.critic(), self.shape.critic(), critic_sides);
        for (mlp, dense, sides) in [actor, critic] {
            let start = mlp.range().start;
            for ((layer, dense), pair) in mlp.layers().iter().zip(&dense).zip(sides.windows(2)) {
                let blocks = [(&pair[0].even, &pair[1].even), (&pair[0].odd, &pair[1].odd)];
                for (block, (from, to)) in layer.blocks.iter().zip(blocks) {
                    for_each_pair(to, from, start + block.weight.start, dense, &mut each);
                }
                for (index, part) in pair[1].even.iter().enumerate() {
                    let count = part.terms().count() as f32;
                    part.terms().for_each(|(at, sign)| {
                        each(start + layer.bias.start + index, dense.bias().start + at, sign, count)
                    });
                }
            }
        }
    }
}

/// Calls `each` for each weight of a block that begins at the learnt parameter `index`.
fn for_each_pair(
    to: &[Part],
    from: &[Part],
    mut index: usize,
    dense: &Dense,
    each: &mut impl FnMut(usize, usize, f32, f32),
) {
    for output in to {
        for input in from {
            let count = (output.terms().count() * input.terms().count()) as f32;
            for (row, row_sign) in output.terms() {
                let row = dense.weight().start + row * dense.input;
                input.terms().for_each(|(column, sign)| each(index, row + column, row_sign * sign, count));
            }
            index += 1;
        }
    }
}

/// Returns one part for each action and its mirror image.
fn orbits(action: &Reflection) -> Vec<Part> {
    let Parts { even, odd } = Parts::of(action);
    even.into_iter().chain(odd.into_iter().filter(|part| !part.is_pair())).collect()
}

#[cfg(test)]
#[path = "networks_tests.rs"]
mod tests;
