//! Open connections: who has how many, and which one makes room for another.
//!
//! A connection without a request in progress is closed as soon as another one needs its place,
//! the one that was idle longest first; then one whose client neither sends the rest of its request
//! nor takes its answer. Where all are busy, a few places more are kept for the operator.

use super::access::PeerAddress;
use crate::config::Limits;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv6Addr};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::sync::Notify;
use tokio::time::Instant;

/// Time for which a client may keep a request waiting, in all, before its connection makes room for
/// another.
const PATIENCE: Duration = Duration::from_secs(1);

/// The open connections of a service.
#[derive(Debug, Clone)]
pub(super) struct Connections(Arc<Mutex<Table>>);

#[derive(Debug)]
struct Table {
    open: BTreeMap<u64, Entry>,
    next: u64,
    limits: Limits,
}

#[derive(Debug)]
struct Entry {
    address: IpAddr,
    place: Place,
    activity: Activity,
    closed: Arc<Notify>,
}

/// Kind of place that a connection has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// One for any request.
    Client,
    /// One for the operator's requests: health, readiness, metrics, dismissals.
    Operator,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Activity {
    /// Without a request in progress since then.
    Idle(Instant),
    /// With a request in progress, whose client has kept it waiting for so long in all.
    Busy(Duration),
    /// The same, and its client has sent and taken nothing since then.
    Stalled(Duration, Instant),
}

/// An open connection, in the table until this is dropped.
#[derive(Debug)]
pub(super) struct OpenConnection {
    connections: Connections,
    number: u64,
    address: IpAddr,
    place: Place,
    closed: Arc<Notify>,
}

/// A request in progress on a connection, until its answer is written and this is dropped.
#[derive(Debug)]
pub(super) struct Busy {
    connections: Connections,
    number: u64,
}

impl Connections {
    pub(super) fn new(limits: Limits) -> Self {
        Self(Arc::new(Mutex::new(Table {
            open: BTreeMap::new(),
            next: 0,
            limits,
        })))
    }

    /// A place for a new connection; `None` if all are busy, the operator's too.
    pub(super) fn open(&self, address: IpAddr) -> Option<OpenConnection> {
        let address = network(address);
        let mut table = self.table();
        let place = table.make_room(address)?;
        let number = table.next;
        table.next += 1;
        let closed = Arc::new(Notify::new());
        table.open.insert(
            number,
            Entry {
                address,
                place,
                activity: Activity::Idle(Instant::now()),
                closed: Arc::clone(&closed),
            },
        );
        Some(OpenConnection {
            connections: self.clone(),
            number,
            address,
            place,
            closed,
        })
    }

    fn set(&self, number: u64, activity: Activity) {
        if let Some(entry) = self.table().open.get_mut(&number) {
            entry.activity = activity;
        }
    }

    /// Notes whether the client of a request in progress keeps the service waiting.
    fn stall(&self, number: u64, waits: bool) {
        if let Some(entry) = self.table().open.get_mut(&number) {
            entry.activity = match (entry.activity, waits) {
                (Activity::Busy(waited), true) => Activity::Stalled(waited, Instant::now()),
                (Activity::Stalled(waited, since), false) => {
                    Activity::Busy(waited + since.elapsed())
                }
                (activity, _) => activity,
            };
        }
    }

    fn table(&self) -> MutexGuard<'_, Table> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Table {
    /// Makes room for a connection from this address: in the places of its own address if it has
    /// its share, else in those of the address that has most.
    fn make_room(&mut self, address: IpAddr) -> Option<Place> {
        let own = self.count(Place::Client, Some(address));
        let room = if own >= self.limits.connections_per_address {
            self.close_one(Place::Client, Some(address))
        } else if self.count(Place::Client, None) >= self.limits.connections {
            self.close_one(Place::Client, None)
        } else {
            true
        };
        if room {
            return Some(Place::Client);
        }
        let room = self.count(Place::Operator, None) < self.limits.operator_connections
            || self.close_one(Place::Operator, None);
        room.then_some(Place::Operator)
    }

    /// Number of connections with such a place, of this address if one is given.
    fn count(&self, place: Place, address: Option<IpAddr>) -> usize {
        let open = self.open.values();
        open.filter(|entry| entry.is(place, address)).count()
    }

    /// Closes a connection with such a place, of this address if one is given, that is idle or
    /// whose client keeps it waiting: one of the address that has most, of these an idle one
    /// first, and the one that waits longest. `false` if there is none.
    fn close_one(&mut self, place: Place, address: Option<IpAddr>) -> bool {
        let mut counts: BTreeMap<IpAddr, usize> = BTreeMap::new();
        for entry in self.open.values().filter(|entry| entry.is(place, address)) {
            *counts.entry(entry.address).or_default() += 1;
        }
        let waiting = self.open.iter().filter_map(|(number, entry)| {
            let (has_request, waited) = match entry.activity {
                Activity::Idle(since) => (false, since.elapsed()),
                // A byte now and then makes no difference.
                Activity::Stalled(waited, since) => (true, waited + since.elapsed()),
                Activity::Busy(_) => return None,
            };
            if has_request && waited < PATIENCE {
                return None;
            }
            let most_first = Reverse(counts.get(&entry.address)?);
            let is_one = entry.is(place, address);
            is_one.then_some((most_first, has_request, Reverse(waited), *number))
        });
        let Some((_, _, _, number)) = waiting.min() else {
            return false;
        };
        if let Some(entry) = self.open.remove(&number) {
            entry.closed.notify_one();
        }
        true
    }
}

impl Entry {
    fn is(&self, place: Place, address: Option<IpAddr>) -> bool {
        self.place == place && address.is_none_or(|address| self.address == address)
    }
}

impl OpenConnection {
    /// Address of the other end.
    pub(super) fn peer(&self) -> PeerAddress {
        PeerAddress(self.address)
    }

    /// Kind of place that it has.
    pub(super) fn place(&self) -> Place {
        self.place
    }

    /// Returns once the connection is to be closed, to make room for another.
    pub(super) async fn closed(&self) {
        self.closed.notified().await;
    }

    /// Notes whether the client of a request in progress keeps the service waiting, with the rest
    /// of its request or by taking nothing of its answer.
    pub(super) fn stall(&self, waits: bool) {
        self.connections.stall(self.number, waits);
    }

    /// Marks that a request has come.
    pub(super) fn begin_request(&self) -> Busy {
        self.connections
            .set(self.number, Activity::Busy(Duration::ZERO));
        Busy {
            connections: self.connections.clone(),
            number: self.number,
        }
    }
}

impl Drop for OpenConnection {
    fn drop(&mut self) {
        self.connections.table().open.remove(&self.number);
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        let idle = Activity::Idle(Instant::now());
        self.connections.set(self.number, idle);
    }
}

/// Address by which connections are counted: of IPv6 its network of 64 bits, which one client has.
fn network(address: IpAddr) -> IpAddr {
    match address {
        IpAddr::V4(_) => address,
        IpAddr::V6(v6) => {
            let [a, b, c, d, ..] = v6.segments();
            Ipv6Addr::new(a, b, c, d, 0, 0, 0, 0).into()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn connections() -> Connections {
        Connections::new(Limits {
            connections: 3,
            connections_per_address: 2,
            operator_connections: 1,
            ..Limits::default()
        })
    }

    fn address(last: u8) -> IpAddr {
        IpAddr::from([192, 0, 2, last])
    }

    #[tokio::test]
    async fn the_longest_idle_connection_makes_room_for_another() {
        let connections = connections();
        let first = connections.open(address(1)).unwrap();
        let second = connections.open(address(1)).unwrap();
        let busy = first.begin_request();
        let third = connections.open(address(1)).unwrap();
        assert_eq!(third.place, Place::Client);
        second.closed().await;
        let other = connections.open(address(2)).unwrap();
        let another = connections.open(address(3)).unwrap();
        assert_eq!(another.place, Place::Client);
        third.closed().await;
        drop(busy);
        let last = connections.open(address(4)).unwrap();
        assert_eq!(last.place, Place::Client);
        other.closed().await;
    }

    #[tokio::test]
    async fn a_client_that_keeps_its_connection_waiting_makes_room_after_the_idle_ones() {
        let connections = connections();
        let open = [1, 1, 2].map(|last| connections.open(address(last)).unwrap());
        let busy: Vec<_> = open.iter().map(OpenConnection::begin_request).collect();
        open[1].stall(true);
        let early = connections.open(address(3)).unwrap();
        assert_eq!(early.place, Place::Operator, "it may still go on");
        drop(early);
        tokio::time::sleep(PATIENCE).await;
        let next = connections.open(address(3)).unwrap();
        assert_eq!(next.place, Place::Client);
        open[1].closed().await;
        open[2].stall(true);
        tokio::time::sleep(PATIENCE / 2).await;
        open[2].stall(false);
        let _busy = next.begin_request();
        let last = connections.open(address(4)).unwrap();
        assert_eq!(last.place, Place::Operator, "its client takes its answer");
        drop(last);
        open[2].stall(true);
        tokio::time::sleep(PATIENCE / 2).await;
        let last = connections.open(address(4)).unwrap();
        assert_eq!(
            last.place,
            Place::Client,
            "it has waited for as long in all"
        );
        drop(busy);
    }

    #[test]
    fn an_address_is_a_network_of_64_bits() {
        let connections = connections();
        let of_one = ["2001:db8::1", "2001:db8::2", "2001:db8::3"];
        let open = of_one.map(|text| connections.open(text.parse().unwrap()).unwrap());
        assert_eq!(connections.table().open.len(), 2);
        assert_eq!(open[0].peer().0, open[2].peer().0);
    }

    #[test]
    fn where_all_are_busy_the_operator_has_a_place_left() {
        let connections = connections();
        let open = [1, 1, 2].map(|last| connections.open(address(last)).unwrap());
        let _busy: Vec<_> = open.iter().map(OpenConnection::begin_request).collect();
        let operator = connections.open(address(3)).unwrap();
        assert_eq!(operator.place, Place::Operator);
        let busy = operator.begin_request();
        assert!(connections.open(address(3)).is_none());
        drop(busy);
        let next = connections.open(address(3)).unwrap();
        assert_eq!(next.place, Place::Operator);
        drop((operator, next));
        assert_eq!(connections.table().open.len(), 3);
    }
}
