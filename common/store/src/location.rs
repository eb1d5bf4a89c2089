//! Location of a store: its URL.

use std::path::PathBuf;

use url::Url;

use crate::StoreError;

/// Forms of a URL, for errors.
pub(crate) const SCHEMES: &str = "file:///FOLDER, s3://BUCKET/PATH, gs://BUCKET/PATH, az://CONTAINER/PATH";

/// Provider of a remote store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scheme {
    S3,
    GoogleCloud,
    Azure,
}

/// Location of a store.
#[derive(Debug, PartialEq)]
pub(crate) enum Location {
    Folder(PathBuf),
    Remote(Scheme, Url),
}

impl Location {
    pub(crate) fn parse(text: &str) -> Result<Self, StoreError> {
        let url = Url::parse(text).map_err(|why| refused(text, &why.to_string()))?;
        if !url.username().is_empty() || url.password().is_some() || url.query().is_some() || url.fragment().is_some() {
            return Err(refused(text, "it has more than a place; credentials and settings belong in the environment"));
        }
        let scheme = match url.scheme() {
            "file" => {
                let root = url.to_file_path().map_err(|()| refused(text, "the folder's path must be absolute"))?;
                return Ok(Self::Folder(root));
            }
            "s3" => Scheme::S3,
            "gs" => Scheme::GoogleCloud,
            "az" => Scheme::Azure,
            other => return Err(refused(text, &format!("`{other}` is no kind of store"))),
        };
        if url.host_str().is_none_or(str::is_empty) {
            return Err(refused(text, "the bucket is missing"));
        }
        if url.path().trim_matches('/').is_empty() {
            return Err(refused(text, "the path of the run within the bucket is missing"));
        }
        Ok(Self::Remote(scheme, url))
    }
}

/// Refuses a URL, whose part with credentials is not repeated.
fn refused(text: &str, why: &str) -> StoreError {
    let shown = text.split(['?', '#']).next().unwrap_or_default();
    let shown = match (shown.split_once("://"), shown.rsplit_once('@')) {
        (Some((scheme, _)), Some((_, place))) => format!("{scheme}://{place}"),
        _ => shown.to_string(),
    };
    StoreError::Url { url: shown, why: why.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn urls_are_understood() {
        assert_eq!(Location::parse("file:///data/run").unwrap(), Location::Folder("/data/run".into()));
        let is_remote =
            |text: &str, wanted: Scheme| matches!(Location::parse(text), Ok(Location::Remote(s, _)) if s == wanted);
        assert!(is_remote("s3://bucket/runs/walk", Scheme::S3));
        assert!(is_remote("gs://bucket/walk/", Scheme::GoogleCloud));
        assert!(is_remote("az://container/walk", Scheme::Azure));
    }

    #[test]
    fn other_urls_are_refused_with_the_reason() {
        let cases = [
            ("runs/walk", "relative URL"),
            ("file://runs/walk", "must be absolute"),
            ("http://host/walk", "`http` is no kind of store"),
            ("s3:///walk", "bucket is missing"),
            ("s3://bucket", "path of the run"),
            ("s3://bucket/", "path of the run"),
        ];
        for (text, wanted) in cases {
            let why = Location::parse(text).unwrap_err().to_string();
            assert!(why.contains(wanted) && why.contains("s3://BUCKET/PATH"), "{text}: {why}");
        }
    }

    #[test]
    fn credentials_in_a_url_are_refused_and_not_repeated() {
        for text in
            ["s3://key:secret@bucket/walk", "az://box/walk?sig=secret", "s3://bucket/walk#secret", "x://a:secret@b"]
        {
            let why = Location::parse(text).unwrap_err().to_string();
            assert!(!why.contains("secret"), "{text}: {why}");
        }
    }
}
