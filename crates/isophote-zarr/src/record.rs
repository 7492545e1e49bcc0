//! What is known about a finished shard: its files, and its part of the results.

use isophote::map::Map;
use isophote::message;
use serde::{Deserialize, Serialize};

use crate::array::ChannelArray;
use crate::error::{Damage, StoreError};
use crate::files::Files;
use crate::plan::{Plan, Shard};
use crate::preview::Boxes;
use crate::statistics::ShardStatistics;

/// The record of a shard. It is written after the shard's files, so if it exists, so do they.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// One per channel; none if the shard is all fill value and has no file.
    files: Vec<Option<StoredFile>>,
    pub statistics: ShardStatistics,
    /// The shard's part of the preview.
    pub preview: String,
}

/// What stands before and after a record and before its checksum, which has [`DIGITS`] digits.
const BEFORE: &str = "{\"record\":";
const BETWEEN: &str = ",\"crc32c\":\"";
const AFTER: &str = "\"}";
const DIGITS: usize = 8;

/// A record with its checksum, as one JSON object.
fn sealed(record: &str) -> String {
    format!("{BEFORE}{record}{BETWEEN}{:08x}{AFTER}", crc32c::crc32c(record.as_bytes()))
}

/// The record in a sealed one; none if a byte of it is not as it was written.
fn opened(sealed: &[u8]) -> Option<&[u8]> {
    let rest = sealed.strip_prefix(BEFORE.as_bytes())?.strip_suffix(AFTER.as_bytes())?;
    let (rest, checksum) = rest.split_at_checked(rest.len().checked_sub(DIGITS)?)?;
    let record = rest.strip_suffix(BETWEEN.as_bytes())?;
    (format!("{:08x}", crc32c::crc32c(record)).as_bytes() == checksum).then_some(record)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct StoredFile {
    bytes: u64,
    crc32c: u32,
}

impl Record {
    /// The name of the record's file in the store.
    pub fn key(shard: Shard) -> String {
        format!(".isophote/shards/{shard}.json")
    }

    /// Writes a rendered shard and then its record. Before each channel it asks whether to continue.
    pub fn make(
        files: &Files,
        arrays: &[ChannelArray],
        plan: Plan,
        shard: Shard,
        map: &Map,
        go_on: &dyn Fn() -> Result<(), StoreError>,
    ) -> Result<(), StoreError> {
        let mut stored = Vec::with_capacity(arrays.len());
        for array in arrays {
            go_on()?;
            let channel = map.channel(&array.quantity).filter(|_| !map.mask().runs().is_empty());
            let bytes = channel.map(|channel| array.encode(channel, map.region)).transpose()?.flatten();
            match &bytes {
                Some(bytes) => files.put(&array.key(shard), bytes)?,
                None => files.remove(&array.key(shard))?,
            }
            stored.push(bytes.map(|bytes| StoredFile { bytes: bytes.len() as u64, crc32c: crc32c::crc32c(&bytes) }));
        }
        let quantities: Vec<_> = arrays.iter().map(|array| array.quantity.clone()).collect();
        let preview = quantities.first().map(|main| Boxes::new(plan.full).part(map, main));
        let record = Self {
            files: stored,
            statistics: ShardStatistics::of(map, &quantities),
            preview: preview.unwrap_or_default(),
        };
        let path = files.path(&Self::key(shard));
        let json = serde_json::to_string(&record).map_err(|error| StoreError::Write { path, reason: error.into() })?;
        files.put(&Self::key(shard), sealed(&json).as_bytes())
    }

    /// The record of a shard whose files all exist and have the recorded lengths.
    pub fn read(files: &Files, arrays: &[ChannelArray], shard: Shard) -> Result<Result<Self, Damage>, StoreError> {
        let damage = |place, reason| Ok(Err(Damage { place, reason }));
        let key = Self::key(shard);
        let Some(json) = files.get(&key)? else { return damage(format!("shard {shard}"), message!("is not computed")) };
        let Some(json) = opened(&json) else { return damage(key, message!("is damaged: its checksum is wrong")) };
        let Ok(record) = serde_json::from_slice::<Self>(json) else { return damage(key, message!("is damaged")) };
        if record.files.len() != arrays.len() {
            return damage(key, message!("is of another map"));
        }
        for (array, stored) in arrays.iter().zip(&record.files) {
            let key = array.key(shard);
            match (files.length(&key), stored.map(|stored| stored.bytes)) {
                (found, expected) if found == expected => {}
                (None, _) => return damage(key, message!("is missing")),
                (Some(_), None) => return damage(key, message!("should not be there: nothing is seen in it")),
                (Some(found), Some(expected)) => {
                    return damage(key, message!("has {found} bytes in place of {expected}", found, expected));
                }
            }
        }
        Ok(Ok(record))
    }

    /// What is wrong with the content of the shard's files, if anything.
    pub fn check(&self, files: &Files, arrays: &[ChannelArray], shard: Shard) -> Result<Option<Damage>, StoreError> {
        for (array, stored) in arrays.iter().zip(&self.files) {
            let Some(stored) = stored else { continue };
            let file = array.key(shard);
            let bytes = files.get(&file)?.unwrap_or_default();
            let found = crc32c::crc32c(&bytes);
            let expected = stored.crc32c;
            let reason = if found == expected {
                array.check(&bytes).err().map(|reason| message!("cannot be decoded: {reason}", reason))
            } else {
                Some(message!(
                    "has the checksum {found} in place of {expected}",
                    found = format!("{found:08x}"),
                    expected = format!("{expected:08x}")
                ))
            };
            if let Some(reason) = reason {
                return Ok(Some(Damage { place: file, reason }));
            }
        }
        Ok(None)
    }

    /// Removes the record of a shard, so that the shard is computed again.
    pub fn forget(files: &Files, shard: Shard) -> Result<(), StoreError> {
        files.remove(&Self::key(shard))
    }
}
