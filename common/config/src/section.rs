//! Macro that declares a section: documentation, type, default and allowed values of each key in one place.
//!
//! It generates the struct, its `Default`, the key table for error messages and documentation, and the check of every value.

use super::ConfigError;

/// Description of a configuration key.
#[derive(Clone, Debug)]
pub struct KeyDoc {
    /// Dotted name, as in `--set`.
    pub key: String,
    /// One line of documentation.
    pub doc: &'static str,
    /// Rust name of the value's type.
    pub kind: &'static str,
    /// Default in TOML notation.
    pub default: String,
    /// Allowed values.
    pub allowed: &'static str,
}

/// Description of a section.
#[derive(Clone, Debug)]
pub struct SectionDoc {
    /// Name of the TOML table.
    pub name: &'static str,
    /// Subject of the section.
    pub about: &'static str,
    /// Keys, in order of declaration.
    pub keys: Vec<KeyDoc>,
}

/// Section of the configuration.
pub trait Section: Default {
    /// Name of the TOML table.
    const NAME: &'static str;
    /// Subject of the section.
    const ABOUT: &'static str;
    /// Returns the keys of this section.
    fn keys() -> Vec<KeyDoc>;
    /// Returns the description of this section.
    fn describe() -> SectionDoc {
        SectionDoc { name: Self::NAME, about: Self::ABOUT, keys: Self::keys() }
    }
    /// Checks each value by itself.
    ///
    /// # Errors
    /// [`ConfigError::Value`] for the first value out of range.
    fn check(&self) -> Result<(), ConfigError>;
}

/// Declares a section: `/// doc` `key: type = default, "allowed values" => check;`.
macro_rules! section {
    (
        #[doc = $about:literal]
        $name:ident as $table:literal {
            $( #[doc = $doc:literal] $field:ident : $kind:ty = $default:expr, $allowed:literal => $check:expr; )*
        }
    ) => {
        #[doc = $about]
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct $name {
            $( #[doc = $doc] pub $field: $kind, )*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $( $field: $default, )* }
            }
        }

        impl $crate::Section for $name {
            const NAME: &'static str = $table;
            const ABOUT: &'static str = $about.trim_ascii();

            fn keys() -> Vec<$crate::KeyDoc> {
                let defaults = Self::default();
                vec![ $( $crate::KeyDoc {
                    key: concat!($table, ".", stringify!($field)).to_string(),
                    doc: $doc.trim(),
                    kind: stringify!($kind),
                    default: $crate::show(&defaults.$field),
                    allowed: $allowed,
                }, )* ]
            }

            fn check(&self) -> Result<(), $crate::ConfigError> {
                $(
                    let allowed: fn(&$kind) -> bool = $check;
                    if !allowed(&self.$field) {
                        let key = concat!($table, ".", stringify!($field));
                        return $crate::refuse(key, $crate::show(&self.$field), $allowed);
                    }
                )*
                Ok(())
            }
        }
    };
}
pub(super) use section;
