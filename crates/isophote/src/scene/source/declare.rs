//! A table of scene files is declared once: its structure, its schema and its reading come of the same lines.

use std::collections::BTreeMap;

use super::{Amount, EmissionName, ProjectionName, ShadowSource};
use crate::camera::Handedness;
use crate::color::ColorSpace;
use crate::import::Origin;
use crate::reflectance::Convention;
use crate::scene::Filter;
use crate::scene::table::Table;
use crate::shape::Side;
use crate::units::{LengthUnit, UnitSystem};

/// Declares tables: structures whose public fields are [`Field`]s, with the schema's attributes. The key is the name of the
/// field, or stands after it: `cuboid as "box"`.
macro_rules! tables {
    ($(
        $(#[$about:meta])*
        pub struct $name:ident {
            $( $(#[$attribute:meta])* pub $field:ident $(as $key:literal)?: $kind:ty, )*
        }
    )*) => { $(
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, schemars::JsonSchema)]
        $(#[$about])*
        pub struct $name {
            $(
                $(#[$attribute])*
                $(#[serde(rename = $key)])?
                #[serde(skip_serializing_if = "crate::scene::source::declare::Field::is_absent")]
                pub $field: $kind,
            )*
        }

        impl crate::scene::source::declare::TableSource for $name {
            fn read(table: &mut crate::scene::table::Table<'_>) -> Self {
                use crate::scene::source::declare::{Field, key};
                Self { $( $field: Field::read(table, key!($field $($key)?)), )* }
            }
        }

        impl crate::scene::source::declare::Written for $name {
            fn read(table: &mut crate::scene::table::Table<'_>, key: &'static str) -> Option<Self> {
                table.table(key, <Self as crate::scene::source::declare::TableSource>::read)
            }
        }
    )* };
}
pub(super) use tables;

macro_rules! key {
    ($field:ident) => {
        stringify!($field)
    };
    ($field:ident $key:literal) => {
        $key
    };
}
pub(super) use key;

/// A structure that is a table of scene files.
pub trait TableSource: Default {
    /// Takes the keys that it has.
    fn read(table: &mut Table<'_>) -> Self;
}

/// What may be written for a key.
pub trait Written: Sized {
    /// What is written for it; nothing where nothing is, or something else.
    fn read(table: &mut Table<'_>, key: &'static str) -> Option<Self>;
}

/// A field of a table.
pub trait Field {
    /// What the table has for its key.
    fn read(table: &mut Table<'_>, key: &'static str) -> Self;

    /// Whether it has nothing.
    fn is_absent(&self) -> bool;
}

impl<T: Written> Field for Option<T> {
    fn read(table: &mut Table<'_>, key: &'static str) -> Self {
        T::read(table, key)
    }

    fn is_absent(&self) -> bool {
        self.is_none()
    }
}

impl<T: TableSource> Field for Vec<T> {
    fn read(table: &mut Table<'_>, key: &'static str) -> Self {
        table.tables(key, T::read)
    }

    fn is_absent(&self) -> bool {
        self.is_empty()
    }
}

impl<T: TableSource> Field for BTreeMap<String, T> {
    fn read(table: &mut Table<'_>, key: &'static str) -> Self {
        table.named_tables(key, T::read)
    }

    fn is_absent(&self) -> bool {
        self.is_empty()
    }
}

impl Field for ShadowSource {
    /// Its keys stand among the shape's own.
    fn read(table: &mut Table<'_>, _: &'static str) -> Self {
        TableSource::read(table)
    }

    fn is_absent(&self) -> bool {
        false
    }
}

impl Field for Origin {
    /// Nothing of it is written.
    fn read(_: &mut Table<'_>, _: &'static str) -> Self {
        Self::default()
    }

    fn is_absent(&self) -> bool {
        true
    }
}

macro_rules! written {
    ($( $kind:ty: $method:ident, )*) => { $(
        impl Written for $kind {
            fn read(table: &mut Table<'_>, key: &'static str) -> Option<Self> {
                table.$method(key)
            }
        }
    )* };
}

written! {
    String: text,
    bool: boolean,
    f64: number,
    u64: count,
    [f64; 2]: numbers,
    [f64; 3]: numbers,
    [[f64; 3]; 3]: matrix,
    Vec<[f64; 3]>: rows,
    Vec<[u64; 3]>: rows_of_counts,
    [u64; 2]: counts,
    Amount: amount,
    LengthUnit: keyword,
    Handedness: keyword,
    Convention: keyword,
    UnitSystem: keyword,
    ColorSpace: keyword,
    ProjectionName: keyword,
    Filter: keyword,
    EmissionName: keyword,
    Side: keyword,
}
