//! Shape of the networks and offset of each tensor in the flat parameter vector.

use serde::{Deserialize, Serialize};

/// Widths of the separate actor and critic networks, which share their hidden widths.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NetworkShape {
    /// Width of an observation.
    pub observation: usize,
    /// Width of an action.
    pub action: usize,
    /// Widths of the hidden layers of each network, from the first.
    pub hidden: Vec<usize>,
    /// Last entries of an observation, which only the critic sees.
    pub privileged: usize,
}

/// One tensor inside the flat parameter vector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedTensor {
    /// Name, such as `actor.0.weight`.
    pub name: String,
    /// Index of its first number in the flat vector.
    pub offset: usize,
    /// Dimensions, row-major; a weight is `[output, input]`, as in PyTorch.
    pub shape: Vec<usize>,
}

impl NamedTensor {
    /// Returns the number of elements.
    pub fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Returns whether there are no elements.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the range in the flat vector.
    pub fn range(&self) -> std::ops::Range<usize> {
        self.offset..self.offset + self.len()
    }
}

/// One dense layer, `y = W x + b`, in the flat parameter vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dense {
    /// Width of the input.
    pub input: usize,
    /// Width of the output.
    pub output: usize,
    /// Offset of the weight, `[output, input]`; the bias, `[output]`, follows it.
    pub offset: usize,
}

impl Dense {
    /// Returns the range of the weight. Widths of any size are allowed, so that a count of parameters can be checked.
    pub fn weight(&self) -> std::ops::Range<usize> {
        self.offset..self.offset.saturating_add(self.output.saturating_mul(self.input))
    }

    /// Returns the range of the bias.
    pub fn bias(&self) -> std::ops::Range<usize> {
        let start = self.weight().end;
        start..start.saturating_add(self.output)
    }
}

impl NetworkShape {
    /// Returns the layers of the actor, which sees the first [`Self::seen_by_actor`] entries of an observation; the last one
    /// outputs the action means.
    pub fn actor(&self) -> Vec<Dense> {
        self.dense_layers(0, self.seen_by_actor(), self.action)
    }

    /// Returns the number of entries of an observation that the actor sees.
    pub fn seen_by_actor(&self) -> usize {
        self.observation.saturating_sub(self.privileged)
    }

    /// Returns the layers of the critic; the last one outputs the value.
    pub fn critic(&self) -> Vec<Dense> {
        self.dense_layers(self.log_std().end, self.observation, 1)
    }

    /// Returns the range of the logarithms of the standard deviations, `[action]`, between the two networks.
    pub fn log_std(&self) -> std::ops::Range<usize> {
        let start = end_of(&self.actor());
        start..start.saturating_add(self.action)
    }

    /// Returns the length of the flat parameter vector.
    pub fn parameter_count(&self) -> usize {
        end_of(&self.critic())
    }

    /// Returns every tensor in the order of the flat vector: the actor's layers, `log_std`, the critic's layers.
    pub fn tensors(&self) -> Vec<NamedTensor> {
        let log_std = self.log_std();
        let mut tensors = named("actor", &self.actor());
        tensors.push(NamedTensor { name: "log_std".into(), offset: log_std.start, shape: vec![self.action] });
        tensors.extend(named("critic", &self.critic()));
        tensors
    }

    /// Returns the tensors of the actor and `log_std`, in the order of the flat vector.
    pub fn actor_tensors(&self) -> Vec<NamedTensor> {
        let end = self.log_std().end;
        self.tensors().into_iter().filter(|tensor| tensor.offset < end).collect()
    }

    fn dense_layers(&self, start: usize, mut input: usize, last: usize) -> Vec<Dense> {
        let mut offset = start;
        let widths = self.hidden.iter().copied().chain([last]);
        widths
            .map(|output| {
                let layer = Dense { input, output, offset };
                offset = layer.bias().end;
                input = output;
                layer
            })
            .collect()
    }
}

fn end_of(layers: &[Dense]) -> usize {
    layers.last().map_or(0, |layer| layer.bias().end)
}

fn named(network: &str, layers: &[Dense]) -> Vec<NamedTensor> {
    let pair = |(i, layer): (usize, &Dense)| {
        [
            NamedTensor {
                name: format!("{network}.{i}.weight"),
                offset: layer.weight().start,
                shape: vec![layer.output, layer.input],
            },
            NamedTensor { name: format!("{network}.{i}.bias"), offset: layer.bias().start, shape: vec![layer.output] },
        ]
    };
    layers.iter().enumerate().flat_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape() -> NetworkShape {
        NetworkShape { observation: 3, action: 2, hidden: vec![4, 5], privileged: 0 }
    }

    #[test]
    fn the_parameter_count_agrees_with_a_count_by_hand() {
        let actor = 4 * 3 + 4 + 5 * 4 + 5 + 2 * 5 + 2;
        let critic = 4 * 3 + 4 + 5 * 4 + 5 + 5 + 1;
        assert_eq!(shape().parameter_count(), actor + 2 + critic);
        assert_eq!(shape().log_std(), actor..actor + 2);
    }

    #[test]
    fn widths_that_overflow_fit_no_parameters() {
        for width in [usize::MAX, 1 << 63, 1 << 32] {
            let shape = NetworkShape { observation: width, action: width, hidden: vec![width, width], privileged: 0 };
            assert_eq!(shape.parameter_count(), usize::MAX);
        }
    }

    #[test]
    fn the_actor_lacks_weights_for_what_only_the_critic_sees() {
        let shape = NetworkShape { privileged: 1, ..shape() };
        assert_eq!((shape.actor()[0].input, shape.critic()[0].input), (2, 3));
        assert_eq!(shape.parameter_count(), self::shape().parameter_count() - 4);
    }

    #[test]
    fn tensors_follow_each_other_without_gaps_in_the_fixed_order() {
        let tensors = shape().tensors();
        let names: Vec<_> = tensors.iter().map(|t| t.name.as_str()).collect();
        assert_eq!(names[..3], ["actor.0.weight", "actor.0.bias", "actor.1.weight"]);
        assert_eq!(names[6..8], ["log_std", "critic.0.weight"]);
        assert_eq!(names.last(), Some(&"critic.2.bias"));
        assert_eq!(tensors[0].shape, [4, 3]);
        let mut next = 0;
        for tensor in &tensors {
            assert_eq!(tensor.offset, next, "{}", tensor.name);
            next += tensor.len();
        }
        assert_eq!(next, shape().parameter_count());
    }

    #[test]
    fn a_network_without_hidden_layers_is_one_dense_layer() {
        let shape = NetworkShape { observation: 3, action: 2, hidden: vec![], privileged: 0 };
        assert_eq!(shape.actor(), [Dense { input: 3, output: 2, offset: 0 }]);
        assert_eq!(shape.parameter_count(), 8 + 2 + 4);
    }
}
