//! One declaration per key: its documentation, type, default and allowed values stand side by side.
//!
//! The macro turns that declaration into the struct, its `Default`, the table of keys that error messages and
//! documentation are made from, and the check of every value.

use super::ConfigError;

/// What is known of one configuration key.
#[derive(Clone, Debug)]
pub struct KeyDoc {
    /// Dotted name, as `--set` takes it.
    pub key: String,
    /// One line of documentation.
    pub doc: &'static str,
    /// Rust name of the value's type.
    pub kind: &'static str,
    /// The default in TOML notation.
    pub default: String,
    /// Allowed values, in words.
    pub allowed: &'static str,
}

/// What is known of one section.
#[derive(Clone, Debug)]
pub struct SectionDoc {
    /// The table's name in TOML.
    pub name: &'static str,
    /// What it is about.
    pub about: &'static str,
    /// Its keys, in the order of their declaration.
    pub keys: Vec<KeyDoc>,
}

/// A section of the configuration.
pub trait Section: Default {
    /// The table's name in TOML.
    const NAME: &'static str;
    /// What it is about.
    const ABOUT: &'static str;
    /// Every key of this section.
    fn keys() -> Vec<KeyDoc>;
    /// All that is known of this section.
    fn describe() -> SectionDoc {
        SectionDoc { name: Self::NAME, about: Self::ABOUT, keys: Self::keys() }
    }
    /// Checks each value by itself.
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
                        return Err($crate::ConfigError::Value {
                            key: concat!($table, ".", stringify!($field)).to_string(),
                            value: $crate::show(&self.$field),
                            allowed: $allowed.to_string(),
                        });
                    }
                )*
                Ok(())
            }
        }
    };
}
pub(super) use section;
