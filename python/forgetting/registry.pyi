# Written by tools/stubs.py from the registries of the core: do not edit.
# ruff: noqa: E501 (headers as they stand in the rule files)

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import Evidence
from .choices import ForgettingFactor, Gate, Mixer, Rate, Rule, Weighting

__all__ = [
    "Best",
    "Component",
    "Constant",
    "ConstantTrace",
    "CovarianceResetting",
    "Custom",
    "CyclicResetting",
    "DataDependent",
    "DeadZone",
    "Directional",
    "DynamicModelAveraging",
    "Efra",
    "Equal",
    "ExactGradient",
    "Exponential",
    "ExponentialResetting",
    "FTest",
    "Fortescue",
    "Function",
    "Gate",
    "GateFunction",
    "Gradient",
    "Huber",
    "MatrixForgetting",
    "MinimumInformation",
    "Mixer",
    "Mlpol",
    "Multiple",
    "NoForgetting",
    "NoisePower",
    "ObliqueProjection",
    "Open",
    "PredictionError",
    "RandomWalk",
    "Rate",
    "Restricted",
    "RmsRatio",
    "Rule",
    "Schedule",
    "Stabilised",
    "StudentT",
    "Subspace",
    "UnityZone",
    "VariableDirection",
    "Weighting",
    "gate",
    "gates",
    "mixer",
    "mixers",
    "rate",
    "rates",
    "rule",
    "rules",
    "weighting",
    "weightings",
]

def rule(name: str, **parameters: Any) -> Rule: ...
def rules() -> list[dict[str, Any]]: ...

def rate(name: str, **parameters: Any) -> Rate: ...
def rates() -> list[dict[str, Any]]: ...

def weighting(name: str, **parameters: Any) -> Weighting: ...
def weightings() -> list[dict[str, Any]]: ...

def gate(name: str, **parameters: Any) -> Gate: ...
def gates() -> list[dict[str, Any]]: ...

def mixer(name: str, **parameters: Any) -> Mixer: ...
def mixers() -> list[dict[str, Any]]: ...

class Best(Mixer):
    """Believes the member with the smallest discounted sum of squared errors, and no other.

    ```text
    s_i ← α s_i + e_i²                 w_i = 1 for the smallest s_i, shared where several are
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | α | discount | (0, 1] | 0.99 |

    - Cost: O(K p m). State: K numbers.
    - Use it to see which member fits when. As a predictor it jumps from member to member where two
      are alike: `mlpol` is seldom worse.
    - Not to predict, where members are alike.

    Reference: the rule of follow the leader; N. Cesa-Bianchi, G. Lugosi, *Prediction, Learning, and
    Games*, Cambridge University Press, 2006.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        discount: float = 0.99,
    ) -> None: ...

class Component(Rule):
    """Forgets each parameter, or each block of parameters, at a rate of its own.

    ```text
    P̄ = P + blkdiag((1/λ_b − 1) P_bb)        West & Harrison, discounting by component
    F_k = R − P̄⁻¹                            the same as Theorem 1 of GF-RLS has it; the form
                                             used: P_bb = V diag(d) Vᵀ, one dyad for each v; for blocks
                                             of one parameter the part that the sample depends on
    P̄ = P + (1/λ_bᶜ − 1) P_bb, b = k mod c   cyclic: one of the c blocks a sample, for c samples
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | n_b | blocks | sizes of consecutive blocks, whole numbers from 1 that sum to n, or one size for all | 1 |
    | λ_b | factors | (0, 1], one number a block or one for all | the forgetting factor λ_k |
    | | schedule | "every_sample" forgets all blocks at each sample, "cyclic" one block | "every_sample" |

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): no. In silence the variances of block b grow as
      λ_b⁻ᵏ (windup).
    - P bounded below (A3): if λ_b ≤ λ_max < 1 and φ is bounded.
    - Cost: O((p + 1) n²) with blocks of one parameter; O(n³) with larger ones, one dyad for each parameter;
      O(p n²) with one block of all parameters, which is `exponential`; cyclic O((p + n_b) n²) for blocks of n_b.
      State: P, in n²/2 numbers more for blocks of one parameter, and whose turn it is.
    - Use it when parameters are known to drift at different rates. `multiple` drops what the
      blocks know of each other and is rarely proper; this rule keeps it. Use the cyclic schedule
      where n and the blocks are large and λ_bᶜ is not small: in silence P is that of the other after each cycle,
      exactly, and the same is guaranteed. k counts the samples used.

    Reference: M. West, J. Harrison, *Bayesian Forecasting and Dynamic Models*, 2nd edition,
    Springer, 1997, section 6.3.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        blocks: ArrayLike = 1.0,
        factors: ArrayLike | None = None,
        schedule: Literal["every_sample", "cyclic"] = "every_sample",
        *,
        half_life: Any = None,
    ) -> None: ...

class Constant(Rate):
    """The same forgetting factor at every sample.

    ```text
    λ_k = λ
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | λ | forgetting_factor | (0, 1] | 0.99 |

    - The memory is 1/(1 − λ) samples long; after ln(1/2)/ln λ samples (the half-life) a sample
      counts half.
    - Cost: none. State: none.
    - Use it first: it is the one number that the others replace.
    - Not where parameters rest and move in turns: one factor is too noisy for the one or too slow
      for the other.

    Reference: GF-RLS (35).
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: float = 0.99,
    ) -> None: ...

class ConstantTrace(Rule):
    """Holds the trace of P: what the data take away in some directions, all directions get back.

    ```text
    P₊ = P_k − K φ̄ P_k,  K = P_k φ̄ᵀ (I + φ̄ P_k φ̄ᵀ)⁻¹
    P_k+1 = c₁ P₊/tr(P₊) + c₂ I                 c₁ = n (level − floor), c₂ = floor
    ```

    The covariance that the estimator shows is P₊, after the data; the second line is applied
    when the next sample comes, whatever that sample is.

    | symbol | name | range | default |
    |---|---|---|---|
    | tr(P)/n | level | (floor, ∞) | 100 |
    | c₂ | floor | (0, ∞) | 0.01 |

    - Proper (A1): no. It can shrink P: where a direction has less variance than before, the
      rule claims information that no sample brought.
    - P̄ bounded above without excitation (A2): always: floor·I ≤ P̄ ≤ (n·level − (n − 1)·floor) I.
    - P bounded below (A3): if φ is bounded: by min(1/(β + 1/floor), 1/(β + 1/λ_min(P₀))) for
      φ̄ᵀφ̄ ≤ β I.
    - Cost: O((p + 1) n²). State: P, in n²/2 numbers more, and whether the trace is to be held.
    - Use it where tracking must never slow down and noise is small. The gain stays high however
      long the parameters rest.

    Reference: K. J. Åström, B. Wittenmark, *Adaptive Control*, 1995, chapter 11; as a case of
    Theorem 1, derived here.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        level: float = 100.0,
        floor: float = 0.01,
    ) -> None: ...

class CovarianceResetting(Rule):
    """Starts afresh from a given covariance when a criterion is met; else forgets as another rule does.

    ```text
    F_k = R_k − P_∞⁻¹  if the criterion is met        GF-RLS (55)–(57)
    F_k of the rule    if not
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | | rule | any rule but this one, by its name or with its parameters | none |
    | | criterion | period, trace, smallest_eigenvalue, change | period |
    | P_∞ | covariance | a number c > 0 (c·I), n numbers > 0 or an n x n positive definite matrix | 100 |
    | N | period | whole numbers from 1 | 100 |
    | h | threshold | (0, ∞) | 1e-3; 20 for change |
    | d | drift | [0, ∞) | 1 |
    | M | memory | whole numbers from 1 | 100 |

    With k the number of samples used before this one, and P before it is forgotten, the criterion
    is met

    - period: at k = N, 2N, …
    - trace: if tr P < h.
    - smallest_eigenvalue: if that of P is < h, that is, if P − h I is not positive definite.
    - change: if a sum of the squared innovations in excess of what they were passes h (a one-sided
      CUSUM). With u = tr(ēᵀ (I + φ̄ P φ̄ᵀ)⁻¹ ē)/(p m), whose mean is 1 without a change if Γ is right,
      and v the mean of u over the samples before (over the last M or so once there are that many):
      from k = M on, g ← max(0, g + u/v − 1 − d), met if g > h, and then g ← 0. u/v does not depend
      on the scale of the noise. With the defaults and Gaussian noise, one target and one row, a
      false alarm comes about once in 40 000 samples, and innovations whose variance suddenly is
      ten times as large are found after 4 to 5 samples on average.

    At a reset P_∞ is the P that the rule finds: it chooses by it what is measured, and whatever its
    state keeps of P starts anew from it; the rest of its state goes on. A sample that it skips is
    skipped, and the criterion does not see it, nor one that a gate holds or freezes. The
    forgetting factor is the rule's.

    - Proper (A1): if P ≤ P_∞ at every reset and the rule is proper.
    - P̄ bounded above without excitation (A2): if the rule's is.
    - P bounded below (A3): if φ is bounded and the rule's P is; or the rule is proper and the
      criterion is period, by 1/(N β + 1/p), or smallest_eigenvalue, by 1/(β + 1/min(h, p)), for
      φ̄ᵀφ̄ ≤ β I and P₀, P_∞ ≥ p I.
    - Cost: that of the rule; and O(n²/2) for trace, O(p n²/2) for change, O(n³/3) for
      smallest_eigenvalue. State: the rule's, k, g and v.
    - Use it for parameters that jump: `change` with any rule for the time between the jumps.
    - Not for slow drift: a reset throws away what is known, and between resets the other rule has
      to follow.

    Reference: G. C. Goodwin, E. K. Teoh, H. Elliott, *Deterministic convergence of a self-tuning
    regulator with covariance resetting*, IEE Proceedings D 130, 1983; E. S. Page, *Continuous
    inspection schemes*, Biometrika 41, 1954 (CUSUM).
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        rule: Rule | str = "none",
        criterion: Literal["period", "trace", "smallest_eigenvalue", "change"] = "period",
        covariance: ArrayLike = 100.0,
        period: int = 100,
        threshold: float | None = None,
        drift: float = 1.0,
        memory: int = 100,
    ) -> None: ...

class Custom(Rule):
    """Forgets what a function of the user's says: Theorem 1 itself.

    ```text
    F_k = forgetting_matrix(R_k, φ̄_k, ē_k)    R = P⁻¹ n x n, φ̄ p x n and ē p x m, whitened
    R̄ = R − F_k                               GF-RLS (9), (12); refused unless R̄ > 0
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | F_k | forgetting_matrix | a function; its result symmetric, n x n, with R − F > 0 | |

    - Proper (A1): if the function returns F ≥ 0.
    - P̄ bounded above without excitation (A2): if R − F ≥ c I, c > 0.
    - P bounded below (A3): if R − F is bounded, and φ.
    - Cost: O(n³) and the function. State: P alone; with a function of the user's it cannot be
      saved as bytes.
    - Use it to try a rule of your own before writing it as one. A sample for which the function
      fails, or R − F is not positive definite beyond the rounding of R, is refused and changes
      nothing.

    Reference: B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
    stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024,
    Theorem 1.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_matrix: Callable[[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]], ArrayLike],
    ) -> None: ...

class CyclicResetting(Rule):
    """Forgets towards a fixed information matrix, one of its directions at each sample, in O(n²).

    ```text
    R_∞ = Σ_j w_j w_jᵀ, j = 0 … r − 1        the rows of its root; at sample k, j = k mod r:
    v_k = √((1 − λ_kʳ) / λ_kʳ⁻¹⁻ʲ) w_j
    F_k = (1 − λ_k) R_k − v_k v_kᵀ           Lai & Bernstein (CR-RLS)
    R̄ = λ R + v vᵀ                           the form used: D ← D / λ, then one information row
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | R_∞ | information | a number c ≥ 0 (c·I), n numbers ≥ 0 or an n x n positive semidefinite matrix | 0.01 |

    A diagonal R_∞ is taken in the order of its elements, a full one in the order of the pivots
    of Cholesky's factorization with diagonal pivots. k counts the samples used.

    - Proper (A1): no. One cycle without data is R → λʳ R + (1 − λʳ) R_∞ exactly, but within it
      information is added before it is due.
    - P̄ bounded above without excitation (A2): if R_∞ > 0: by 1/(λʳ⁻¹ μ), μ = λ_min(R_∞), for a
      constant λ and P₀ ≤ λʳ⁻¹/μ I. Within a cycle P may exceed 1/μ.
    - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded: P ≥ (1 − λ_max)/(β + v) I once it
      is, for φ̄ᵀφ̄ ≤ β I and v_k v_kᵀ ≤ v I.
    - Cost: O((p + 1) n²). State: P and the place in the cycle.
    - Use it in the place of `exponential_resetting` when n is large. With λ_k that varies within
      a cycle the inserted weights are those of each sample's λ_k, and the cycle is approximate.
    - Not where n is small: `exponential_resetting` then costs little more, and is exact at every
      sample.

    Reference: B. Lai, D. S. Bernstein, *Exponential resetting and cyclic resetting recursive
    least squares*, IEEE Control Systems Letters 7, 2023.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        information: ArrayLike = 0.01,
        *,
        half_life: Any = None,
    ) -> None: ...

class DataDependent(Rule):
    """Weighs each sample by what it can tell given a bound on the noise, and forgets in proportion.

    ```text
    R_{k+1} = (1 − μ_k) R_k + μ_k φ̄_kᵀ φ̄_k         GF-RLS (45)
    θ_{k+1} = θ_k + μ_k P_{k+1} φ̄_kᵀ ē_k           (46)
    F_k = μ_k R_k with Γ_k = I/μ_k                 the form used: D ← D/(1 − μ), φ̄ and ē times √μ
    σ²_{k+1}(μ) = (1 − μ) σ²_k + μ γ² − μ (1 − μ) Σ_i c_i² / (1 − μ + μ w_i)
    ```

    θ is known to lie in {t : (t − θ_k)ᵀ R_k (t − θ_k) ≤ σ²_k}. μ_k in [0, a] makes σ²_{k+1} as small
    as it can be; w_i are the eigenvalues of φ̄ P φ̄ᵀ and c_i the errors in its eigenvectors (c_i² is
    the mean over the targets). If σ² + ‖ē‖² ≤ γ², μ = 0: the sample is left out (`within_bound`).
    Else, for one row with G = φ̄ P φ̄ᵀ, δ = ē² + σ² − γ² and C = δ + (γ² − σ²) G,
    μ = min(a, δ / (C + √(C G ē²))), and a if C ≤ 0; for several rows μ is found by bisection of the
    slope of σ²(μ), which does not decrease. The printed (50), Γ = I with
    λ_k = (1 − μ_k) μ_{k−1}/μ_k, is undefined at μ = 0 and not proper when μ falls fast.

    | symbol | name | range | default |
    |---|---|---|---|
    | γ | noise_bound | (0, ∞) | 1 |
    | a | largest_weight | (0, 1) | 0.5 |
    | σ₀ | initial_radius | (0, ∞) | 1 |

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): no. Silence with errors beyond the bound winds up.
    - P bounded below (A3): if φ is bounded: R_k ≤ max(β, λ_max(R₀)) I for φ̄ᵀφ̄ ≤ β I.
    - Cost: O(p n²). State: P and σ². It sets its own forgetting factor 1 − μ; no rate.
    - Use it when a bound on the noise is known but not its distribution. σ² < 0 means that the
      noise has broken its bound; the formulas go on.

    Reference: S. Dasgupta, Y.-F. Huang, *Asymptotically convergent modified recursive least
    squares with data-dependent updating and forgetting factor for systems with bounded noise*,
    IEEE Transactions on Information Theory 33, 1987.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        noise_bound: float = 1.0,
        largest_weight: float = 0.5,
        initial_radius: float = 1.0,
    ) -> None: ...

class DeadZone(Gate):
    """Lets a sample through if its error is larger than the noise explains.

    ```text
    r_k = ‖ē_k‖ over the rows, of the target where it is longest     ē = Γ^(−1/2)(y − φθ)
    update if r_k > width, else what `otherwise` says
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | r | width | (0, ∞) | 1 |
    | | otherwise | hold, freeze | hold |

    The error is whitened by Γ: `width` is in standard deviations of the noise where Γ is its
    covariance, and in units of y where P₀ is given and Γ is not, which is then 1. It is the error
    itself, not divided by √(1 + φ̄Pφ̄ᵀ) and not weighted.

    - While the model explains the data to within `width`, nothing is forgotten: with hold θ and P
      stay as they are, with freeze P still shrinks as the data say. Neither can wind up.
    - With bounded noise, ‖ē‖ ≤ width for the true θ, held samples are those that do not contradict
      θ. Gaussian noise of variance 1 is within a width of 2 for 95 % of the samples: to hold those
      is to learn from the tails only, and slowly.
    - An error that is small by chance holds a sample that would have told much, so that hold
      learns later than it could. Freeze does not.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, every sample passes.
    - Cost: O(p m). State: none.
    - Use it against drift in quiet times, and where the parameters change seldom: `freeze` then
      averages on, and forgets when the model no longer fits.
    - Not with hold where every sample is needed: in Gaussian noise most of them are held.

    Reference: B. Egardt, *Stability of Adaptive Controllers*, 1979; G. C. Goodwin, K. S. Sin,
    *Adaptive Filtering, Prediction and Control*, 1984.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        width: float = 1.0,
        otherwise: Literal["hold", "freeze"] = "hold",
    ) -> None: ...

class Directional(Rule):
    """Forgets only in the direction of the regressor, for one row, and skips regressors too short to inform.

    ```text
    F_k = (1 − λ_k) R φ̄ᵀ φ̄ R / (φ̄ R φ̄ᵀ)      GF-RLS (63), if ‖φ̄‖ > threshold
    P̄ = P + (1 − λ)/λ · φ̄ᵀ φ̄ / (φ̄ R φ̄ᵀ)      GF-RLS (62), with its transposes; the form used:
                                             one dyad, φ̄ R φ̄ᵀ = ‖D^(−1/2) U⁻¹ φ̄ᵀ‖² by one solve
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | ε | threshold | [0, ∞) | 1e-6 |

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): if threshold > 0 and λ_k ≥ λ_min > 0:
      R_k ≥ min(threshold²/(1 − λ_min), λ_min(R₀)) I.
    - P bounded below (A3): if λ_k ≤ λ_max < 1 and ‖φ̄‖² ≤ β: R_k ≤ max(β/(1 − λ_max), λ_max(R₀)) I.
    - Cost: O(n²), one row only. State: P alone.
    - As printed, (58) still learns from regressors below the threshold; they would be accumulated
      and never forgotten, without bound. Here they are skipped altogether, which is what the two
      bounds rest on.
    - Use it to compare with work that used it, with one row; `subspace` is the same for several.

    Reference: L. Cao, H. M. Schwartz, *A directional forgetting algorithm based on the
    decomposition of the information matrix*, Automatica 36, 2000.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        threshold: float = 1e-06,
        *,
        half_life: Any = None,
    ) -> None: ...

class DynamicModelAveraging(Mixer):
    """Believes members as far as they are probable, and lets probability drift from one to another.

    ```text
    π̂_i ∝ π_i^α                                      between samples: the model may have changed
    π_i ∝ π̂_i N(y; φθ_i, v_i (1 + s_i))               Gaussian; s_i = φP̄φᵀ, the leverage
    v_i ← v_i + (e_i²/(1 + s_i) − v_i)/min(k, N)      the noise variance, from member i's own errors
    w_i = π̂_i
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | α | forgetting | (0, 1] | 0.99 |
    | N | memory | [1, ∞) | 100 |

    - The weights are probabilities if one of the members is right and the noise is Gaussian. One gross
      error then moves them far: `mlpol` is the sturdier.
    - Cost: O(K p m) and K logarithms and exponentials. State: 2 K + 1 numbers.
    - Use it where the probability of each model is itself the result.
    - Not with gross errors in y.

    Reference: A. E. Raftery, M. Kárný, P. Ettler, *Online prediction under model uncertainty via
    dynamic model averaging: application to a cold rolling mill*, Technometrics 52(1), 2010, with the
    noise variance estimated for each model.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting: float = 0.99,
        memory: float = 100.0,
    ) -> None: ...

class Efra(Rule):
    """Exponential forgetting and resetting (EFRA): P grows as if forgetting, but saturates at a known bound.

    ```text
    K = a P φ̄ᵀ/(1 + s),  s = φ̄ P φ̄ᵀ                          EFRA, one row
    P_k+1 = P_k/λ_k − K φ̄ P_k + b I − d P_k²
    Γ_k = 1/a + s (1/a − 1), then                             the form used: a measurement with
    P_k+1 = P₊ + Σ_i max(0, g p_i + b − d p_i²) v_i v_iᵀ      this noise, then a dyad for each
                                                              eigenpair (p_i, v_i) of P_k;
                                                              g = (1 − λ_k)/λ_k
    P̄ = P + (p_n − P_ii) e_i e_iᵀ,  i = k mod n,  p_0 = P_ii   cyclic: one parameter a sample, for n
    p_j+1 = p_j + max(0, g p_j + b − d p_j²)                  samples; then Γ_k, s = φ̄ P̄ φ̄ᵀ
    ```

    The covariance that the estimator shows is P₊, after the data; what a sample adds to P is
    added when the next one comes. The cyclic schedule forgets first and then measures. The published
    map has no max: it is the same while P ≤ σ_max I, σ_max = g/(2d)·(1 + √(1 + 4bd/g²)), which
    P₀ ≤ σ_max I guarantees for a constant λ with g² + 4bd ≤ 1. λ_k = 1 is plain least squares, a, b
    and d left out.

    | symbol | name | range | default |
    |---|---|---|---|
    | a | gain | (0, 1] | 0.5 |
    | b | increase | [0, ∞) | 0.005 |
    | d | saturation | (0, ∞) | 0.0001 |
    | | schedule | "every_sample" adds along each eigenvector at each sample, "cyclic" along one parameter | "every_sample" |

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): if λ_k ≥ λ_min > 0, by the larger of P₀ and
      b + (1 + g)²/(4d), g of λ_min, the most that p + g p + b − d p² can be; where g² + 4bd ≤ 1 by
      σ_max in its place. Silence takes P to σ_max I. Cyclic: this bounds every P_ii, and P by n times
      it, as P ≤ tr(P) I; silence takes every P_ii to σ_max and leaves the rest of P as it is.
    - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded, but not for the cyclic schedule: where
      two elements of φ are equal at all samples, both variances go to σ_max, and what is known of the
      sum of the two parameters is forgotten no more.
    - Cost: O(n³). State: P, n eigenvectors and 2 n numbers. The eigenvectors follow P from sample to
      sample; after one that a gate freezes they are computed anew. Cyclic O(n²). State: P, and whose
      turn it is.
    - Use it for one output, where P must stay below a bound that is stated beforehand, with
      P₀ at or below it. Use the cyclic schedule where n is large. It forgets along the parameters,
      where the published map forgets alike in any basis; a diagonal P is after a cycle in silence what
      n samples of the other make of it. k counts the samples used.
    - Not with the cyclic schedule where two regressors are equal, or opposite, at almost all samples.

    Reference: M. E. Salgado, G. C. Goodwin, R. H. Middleton, *Modified least squares algorithm
    incorporating exponential resetting and forgetting*, International Journal of Control 47,
    1988; as a case of Theorem 1, derived here.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        gain: float = 0.5,
        increase: float = 0.005,
        saturation: float = 0.0001,
        schedule: Literal["every_sample", "cyclic"] = "every_sample",
        *,
        half_life: Any = None,
    ) -> None: ...

class Equal(Weighting):
    """Trusts every sample as much as its Γ says.

    ```text
    w_k = 1
    ```

    | symbol | name | range | default |
    |---|---|---|---|

    - Influence is not bounded: an error twice as large moves θ twice as far.
    - Cost: none. State: none.
    - Use it when the noise is near to Gaussian, or Γ tells how good each sample is.
    - Not with gross errors: one moves θ as far as it is large.

    Reference: B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
    stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024, Theorem 1.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(self) -> None: ...

class ExactGradient(Rate):
    """Follows the exact gradient of the squared error: how θ would have been with another factor.

    ```text
    Ψ = dθ/dλ,  Z = dP/dλ,  both 0 at the start;  l = λ_k,  P = P_{k+1},  M = I − P φ̄ᵀφ̄
    λ_{k+1} = clip(l + α tr(Ψᵀφ̄ᵀe)/m, smallest, largest)          λ_0 = largest
    Z ← (M Z Mᵀ − P + P φ̄ᵀφ̄ P)/l
    Ψ ← M Ψ + Z φ̄ᵀe                                               the new Z, the error before
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | α | step_size | (0, ∞) | 1e-3 |
    | λ_min | smallest | (0, 1] | 0.9 |
    | λ_max | largest | [smallest, 1] | 0.9999 |

    - For the next sample.
    - Exact for a constant λ and the rule `exponential`; with other rules it is the same recursion.
    - φ̄ and e are whitened by Γ and weighted: λ does not depend on the units of y. Targets are
      averaged.
    - Should Z or Ψ leave the range of the number type, where P has wound up, both start again at 0.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, errors count as 0.
    - Cost: O(n³/6 + p n²), for the elements of P. State: Z, Ψ and the next λ, n² + m n + 1 numbers.
    - Use it for slow drift when n is small; `gradient` costs nothing beside.
    - Not for jumps: λ follows over many samples. Not for large n, by its cost.

    Reference: S. Haykin, *Adaptive Filter Theory*, "RLS algorithm with adaptive memory".
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        step_size: float = 0.001,
        smallest: float = 0.9,
        largest: float = 0.9999,
    ) -> None: ...

class Exponential(Rule):
    """Forgets everything at the same rate.

    ```text
    F_k = (1 − λ_k) R_k                      GF-RLS (35), with any rate (39)
    R̄ = λ R,   P̄ = P / λ                    the form used: D ← D / λ
    ```

    | symbol | name | range | default |
    |---|---|---|---|

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): no. In a direction without excitation P grows as
      λ⁻ᵏ (windup): the update reports it. At the end of the range of numbers P stays
      below, and nothing is forgotten until the input returns.
    - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded.
    - Cost: O(p n²). State: P alone.
    - Use it when the input excites every parameter all the time. When it may fall silent, use
      `subspace` or `exponential_resetting`.

    Reference: A. Goel, A. L. Bruce, D. S. Bernstein, *Recursive least squares with
    variable-direction forgetting*, IEEE Control Systems Magazine 40(4), 2020, Theorem 1.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        *,
        half_life: Any = None,
    ) -> None: ...

class ExponentialResetting(Rule):
    """Forgets towards a fixed information matrix, so that in silence P returns to its inverse.

    ```text
    F_k = (1 − λ_k) (R_k − R_∞)              GF-RLS (55)
    R̄ = λ R + (1 − λ) R_∞                    the form used: D ← D / λ, then one information
                                             row √(1 − λ) r for each row r of a root of R_∞
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | R_∞ | information | a number c ≥ 0 (c·I), n numbers ≥ 0 or an n x n positive semidefinite matrix | 0.01 |

    - Proper (A1): if R₀ ≥ R_∞.
    - P̄ bounded above without excitation (A2): if R_∞ > 0: R_k ≥ λᵏR₀ + (1 − λᵏ)R_∞.
    - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded.
    - Cost: O((p + r) n²), r the rank of R_∞; O(n³) for a full one. State: P alone.
    - Use it when what is known without data should come back in silence. `cyclic_resetting`
      does nearly the same in O(n²).
    - Not where what was learned should outlive silence: it fades towards R_∞. `subspace` keeps it.

    Reference: B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
    stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024, V-E.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        information: ArrayLike = 0.01,
        *,
        half_life: Any = None,
    ) -> None: ...

class FTest(Rate):
    """Forgets when an F-test says that the recent errors are larger than they used to be.

    ```text
    z = all errors of a sample, d = p m numbers;  Σ_n, Σ_d = mean of z zᵀ over the last τ_n, τ_d
    a = d τ_n,  B = (τ_n + τ_d − d − 1)(τ_d − 1)/((τ_d − d − 3)(τ_d − d))
    b = 4 + (a + 2)/(B − 1),  c = a (b − 2)/(b (τ_d − d − 1))           Lawley and Hotelling
    g_k = √((τ_n/τ_d) tr(Σ_n Σ_d⁻¹)/c) − √(F⁻¹_{a,b}(1 − α))
    λ_k = 1/(1 + η g_k) if g_k > 0, else 1
    λ_k ← clip(λ_k, smallest, largest)
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | η | sensitivity | [0, ∞) | 0.1 |
    | τ_n | short_window | 1, 2, ... | 10 |
    | τ_d | long_window | more than short_window and than p m + 3 | 100 |
    | α | significance | (0, 1) | 0.01 |
    | λ_min | smallest | (0, 1] | 0.9 |
    | λ_max | largest | [smallest, 1] | 1 |

    - Uses this sample: both windows include it. Until τ_d samples were seen, and while Σ_d of the
      samples before this one is singular (d > 1; d = 1: while Σ_d = 0), λ = largest.
    - α is more than the probability of a false alarm at each sample, which is α/4 to α/2: the law
      is that of windows apart, but the long one holds the short one, whose errors raise both. For d = 1 it is a = τ_n, b = τ_d, c = τ_n/τ_d, and
      g = √(ratio of the mean squares) − √(quantile).
    - Only a ratio of errors counts: λ depends neither on the units of y nor on the noise
      covariance. e is whitened by Γ and clipped by the weighting.
    - Cost: O(τ_d d² + d³); the sums are formed anew, so that they do not drift. State: τ_d d + d²
      numbers.
    - The quantile is found once, by bisection of the continued fraction of the incomplete beta
      function: ten digits or more.
    - Use it in place of `rms_ratio` when false alarms cost something.
    - Not for slow drift: both windows then see the same errors.

    Reference: N. Mohseni, D. S. Bernstein, *Recursive least squares with variable-rate forgetting
    based on the F-test*, American Control Conference, 2022.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        sensitivity: float = 0.1,
        short_window: int = 10,
        long_window: int = 100,
        significance: float = 0.01,
        smallest: float = 0.9,
        largest: float = 1.0,
    ) -> None: ...

class Fortescue(Rate):
    """Keeps the information in the estimate constant: forgets as much as the sample surprised.

    ```text
    λ_{k+1} = 1 − tr(e_kᵀ (I + S_k)⁻¹ e_k) / (m N₀ σ²)     S_k = φ̄_k P_k φ̄_kᵀ
            = 1 − e_k² / (N₀ σ² (1 + s_k))                 one row and one target
    λ_{k+1} ← clip(λ_{k+1}, smallest, largest),   λ_0 = largest
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | N₀ | memory | (0, ∞) | 100 |
    | σ² | noise_variance | (0, ∞) | 1 |
    | λ_min | smallest | (0, 1] | 0.9 |
    | λ_max | largest | [smallest, 1] | 1 |

    - For the next sample: the original divides P by λ after sample k, which is forgetting before
      sample k + 1.
    - Keeps the discounted sum of squared errors at N₀σ²: with noise of variance σ² the memory is
      about N₀ samples, N₀/p with p rows.
    - e is whitened by Γ and clipped by the weighting, so that λ does not depend on the units of y:
      σ² is the variance of the whitened noise, 1 where Γ is the noise covariance.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, errors count as 0.
    - Cost: O(p n²/2 + p² n). State: the next λ.
    - Use it when the noise variance is known and constant; else `noise_power`.
    - Not where σ² is a guess: too small, it forgets at every sample; too large, hardly ever.

    Reference: T. R. Fortescue, L. S. Kershenbaum, B. E. Ydstie, *Implementation of self-tuning
    regulators with variable forgetting factors*, Automatica 17(6), 1981.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        memory: float = 100.0,
        noise_variance: float = 1.0,
        smallest: float = 0.9,
        largest: float = 1.0,
    ) -> None: ...

class Function(Rate):
    """Asks a function of yours for the factor of each sample.

    ```text
    λ_k = f(evidence of sample k)
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | f | function | a function of the evidence, with values in (0, 1] | |

    - Uses this sample: the function sees the whitened, clipped errors and what P says of the
      sample, before it is used.
    - A value outside (0, 1], or a failure of the function, refuses the sample: the estimator is as
      it was, bit for bit. A function that remembers has then still seen the sample.
    - Cost: the function, and O(p n²/2 + p² n) for what it is shown. State: none that is saved; an
      estimator with a function cannot be.
    - Use it for a design of your own. One that is to be saved, or to run without an interpreter, is
      better a rate.
    - Not where speed counts: the function is called at every sample.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        function: Callable[[Evidence], float],
    ) -> None: ...

class GateFunction(Gate):
    """Asks a function of yours what to do with each sample.

    ```text
    update, freeze or hold = f(evidence of sample k)
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | f | function | a function of the evidence that answers `update`, `freeze` or `hold` | |

    - The function sees the whitened errors, not clipped by the weighting, and what P says of the
      sample, before anything is forgotten.
    - Any other answer, or a failure of the function, refuses the sample: the estimator is as it
      was, bit for bit. A function that remembers has then still seen the sample.
    - Cost: the function, and O(p n²/2 + p² n) for what it is shown. State: none that is saved; an
      estimator with a function cannot be.
    - Use it for what you know and the record does not say: a valve that is shut, a sensor that
      saturates.
    - Not where speed counts: the function is called at every sample.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        function: Callable[[Evidence], Literal["update", "freeze", "hold"]],
    ) -> None: ...

class Gradient(Rate):
    """Follows the gradient of the modelled mean square error down to the best factor.

    ```text
    E, V ← averages of ‖e‖²/p over K_a n and K_b n samples     l = λ_{k−1},  λ_{−1} = largest
    r′ = r,  t′ = 2 l t;   r ← 1 + l r,  t ← 1 + l² t
    D = (n + 1) t + r²,    D′ = (n + 1) t′ + 2 r r′
    ζ = 1 − 2/r + (n + 2)/D,   ζ′ = 2 r′/r² − (n + 2) D′/D²
    h = 2/r − 2/D,             h′ = −2 r′/r² + 2 D′/D²
    J_k = ζ J_{k−1} + h V                                      the modelled error
    g ← ζ g + ζ′ E + h′ V                                      dJ/dλ
    λ_k = clip(l − α g/(1 − l), smallest, largest)             r = t = g = 0 at the start
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | α | step_size | (0, ∞) | 1e-3 |
    | K_a | short_memory | [1, ∞) | 2 |
    | K_b | long_memory | (short_memory, ∞) | 10 |
    | λ_min | smallest | (0, 1) | 0.9 |
    | λ_max | largest | [smallest, 1) | 0.9999 |

    - Uses this sample.
    - The sign of 2/D in h is minus: only then is J_k = V (1 + n/k) without forgetting. In print it
      is plus, which gives V (1 + (n + 4)/k). The original's second, moving lower clip is left
      out: `smallest` does its work.
    - e is whitened by Γ and clipped by the weighting: λ does not depend on the units of y. ‖e‖² is
      the sum over the p rows, averaged over targets.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, errors count as 0.
    - Cost: O(1). State: six numbers.
    - Use it for slow, steady drift in noise whose variance is stationary.
    - Not for jumps: λ follows over many samples.

    Reference: S. H. Leung, C. F. So, *Gradient-based variable forgetting factor RLS algorithm in
    time-varying environments*, IEEE Transactions on Signal Processing 53(8), 2005.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        step_size: float = 0.001,
        short_memory: float = 2.0,
        long_memory: float = 10.0,
        smallest: float = 0.9,
        largest: float = 0.9999,
    ) -> None: ...

class Huber(Weighting):
    """Trusts a sample fully up to a threshold, and clips what its error exceeds it by.

    ```text
    r_k = ‖ē_k‖ over the rows, of the target where it is longest     ē = Γ^(−1/2)(y − φθ)
    w_k = min(1, c/r_k)                                              Γ ← Γ/w
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | c | threshold | (0, ∞) | 1.345 |

    - Bounded influence: w r ≤ c. One sample moves θ_i of any target by at most
      c ‖(P̄φ̄ᵀ)_i‖ ≤ c √(P̄_ii tr φ̄P̄φ̄ᵀ), whatever y is: θ₊ − θ = w P̄φ̄ᵀ(I + w φ̄P̄φ̄ᵀ)⁻¹ē, and no
      direction of the inverse is longer than 1. φ̄ is whitened, without the weight. With uniform or
      directional forgetting P̄ ≤ P/λ.
    - The error is not normalized by 1 + φ̄Pφ̄ᵀ: the bound would grow by its root. A large first error
      is still corrected at once, for then P̄ is large.
    - Rates see the clipped error w ē, so that an outlier makes none of them forget more than an
      error of c.
    - c is in standard deviations of the noise, if Γ is its covariance. With 1.345 the estimate of a
      constant that solves Σ w ē = 0 has 95 % of the efficiency of least squares in Gaussian noise;
      the recursion, of which the gain is 1/Σ w, has 92.3 %.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, w = 1.
    - Cost: O(p m). State: none.
    - Use it when some samples are gross errors. One in φ is not recognized.
    - Not where a large error is news: a jump of θ is followed more slowly.

    Reference: P. J. Huber, *Robust estimation of a location parameter*, Annals of Mathematical
    Statistics 35(1), 1964.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        threshold: float = 1.345,
    ) -> None: ...

class MatrixForgetting(Rule):
    """Forgets each eigenvalue of the information matrix by a function of its own that holds it at α.

    ```text
    F_k = (1 − λ_k) (I − α P_k)ᴺ R_k                        choice 1: tutorial (S2)
    F_k = (1 − λ_k) (R_k − α I)ᴺ (R_k + β I)⁻ᴺ R_k          choice 2: tutorial (S3)
    r̄ = r (1 − (1 − λ_k) bᴺ),  b = 1 − α/r                  the form used: each eigenvalue r of R
                           or  b = (r − α)/(r + β)          by itself, along its eigenvector a
                                                            dyad for b > 0, a row for b < 0
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | α | information | (0, ∞) | 0.01 |
    | N | power | odd whole numbers, 1 to 99 | 1 |
    | | choice | 1 or 2 | 1 |
    | β | shift | [0, ∞), with choice 2 | 0 |

    - Proper (A1): if R₀ ≥ α I; R_k ≥ α I then holds for ever.
    - P̄ bounded above without excitation (A2): always: R_k ≥ min(λ_min(R₀), α) I.
    - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded.
    - Cost: O(n³). State: P and the eigenvectors and eigenvalues of P⁻¹; none for N = 1,
      choice 1, which costs what `exponential_resetting` does.
    - N = 1 with choice 1 is `exponential_resetting` with α I, bit for bit. For N ≥ 3, what lies
      near α is hardly touched: the return to α is slower than any exponential, and information
      well below α may jump beyond it. β > 0 bounds the jump.
    - Use it to reproduce work that used it; else `exponential_resetting`.
    - Not where information falls far below α by itself: with N ≥ 3 it may jump beyond it.

    Reference: A. Goel, A. L. Bruce, D. S. Bernstein, *Recursive least squares with
    variable-direction forgetting*, IEEE Control Systems Magazine 40(4), 2020, sidebar "Toward
    matrix forgetting"; after G. Kreisselmeier, *Stabilized least-squares type adaptive
    identifiers*, IEEE Transactions on Automatic Control 35, 1990.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        information: float = 0.01,
        power: int = 1,
        choice: int = 1,
        shift: float = 0.0,
        *,
        half_life: Any = None,
    ) -> None: ...

class MinimumInformation(Gate):
    """Lets a sample through if it can tell enough beside what is known already.

    ```text
    s_k = tr φ̄_k P_k φ̄_kᵀ,  P before forgetting
    update if s_k ≥ information, else what `otherwise` says
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | s | information | (0, ∞) | 1e-6 |
    | | otherwise | hold, freeze | hold |

    s is the variance of the prediction in units of the noise's; the sample tells ½ ln(1 + s) nats
    of θ, for one row. It has no unit, and does not depend on the units of φ or θ.

    - While every regressor is small, P stays as it is: silence cannot wind up, with any rule. Where
      other directions go on telling, the gate is open and those that are silent are the rule's
      affair: only a rule that forgets direction by direction keeps them.
    - `information` must be well below what a sample tells in the steady state, which for n
      parameters that are all excited is about n (1 − λ), shared unevenly among the samples. Above
      that P shrinks until no sample passes, and the gate never opens again.
    - Freeze lets such samples reduce P, hold does not.
    - Cost: O(p n²/2). State: none.
    - Use it with a rule that forgets in silence, such as `exponential`, for records with nights
      and standstills.
    - Not against silence in some directions while others go on telling: that takes a rule that
      forgets by directions.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        information: float = 1e-06,
        otherwise: Literal["hold", "freeze"] = "hold",
    ) -> None: ...

class Mlpol(Mixer):
    """Believes members in proportion to how much better than the mixture they have been, with nothing to tune.

    ```text
    r_i = 2 e (e − e_i)                    how much following member i more would have helped
    R_i ← R_i + r_i                        regret of not having followed it
    B⁺ = max(B_i, r_i²),  S_i ← S_i + r_i² + B⁺ − B_i,  B_i ← B⁺
    w_i ∝ π_i max(R_i, 0)/S_i              w_i ∝ π_i while no regret is positive
    π_i = q^i                              the weights beforehand, i = 0 for the first member
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | q | prior_ratio | (0, 1] | 1; 0.93 for the default members of a bank |

    e is the error of the mixture and e_i that of member i; for several rows and targets the products
    are sums over them.

    - After T samples the sum of squared errors of the mixture exceeds that of member i by at most the
      root of (1 + ln T) S_i Σπ/π_i, whatever the samples are; with q = 1 the same with K max S_i holds for
      every fixed convex combination of the K members.
    - Weights beforehand are for members in an order. The slowest of those that are there by default
      comes first: where nothing changes, members that forget more than need be are given up sooner.
    - It has no unit: errors are taken in units of the largest so far.
    - A member that has always been worse than the mixture has weight 0, and costs nothing.
    - Cost: O(K p m). State: 3 K + 1 numbers.
    - Use it first: it is the default mixer.
    - Not where the best member changes often: regret is added up since the start, and the weights
      turn back slowly.

    Reference: P. Gaillard, G. Stoltz, T. van Erven, *A second-order bound with excess losses*,
    Proceedings of the 27th Conference on Learning Theory, 2014 (ML-Poly).
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        prior_ratio: float = 1.0,
    ) -> None: ...

class Multiple(Rule):
    """Forgets parameters, or blocks of them, each at its own rate, and keeps no information between blocks.

    ```text
    F_k = R_k − blkdiag(λ_b R_bb,k)          GF-RLS (74)–(83), there for two parameters
    R̄_bb = λ_b R_bb, no information else     the form used: a factor of R_bb⁻¹ for each block,
                                             D_b ← D_b/λ_b, then the rows φ̄_b of the sample
    P₊ = (R̄ + φ̄ᵀφ̄)⁻¹                         the covariance shown, (79)
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | λ_b | factors | (0, 1], one number or one a block | 0.99 |
    | | blocks | whole numbers ≥ 1: a size for all, or sizes that add up to n | 1 |

    - Proper (A1): if the correlation matrix of R_k, with its blocks normalized to I, is at least
      blkdiag(λ_b I); for two parameters: (1 − λ₁)(1 − λ₂) ≥ R₁₂²/(R₁₁R₂₂). That fails as soon as
      regressors are correlated and factors near 1. `component` is always proper.
    - P̄ bounded above without excitation (A2): no: a block without excitation winds up.
    - P bounded below (A3): if λ_b ≤ λ_max < 1 and φ is bounded: P ≥ (1 − λ_max)/β I for φ̄ᵀφ̄ ≤ β I,
      once it is.
    - Cost: O(p n²), of which the rule itself takes O(n²), or O(p Σ n_b²) and writing U anew.
      State: P and a factor of each block.
    - Use it to reproduce work that used it. It treats the blocks as if they were uncorrelated,
      even with every factor 1.

    Reference: A. Vahidi, A. Stefanopoulou, H. Peng, *Recursive least squares with forgetting for
    online estimation of vehicle mass and road grade: theory and experiments*, Vehicle System
    Dynamics 43, 2005; B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
    stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024, V-J.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        factors: ArrayLike = 0.99,
        blocks: ArrayLike = 1.0,
    ) -> None: ...

class NoForgetting(Rule):
    """Never forgets: plain recursive least squares.

    ```text
    F_k = 0                                  GF-RLS section V-A, (32)
    R̄ = R                                    nothing to do
    ```

    | symbol | name | range | default |
    |---|---|---|---|

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): always, by P₀.
    - P bounded below (A3): no, P → 0 under persistent excitation; old data weigh as much as new.
    - Cost: O(p n²). State: P alone.
    - Use it for parameters that never change. With parameters that drift, the estimate lags more
      and more.

    Reference: B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
    stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(self) -> None: ...

class NoisePower(Rate):
    """Lets the error after the correction have the power of the noise, which it estimates.

    ```text
    A ← A + (‖e‖²/p − A)/min(K_a n, m)             σ_e², the m-th sample
    B ← B + (‖e‖²/p − B)/min(K_b n, m)             σ_v²
    Q ← Q + ((tr S/p)² − Q)/min(K_a n, m)          σ_q²,  S = φ̄ P φ̄ᵀ
    λ_{k+1} = largest                              if √A ≤ γ √B
            = √Q √B / (ξ + |√A − √B|)              else
    λ_{k+1} ← clip(λ_{k+1}, smallest, largest),   λ_0 = largest
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | K_a | short_memory | [1, ∞) | 2 |
    | K_b | long_memory | (short_memory, ∞) | 10 |
    | γ | ratio | [1, ∞) | 1.5 |
    | ξ | floor | (0, ∞) | 1e-8 |
    | λ_min | smallest | (0, 1] | 0.9 |
    | λ_max | largest | [smallest, 1] | 0.9999 |

    - For the next sample. One row is the published algorithm once m > K_b n; it leaves the first
      values open, and plain means forget the errors of an arbitrary θ₀ soonest. The lower clip is
      ours.
    - e is whitened by Γ and clipped by the weighting: λ does not depend on the units of y. ‖e‖² is
      the sum over the p rows, averaged over targets.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, errors count as 0.
    - Cost: O(p n²/2) for tr S. State: three averages and the next λ.
    - Use it when the noise is unknown or its variance changes slowly.
    - Not where changes are small beside the noise: they hide in its power.

    Reference: C. Paleologu, J. Benesty, S. Ciochină, *A robust variable forgetting factor
    recursive least-squares algorithm for system identification*, IEEE Signal Processing Letters
    15, 2008.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        short_memory: float = 2.0,
        long_memory: float = 10.0,
        ratio: float = 1.5,
        floor: float = 1e-08,
        smallest: float = 0.9,
        largest: float = 0.9999,
    ) -> None: ...

class ObliqueProjection(Rule):
    """Forgets the part of the information that the rows of the sample span, by oblique projection.

    ```text
    F_k = (1 − λ_k) R φ̄ᵀ (φ̄ R φ̄ᵀ)⁺ φ̄ R       Zhu, Yu & Wan (17), (19), if ‖φ̄‖₂ ≥ threshold
    F_k = 0                                  (18), if not; every sample is learned from (23)
    P̄ = P + (1 − λ)/λ · V (Vᵀ R V)⁻¹ Vᵀ      the form used: V spans the rows of φ̄, one dyad w wᵀ
                                             for each of r vectors w with w_iᵀ R w_j = δ_ij
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | ε | threshold | [0, ∞) | 1e-6 |

    The rank r of φ̄ is the number of its singular values above √(machine epsilon) times the
    largest. It is decided on φ̄: a cut-off on φ̄ R φ̄ᵀ would depend on the condition of R.

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): no. The threshold looks at the largest singular
      value only: in a direction of a small one, δ, R falls to δ²/(1 − λ).
    - P bounded below (A3): no. Samples below the threshold are learned from and never forgotten.
    - Cost: O(p n²), without an n x n inverse. State: P alone.
    - Use it to reproduce the paper. `subspace` is the same with a threshold for each singular
      value, which gives both bounds.

    Reference: K. Zhu, C. Yu, Y. Wan, *Recursive least squares identification with
    variable-direction forgetting via oblique projection decomposition*, IEEE/CAA Journal of
    Automatica Sinica 9(3), 2022.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        threshold: float = 1e-06,
        *,
        half_life: Any = None,
    ) -> None: ...

class Open(Gate):
    """Lets every sample through.

    ```text
    update, always
    ```

    | symbol | name | range | default |
    |---|---|---|---|

    - Cost: none. State: none.
    - Use it where the rule itself knows what to leave alone, as `subspace` does.
    - Not with a rule that forgets in silence, where the input may fall silent.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(self) -> None: ...

class PredictionError(Rate):
    """Forgets more the larger the prediction error, less the less certain the estimate.

    ```text
    λ_k = 1 − ‖e_k‖² / ((η + ‖e_k‖²) (p + tr S_k))     S_k = φ̄_k P_k φ̄_kᵀ     Zhu et al. (21)
    λ_k ← clip(λ_k, smallest, largest)
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | η | sensitivity | (0, ∞) | 1 |
    | λ_min | smallest | (0, 1] | 0.9 |
    | λ_max | largest | [smallest, 1] | 0.999 |

    - Uses this sample: λ_k forgets before φ_k is learned from.
    - e is whitened by Γ and clipped by the weighting, so that λ does not depend on the units of y;
      ‖e‖² is the sum over the p rows, averaged over targets.
    - η is in units of ‖e‖²: the squared error that has half of the effect of a very large one.
      Small is sensitive.
    - λ_k is in (1 − 1/p, 1] without the clip, and is 1 when the error is 0: it is `largest` < 1
      that bounds the information.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, errors count as 0.
    - Cost: O(p n²/2) for tr S. State: none.
    - Use it when jumps show in the error at once and the noise is small beside them.
    - Not where noise is large beside the changes: every large error is then taken for one.

    Reference: K. Zhu, C. Yu, Y. Wan, *Recursive least squares identification with
    variable-direction forgetting via oblique projection decomposition*, IEEE/CAA Journal of
    Automatica Sinica 9(3), 2022, (21); after S. Bertin, S. Bittanti, P. Bolzern, *Tracking of
    nonstationary systems by means of different prediction error directional forgetting
    techniques*, 1987.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        sensitivity: float = 1.0,
        smallest: float = 0.9,
        largest: float = 0.999,
    ) -> None: ...

class RandomWalk(Rule):
    """Expects the parameters to walk at random, as the Kalman filter does.

    ```text
    P̄ = P + Q                                prediction of the Kalman filter with transition I
    P̄ = κ P + Q,  κ = 1 − λ_max(Q)/b         where a bound b is given
    P̄ = P + r w_jᵀ w_j,  j = k mod r         cyclic: Q = Σ_j w_jᵀ w_j, one of its r dyads a sample,
                                             for r samples
    P̄ = S_j P S_j + (1 − κʳ)/(1 − κ) w_jᵀ w_j    the same with a bound, for a diagonal Q:
                                             S_j = I but for κ^(r/2) at parameter j
    F_k = R − P̄⁻¹                            the same as Theorem 1 of GF-RLS has it; the form used: for
                                             a diagonal Q, of what was added the part that the sample
                                             depends on, for Q = c·I with n ≤ 10 one pass of Gram and
                                             Schmidt over [U, I], else one dyad for each row of a root
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | Q | process_noise | a number c ≥ 0 (c·I), n numbers ≥ 0 or an n x n positive semidefinite matrix | 1e-4 |
    | b | bound | (0, ∞), above process_noise, or not given | not given |
    | | schedule | "every_sample" adds Q at each sample, "cyclic" one dyad of it | "every_sample" |

    - Proper (A1): if there is no bound; with one, while P ≤ Q b/λ_max(Q), which for Q = c·I is P ≤ b·I,
      but for the cyclic schedule, which draws each variance towards its bound in its turn.
    - P̄ bounded above without excitation (A2): if a bound b is given: P ≤ b·I makes P̄ ≤ b·I. Without one
      P grows by Q at each sample that brings no information, linearly.
    - P bounded below (A3): if Q > 0 and φ is bounded.
    - Cost: O((p + 1) n²) for a number or n numbers, at n ≤ 10 about twice that of `exponential`; O((p + r) n²)
      for a matrix of rank r; cyclic O((p + 1) n²), and less of it. State: P, in n²/2 numbers more for a diagonal
      Q, and whose turn it is.
    - Where the time Δt between samples is given, Q is per unit of it: κ^Δt and (1 − κ^Δt)/(1 − κ) Q, or
      Δt Q without a bound, so that gaps without data add up.
    - Q is per sample and in units of P: the variance by which θ moves, over the variance of the
      measurement noise (Γ).
    - Use it when that ratio is known: the estimate is then the optimal one. With P₀ that follows the
      data, Q counts in units of the typical size of each regressor. Use the cyclic schedule where n
      is large, Q a full matrix or memory scarce, and θ moves little in n samples: without data a whole
      cycle adds what r samples add, and within one P is off by less than that.
    - Not without a bound where the input may fall silent for ever: P then grows without end.

    A diagonal Q is taken in the order of its elements, a full one in the order of the pivots of
    Cholesky's factorization with diagonal pivots. k counts the samples used.

    Reference: R. E. Kalman, *A new approach to linear filtering and prediction problems*, Journal
    of Basic Engineering 82, 1960; as forgetting, GF-RLS, Theorem 1. The cyclic schedule is that filter
    for steps that come in turns; one direction a sample is from B. Lai, D. S. Bernstein,
    *Exponential resetting and cyclic resetting recursive least squares*, IEEE Control Systems
    Letters 7, 2023.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        process_noise: ArrayLike = 0.0001,
        bound: float | None = None,
        schedule: Literal["every_sample", "cyclic"] = "every_sample",
    ) -> None: ...

class Restricted(Rule):
    """Forgets along the last gain only: the information may shrink, but not where nothing was measured.

    ```text
    s_k = φ̄_k P_k φ̄_kᵀ,  β_k = λ_k − (1 − λ_k)/s_k          GF-RLS (69)
    P_{k+1}⁻¹ = P_k⁻¹ + β_k φ̄_kᵀ φ̄_k                        (67); β_k < 0 if λ_k < 1/(1 + s_k)
              = (P₊ + (1 − λ_k)/λ_k · P₊ Vᵀ (V P₊ Vᵀ)⁻¹ V P₊)⁻¹
                                          P₊ after the data; V spans the rows of φ̄_k
    F_k = (1 − λ_{k−1}) Vᵀ (V P_k Vᵀ)⁻¹ V, V of sample k − 1  (73) with s_{k−1}; F_0 = 0
    ```

    The published algorithm measures, then forgets. Here it is Theorem 1 shifted by one step: the
    state keeps φ̄_k and λ_k, sample k + 1 forgets with them before it is measured, and P is that
    after the data. θ is the same. The form used is one dyad P₊v for each direction v of φ̄_k, so
    that P stays positive definite although β_k may be negative.

    | symbol | name | range | default |
    |---|---|---|---|

    For several rows (not published), V spans those directions of φ̄ whose singular values are
    above √(machine epsilon) times the largest; for one row, V = φ̄.

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): no. In silence P stays as it is, but weakly
      excited directions wind up slowly.
    - P bounded below (A3): no.
    - Cost: O(p n²). State: P, φ̄ and λ of the sample before.
    - Use it to reproduce the literature on directional forgetting; `subspace` is bounded.

    Reference: R. Kulhavý, M. Kárný, *Tracking of slowly varying parameters by directional
    forgetting*, 9th IFAC World Congress, 1984; S. Bittanti, P. Bolzern, M. Campi, *Convergence and
    exponential convergence of identification algorithms with directional forgetting factor*,
    Automatica 26, 1990.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        *,
        half_life: Any = None,
    ) -> None: ...

class RmsRatio(Rate):
    """Forgets when the recent errors are larger than they used to be.

    ```text
    g_k = √(mean of ‖e‖² over the last τ_n / mean of ‖e‖² over the last τ_d) − 1
    λ_k = 1/(1 + η g_k) if g_k > 0, else 1
    λ_k ← clip(λ_k, smallest, largest)
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | η | sensitivity | [0, ∞) | 0.1 |
    | τ_n | short_window | 1, 2, ... | 10 |
    | τ_d | long_window | more than short_window | 100 |
    | λ_min | smallest | (0, 1] | 0.9 |
    | λ_max | largest | [smallest, 1] | 1 |

    - Uses this sample: both windows include it. Until τ_d samples were seen, and while their mean
      is 0, λ = largest.
    - Only a ratio of errors counts: λ depends neither on the units of y nor on the noise variance.
      e is whitened by Γ and clipped by the weighting; ‖e‖² is the sum over rows and targets.
    - Cost: O(τ_d) additions; the sums are formed anew, so that they do not drift. State: τ_d
      numbers.
    - Use it when the noise variance is unknown. A change is noticed only once, against the errors
      of before.
    - Not for slow drift: both windows then see the same errors.

    Reference: A. L. Bruce, A. Goel, D. S. Bernstein, *Convergence and consistency of recursive
    least squares with variable-rate forgetting*, Automatica 119, 2020.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        sensitivity: float = 0.1,
        short_window: int = 10,
        long_window: int = 100,
        smallest: float = 0.9,
        largest: float = 1.0,
    ) -> None: ...

class Schedule(Rate):
    """Takes the factors from a list, one a sample.

    ```text
    λ_k = l_(min(k, N − 1))     end = "hold": the last one for ever
    λ_k = l_(k mod N)           end = "repeat": from the first one again
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | l | factors | a number in (0, 1], or N of them | 0.99 |
    | | end | "hold" or "repeat" | "hold" |

    - k counts the samples used; one that is skipped takes no factor from the list.
    - λ is within the smallest and the largest of the list.
    - Cost: O(1). State: none, the list is configuration.
    - Use it to forget the start fast, or when it is known when parameters change.
    - Not where it is the record that has to tell when parameters change.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        factors: ArrayLike = 0.99,
        end: Literal["hold", "repeat"] = "hold",
    ) -> None: ...

class Stabilised(Rule):
    """Forgets towards a fixed covariance, so that P stays between two bounds whatever the input.

    ```text
    P̄ = λ_k P_k + (1 − λ_k) P_∞              stabilised (regularized) linear forgetting
    F_k = R_k − P̄⁻¹                          as a case of Theorem 1
    P ← λ P, P ← P + (1 − λ) Σ_i r_iᵀr_i     the form used: D ← λ D, then for a diagonal P_∞, of what
                                             was added, the part that the sample depends on, for
                                             P_∞ = c·I with n ≤ 10 one pass of Gram and Schmidt over
                                             [U, I], else one dyad for each row r_i of a root
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | P_∞ | covariance | a number c > 0 (c·I), n numbers > 0 or an n x n positive definite matrix | 100 |

    The dual of `exponential_resetting`, which averages P⁻¹ where this averages P. In silence both
    return to a fixed covariance. Here P̄ is also at least (1 − λ) P_∞ at every sample, so that a
    direction that was informed about for long is forgotten at once as far as that.

    - Proper (A1): if P₀ ≤ P_∞; P_k ≤ P_∞ then holds for ever.
    - P̄ bounded above without excitation (A2): always, by the larger of P₀ and P_∞.
    - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded: after a sample with φ̄ᵀφ̄ ≤ β I,
      P⁻¹ ≤ β I + P_∞⁻¹/(1 − λ_max).
    - Cost: O((p + 1) n²), at n ≤ 10 with P_∞ = c·I about twice that of `exponential`; O(n³) for a full P_∞.
      State: P alone, in n²/2 numbers more for a diagonal P_∞.
    - Use it when the gain must neither wind up nor fall asleep, with both bounds stated
      beforehand. The smallest variance that it keeps, (1 − λ) P_∞, is noise in the estimate.
    - Not where the estimate must come to rest: P̄ is at least (1 − λ) P_∞ at every sample.

    Reference: R. Kulhavý, F. J. Kraus, *On duality of regularized exponential and linear
    forgetting*, Automatica 32, 1996; with P_∞ = c·I the linear case of J. E. Parkum, N. K. Poulsen,
    J. Holst, *Recursive forgetting algorithms*, International Journal of Control 55, 1992, which
    measures first and forgets afterwards.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        covariance: ArrayLike = 100.0,
        *,
        half_life: Any = None,
    ) -> None: ...

class StudentT(Weighting):
    """Trusts a sample less the larger its error, as if the noise had Student's t distribution.

    ```text
    r_k = ‖ē_k‖ over the rows, of the target where it is longest     ē = Γ^(−1/2)(y − φθ)
    w_k = min(1, (ν + p)/(ν + r_k²))                                 Γ ← Γ/w
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | ν | degrees | (0, ∞) | 4 |

    - Bounded influence: w r ≤ c, with c = (ν + p)/(2√ν) at r = √ν, or √p at r = √p if ν < p. One
      sample moves θ_i of any target by at most c ‖(P̄φ̄ᵀ)_i‖ ≤ c √(P̄_ii tr φ̄P̄φ̄ᵀ), whatever y is;
      see `huber`. Beyond that r the influence falls again, to 0 as 1/r.
    - w is the weight of the maximum likelihood estimate, but never above 1: that would trust a
      sample more than its Γ says.
    - Rates see the clipped error w ē.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, w = 1.
    - Cost: O(p m). State: none.
    - Use it when gross errors are so large that even a clipped one disturbs; `huber` loses less
      when there are none. After a jump of θ it takes longer to believe.
    - Not where a large error is news: a jump of θ is taken for gross errors, and hardly followed
      at first.

    Reference: K. L. Lange, R. J. A. Little, J. M. G. Taylor, *Robust statistical modeling using the
    t distribution*, Journal of the American Statistical Association 84(408), 1989.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        degrees: float = 4.0,
    ) -> None: ...

class Subspace(Rule):
    """Forgets only in the directions that the sample informs (SIFt), and skips what is too small to inform.

    ```text
    φ̄ = W S Vᵀ, keep the q singular values ≥ threshold: φ_f = W_qᵀφ̄, y_f = W_qᵀȳ
    F_k = (1 − λ_k) R φ_fᵀ (φ_f R φ_fᵀ)⁻¹ φ_f R        Lai & Bernstein 2024 (SIFt-RLS)
    P̄ = P + (1 − λ)/λ · φ_fᵀ (φ_f R φ_fᵀ)⁻¹ φ_f        the form used: one dyad w wᵀ for each of
                                                       q vectors w with w_iᵀ R w_j = δ_ij
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | √ε | threshold | (0, ∞) | 1e-6 |

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): always, for λ_k ≥ λ_min > 0:
      R_k ≥ min(threshold²/(1 − λ_min), λ_min(R₀)) I.
    - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ̄φ̄ᵀ ≤ β I:
      R_k ≤ max(β/(1 − λ_max), λ_max(R₀)) I.
    - Cost: O(p n²), twice that of `exponential`. State: P alone.
    - `threshold` is the smallest singular value of the whitened φ that counts as information, in
      units of φ̄; set it above the noise of the regressors. Smaller ones are neither forgotten nor
      accumulated.
    - Use it first where P₀ is given: it is then the default rule.
    - Not where knowledge goes stale in silence: it is kept, with the variance that it had. One
      direction is forgotten a sample and row, so that with n parameters the memory is about n
      times that of `exponential` with the same λ.

    Reference: B. Lai, D. S. Bernstein, *SIFt-RLS: subspace of information forgetting recursive
    least squares*, arXiv 2404.10844, 2024; for one row, L. Cao, H. M. Schwartz, *A directional
    forgetting algorithm based on the decomposition of the information matrix*, Automatica 36, 2000.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        threshold: float = 1e-06,
        *,
        half_life: Any = None,
    ) -> None: ...

class UnityZone(Rate):
    """Does not forget at all while the error is within the noise, and halves the memory beyond.

    ```text
    L_k = ⌊ρ ‖e_k‖²/p + ½⌋
    λ_k = λ_min + (1 − λ_min) 2^(−L_k)
    λ_k ← clip(λ_k, smallest, largest)
    ```

    | symbol | name | range | default |
    |---|---|---|---|
    | ρ | sensitivity | (0, ∞) | 0.05 |
    | λ_min | smallest | (0, 1] | 0.9 |
    | λ_max | largest | [smallest, 1] | 1 |

    - Uses this sample. One row is the printed form.
    - λ_k = 1, then clipped to `largest`, while ρ‖e‖²/p < ½: the unity zone. With the default it
      reaches to three standard deviations of the noise, if Γ is its covariance.
    - e is whitened by Γ and clipped by the weighting: λ does not depend on the units of y. ‖e‖² is
      the sum over the p rows, averaged over targets.
    - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
      until five after 2n samples have told it, errors count as 0.
    - Cost: O(1). State: none.
    - Use it for parameters that are constant but for jumps.
    - Not for slow drift: while its errors stay within the noise, nothing is forgotten.

    Reference: D. J. Park, B. E. Jun, J. H. Kim, *Fast tracking RLS algorithm using novel variable
    forgetting factor with unity zone*, Electronics Letters 27(23), 1991.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        sensitivity: float = 0.05,
        smallest: float = 0.9,
        largest: float = 1.0,
    ) -> None: ...

class VariableDirection(Rule):
    """Forgets along the eigenvectors of the information matrix that the sample excites.

    ```text
    R = V diag(r) Vᵀ,  ψ = φ̄ V                         tutorial (66)
    F_k = V diag((1 − λ_k) r_i [‖ψ_i‖ > threshold]) Vᵀ  (64), (67)–(69)
    P̄ = P + (1 − λ)/λ · Σ v_i v_iᵀ/r_i, the excited i   the form used: one dyad for each excited
                                                        i, or, where these are most,
    P̄⁻¹ = λ R + (1 − λ) Σ r_i v_i v_iᵀ, the other i     D ← D/λ and one row for each of the rest
    ```

    Eigenvalues that differ by less than √precision, relatively, have no eigenvectors of their
    own (P₀ = c·I has none at all). Among them the sample decides: the directions forgotten are
    the right singular vectors of φ̄V_c with singular values above the threshold, V_c any basis
    of their space. What is forgotten then depends on P and φ̄ only.

    | symbol | name | range | default |
    |---|---|---|---|
    | ε | threshold | (0, ∞) | 1e-6 |

    - Proper (A1): always.
    - P̄ bounded above without excitation (A2): no. An eigenvector that φ̄ meets at a small angle is
      forgotten like any other, and may gain less than it loses. Under persistent excitation,
      with R_k ≥ λᴺ α I.
    - P bounded below (A3): no. A sample along which every ‖ψ_i‖ is at or below the threshold is
      not forgotten but still accumulated, as published; without end it drives P to 0. `subspace`
      leaves such samples out.
    - Cost: O(n³), most of it one product of n x n matrices a row. State: P and the
      eigenvectors and eigenvalues of P⁻¹, which follow P by rank-one updates (the secular
      equation) and are computed from its factor every 128 samples; P is never inverted.
    - Use it to reproduce work that used it, or where directions should be forgotten by the
      principal axes of what is known. `subspace` forgets exactly what the sample informs, for
      O(p n²), with bounds.

    Reference: A. Goel, A. L. Bruce, D. S. Bernstein, *Recursive least squares with
    variable-direction forgetting*, IEEE Control Systems Magazine 40(4), 2020, (64)–(71), with
    the transposes that (70) lost.
    """

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    def __init__(
        self,
        forgetting_factor: ForgettingFactor = 0.99,
        threshold: float = 1e-06,
        *,
        half_life: Any = None,
    ) -> None: ...
