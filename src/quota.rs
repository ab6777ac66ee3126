//! Quotas: how many of something may be in use at the same time, in all and by one caller.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A quota, shared by those who count in it.
#[derive(Debug, Clone)]
pub(crate) struct Quota(Arc<Shared>);

#[derive(Debug)]
struct Shared {
    /// Largest number in all.
    total: usize,
    /// Largest number of one caller.
    per_caller: usize,
    in_use: Mutex<BTreeMap<String, usize>>,
}

/// One in use, until this is dropped.
#[derive(Debug)]
pub(crate) struct InUse {
    quota: Quota,
    caller: String,
}

/// A quota that is used up, and how many are in use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum UsedUp {
    /// By all callers together.
    ByAll(usize),
    /// By this caller.
    ByCaller(usize),
}

impl Quota {
    /// A quota of `total`, of which one caller may have `per_caller`.
    pub(crate) fn new(total: usize, per_caller: usize) -> Self {
        Self(Arc::new(Shared {
            total,
            per_caller,
            in_use: Mutex::default(),
        }))
    }

    /// Counts one more of this caller.
    ///
    /// # Errors
    /// The quota is used up.
    pub(crate) fn enter(&self, caller: &str) -> Result<InUse, UsedUp> {
        let mut in_use = self.in_use();
        let own = in_use.get(caller).copied().unwrap_or_default();
        if own >= self.0.per_caller {
            return Err(UsedUp::ByCaller(own));
        }
        let all = in_use.values().sum();
        if all >= self.0.total {
            return Err(UsedUp::ByAll(all));
        }
        in_use.insert(caller.to_owned(), own + 1);
        Ok(InUse {
            quota: self.clone(),
            caller: caller.to_owned(),
        })
    }

    fn in_use(&self) -> MutexGuard<'_, BTreeMap<String, usize>> {
        self.0.in_use.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl InUse {
    /// The caller.
    pub(crate) fn caller(&self) -> &str {
        &self.caller
    }
}

impl Drop for InUse {
    fn drop(&mut self) {
        let mut in_use = self.quota.in_use();
        if let Some(own) = in_use.get_mut(&self.caller) {
            *own -= 1;
            if *own == 0 {
                in_use.remove(&self.caller);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_caller_has_its_share_and_all_of_them_the_whole() {
        let quota = Quota::new(3, 2);
        let a: Vec<_> = (0..2).map(|_| quota.enter("a").unwrap()).collect();
        assert_eq!(quota.enter("a").unwrap_err(), UsedUp::ByCaller(2));
        let b = quota.enter("b").unwrap();
        assert_eq!(quota.enter("c").unwrap_err(), UsedUp::ByAll(3));
        drop(a);
        assert!(quota.enter("c").is_ok());
        drop(b);
        assert!(quota.in_use().is_empty(), "callers who left are forgotten");
    }
}
