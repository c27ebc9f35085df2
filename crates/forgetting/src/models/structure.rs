//! The structures that have a name.

/// A structure: which polynomials a model has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Structure {
    /// its name
    pub name: &'static str,
    /// what the name stands for
    pub title: &'static str,
    /// the orders that are chosen, in their order; the others are 0
    pub orders: &'static [&'static str],
    /// when to use it, in one sentence
    pub purpose: &'static str,
}

impl Structure {
    /// Whether its regressors need nothing but measured values, so that it is linear in θ.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        !self.orders.iter().any(|order| matches!(*order, "nc" | "nd" | "nf"))
    }

    /// Whether it has inputs.
    #[must_use]
    pub fn has_inputs(&self) -> bool {
        self.orders.contains(&"nb")
    }
}

/// All structures, from the simplest on.
pub const STRUCTURES: [Structure; 7] = [
    Structure {
        name: "fir",
        title: "finite impulse response",
        orders: &["nb", "nk"],
        purpose: "an echo path or any other response that dies out: never unstable, often long",
    },
    Structure {
        name: "ar",
        title: "autoregression",
        orders: &["na"],
        purpose: "a signal without a measured input that follows its own past",
    },
    Structure {
        name: "arx",
        title: "autoregression with inputs",
        orders: &["na", "nb", "nk"],
        purpose: "noise that passes through the same poles as the inputs; the one to begin with",
    },
    Structure {
        name: "arma",
        title: "autoregression, moving average of the noise",
        orders: &["na", "nc"],
        purpose: "a signal without a measured input whose noise is not white",
    },
    Structure {
        name: "armax",
        title: "autoregression with inputs, moving average of the noise",
        orders: &["na", "nb", "nc", "nk"],
        purpose: "disturbances that enter with the inputs; ARX is biased where they are not white",
    },
    Structure {
        name: "oe",
        title: "output error",
        orders: &["nb", "nf", "nk"],
        purpose: "noise of the sensor alone: the model that simulates best",
    },
    Structure {
        name: "bj",
        title: "Box and Jenkins",
        orders: &["nb", "nc", "nd", "nf", "nk"],
        purpose: "noise with poles of its own",
    },
];
