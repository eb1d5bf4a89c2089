//! Module for serde's `with`: writes the infinite numbers of a section as `"inf"` and `"-inf"`, because JSON has none, and
//! reads sections with retired keys.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::DeserializeOwned, de::Error as _, ser::Error as _};

use super::{Section, retired};

/// Writes a section with its keys in alphabetical order.
pub fn serialize<T: Serialize, S: Serializer>(section: &T, serializer: S) -> Result<S::Ok, S::Error> {
    to_json(toml::Value::try_from(section).map_err(S::Error::custom)?).serialize(serializer)
}

/// Reads a section, without its retired keys.
pub fn deserialize<'de, T: Section + DeserializeOwned, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    let json = serde_json::Value::deserialize(deserializer)?;
    let mut open =
        to_toml(json).ok_or_else(|| D::Error::custom("a section has no null and no number beyond 64 bits"))?;
    if let Some(entries) = open.as_table_mut() {
        let mut kept = toml::Table::new();
        for (name, value) in std::mem::take(entries) {
            if !retired::ignores(&format!("{}.{name}", T::NAME), &value).map_err(D::Error::custom)? {
                kept.insert(name, value);
            }
        }
        *entries = kept;
    }
    open.try_into().map_err(|error: toml::de::Error| D::Error::custom(error.message()))
}

fn to_json(value: toml::Value) -> serde_json::Value {
    match value {
        toml::Value::Float(number) => {
            serde_json::Number::from_f64(number).map_or_else(|| number.to_string().into(), serde_json::Value::Number)
        }
        toml::Value::Integer(number) => number.into(),
        toml::Value::Boolean(switch) => switch.into(),
        toml::Value::String(text) => text.into(),
        toml::Value::Datetime(time) => time.to_string().into(),
        toml::Value::Array(items) => items.into_iter().map(to_json).collect(),
        toml::Value::Table(entries) => entries.into_iter().map(|(key, value)| (key, to_json(value))).collect(),
    }
}

fn to_toml(value: serde_json::Value) -> Option<toml::Value> {
    Some(match value {
        serde_json::Value::Null => return None,
        serde_json::Value::Bool(switch) => switch.into(),
        serde_json::Value::Number(number) => match number.as_i64() {
            Some(whole) => whole.into(),
            None => number.as_f64()?.into(),
        },
        serde_json::Value::String(text) => match text.as_str() {
            "inf" => f64::INFINITY.into(),
            "-inf" => f64::NEG_INFINITY.into(),
            _ => text.into(),
        },
        serde_json::Value::Array(items) => items.into_iter().map(to_toml).collect::<Option<Vec<_>>>()?.into(),
        serde_json::Value::Object(entries) => {
            let entries = entries.into_iter().map(|(key, value)| Some((key, to_toml(value)?)));
            toml::Value::Table(entries.collect::<Option<_>>()?)
        }
    })
}

#[cfg(test)]
mod tests {
    use crate::EnvConfig;

    #[derive(serde::Serialize, serde::Deserialize)]
    struct Holder {
        #[serde(with = "super")]
        env: EnvConfig,
    }

    #[test]
    fn infinite_bounds_survive_json() {
        let env = EnvConfig { healthy_z_range: [0.5, f64::INFINITY], ..EnvConfig::default() };
        assert_eq!(env.contact_cost_range[0], f64::NEG_INFINITY);
        let text = serde_json::to_string(&Holder { env: env.clone() }).unwrap();
        assert!(text.contains(r#""contact_cost_range":["-inf",10.0]"#), "{text}");
        assert!(text.contains(r#""healthy_z_range":[0.5,"inf"]"#), "{text}");
        assert_eq!(serde_json::from_str::<Holder>(&text).unwrap().env, env);
    }

    #[test]
    fn sections_of_earlier_versions_have_retired_keys_and_lack_new_ones() {
        let text = serde_json::to_string(&Holder { env: EnvConfig::default() }).unwrap();
        let older =
            text.replace(r#""control_step_s":0.015,"#, "").replace(r#""keyframe":"","#, r#""solver_iterations":4,"#);
        assert!(!older.contains("control_step_s") && older.contains("solver_iterations"), "{older}");
        assert_eq!(serde_json::from_str::<Holder>(&older).unwrap().env, EnvConfig::default());
    }

    #[test]
    fn malformed_sections_are_refused() {
        let refused = |text: &str| serde_json::from_str::<Holder>(text).err().expect("it is refused").to_string();
        assert!(refused(r#"{"env": {"substeps": null}}"#).contains("null"));
        assert!(refused(r#"{"env": {"substep": 2}}"#).contains("substep"));
        assert!(refused(r#"{"env": {"substeps": "two"}}"#).contains("two"));
        assert!(refused(r#"{"env": 7}"#).contains("7"));
    }
}
