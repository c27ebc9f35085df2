//! The loops over U: one file per operation, on plain slices.
//!
//! `columns` holds the columns of U in tiles ([`layout::place`] says where a number is); every inner
//! loop runs along columns, over neighbouring numbers.
//!
//! Each loop is a [`Kernel`]: it is written over any vector type and any number of columns at a
//! time, and the bits of the result depend on neither. A number type chooses both ([`Dispatch`])
//! and compiles all loops once ([`Kernels`]).
//!
//! What may be assumed in here, and what must not be written, is in `README.md` of this crate.

/// Calls `$function::<.., N>` with a number N of parameters, 1 to 8, as a constant.
macro_rules! with_width {
    ($n:expr, $function:ident::<$($T:ident),+>$arguments:tt) => {
        match $n {
            1 => $function::<$($T,)+ 1>$arguments,
            2 => $function::<$($T,)+ 2>$arguments,
            3 => $function::<$($T,)+ 3>$arguments,
            4 => $function::<$($T,)+ 4>$arguments,
            5 => $function::<$($T,)+ 5>$arguments,
            6 => $function::<$($T,)+ 6>$arguments,
            7 => $function::<$($T,)+ 7>$arguments,
            _ => $function::<$($T,)+ 8>$arguments,
        }
    };
}

/// The same for 1 to 10.
macro_rules! with_few {
    ($n:expr, $function:ident::<$($T:ident),+>$arguments:tt) => {
        match $n {
            9 => $function::<$($T,)+ 9>$arguments,
            10 => $function::<$($T,)+ 10>$arguments,
            n => with_width!(n, $function::<$($T),+>$arguments),
        }
    };
}

pub mod agee_turner;
mod along;
mod batch;
mod bierman;
pub mod compact;
mod copies;
pub mod dispatch;
pub mod eigen;
pub mod form;
pub mod functions;
#[macro_use]
pub mod kernels;
pub mod lanes;
pub mod layout;
pub mod measure;
pub mod measured;
pub mod outcome;
mod registers;
pub mod runs;
mod scratch;
pub mod symmetric;
mod tiles;
mod together;
pub mod triangle;
pub mod units;
pub mod variances;
pub mod vectors;
pub mod watch;

pub use dispatch::{Dispatch, Kernel, Portable};
pub use kernels::Kernels;
pub use scratch::scratch;

/// Compiles the kernels of a number type with the instructions of the compiler's target, in a module of
/// their own: the compiler makes units of code of whole modules, and two units are compiled side by
/// side.
macro_rules! compile_portable {
    ($module:ident, $float:ident) => {
        mod $module {
            use crate::kernel::dispatch::{Dispatch, Kernel};
            use crate::kernel::layout::COMPACT;
            use crate::number::Real;

            struct Unit;

            impl Dispatch<$float> for Unit {
                // a function for each kernel: in one function they would compile for minutes
                #[inline(never)]
                fn run<K: Kernel<$float>>(kernel: K) -> K::Output {
                    kernel.run::<<$float as Real>::Lanes, {
                        if COMPACT {
                            1
                        } else {
                            2
                        }
                    }>()
                }
            }

            #[cfg(not(feature = "on-demand"))]
            compile_kernels!($float, Unit);
            #[cfg(feature = "on-demand")]
            compile_kernels!($float, Unit, #[inline]);
        }
    };
}
compile_portable!(double, f64);
compile_portable!(float, f32);
