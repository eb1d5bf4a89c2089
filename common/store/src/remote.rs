//! Objects of a cloud's store.

use std::{error::Error, time::Duration};

use bytes::Bytes;
use object_store::{
    BackoffConfig, ObjectStore, ObjectStoreExt, PutMode, PutOptions, PutPayload, RetryConfig, UpdateVersion,
    aws::AmazonS3Builder, azure::MicrosoftAzureBuilder, gcp::GoogleCloudStorageBuilder, path::Path,
};
use tokio::runtime::Runtime;
use url::Url;

use crate::{StoreError, Tag, location::Scheme};

/// Attempts after the first one. Callers wait and try again by themselves, and say so meanwhile.
const RETRIES: usize = 1;
/// Longest time in which an attempt may follow.
const RETRY_TIMEOUT: Duration = Duration::from_secs(5);

/// Longest wait for an answer. A connection that was cut off would wait longer, and go on late when it is back.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(5);
/// Slowest transfer that is not taken for a cut-off one (bytes per second).
const SPEED_MIN_BPS: u64 = 1 << 20;

/// Longest error that is shown, in characters: a store may answer with a whole page.
const WORDS_MAX: usize = 600;

const NO_BUCKET: &str = "its bucket does not exist; create it, or correct the URL or the endpoint";

/// Address at which a cloud gives its machines credentials. Without credentials in the environment they are asked for there.
const MACHINE_CREDENTIALS: &str = "169.254.169.254";
const NO_CREDENTIALS: &str = "neither the environment nor this machine has credentials; set the store's variables, as \
                              docs/operations/failover.md lists them: ";

/// Objects below a path of a bucket.
#[derive(Debug)]
pub(crate) struct Remote {
    scheme: Scheme,
    objects: Box<dyn ObjectStore>,
    root: Path,
    answer_timeout: Duration,
    /// `None` only while it is dropped.
    runtime: Option<Runtime>,
}

impl Remote {
    pub(crate) fn open(scheme: Scheme, url: &Url) -> Result<Self, StoreError> {
        let settings = |why: &dyn Error| StoreError::Settings { store: url.to_string(), why: in_words(why) };
        // Where the process has a provider already, it is the same one.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let objects = client(scheme, url).map_err(|why| settings(&why))?;
        let root = Path::from_url_path(url.path()).map_err(|why| settings(&why))?;
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .max_blocking_threads(2)
            .thread_name("store")
            .enable_all()
            .build()
            .map_err(|why| settings(&why))?;
        Ok(Self { scheme, objects, root, answer_timeout: ANSWER_TIMEOUT, runtime: Some(runtime) })
    }

    /// Pause between two writes of one object, of which Google takes one per second:
    /// <https://cloud.google.com/storage/quotas>.
    pub(crate) fn pause(&self) -> Duration {
        if matches!(self.scheme, Scheme::GoogleCloud) { Duration::from_millis(1100) } else { Duration::ZERO }
    }

    pub(crate) fn put(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let written = self.wait(bytes.len() as u64, self.objects.put(&self.path(name), payload(bytes)));
        written.map(|_| ()).map_err(|why| not_written(name, &why))
    }

    pub(crate) fn get(&self, name: &str) -> Result<(Vec<u8>, Tag), StoreError> {
        let found = self.wait(0, self.objects.get(&self.path(name))).map_err(|why| failed(name, &why))?;
        let (tag, version) = (found.meta.e_tag.clone(), found.meta.version.clone());
        let bytes = self.wait(found.meta.size, found.bytes()).map_err(|why| failed(name, &why))?;
        Ok((bytes.to_vec(), self.tag(name, tag, version)?))
    }

    pub(crate) fn replace(&self, name: &str, bytes: &[u8], last: Option<&Tag>) -> Result<Tag, StoreError> {
        let mode = last.map_or(PutMode::Create, |Tag(tag)| {
            PutMode::Update(UpdateVersion { e_tag: Some(tag.clone()), version: Some(tag.clone()) })
        });
        let options = PutOptions { mode, ..PutOptions::default() };
        let written = self.wait(bytes.len() as u64, self.objects.put_opts(&self.path(name), payload(bytes), options));
        let written = written.map_err(|why| not_written(name, &why))?;
        self.tag(name, written.e_tag, written.version)
    }

    /// Returns what a condition names: Google's the version, the others' the ETag.
    fn tag(&self, name: &str, tag: Option<String>, version: Option<String>) -> Result<Tag, StoreError> {
        let named = if self.scheme == Scheme::GoogleCloud { version } else { tag };
        named
            .map(Tag)
            .ok_or_else(|| StoreError::failed(name, "it names no version of an object, so no write is conditional"))
    }

    pub(crate) fn delete(&self, name: &str) -> Result<(), StoreError> {
        match self.wait(0, self.objects.delete(&self.path(name))) {
            Ok(()) | Err(object_store::Error::NotFound { .. }) => Ok(()),
            Err(why) => Err(failed(name, &why)),
        }
    }

    pub(crate) fn list(&self, folder: &str) -> Result<Vec<String>, StoreError> {
        let listed = self.wait(0, self.objects.list_with_delimiter(Some(&self.path(folder))));
        let objects = listed.map_err(|why| failed(folder, &why))?.objects;
        Ok(objects.iter().filter_map(|object| object.location.filename().map(str::to_string)).collect())
    }

    fn path(&self, name: &str) -> Path {
        name.split('/').fold(self.root.clone(), |path, part| path.join(part))
    }

    /// Waits for work that transfers this many bytes. Gives up work that takes too long; it may take effect all the same.
    fn wait<T>(
        &self,
        bytes: u64,
        work: impl Future<Output = Result<T, object_store::Error>>,
    ) -> Result<T, object_store::Error> {
        let limit = self.answer_timeout + Duration::from_secs(bytes / SPEED_MIN_BPS);
        let runtime = self.runtime.as_ref().expect("only a drop takes it");
        let done = runtime.block_on(async { tokio::time::timeout(limit, work).await });
        done.unwrap_or_else(|_| {
            let why = format!("no answer within {} s", limit.as_secs());
            Err(object_store::Error::Generic { store: "store", source: why.into() })
        })
    }
}

impl Drop for Remote {
    fn drop(&mut self) {
        // A plain drop waits, which panics in an async task.
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}

/// Returns a client with the settings and credentials of the environment.
fn client(scheme: Scheme, url: &Url) -> Result<Box<dyn ObjectStore>, object_store::Error> {
    let (backoff, url) = (BackoffConfig::default(), url.as_str());
    let retry = RetryConfig { backoff, max_retries: RETRIES, retry_timeout: RETRY_TIMEOUT };
    Ok(match scheme {
        Scheme::S3 => Box::new(AmazonS3Builder::from_env().with_url(url).with_retry(retry).build()?),
        Scheme::GoogleCloud => Box::new(GoogleCloudStorageBuilder::from_env().with_url(url).with_retry(retry).build()?),
        Scheme::Azure => Box::new(MicrosoftAzureBuilder::from_env().with_url(url).with_retry(retry).build()?),
    })
}

fn payload(bytes: &[u8]) -> PutPayload {
    Bytes::copy_from_slice(bytes).into()
}

/// A write does not need the object, so what it does not find is the bucket. Reads do not distinguish the two: some
/// servers create a bucket with its first object.
fn not_written(name: &str, why: &object_store::Error) -> StoreError {
    match why {
        object_store::Error::NotFound { .. } => StoreError::failed(name, NO_BUCKET),
        _ => failed(name, why),
    }
}

fn failed(name: &str, why: &object_store::Error) -> StoreError {
    match why {
        object_store::Error::NotFound { .. } => StoreError::missing(name),
        object_store::Error::AlreadyExists { .. } | object_store::Error::Precondition { .. } => {
            StoreError::conflict(name)
        }
        _ => StoreError::failed(name, in_words(why)),
    }
}

/// Returns an error with those of its causes that it does not repeat by itself.
fn in_words(why: &dyn Error) -> String {
    let mut text = why.to_string();
    let mut source = why.source();
    while let Some(cause) = source {
        let cause_text = cause.to_string();
        if !text.contains(&cause_text) {
            text = format!("{text}: {cause_text}");
        }
        source = cause.source();
    }
    if text.contains(MACHINE_CREDENTIALS) {
        text.insert_str(0, NO_CREDENTIALS);
    }
    without_secrets(&text).chars().take(WORDS_MAX).collect()
}

/// Removes the queries of URLs, where signatures are, and line breaks.
fn without_secrets(text: &str) -> String {
    let is_end = |c: char| c.is_whitespace() || matches!(c, ')' | '"' | '\'' | '>' | '`');
    let mut shown = String::with_capacity(text.len());
    let mut is_query = false;
    for c in text.chars() {
        is_query = (is_query || c == '?') && !is_end(c);
        if !is_query {
            shown.push(if c == '\n' { ' ' } else { c });
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use std::{
        io::{Read, Write},
        net::{SocketAddr, TcpListener},
    };

    use super::*;

    #[test]
    fn signatures_are_not_shown() {
        let text = "error for url (https://box.example/a?sig=secret&x=1): refused\nby it";
        assert_eq!(without_secrets(text), "error for url (https://box.example/a): refused by it");
    }

    /// Objects of an S3 server at this address.
    fn remote(address: SocketAddr) -> Remote {
        let url = Url::parse("s3://bucket/walk").unwrap();
        let builder = AmazonS3Builder::new()
            .with_url(url.as_str())
            .with_endpoint(format!("http://{address}"))
            .with_allow_http(true)
            .with_access_key_id("public")
            .with_secret_access_key("secret")
            .with_retry(RetryConfig { max_retries: 0, ..RetryConfig::default() });
        let _ = rustls::crypto::ring::default_provider().install_default();
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build().unwrap();
        Remote {
            scheme: Scheme::S3,
            objects: Box::new(builder.build().unwrap()),
            root: Path::from_url_path(url.path()).unwrap(),
            answer_timeout: Duration::from_millis(500),
            runtime: Some(runtime),
        }
    }

    #[test]
    fn what_a_write_does_not_find_is_the_bucket() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let remote = remote(listener.local_addr().unwrap());
        std::thread::spawn(move || {
            for _ in 0..2 {
                let mut client = listener.accept().unwrap().0;
                let mut request = [0; 4096];
                assert_ne!(client.read(&mut request).unwrap(), 0);
                let answer = "HTTP/1.1 404 Not Found\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
                client.write_all(answer.as_bytes()).unwrap();
            }
        });
        assert!(matches!(remote.get("manifest.json"), Err(StoreError::Missing { .. })));
        let why = remote.put("states/1", b"state").unwrap_err().to_string();
        assert!(why.contains("bucket does not exist"), "{why}");
    }

    #[test]
    fn missing_credentials_are_named() {
        let asked = "Error performing PUT http://169.254.169.254/latest/api/token: connect timed out";
        assert!(in_words(&std::io::Error::other(asked)).starts_with("neither the environment nor this machine"));
        assert!(!in_words(&std::io::Error::other("refused")).contains("credentials"));
    }

    #[test]
    fn a_store_that_is_away_is_an_error_without_credentials() {
        // Nothing listens on this port of loopback.
        let why = remote(([127, 0, 0, 1], 9).into()).get("manifest.json").unwrap_err().to_string();
        assert!(why.contains("manifest.json") && !why.contains("secret"), "{why}");
    }

    #[test]
    fn a_store_that_does_not_answer_is_an_error() {
        // The system accepts connections, and no program reads them.
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let remote = remote(listener.local_addr().unwrap());
        for why in [remote.get("manifest.json").unwrap_err(), remote.put("states/1", b"state").unwrap_err()] {
            assert!(why.to_string().contains("no answer within"), "{why}");
        }
    }
}
