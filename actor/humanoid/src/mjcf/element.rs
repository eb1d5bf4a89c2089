//! Elements of a model text: attributes with defaults filled in, and the values that they must have.

use std::str::FromStr;

use roxmltree::Node;

use crate::error::ModelError;
use crate::model::{SolverNumbers, not_negative};

/// Name and value of an attribute.
pub(super) type Attribute = (String, String);

/// Element of a model text. [`super::vocabulary`] has checked the attributes of those in a tree.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) tag: String,
    /// Name, or a description for messages.
    pub(super) label: String,
    pub(super) attributes: Vec<Attribute>,
}

impl Element {
    /// Returns an element without defaults.
    pub(super) fn of(node: Node<'_, '_>, label: impl Into<String>) -> Self {
        let attributes = node.attributes().map(|attribute| (attribute.name().to_owned(), attribute.value().to_owned()));
        Self { tag: node.tag_name().name().to_owned(), label: label.into(), attributes: attributes.collect() }
    }

    /// Returns the value of an attribute.
    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(found, _)| found == name).map(|(_, value)| value.as_str())
    }

    /// Returns the text of an attribute, or "" without it.
    pub(super) fn text(&self, attribute: &str) -> String {
        self.get(attribute).unwrap_or_default().to_owned()
    }

    /// Returns the numbers of an attribute.
    pub(super) fn list(&self, name: &str) -> Option<Vec<f64>> {
        self.get(name).and_then(numbers)
    }

    /// Returns a list whose first entries are those of the attribute, and whose other ones are the defaults.
    pub(super) fn list_over<const N: usize>(&self, name: &str, mut defaults: [f64; N]) -> [f64; N] {
        for (entry, number) in defaults.iter_mut().zip(self.list(name).unwrap_or_default()) {
            *entry = number;
        }
        defaults
    }

    /// Returns the first number of an attribute.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        self.list(name)?.first().copied()
    }

    /// Returns a number that must be finite and not negative; 0 without the attribute.
    pub(super) fn amount(&self, name: &str, what: &'static str) -> Result<f64, ModelError> {
        not_negative(&self.label, what, self.number(name).unwrap_or(0.0))
    }

    /// Returns a whole number.
    pub(super) fn whole<T: FromStr>(&self, name: &str, default: T) -> Result<T, ModelError> {
        let Some(text) = self.get(name) else { return Ok(default) };
        text.trim().parse().map_err(|_| self.wrong(name, "a whole number that is not negative"))
    }

    /// Returns a keyword's meaning: whether the attribute is true.
    pub(super) fn is_true(&self, name: &str, default: bool) -> bool {
        self.get(name).map_or(default, |value| matches!(value, "true" | "1"))
    }

    /// Returns a range if its flag, or its presence, limits the element.
    pub(super) fn range(&self, name: &str, flag: &str, autolimits: bool) -> Result<Option<[f64; 2]>, ModelError> {
        let is_limited = self.is_true(flag, false);
        if matches!(self.get(flag), Some("false" | "0")) {
            return Ok(None);
        }
        match self.list(name).as_deref() {
            None if is_limited => Err(self.refused(format!("it is limited, but has no `{name}`"))),
            None => Ok(None),
            // As in MuJoCo, this switches off a range of the class.
            Some([0.0, 0.0]) if !is_limited => Ok(None),
            Some(_) if !is_limited && !autolimits => {
                Err(self.refused(format!("without autolimits `{name}` needs `{flag}`")))
            }
            Some([low, high]) if low < high => Ok(Some([*low, *high])),
            Some(_) => Err(self.wrong(name, "a lower and an upper limit")),
        }
    }

    /// Returns the softness in the attributes of the given names, those of `solref` and `solimp`.
    pub(super) fn softness(&self, names: [&str; 2]) -> Result<SolverNumbers, ModelError> {
        let default = SolverNumbers::default();
        let solver = SolverNumbers {
            solref: self.list_over(names[0], default.solref),
            solimp: self.list_over(names[1], default.solimp),
        };
        match solver.is_consistent() {
            true => Ok(solver),
            false => {
                let [first, second] = solver.solref;
                let expected = "two numbers above 0 (time constant in s, damping ratio), or two that are not \
                                (−stiffness, −damping), up to 1e12";
                Err(ModelError::attribute(&self.label, names[0], &format!("{first} {second}"), expected))
            }
        }
    }

    /// Returns the error that the element is not supported.
    pub(super) fn refused(&self, problem: impl Into<String>) -> ModelError {
        ModelError::unsupported(&self.label, problem)
    }

    /// Returns the error that an attribute must have another value.
    pub(super) fn wrong(&self, attribute: &str, expected: impl Into<String>) -> ModelError {
        ModelError::attribute(&self.label, attribute, self.get(attribute).unwrap_or_default(), expected)
    }
}

/// Returns the numbers of a list; `None` if an entry is not a finite number.
pub(super) fn numbers(value: &str) -> Option<Vec<f64>> {
    value.split_whitespace().map(|token| token.parse::<f64>().ok().filter(|number| number.is_finite())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn softness(solref: &str) -> Result<SolverNumbers, ModelError> {
        let attributes = vec![("solref".to_owned(), solref.to_owned())];
        Element { tag: String::new(), label: "part".to_owned(), attributes }.softness(["solref", "solimp"])
    }

    #[test]
    fn mixed_formats_of_softness_are_refused_by_name() {
        for wrong in ["-100", "0.02 -1", "0 1", "0.02 0", "1e13 1"] {
            let message = softness(wrong).expect_err(wrong).to_string();
            assert!(message.contains("`solref`") && message.contains("time constant"), "{message}");
        }
        assert!(softness("-500 -20").is_ok() && softness("0 0").is_ok());
    }
}
