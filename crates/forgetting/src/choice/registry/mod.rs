//! The registry of an axis, made from one line an entry: its files, the list of its entries, and
//! a type that is any of them, chosen by name at run time.
//!
//! ```text
//! registry! {
//!     "gate", "gates", GATES, AnyGate: Gate {        the axis, its list, its type and its trait,
//!         fn is_open(&self) -> bool;                 with the methods that the type passes on
//!     }
//!     entries { open::Open, dead_zone::DeadZone, }   a file and the type in it
//! }
//! ```
//!
//! `AnyRate [AnyRateState]` also makes the type of any state; in a method, `State` stands for it.
//! `around` lists entries that take another entry as a parameter, and makes the type of those
//! that they take; `also` are methods that both types write themselves.
//!
//! A macro can repeat over the entries or over the methods, not over both. So the entries travel as
//! one token, `[{...} {...}]`, and each method goes with all of them to a macro of its own.

mod any;
mod methods;

pub(crate) use any::{any, any_state, any_type, described, started};
pub(crate) use methods::{ask, call, pass_on, Mismatch};

macro_rules! registry {
    (
        $axis:literal, $plural:literal, $LIST:ident, $Any:ident $([$State:ident])?: $Trait:ident
        $methods:tt
        entries $entries:tt
    ) => {
        $crate::choice::registry::modules! { $axis $plural $LIST [$entries] }
        $crate::choice::registry::any! {
            $axis $Any [$($State)?] $Trait $methods {} [$entries]
        }
    };
    (
        $axis:literal, $plural:literal, $LIST:ident, $Any:ident [$State:ident]: $Trait:ident
        $methods:tt
        entries $entries:tt
        around $Inner:ident [$InnerState:ident] $around:tt
        also $also:tt
    ) => {
        $crate::choice::registry::modules! { $axis $plural $LIST [$entries $around] }
        $crate::choice::registry::any! {
            $axis $Any [$State] $Trait $methods $also [$entries $around]
        }
        $crate::choice::registry::any! {
            $axis $Inner [$InnerState] $Trait $methods $also [$entries]
        }
    };
}

/// The files, and the list of what they say of themselves.
macro_rules! modules {
    (
        $axis:literal $plural:literal $LIST:ident
        [$({$($(#[$only:meta])* $module:ident :: $Choice:ident,)*})*]
    ) => {
        $($(
            $(#[$only])*
            pub mod $module;
            $(#[$only])*
            pub use $module::$Choice;
        )*)*

        #[doc = concat!("Every ", $axis, ": its name, parameters and documentation.")]
        pub const $LIST: &[$crate::choice::About] =
            &[$($($(#[$only])* $crate::choice::registry::entry!($module $Choice),)*)*];

        #[doc = concat!("What a ", $axis, " is, and every one.")]
        pub const AXIS: $crate::choice::Axis = $crate::choice::Axis {
            name: $axis,
            plural: $plural,
            source: $crate::choice::registry::header!("mod.rs"),
            entries: $LIST,
        };
    };
}

/// What a file says of its choice, with the names and the text.
macro_rules! entry {
    ($module:ident $Choice:ident) => {
        $crate::choice::About {
            name: stringify!($module),
            type_name: stringify!($Choice),
            source: $crate::choice::registry::header!(concat!(stringify!($module), ".rs")),
            ..$module::ABOUT
        }
    };
}

/// The header of a file, in bytes of its own: of the rest of the file nothing gets into the program.
macro_rules! header {
    ($file:expr) => {{
        const FILE: &str = include_str!($file);
        const HEADER: [u8; $crate::choice::about::header_length(FILE)] =
            $crate::choice::about::copy_of(FILE);
        $crate::choice::about::text_of(&HEADER)
    }};
}

pub(crate) use {entry, header, modules, registry};
