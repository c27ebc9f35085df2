//! Under which conditions a rule's claims hold, and what breaks them without.

use crate::inputs::Input;
use crate::run::Setting;
use crate::subjects::{Given, Item};

/// λ = 0.95, P₀ = 10 I and the default parameters.
pub fn usual(input: Input) -> Setting {
    Setting { given: Given::default(), factor: 0.95, variance: 10.0, input, error: 1.0 }
}

fn with(name: &'static str, item: Item, setting: Setting) -> Setting {
    Setting { given: Given::one(name, item), ..setting }
}

/// Makes the condition of a rule's claim hold, where it is not one on λ or on the regressors.
pub fn holding(name: &str, setting: Setting) -> Setting {
    match name {
        // R₀ = 0.1 I, above the default information 0.01 I
        "exponential_resetting" | "matrix_forgetting" => setting,
        // P₀ below P_∞ = 100 I; without a rule between the resets P only shrinks
        "covariance_resetting" => setting,
        // (1 − λ₁)(1 − λ₂)… is large: hardly anything is kept that could be correlated
        "multiple" => with("factors", Item::Real(0.05), setting),
        _ => setting,
    }
}

/// A setting in which the rule is not proper.
pub fn improper(name: &str) -> Option<Setting> {
    let exciting = usual(Input::Exciting(1));
    Some(match name {
        // R₀ = 0.1 I below R_∞ = I
        "exponential_resetting" | "matrix_forgetting" => {
            with("information", Item::Real(1.0), exciting)
        }
        // what is inserted at the start of a cycle is due at its end
        "cyclic_resetting" => Setting { variance: 100.0, ..usual(Input::Silent) },
        // P₀ above P_∞
        "covariance_resetting" => Setting {
            given: Given(vec![("covariance", Item::Real(1.0)), ("period", Item::Real(1.0))]),
            ..usual(Input::Silent)
        },
        "multiple" => usual(Input::Correlated),
        // the trace is held by taking from the directions without data
        "constant_trace" => usual(Input::Fixed),
        _ => return None,
    })
}

/// A setting without excitation in which P̄ grows without bound, or beyond 1000 P₀ and further
/// with a more extreme input.
pub fn growing(name: &str) -> Option<Setting> {
    let zero_information =
        with("information", Item::Real(0.0), Setting { factor: 0.99, ..usual(Input::Silent) });
    Some(match name {
        "exponential" | "component" | "multiple" | "variable_direction" => usual(Input::Fixed),
        "exponential_resetting" | "cyclic_resetting" => zero_information,
        "random_walk" => with("process_noise", Item::Real(1e4), usual(Input::Silent)),
        "data_dependent" => Setting { error: 1e6, ..usual(Input::Silent) },
        "oblique_projection" => usual(Input::Uneven(1e-4)),
        "restricted" => usual(Input::Fading(1e-6)),
        "directional" => with("threshold", Item::Real(0.0), usual(Input::Fading(1e-6))),
        // λ → 0 is the condition: R̄ is λ R along the regressor
        "subspace" => Setting { factor: 1e-6, ..usual(Input::Exciting(1)) },
        "efra" => Setting { factor: 1e-6, ..usual(Input::Silent) },
        "covariance_resetting" => Setting {
            given: Given(vec![
                ("rule", Item::Word("exponential")),
                ("criterion", Item::Word("trace")),
            ]),
            ..usual(Input::Silent)
        },
        _ => return None,
    })
}

/// A setting with bounded regressors in which P falls without bound.
pub fn vanishing(name: &str) -> Option<Setting> {
    let never = |input| Setting { factor: 1.0, ..usual(input) };
    Some(match name {
        "none" => usual(Input::Exciting(1)),
        // λ ≤ λ_max < 1 is the condition
        "exponential"
        | "exponential_resetting"
        | "cyclic_resetting"
        | "subspace"
        | "directional"
        | "component"
        | "matrix_forgetting" => never(Input::Exciting(1)),
        "multiple" => with("factors", Item::Real(1.0), usual(Input::Exciting(1))),
        "oblique_projection" | "variable_direction" => {
            with("threshold", Item::Real(2.0), usual(Input::Exciting(1)))
        }
        "restricted" => usual(Input::Alternating),
        "random_walk" => with("process_noise", Item::Real(0.0), usual(Input::Exciting(1))),
        // never reset, and `none` between
        "covariance_resetting" => Setting {
            given: Given(vec![
                ("criterion", Item::Word("trace")),
                ("threshold", Item::Real(1e-12)),
            ]),
            ..usual(Input::Exciting(1))
        },
        // the condition is that regressors are bounded: these are as large as can be
        "data_dependent" | "constant_trace" | "efra" => usual(Input::Scaled(1e6)),
        _ => return None,
    })
}
