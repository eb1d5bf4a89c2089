//! Types of values, and how TOML is converted to them.

use toml::Value as Toml;

/// Type of a key's values.
pub trait Value {
    /// How a value is written.
    const NOTATION: &'static str;
    /// How a pair of values is written.
    const PAIR: &'static str = "two of them, as in [a, b]";
    /// How a list of values is written.
    const LIST: &'static str = "a list of texts, as in [\"a\", \"b\"]";

    /// Converts a TOML value to this type if that loses nothing, such as `1` to `1.0` and `8e6` to `8000000`.
    ///
    /// # Errors
    /// [`Misfit`] for a value of another type.
    fn convert(value: &Toml) -> Result<Toml, Misfit>;
}

/// Value that is not of a key's type.
#[derive(Clone, Debug, PartialEq)]
pub enum Misfit {
    /// It is written in another way.
    Type {
        /// The value in TOML notation.
        value: String,
        /// How values are written.
        notation: &'static str,
    },
    /// The type does not hold it.
    Range {
        /// The value in TOML notation.
        value: String,
    },
}

impl Misfit {
    /// Returns the misfit of a value that is written in another way than those of `T`.
    pub fn of<T: Value>(value: &Toml) -> Self {
        Self::Type { value: value.to_string(), notation: T::NOTATION }
    }
}

impl Value for bool {
    const NOTATION: &'static str = "true or false";

    fn convert(value: &Toml) -> Result<Toml, Misfit> {
        value.as_bool().map(Toml::Boolean).ok_or_else(|| Misfit::of::<Self>(value))
    }
}

impl Value for String {
    const NOTATION: &'static str = "a text in quotes";

    fn convert(value: &Toml) -> Result<Toml, Misfit> {
        if value.is_str() { Ok(value.clone()) } else { Err(Misfit::of::<Self>(value)) }
    }
}

impl Value for f64 {
    const NOTATION: &'static str = "a number";
    const PAIR: &'static str = "two numbers, as in [0.5, 1.0]";
    const LIST: &'static str = "a list of numbers, as in [0.5, 1.0]";

    fn convert(value: &Toml) -> Result<Toml, Misfit> {
        let number = value.as_float().or_else(|| value.as_integer().map(|whole| whole as Self));
        number.map(Toml::Float).ok_or_else(|| Misfit::of::<Self>(value))
    }
}

/// Returns a whole number within `min` to `max`, also of a fraction without decimals.
fn whole<T: Value>(value: &Toml, min: i64, max: i64) -> Result<Toml, Misfit> {
    let number = match value {
        Toml::Integer(number) => *number,
        Toml::Float(number) if number.fract() == 0.0 && number.abs() < 9e15 => *number as i64,
        _ => return Err(Misfit::of::<T>(value)),
    };
    match (min..=max).contains(&number) {
        true => Ok(Toml::Integer(number)),
        false => Err(Misfit::Range { value: number.to_string() }),
    }
}

impl Value for u32 {
    const NOTATION: &'static str = "a whole number";
    const PAIR: &'static str = "two whole numbers, as in [0, 1]";
    const LIST: &'static str = "a list of whole numbers, as in [256, 128]";

    fn convert(value: &Toml) -> Result<Toml, Misfit> {
        whole::<Self>(value, 0, Self::MAX.into())
    }
}

impl Value for i32 {
    const NOTATION: &'static str = u32::NOTATION;
    const PAIR: &'static str = u32::PAIR;
    const LIST: &'static str = u32::LIST;

    fn convert(value: &Toml) -> Result<Toml, Misfit> {
        whole::<Self>(value, Self::MIN.into(), Self::MAX.into())
    }
}

impl Value for u64 {
    const NOTATION: &'static str = u32::NOTATION;

    fn convert(value: &Toml) -> Result<Toml, Misfit> {
        whole::<Self>(value, 0, i64::MAX)
    }
}

impl<T: Value> Value for [T; 2] {
    const NOTATION: &'static str = T::PAIR;

    fn convert(value: &Toml) -> Result<Toml, Misfit> {
        match value.as_array() {
            Some(items) if items.len() == 2 => items.iter().map(T::convert).collect::<Result<_, _>>().map(Toml::Array),
            _ => Err(Misfit::of::<Self>(value)),
        }
    }
}

impl<T: Value> Value for Vec<T> {
    const NOTATION: &'static str = T::LIST;

    fn convert(value: &Toml) -> Result<Toml, Misfit> {
        let items = value.as_array().ok_or_else(|| Misfit::of::<Self>(value))?;
        items.iter().map(T::convert).collect::<Result<_, _>>().map(Toml::Array)
    }
}

/// Declares an enum whose variants are written as names, and the list of these names.
#[macro_export]
macro_rules! choice {
    (
        $(#[$meta:meta])*
        $name:ident { $( $(#[$variant_meta:meta])* $variant:ident = $text:literal, )* }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        pub enum $name {
            $( $(#[$variant_meta])* #[serde(rename = $text)] $variant, )*
        }

        impl $name {
            /// Names of the variants in a configuration.
            pub const NAMES: &[&str] = &[$($text),*];

            /// Returns the name of this variant.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $( Self::$variant => $text, )*
                }
            }
        }

        impl $crate::Value for $name {
            const NOTATION: &'static str = <String as $crate::Value>::NOTATION;

            fn convert(value: &toml::Value) -> Result<toml::Value, $crate::Misfit> {
                match value.as_str() {
                    Some(name) if Self::NAMES.contains(&name) => Ok(value.clone()),
                    Some(_) => Err($crate::Misfit::Range { value: value.to_string() }),
                    None => Err($crate::Misfit::of::<Self>(value)),
                }
            }
        }
    };
}
