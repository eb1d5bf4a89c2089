//! Plain description of the networks, for programs of a GPU: which part of the flat vector maps which columns to which.

use std::ops::Range;

use crate::{Mlp, Networks, mirror::Parts};

/// Two columns or actions, and the sign of each, 1, −1 or 0.
pub type SignedPair = [(usize, i8); 2];

/// Actor, critic, and how their outputs become actions.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkStructure {
    /// Layers of the actor, from the first.
    pub actor: Vec<NetworkLayer>,
    /// Layers of the critic, from the first.
    pub critic: Vec<NetworkLayer>,
    /// Whether hidden layers exchange halves: `u` and `v` of a row become `elu(u + v + bias)` and `elu(u − v + bias)`, whose
    /// sum and difference the next layer reads.
    pub is_equivariant: bool,
    /// Entry of the flat vector with the `log_std` of each action.
    pub log_std: Vec<usize>,
    /// For each action, the columns of the actor's output that add up to its mean.
    pub joins: Vec<SignedPair>,
    /// For each column of the actor's output, the actions that it is part of: the transpose of the joins.
    pub splits: Vec<SignedPair>,
}

/// Layer of a network.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkLayer {
    /// Columns of a row that it writes.
    pub output: usize,
    /// Parts of its weight.
    pub blocks: Vec<LayerBlock>,
    /// Entries of the flat vector with the bias of its first columns.
    pub bias: Range<usize>,
}

/// Part of a layer's weight.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerBlock {
    /// Columns of a row that it reads.
    pub input: Range<usize>,
    /// Columns of a row that it writes.
    pub output: Range<usize>,
    /// Where its weight, `[output, input]`, begins in the flat vector.
    pub weight: usize,
}

impl Networks {
    /// Returns the description. Networks read rows as [`Mlp::inputs`] writes them.
    pub fn structure(&self) -> NetworkStructure {
        let identity = |columns: usize| -> Vec<_> { (0..columns).map(|column| [(column, 1), (column, 0)]).collect() };
        let actions = self.shape().action;
        let (joins, splits) = match &self.mirror() {
            None => (identity(actions), identity(actions)),
            Some(mirror) => joins_and_splits(&Parts::of(&mirror.action)),
        };
        let (mut log_std, range) = (vec![0; actions], self.log_std_range());
        for entry in range.clone() {
            let mut marked = vec![0.0; self.parameter_count()];
            marked[entry] = 1.0;
            let marks = self.log_std(&marked).into_owned();
            log_std.iter_mut().zip(marks).filter(|(_, mark)| *mark != 0.0).for_each(|(at, _)| *at = entry);
        }
        let is_equivariant = self.mirror().is_some();
        NetworkStructure {
            actor: layers(&self.actor()),
            critic: layers(&self.critic()),
            is_equivariant,
            log_std,
            joins,
            splits,
        }
    }
}

fn layers(network: &Mlp) -> Vec<NetworkLayer> {
    let start = network.range().start;
    let layer = |(index, layer): (usize, &crate::mlp::BlockLayer)| {
        let block = |(number, block): (usize, &crate::mlp::Block)| {
            let first = if index == 0 { network.first_columns()[number] } else { block.input.start };
            let input = first..first + block.input.len();
            LayerBlock { input, output: block.output.clone(), weight: start + block.weight.start }
        };
        NetworkLayer {
            output: layer.output,
            blocks: layer.blocks.iter().enumerate().map(block).collect(),
            bias: start + layer.bias.start..start + layer.bias.end,
        }
    };
    network.layers().iter().enumerate().map(layer).collect()
}

fn joins_and_splits(parts: &Parts) -> (Vec<SignedPair>, Vec<SignedPair>) {
    let all: Vec<_> = parts.even.iter().chain(&parts.odd).collect();
    let mut joins = vec![[(0, 0); 2]; all.len()];
    let mut splits = Vec::new();
    for (column, part) in all.into_iter().enumerate() {
        let mut split = [(part.entry, 0); 2];
        for (slot, (action, sign)) in part.terms().enumerate() {
            // An action is a sum of one even and one odd part at most.
            joins[action][usize::from(column >= parts.even.len())] = (column, sign as i8);
            split[slot] = (action, sign as i8);
        }
        splits.push(split);
    }
    (joins, splits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{NetworkShape, mirror::PolicyMirror};

    #[test]
    fn dense_networks_are_one_block_per_layer() {
        let shape = NetworkShape { observation: 3, action: 2, hidden: vec![4], privileged: 1 };
        let structure = Networks::from(shape).structure();
        let block = |input: usize, output: usize, weight| LayerBlock { input: 0..input, output: 0..output, weight };
        assert_eq!(structure.actor[0], NetworkLayer { output: 4, blocks: vec![block(2, 4, 0)], bias: 8..12 });
        assert_eq!(structure.actor[1], NetworkLayer { output: 2, blocks: vec![block(4, 2, 12)], bias: 20..22 });
        assert_eq!(structure.critic[0], NetworkLayer { output: 4, blocks: vec![block(3, 4, 24)], bias: 36..40 });
        assert_eq!((structure.log_std, structure.joins), (vec![22, 23], vec![[(0, 1), (0, 0)], [(1, 1), (1, 0)]]));
    }

    #[test]
    fn joins_and_splits_are_those_of_the_parts() {
        // Actions 0 and 2 change places and sign, 1 stays, 3 changes its sign.
        let action = vec![(2, -1.0), (1, 1.0), (0, -1.0), (3, -1.0)];
        let mirror = PolicyMirror { observation: vec![(1, 1.0), (0, 1.0), (2, 1.0)], action: action.clone() };
        let shape = NetworkShape { observation: 3, action: 4, hidden: vec![4], privileged: 1 };
        let networks = Networks::new(shape, Some(mirror)).unwrap();
        let structure = networks.structure();
        let (parts, output) = (Parts::of(&action), [1.0, 20.0, 300.0, 4000.0]);
        let (mut row, mut gradient) = ([0.0; 4], [0.0; 4]);
        parts.join(&output, &mut row);
        parts.split(&output, &mut gradient);
        let sum = |terms: &SignedPair| terms.iter().map(|(at, sign)| f32::from(*sign) * output[*at]).sum::<f32>();
        assert_eq!(structure.joins.iter().map(sum).collect::<Vec<_>>(), row);
        assert_eq!(structure.splits.iter().map(sum).collect::<Vec<_>>(), gradient);
        // One log_std for actions 0 and 2.
        let start = networks.log_std_range().start;
        assert_eq!(structure.log_std[0], structure.log_std[2]);
        assert_eq!(structure.log_std.iter().max(), Some(&(start + 2)));
        // The actor sees two of three even or odd entries: one of each kind.
        assert_eq!(structure.actor[0].blocks[0].input, 0..1);
        assert_eq!(structure.actor[0].blocks[1].input, 2..3);
        assert_eq!(structure.critic[0].blocks[0].input, 0..2);
    }
}
