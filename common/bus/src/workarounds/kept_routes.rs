//! Lets Zenoh keep the routes of statistics that come through routers.
//!
//! For a key that no session has declared, Zenoh compares each message's key with every declared key beside it. Here
//! these are the tokens of all actors: with 1000 actors behind routers, a learner spent 0.6 of a core on that. It keeps
//! the routes of declared keys, so the learner declares the key of each live actor's statistics. Without routers the
//! actor's own declaration is enough. No upstream issue is known. Delete when Zenoh keeps the routes of other keys,
//! too.

use std::collections::{BTreeSet, HashMap};

use zenoh::{Session, Wait, key_expr::KeyExpr};

/// Declared keys of the live actors' statistics.
pub(crate) struct KeptRoutes {
    session: Session,
    declared: HashMap<String, KeyExpr<'static>>,
}

impl KeptRoutes {
    /// Declares nothing yet.
    pub(crate) fn new(session: &Session) -> Self {
        Self { session: session.clone(), declared: HashMap::new() }
    }

    /// Declares the `key` of new actors, and undeclares those of actors that are gone. Must not be called in a callback.
    pub(crate) fn set_actors(&mut self, actors: &BTreeSet<String>, key: impl Fn(&str) -> String) {
        let gone: Vec<String> = self.declared.keys().filter(|actor| !actors.contains(*actor)).cloned().collect();
        for key in gone.iter().filter_map(|actor| self.declared.remove(actor)) {
            if let Err(error) = self.session.undeclare(key).wait() {
                tracing::debug!(%error, "key not undeclared");
            }
        }
        for actor in actors {
            if self.declared.contains_key(actor) {
                continue;
            }
            match self.session.declare_keyexpr(key(actor)).wait() {
                Ok(key) => drop(self.declared.insert(actor.clone(), key)),
                Err(error) => tracing::debug!(%actor, %error, "key not declared"),
            }
        }
    }
}
