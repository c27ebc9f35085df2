//! What an estimator is when nothing is said, in every language.

/// The rule when none is named and P₀ is given, in units of the user.
pub const RULE: &str = "subspace";
/// The rule when neither it nor P₀ nor a forgetting factor is given, with [`PROCESS_NOISE`] and the bound
/// [`DIFFUSE`](crate::DIFFUSE).
pub const RULE_OF_DATA: &str = "random_walk";
/// Process noise of [`RULE_OF_DATA`]: parameters that are remembered over some twenty samples each. On
/// open records a larger one predicts a little better, and a noisy constant is then followed worse.
pub const PROCESS_NOISE: f64 = 3e-3;
/// λ when none is given, of a rule that uses it.
pub const FORGETTING_FACTOR: f64 = 0.99;
