//! Every kind, and how one is found by name.

use crate::kind::{Kind, Saving, View, Whole};
use crate::model::bank::Bank;
use crate::model::compact::{
    Directional, Exponential, Named, NoForgetting, Of, RandomWalk, Subspace,
};
#[cfg(feature = "general")]
use crate::model::general::General;
use core::ffi::{c_char, CStr};

macro_rules! kinds {
    ($($Rule:ident $rule:literal [$($n:literal)*];)*) => {
        const COMPACT: &[(&str, &Kind)] = &[$($(
            {
                #[export_name = concat!("fg_", $rule, "_f32_", $n)]
                static KIND: Kind = Kind::of::<Of<$Rule, f32, $n>>(Saving::F32(View::of::<Of<$Rule, f32, $n>>()));
                ($Rule::NAME, &KIND)
            },
            {
                #[export_name = concat!("fg_", $rule, "_f64_", $n)]
                static KIND: Kind = Kind::of::<Of<$Rule, f64, $n>>(Saving::F64(View::of::<Of<$Rule, f64, $n>>()));
                ($Rule::NAME, &KIND)
            },
        )*)*];
    };
}

// one line for each rule: its type, its name, and the numbers of parameters that it is compiled for
kinds! {
    NoForgetting "none" [1 2 3 4 5 6 7 8];
    Exponential "exponential" [1 2 3 4 5 6 7 8];
    Subspace "subspace" [1 2 3 4 5 6 7 8];
    Directional "directional" [1 2 3 4 5 6 7 8];
    RandomWalk "random_walk" [1 2 3 4 5 6 7 8];
}

macro_rules! banks {
    ($Bank:ident $name:literal [$($n:literal)*];) => {
        const BANKS: &[(&str, &Kind)] = &[$(
            {
                #[export_name = concat!("fg_", $name, "_f32_", $n)]
                static KIND: Kind = Kind::of::<$Bank<f32, $n>>(Saving::Whole(Whole::of::<$Bank<f32, $n>>()));
                ($name, &KIND)
            },
            {
                #[export_name = concat!("fg_", $name, "_f64_", $n)]
                static KIND: Kind = Kind::of::<$Bank<f64, $n>>(Saving::Whole(Whole::of::<$Bank<f64, $n>>()));
                ($name, &KIND)
            },
        )*];
    };
}

// the default bank
banks! {
    Bank "bank" [1 2 3 4 5 6 7 8];
}

macro_rules! general {
    ($($name:ident: $T:ty, $n:literal;)*) => {
        $(
            #[doc = concat!("Any rule, up to ", $n, " parameters.")]
            #[cfg(feature = "general")]
            #[no_mangle]
            pub static $name: Kind = Kind::of::<General<$T, $n>>(Saving::Whole(Whole::of::<General<$T, $n>>()));
        )*

        #[cfg(feature = "general")]
        const GENERAL: &[&Kind] = &[$(&$name,)*];
        #[cfg(not(feature = "general"))]
        const GENERAL: &[&Kind] = &[];
    };
}

general! {
    fg_general_f32_8: f32, 8;
    fg_general_f64_8: f64, 8;
    fg_general_f64_32: f64, 32;
}

/// The compact kind of the rule called `rule`, or the bank, or, where that is null, the smallest kind for any rule;
/// null if there is none.
///
/// # Safety
/// `rule` is null or ended by a zero.
#[no_mangle]
pub unsafe extern "C" fn fg_find(
    rule: *const c_char,
    number: i32,
    parameters: usize,
) -> *const Kind {
    let fits = |kind: &Kind| {
        let (least, most) = kind.parameters;
        kind.number as i32 == number && (least..=most).contains(&parameters)
    };
    let found = if rule.is_null() {
        GENERAL.iter().copied().find(|kind| fits(kind))
    } else {
        // SAFETY: as above.
        let rule = unsafe { CStr::from_ptr(rule) }.to_str();
        let is_it = |(name, kind): &&(&str, &Kind)| Ok(*name) == rule && fits(kind);
        COMPACT.iter().chain(BANKS).find(is_it).map(|(_, kind)| *kind)
    };
    found.map_or(core::ptr::null(), |kind| kind)
}
