//! Macro that declares a section: documentation, type, default and allowed values of each key in one place.
//!
//! It generates the struct, its `Default`, the key table for error messages and documentation, and the check of every value.

use super::{ConfigError, Misfit};

/// Description of a configuration key.
#[derive(Clone, Debug)]
pub struct KeyDoc {
    /// Dotted name, as in `--set`.
    pub key: &'static str,
    /// One paragraph of documentation.
    pub doc: &'static str,
    /// How its values are written.
    pub notation: &'static str,
    /// Default in TOML notation.
    pub default: String,
    /// Allowed values.
    pub allowed: &'static str,
    /// Converts a TOML value to the key's type, see [`crate::Value::convert`].
    pub convert: fn(&toml::Value) -> Result<toml::Value, Misfit>,
    /// Returns whether a converted value is allowed.
    pub is_allowed: fn(toml::Value) -> bool,
}

impl KeyDoc {
    /// Returns the name within the section.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.key.split_once('.').map_or(self.key, |(_, name)| name)
    }

    /// Converts a value to the key's type if that loses nothing, such as `1` to `1.0` and `8e6` to `8000000`.
    ///
    /// # Errors
    /// [`ConfigError::Type`] or [`ConfigError::Value`] for a value of another type, or one that is not allowed.
    pub fn convert(&self, value: &toml::Value) -> Result<toml::Value, ConfigError> {
        let (key, allowed) = (self.key.to_string(), self.allowed.to_string());
        match (self.convert)(value) {
            Ok(converted) if (self.is_allowed)(converted.clone()) => Ok(converted),
            Ok(converted) => Err(ConfigError::Value { key, value: converted.to_string(), allowed }),
            Err(Misfit::Type { value, notation }) => Err(ConfigError::Type { key, value, notation, allowed }),
            Err(Misfit::Range { value }) => Err(ConfigError::Value { key, value, allowed }),
        }
    }
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
    /// Returns the description of this section.
    fn describe() -> SectionDoc;
    /// Checks each value by itself.
    ///
    /// # Errors
    /// [`ConfigError::Value`] for the first value out of range.
    fn check(&self) -> Result<(), ConfigError>;
}

/// Declares a section: `/// doc` `key: type = default, "allowed values" => check;`.
#[macro_export]
macro_rules! section {
    (
        $( #[doc = $about:literal] )+
        $name:ident as $table:literal {
            $( $( #[doc = $doc:literal] )+ $field:ident : $kind:ty = $default:expr, $allowed:literal => $check:expr; )*
        }
    ) => {
        $( #[doc = $about] )+
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct $name {
            $( $( #[doc = $doc] )+ pub $field: $kind, )*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $( $field: $default, )* }
            }
        }

        impl $crate::Section for $name {
            const NAME: &'static str = $table;

            fn describe() -> $crate::SectionDoc {
                let defaults = Self::default();
                let keys = vec![ $( $crate::KeyDoc {
                    key: concat!($table, ".", stringify!($field)),
                    doc: concat!($( $doc ),+).trim(),
                    notation: <$kind as $crate::Value>::NOTATION,
                    default: $crate::show(&defaults.$field),
                    allowed: $allowed,
                    convert: <$kind as $crate::Value>::convert,
                    is_allowed: |value| {
                        let allowed: fn(&$kind) -> bool = $check;
                        // What is no such value is refused elsewhere.
                        value.try_into::<$kind>().map_or(true, |value| allowed(&value))
                    },
                }, )* ];
                $crate::SectionDoc { name: $table, about: concat!($( $about ),+).trim(), keys }
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
