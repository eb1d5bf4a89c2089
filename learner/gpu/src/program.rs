//! Launches of a gradient step, and of the measure of its divergence.

use treadmill_policy::{NetworkLayer, NetworkStructure};

use crate::layout::{LayerRows, MemoryLayout, SUMMERS, SUMS, TILE, slices};

/// A kernel's name in `kernels.cu`.
pub(crate) type Kernel = &'static str;

/// All kernels.
pub(crate) const KERNELS: [Kernel; 13] = [
    "gather",
    "transpose",
    "product",
    "activate",
    "activate_backward",
    "loss",
    "column_sums",
    "sum_slices",
    "sum_terms",
    "sum_sums",
    "prepare_step",
    "adam",
    "divergence",
];

/// Tiles of a product per block of threads.
const TILES_PER_BLOCK: usize = 2;
/// Threads of a block, and of one whose threads do much each.
const BLOCK: usize = 128;
const SMALL_BLOCK: usize = 32;

/// One launch of a kernel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Launch {
    pub(crate) kernel: Kernel,
    /// Blocks in x, y and z.
    pub(crate) grid: [usize; 3],
    /// Threads of a block.
    pub(crate) block: usize,
    /// Where its fields begin in the array of integers.
    pub(crate) at: usize,
}

/// Launches in their order, and their fields.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    /// Where the fields begin in the array of integers.
    pub(crate) begin: usize,
    pub(crate) launches: Vec<Launch>,
    pub(crate) fields: Vec<usize>,
}

/// What programs are made for.
pub(crate) struct StepPlan<'a> {
    pub(crate) structure: &'a NetworkStructure,
    pub(crate) layout: &'a MemoryLayout,
    /// Width of an observation.
    pub(crate) observation: usize,
    /// Length of the flat parameter vector.
    pub(crate) parameters: usize,
}

/// Product of a plan's matrices, see `product` in `kernels.cu`.
struct Product {
    slices: usize,
    /// Offset, stride by row, and by inner index.
    a: [usize; 3],
    /// Offset, and stride by inner index.
    b: [usize; 2],
    /// Offset, stride by row, and by slice.
    c: [usize; 3],
    rows: usize,
    columns: usize,
    inner: usize,
    slice: usize,
}

impl Program {
    /// Adds a launch with so many threads in x, of which `block` are together, and blocks in y and z.
    fn add(&mut self, kernel: Kernel, [x, y, z]: [usize; 3], block: usize, fields: impl IntoIterator<Item = usize>) {
        let at = self.begin + self.fields.len();
        self.fields.extend(fields);
        self.launches.push(Launch { kernel, grid: [x.div_ceil(block).max(1), y, z], block, at });
    }

    fn products(&mut self, products: &[Product]) {
        let tiles = |product: &Product| product.rows.div_ceil(TILE[0]) * product.columns.div_ceil(TILE[1]);
        let tiles = products.iter().map(tiles).max().unwrap_or(0);
        let fields = products.iter().flat_map(|p| {
            let ([a, a_row, a_inner], [b, b_inner], [c, c_row, c_slice]) = (p.a, p.b, p.c);
            [p.slices, a, a_row, a_inner, b, b_inner, c, c_row, p.rows, p.columns, p.inner, p.slice, c_slice]
        });
        let slices = products.iter().map(|product| product.slices).sum();
        self.add("product", [32 * tiles, 1, slices], 32 * TILES_PER_BLOCK, fields);
    }
}

/// A network whose layers are computed, with their rows.
#[derive(Clone, Copy)]
struct Network<'a> {
    layers: &'a [NetworkLayer],
    rows: &'a [LayerRows],
}

impl<'a> Network<'a> {
    /// Returns where the input of a layer begins, and its columns.
    fn input(&self, index: usize, plan: &StepPlan) -> (usize, usize) {
        match index {
            0 => (plan.layout.gathered, plan.observation),
            _ => (self.rows[index - 1].rows, self.layers[index - 1].output),
        }
    }
}

impl StepPlan<'_> {
    /// Returns the launches of a gradient step on so many rows.
    pub(crate) fn step(&self, rows: usize, begin: usize) -> Program {
        let (layout, structure) = (self.layout, self.structure);
        let actions = structure.log_std.len();
        let networks = self.networks();
        let mut program = Program { begin, ..Program::default() };
        self.forward(&mut program, &networks, rows, layout.order, true);
        let (actor, critic) = (last(&networks[0]), last(&networks[1]));
        let state = layout.state.start;
        let fields = [
            vec![rows, actions, layout.order, layout.actions, layout.log_probs, layout.advantages, layout.returns],
            vec![state, layout.log_std, actor.1.rows, state + actor.0.bias.start, actor.0.bias.len()],
            vec![layout.joins, layout.splits, layout.means, layout.by_means, actor.1.gradient, layout.by_log_std],
            vec![critic.1.rows, state + critic.0.bias.start, critic.1.gradient, layout.terms],
        ];
        let fields = fields.concat();
        program.add("loss", [rows, 1, 1], SMALL_BLOCK, fields);
        self.backward(&mut program, &networks, rows);

        let log_std = structure.log_std.iter().copied();
        let first = log_std.clone().min().unwrap_or(0);
        let entries = log_std.max().map_or(0, |last| last + 1 - first);
        let parameters = self.parameters;
        let sums =
            [slices(rows).1, parameters, actions, layout.slices, layout.gradient, first, entries, layout.log_std];
        program.add("sum_slices", [parameters, 1, 1], BLOCK, sums);
        let terms = [layout.gradient, parameters, layout.terms, rows, layout.sums];
        program.add("sum_terms", [SUMMERS, 1, 1], SMALL_BLOCK, terms);
        program.add("sum_sums", [SUMS * 32, 1, 1], SMALL_BLOCK, [layout.sums, layout.folded]);
        program.add("prepare_step", [1, 1, 1], SMALL_BLOCK, [layout.folded, rows, actions, state, layout.log_std]);
        program.add("adam", [parameters, 1, 1], BLOCK, [state, parameters, layout.gradient, first, entries]);
        program
    }

    /// Returns the launches that measure the divergence on so many rows.
    pub(crate) fn divergence(&self, rows: usize, begin: usize) -> Program {
        let (layout, actions) = (self.layout, self.structure.log_std.len());
        let networks = &self.networks()[..1];
        let mut program = Program { begin, ..Program::default() };
        self.forward(&mut program, networks, rows, layout.measured, false);
        let ((layer, outputs), state) = (last(&networks[0]), layout.state.start);
        let output = [rows, actions, outputs.rows, state + layer.bias.start, layer.bias.len(), layout.joins];
        let old = [layout.old_means, state, layout.log_std, layout.old_log_std, layout.divergences];
        program.add("divergence", [rows, 1, 1], SMALL_BLOCK, output.into_iter().chain(old));
        program
    }

    fn networks(&self) -> [Network<'_>; 2] {
        let Self { structure, layout, .. } = self;
        let actor = Network { layers: &structure.actor, rows: &layout.actor };
        [actor, Network { layers: &structure.critic, rows: &layout.critic }]
    }

    /// Units of a hidden layer that a thread does, and half of its width or 0.
    fn units(&self, layer: &NetworkLayer) -> [usize; 2] {
        if self.structure.is_equivariant { [layer.output / 2; 2] } else { [layer.output, 0] }
    }

    /// Adds the launches from the rows of a batch to the outputs of networks, without the last bias. All networks have
    /// the same number of layers.
    fn forward(&self, program: &mut Program, networks: &[Network], rows: usize, index: usize, by_start: bool) {
        let (layout, width) = (self.layout, self.observation);
        let gather = [rows, width, index, usize::from(by_start), layout.inputs, layout.gathered];
        program.add("gather", [rows * width, 1, 1], BLOCK, gather);
        let blocks = || networks.iter().flat_map(|network| network.layers).flat_map(|layer| &layer.blocks);
        let size = |block: &treadmill_policy::LayerBlock| block.input.len() * block.output.len();
        let matrices = blocks().flat_map(|block| {
            let (from, to) = (layout.state.start + block.weight, layout.transposed + block.weight);
            [from, to, block.output.len(), block.input.len()]
        });
        let largest = blocks().map(size).max().unwrap_or(0);
        program.add("transpose", [largest, blocks().count(), 1], BLOCK, matrices);

        let count = networks[0].layers.len();
        for index in 0..count {
            let mut products = Vec::new();
            for network in networks {
                let ((source, stride), layer) = (network.input(index, self), &network.layers[index]);
                let target = network.rows[index].rows;
                products.extend(layer.blocks.iter().filter(|block| !block.output.is_empty()).map(|block| Product {
                    slices: 1,
                    a: [source + block.input.start, stride, 1],
                    b: [layout.transposed + block.weight, block.output.len()],
                    c: [target + block.output.start, layer.output, 0],
                    rows,
                    columns: block.output.len(),
                    inner: block.input.len(),
                    slice: block.input.len(),
                }));
            }
            program.products(&products);
            if index + 1 < count {
                let jobs = networks.iter().flat_map(|network| {
                    let (layer, target) = (&network.layers[index], network.rows[index].rows);
                    let [units, half] = self.units(layer);
                    [rows, units, layer.output, half, target, layout.state.start + layer.bias.start]
                });
                program.add("activate", [self.largest_rows(networks, index, rows), networks.len(), 1], BLOCK, jobs);
            }
        }
    }

    /// Threads of the larger of the networks' layers with this index.
    fn largest_rows(&self, networks: &[Network], index: usize, rows: usize) -> usize {
        networks.iter().map(|network| rows * self.units(&network.layers[index])[0]).max().unwrap_or(0)
    }

    /// Adds the launches from the gradient by the outputs to partial gradients of all parameters.
    fn backward(&self, program: &mut Program, networks: &[Network], rows: usize) {
        let layout = self.layout;
        for index in (1..networks[0].layers.len()).rev() {
            let mut products = Vec::new();
            for network in networks {
                let (layer, above, below) = (&network.layers[index], network.rows[index], network.rows[index - 1]);
                let width = network.layers[index - 1].output;
                products.extend(layer.blocks.iter().filter(|block| !block.input.is_empty()).map(|block| Product {
                    slices: 1,
                    a: [above.gradient + block.output.start, layer.output, 1],
                    b: [layout.state.start + block.weight, block.input.len()],
                    c: [below.gradient + block.input.start, width, 0],
                    rows,
                    columns: block.input.len(),
                    inner: block.output.len(),
                    slice: block.output.len(),
                }));
            }
            program.products(&products);
            let jobs = networks.iter().flat_map(|network| {
                let (layer, numbers) = (&network.layers[index - 1], network.rows[index - 1]);
                let [units, half] = self.units(layer);
                [rows, units, layer.output, half, numbers.gradient, numbers.rows]
            });
            let threads = [self.largest_rows(networks, index - 1, rows), networks.len(), 1];
            program.add("activate_backward", threads, BLOCK, jobs);
        }

        let (slice, count) = slices(rows);
        let actions = self.structure.log_std.len();
        let stride = self.parameters + actions;
        let (mut products, mut sums) =
            (Vec::new(), vec![[actions, actions, layout.by_log_std, layout.slices + self.parameters]]);
        for network in networks {
            for (index, layer) in network.layers.iter().enumerate() {
                let ((source, columns), above) = (network.input(index, self), network.rows[index].gradient);
                let used = layer.blocks.iter().filter(|block| !block.output.is_empty() && !block.input.is_empty());
                products.extend(used.map(|block| Product {
                    slices: count,
                    a: [above + block.output.start, 1, layer.output],
                    b: [source + block.input.start, columns],
                    c: [layout.slices + block.weight, block.input.len(), stride],
                    rows: block.output.len(),
                    columns: block.input.len(),
                    inner: rows,
                    slice,
                }));
                sums.push([layer.output, layer.bias.len(), above, layout.slices + layer.bias.start]);
            }
        }
        program.products(&products);
        let widest = sums.iter().map(|sum| sum[1]).max().unwrap_or(0);
        let jobs = sums
            .iter()
            .flat_map(|[width, columns, source, target]| [rows, *width, *columns, slice, *source, *target, stride]);
        program.add("column_sums", [widest, count, sums.len()], SMALL_BLOCK, jobs);
    }
}

fn last<'a>(network: &Network<'a>) -> (&'a NetworkLayer, &'a LayerRows) {
    (network.layers.last().expect("a network has layers"), network.rows.last().expect("a network has layers"))
}
