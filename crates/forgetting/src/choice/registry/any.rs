//! The type that is any entry of a registry, and that of its state.

/// The type that is any of the entries.
macro_rules! any {
    (
        $axis:literal $Any:ident $state:tt $Trait:ident
        {$($(#[$attribute:meta])* fn $method:ident $arguments:tt $(-> $Output:ty)?;)*}
        {$($also:tt)*}
        $entries:tt
    ) => {
        $crate::choice::registry::any_type! { $axis $Any $Trait $entries }
        $crate::choice::registry::any_state! { $state $Trait $entries }

        impl<M: $crate::memory::Memory> $Trait<M> for $Any<M> {
            $($also)*
            $crate::choice::registry::described! { $axis $Trait $state $entries }
            $(
                $crate::choice::registry::pass_on! {
                    $(#[$attribute])* $Trait $state $entries
                    fn $method $arguments $(-> $Output)?
                }
            )*
        }
    };
}

/// Its variants, and how it is made by name.
macro_rules! any_type {
    (
        $axis:literal $Any:ident $Trait:ident
        [$({$($(#[$only:meta])* $module:ident :: $Choice:ident,)*})*]
    ) => {
        #[doc = concat!("Any ", $axis, " of the registry, chosen by name at run time.")]
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "each variant is the choice of that name")]
        pub enum $Any<M: $crate::memory::Memory> {
            $($($(#[$only])* $Choice($Choice<M>),)*)*
        }

        impl<M: $crate::memory::Memory> $Any<M> {
            #[doc = concat!("The ", $axis, " called `name`, with these parameter values.")]
            ///
            /// # Errors
            /// [`Error::Unknown`](crate::Error::Unknown) for a name that is not in the registry,
            /// [`Error::Value`](crate::Error::Value) for more rows than it takes, else its own.
            pub fn named(
                name: &str,
                values: &dyn $crate::choice::Values,
                memory: M,
            ) -> Result<Self, $crate::error::Error> {
                match name {
                    $($($(#[$only])* stringify!($module) => {
                        $module::ABOUT.check_rows(memory.rows())?;
                        <$Choice<M> as $Trait<M>>::configure(values, memory).map(Self::$Choice)
                    })*)*
                    _ => Err($crate::error::Error::Unknown { parameter: $axis }),
                }
            }

            /// Its name in the registry.
            pub fn called(&self) -> &'static str {
                match self {
                    $($($(#[$only])* Self::$Choice(_) => stringify!($module),)*)*
                }
            }

            /// What the file of the one called `name` says of it, without the names and the text that
            /// the registry adds: these would be in every program that looks here.
            pub fn entry(name: &str) -> Option<&'static $crate::choice::About> {
                match name {
                    $($($(#[$only])* stringify!($module) => Some(const { &$module::ABOUT }),)*)*
                    _ => None,
                }
            }

            /// What the registry says of it.
            pub fn about(&self) -> &'static $crate::choice::About {
                match self {
                    $($($(#[$only])* Self::$Choice(_) => {
                        const ABOUT: &$crate::choice::About =
                            &$crate::choice::registry::entry!($module $Choice);
                        ABOUT
                    })*)*
                }
            }
        }
    };
}

/// The type of its state; none where the trait of the axis has no state.
macro_rules! any_state {
    ([] $Trait:ident $entries:tt) => {};
    (
        [$State:ident] $Trait:ident
        [$({$($(#[$only:meta])* $module:ident :: $Choice:ident,)*})*]
    ) => {
        /// The state of any of them.
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "each variant is the state of the choice of that name")]
        pub enum $State<M: $crate::memory::Memory> {
            $($($(#[$only])* $Choice(<$Choice<M> as $Trait<M>>::State),)*)*
        }

        impl<M: $crate::memory::Memory> $crate::memory::state::State<M::Real> for $State<M> {
            fn visit(&mut self, visitor: &mut dyn $crate::memory::state::Visitor<M::Real>) {
                match self {
                    $($($(#[$only])* Self::$Choice(state) => {
                        $crate::memory::state::State::<M::Real>::visit(state, visitor)
                    })*)*
                }
            }

            fn is_sound(&self) -> bool {
                match self {
                    $($($(#[$only])* Self::$Choice(state) => {
                        $crate::memory::state::State::<M::Real>::is_sound(state)
                    })*)*
                }
            }
        }
    };
}

/// What every trait of an axis has: configuration by values, description, and the first state.
macro_rules! described {
    (
        $axis:literal $Trait:ident $state:tt
        [$({$($(#[$only:meta])* $module:ident :: $Choice:ident,)*})*]
    ) => {
        fn configure(_: &dyn $crate::choice::Values, _: M) -> Result<Self, $crate::error::Error> {
            Err($crate::error::Error::Missing { parameter: $axis })
        }

        fn describe(&self, each: &mut dyn FnMut(&'static str, $crate::choice::Value<'_>)) {
            match self {
                $($($(#[$only])* Self::$Choice(choice) => $Trait::<M>::describe(choice, each),)*)*
            }
        }

        $crate::choice::registry::started! {
            $Trait $state [$({$($(#[$only])* $module :: $Choice,)*})*]
        }
    };
}

/// The first state, where the trait of the axis has one.
macro_rules! started {
    ($Trait:ident [] $entries:tt) => {};
    (
        $Trait:ident [$State:ident]
        [$({$($(#[$only:meta])* $module:ident :: $Choice:ident,)*})*]
    ) => {
        type State = $State<M>;

        fn start(&self, memory: M) -> $State<M> {
            match self {
                $($($(#[$only])* Self::$Choice(choice) => {
                    $State::$Choice($Trait::<M>::start(choice, memory))
                })*)*
            }
        }
    };
}

pub(crate) use {any, any_state, any_type, described, started};
