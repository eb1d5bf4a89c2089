//! Keeps queryables until their session is closed.
//!
//! If one of two routers undeclares a queryable on a key on which both have one, the other router no longer declares
//! its own to links that it gets later: `Hat::unregister_queryable` takes the key out of the set of keys with
//! queryables when no *other* router has one. So after a learner that was overtaken had stepped down, routers whose
//! links broke had no way to its successor for the rest of the leadership. If the session is closed instead, Zenoh
//! forgets its queryables together, and keeps the key. No upstream issue is known. Delete when `unregister_queryable`
//! keeps keys of this router's own, too.

use zenoh::{Session, Wait, query::Query};

/// Declares a queryable that lasts as long as the session. Its callback must not block.
pub(crate) fn declare_queryable(
    session: &Session,
    key: String,
    callback: impl Fn(Query) + Send + Sync + 'static,
) -> zenoh::Result<()> {
    session.declare_queryable(key).callback(callback).background().wait()
}
