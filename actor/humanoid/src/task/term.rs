//! Table of an observation: one row for each term, with all that is known of it.

use crate::config::EnvironmentConfig;
use crate::model::mirror::SignedPermutation;
use crate::observation::ObservationTerm;
use crate::randomisation::SensorNoise;

/// Sign of a number in the mirror.
pub(super) const SCALAR: &[f32] = &[1.0];
/// Signs of a vector, which keeps them along x and z.
pub(super) const VECTOR: &[f32] = &[1.0, -1.0, 1.0];
/// Signs of an angular velocity, a pseudo-vector, which keeps them along y.
pub(super) const AXIAL: &[f32] = &[-1.0, 1.0, -1.0];

/// Task that shows its observation by a table of terms.
pub trait Shown: 'static {
    /// What there is to see at one moment.
    type View<'a>;
}

/// Parts of which each has equally many entries of a term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TermPart {
    /// The robot as a whole.
    Whole,
    /// Joints of the action.
    Joint,
    Foot,
    /// Points of the height scan.
    ScanPoint,
    /// Compared links.
    Link,
    /// Ends of limbs.
    End,
}

/// Passes the entries of a term to the last argument, in order.
type Write<S> = for<'a> fn(&<S as Shown>::View<'a>, &mut SensorNoise, &mut dyn FnMut(f64));

/// Term of the observation of a task.
pub struct TermRow<S: Shown> {
    /// Name, as in the tables of the simulator that the task is taken from, and in `deploy.yaml`.
    pub name: &'static str,
    /// Name in the metadata of mjlab's ONNX files.
    pub mjlab_name: &'static str,
    /// Unit of its entries.
    pub unit: &'static str,
    /// Frame of its entries.
    pub frame: &'static str,
    /// Returns its parameters in `deploy.yaml`.
    pub deploy_params: fn(&EnvironmentConfig) -> String,
    /// Whether only the critic sees it.
    is_privileged: bool,
    part: TermPart,
    /// Signs in the mirror of the entries of a part.
    signs: &'static [f32],
    /// How often its entries follow each other: 0 leaves the term out.
    times: fn(&EnvironmentConfig) -> usize,
    write: Write<S>,
}

impl<S: Shown> TermRow<S> {
    /// Returns a term of the whole robot that the policy observes, with the signs of its entries in the mirror.
    pub(super) const fn new(
        name: &'static str,
        unit: &'static str,
        frame: &'static str,
        signs: &'static [f32],
        write: Write<S>,
    ) -> Self {
        Self {
            name,
            mjlab_name: name,
            unit,
            frame,
            deploy_params: |_| "{}".to_owned(),
            is_privileged: false,
            part: TermPart::Whole,
            signs,
            times: |_| 1,
            write,
        }
    }

    /// Gives each of these parts such entries.
    pub(super) const fn of_each(self, part: TermPart) -> Self {
        Self { part, ..self }
    }

    /// Shows the term to the critic only.
    pub(super) const fn privileged(self) -> Self {
        Self { is_privileged: true, ..self }
    }

    /// Repeats the entries of all parts so often, or leaves the term out.
    pub(super) const fn repeated(self, times: fn(&EnvironmentConfig) -> usize) -> Self {
        Self { times, ..self }
    }

    /// Names the term as mjlab does.
    pub(super) const fn with_mjlab_name(self, mjlab_name: &'static str) -> Self {
        Self { mjlab_name, ..self }
    }

    /// Gives the term parameters in `deploy.yaml`.
    pub(super) const fn with_deploy_params(self, deploy_params: fn(&EnvironmentConfig) -> String) -> Self {
        Self { deploy_params, ..self }
    }
}

/// Terms that a configuration selects: those of the policy, once for each frame of the history, then those of the critic
/// alone.
pub(super) struct Layout<S: Shown> {
    rows: Vec<&'static TermRow<S>>,
    /// The rows with their places.
    pub(super) terms: Vec<ObservationTerm>,
    history: usize,
}

impl<S: Shown> Layout<S> {
    /// Returns the layout of a table, for these numbers of parts.
    pub(super) fn new(
        table: &'static [TermRow<S>],
        config: &EnvironmentConfig,
        history: usize,
        parts: impl Fn(TermPart) -> usize,
    ) -> Self {
        let observed = |is_privileged: bool| {
            table.iter().filter(move |row| row.is_privileged == is_privileged && (row.times)(config) > 0)
        };
        let rows: Vec<_> = (0..history).flat_map(|_| observed(false)).chain(observed(true)).collect();
        let mut end = 0;
        let place = |row: &&TermRow<S>| {
            let start = end;
            end += (row.times)(config) * parts(row.part) * row.signs.len();
            ObservationTerm { name: row.name.to_owned(), range: start..end, is_privileged: row.is_privileged }
        };
        Self { terms: rows.iter().map(place).collect(), rows, history }
    }

    /// Returns the number of entries that the policy observes.
    pub(super) fn of_policy(&self) -> usize {
        self.terms.iter().filter(|term| !term.is_privileged).map(|term| term.range.len()).sum()
    }

    /// Returns the mirror image of an observation, for these images of the parts; `None` if those of a term have none.
    pub(super) fn mirrored(&self, images: impl Fn(TermPart) -> Option<SignedPermutation>) -> Option<SignedPermutation> {
        let mut mirrored = SignedPermutation::new();
        for (row, term) in self.rows.iter().zip(&self.terms) {
            let (images, width) = (images(row.part)?, row.signs.len());
            let all = images.len() * width;
            for start in term.range.clone().step_by(all.max(1)) {
                for (image, sign) in &images {
                    let entries = row.signs.iter().enumerate();
                    mirrored.extend(entries.map(|(at, own)| (start + image * width + at, sign * own)));
                }
            }
        }
        Some(mirrored)
    }

    /// Writes what the policy observes now, or what only the critic observes. Does not allocate.
    pub(super) fn write(&self, view: &S::View<'_>, is_privileged: bool, noise: &mut SensorNoise, frame: &mut [f32]) {
        let mut numbers = frame.iter_mut();
        let mut write = |number: f64| *numbers.next().expect("the terms fill the frame") = number as f32;
        for row in self.frame(is_privileged) {
            (row.write)(view, noise, &mut write);
        }
    }

    /// Returns the rows of one frame of the policy, or of the critic alone.
    fn frame(&self, is_privileged: bool) -> &[&'static TermRow<S>] {
        let of_policy = self.rows.iter().filter(|row| !row.is_privileged).count();
        if is_privileged { &self.rows[of_policy..] } else { &self.rows[..of_policy / self.history] }
    }
}

/// Returns the images of parts that keep their signs.
pub(super) fn unsigned(images: impl IntoIterator<Item = usize>) -> SignedPermutation {
    images.into_iter().map(|image| (image, 1.0)).collect()
}
