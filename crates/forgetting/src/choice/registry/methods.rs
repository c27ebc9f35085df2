//! The methods of the type that is any entry: each asks the entry that it is.

use crate::error::Error;

/// A method that passes on to the choice that it is, with the state of that choice if it has one.
macro_rules! pass_on {
    (
        $(#[$attribute:meta])* $Trait:ident [$State:ident] $entries:tt
        fn $method:ident(&self, state: &mut State $(, $name:ident: $Type:ty)* $(,)?)
        $(-> $Output:ty)?
    ) => {
        $(#[$attribute])*
        fn $method(&self, state: &mut $State<M> $(, $name: $Type)*) $(-> $Output)? {
            $crate::choice::registry::ask! {
                $Trait $State $entries $method self state ($($name),*)
            }
        }
    };
    (
        $(#[$attribute:meta])* $Trait:ident [$State:ident] $entries:tt
        fn $method:ident(&self, state: &State $(, $name:ident: $Type:ty)* $(,)?)
        $(-> $Output:ty)?
    ) => {
        $(#[$attribute])*
        fn $method(&self, state: &$State<M> $(, $name: $Type)*) $(-> $Output)? {
            $crate::choice::registry::ask! {
                $Trait $State $entries $method self state ($($name),*)
            }
        }
    };
    (
        $(#[$attribute:meta])* $Trait:ident $state:tt $entries:tt
        fn $method:ident(&self $(, $name:ident: $Type:ty)* $(,)?) $(-> $Output:ty)?
    ) => {
        $(#[$attribute])*
        fn $method(&self $(, $name: $Type)*) $(-> $Output)? {
            $crate::choice::registry::ask! { $Trait $entries $method self ($($name),*) }
        }
    };
}

/// The same method of the choice that `self` is.
macro_rules! ask {
    (
        $Trait:ident
        [$({$($(#[$only:meta])* $module:ident :: $Choice:ident,)*})*]
        $method:ident $self:ident $arguments:tt
    ) => {
        match $self {
            $($($(#[$only])* Self::$Choice(choice) => {
                $crate::choice::registry::call!($Trait $method (choice) $arguments)
            })*)*
        }
    };
    (
        $Trait:ident $State:ident
        [$({$($(#[$only:meta])* $module:ident :: $Choice:ident,)*})*]
        $method:ident $self:ident $state:ident $arguments:tt
    ) => {
        match ($self, $state) {
            $($($(#[$only])* (Self::$Choice(choice), $State::$Choice(state)) => {
                $crate::choice::registry::call!($Trait $method (choice, state) $arguments)
            })*)*
            _ => $crate::choice::registry::Mismatch::mismatch(),
        }
    };
}

/// The call itself: the choice, its state if it has one, then the arguments.
macro_rules! call {
    ($Trait:ident $method:ident ($($first:ident),*) ($($name:ident),*)) => {
        $Trait::<M>::$method($($first,)* $($name),*)
    };
}

pub(crate) use {ask, call, pass_on};

/// What a choice answers when it gets the state of another: nothing, or an error.
pub(crate) trait Mismatch {
    fn mismatch() -> Self;
}

impl Mismatch for () {
    fn mismatch() {}
}

impl<T> Mismatch for Result<T, Error> {
    fn mismatch() -> Self {
        Err(Error::State { reason: "the state is that of another choice" })
    }
}
