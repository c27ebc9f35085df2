"""Dense GF-RLS for any forgetting map, many runs at once: the reference of these tests.

    forget    P̄_k = rule(P_k, ...)              (F_k = P_k⁻¹ - P̄_k⁻¹)
    measure   P_{k+1}⁻¹ = P̄_k⁻¹ + φ_kᵀφ_k
    correct   θ_{k+1} = θ_k + P_{k+1} φ_kᵀ (y_k - φ_k θ_k)

Arrays carry a leading axis of runs: φ (B, T, p, n), P (B, n, n). Weighted by Γ beforehand.
"""

from dataclasses import dataclass

import numpy as np

from forgetting.analysis import Trajectory


@dataclass
class Sample:
    """What a rule may look at."""

    k: int
    P: np.ndarray
    R: np.ndarray
    phi: np.ndarray
    last: np.ndarray | None


@dataclass
class Runs:
    """Outcome of `simulate`; axis 0 is the run."""

    phi: np.ndarray
    before: np.ndarray
    prior: np.ndarray
    after: np.ndarray
    theta: np.ndarray
    errors: np.ndarray

    def trajectory(self, run=0):
        path = np.concatenate([self.before[run], self.after[run][-1:]])
        return Trajectory.from_arrays(self.phi[run], path, prior_covariance=self.prior[run])


def symmetric(A):
    return (A + np.swapaxes(A, -1, -2)) / 2


def inverse(A):
    return symmetric(np.linalg.inv(A))


def transpose(A):
    return np.swapaxes(A, -1, -2)


def simulate(rule, phi, y, P0, theta0=None):
    """Run B estimators side by side. y (B, T, p) or None for covariances only."""
    runs, samples, _, n = phi.shape
    P = np.broadcast_to(P0, (runs, n, n)).copy()
    theta = np.zeros((runs, n)) if theta0 is None else theta0.copy()
    before, prior, after = (np.empty((runs, samples, n, n)) for _ in range(3))
    used = phi.copy()
    path, errors = np.empty((runs, samples + 1, n)), np.zeros(phi.shape[:3])
    path[:, 0] = theta
    for k in range(samples):
        before[:, k] = P
        last = used[:, k - 1] if k else None
        forgotten = rule(Sample(k, P, inverse(P), phi[:, k], last))
        prior[:, k], used[:, k] = (
            forgotten
            if isinstance(forgotten, tuple)
            else (
                forgotten,
                phi[:, k],
            )
        )
        f, Pbar = used[:, k], prior[:, k]
        S = np.eye(f.shape[1]) + f @ Pbar @ transpose(f)
        gain = Pbar @ transpose(np.linalg.solve(S, f))
        keep = np.eye(n) - gain @ f
        P = symmetric(keep @ Pbar @ transpose(keep) + gain @ transpose(gain))
        if y is not None:
            errors[:, k] = y[:, k] - np.einsum("bpn,bn->bp", phi[:, k], theta)
            theta = theta + np.einsum("bnp,bp->bn", gain, errors[:, k])
        after[:, k], path[:, k + 1] = P, theta
    return Runs(used, before, prior, after, path, errors)


# ------------------------------------------------------------------ proper rules


def none():
    return lambda s: s.P


def exponential(factor):
    return lambda s: s.P / factor


def variable_rate(factors):
    return lambda s: s.P / factors[s.k]


def resetting(factor, R_inf):
    return lambda s: inverse(factor * s.R + (1 - factor) * R_inf)


def variable_direction(factor, threshold):
    """VDF by eigen-decomposition, Goel et al. (64)-(69)."""

    def rule(s):
        sigma, U = np.linalg.eigh(s.R)
        informed = np.linalg.norm(s.phi @ U, axis=1) > threshold
        sigma = np.where(informed, factor * sigma, sigma)
        return symmetric((U / sigma[:, None, :]) @ transpose(U))

    return rule


def oblique_projection(factor):
    """VDF-OPD, Zhu et al. (17)-(23), covariance form."""

    def rule(s):
        gram = symmetric(s.phi @ s.R @ transpose(s.phi))
        add = transpose(s.phi) @ np.linalg.pinv(gram, rcond=1e-10, hermitian=True) @ s.phi
        return s.P + (1 / factor - 1) * symmetric(add)

    return rule


def subspace(factor, threshold):
    """SIFt-RLS: oblique projection on the singular directions above the threshold."""

    def rule(s):
        U, sigma, Vt = np.linalg.svd(s.phi, full_matrices=False)
        filtered = (U * np.where(sigma >= threshold**0.5, sigma, 0.0)[:, None, :]) @ Vt
        inner = Sample(s.k, s.P, s.R, filtered, s.last)
        return oblique_projection(factor)(inner), filtered

    return rule


def random_walk(Q):
    return lambda s: s.P + Q


def component_discount(factors):
    """West and Harrison: each parameter discounted by itself."""

    def rule(s):
        variance = np.diagonal(s.P, axis1=1, axis2=2) * (1 / factors - 1)
        return s.P + np.eye(len(factors)) * variance[:, None, :]

    return rule


def restricted(factor):
    """Kulhavy and Karny, one row: inflate along the gain of the sample before."""

    def rule(s):
        if s.last is None:
            return s.P
        gain = s.P @ transpose(s.last)
        size = s.last @ gain
        safe = np.where(size > 0, size, 1.0)
        return s.P + np.where(size > 0, (1 - factor) / (factor * safe), 0.0) * (
            gain @ transpose(gain)
        )

    return rule


# ---------------------------------------------------------------- improper rules


def constant_trace(c1, c2):
    def rule(s):
        trace = np.trace(s.P, axis1=1, axis2=2)[:, None, None]
        return c1 * s.P / trace + c2 * np.eye(s.P.shape[-1])

    return rule


def multiple(factors):
    """Vahidi et al.: R̄ = diag(λ_i R_ii)."""
    return lambda s: (
        np.eye(len(factors)) / (factors * np.diagonal(s.R, axis1=1, axis2=2))[:, None, :]
    )


def cyclic(factor, r_inf):
    """Cyclic resetting: a cycle of n steps puts back (1 - λⁿ) R_∞."""

    def rule(s):
        n = s.R.shape[-1]
        j = s.k % n
        e = np.zeros((n, n))
        e[j, j] = (1 - factor**n) * r_inf / factor ** (n - 1 - j)
        return inverse(factor * s.R + e)

    return rule


def vector_type(factors):
    root = np.sqrt(factors)
    return lambda s: s.P / (root[:, None] * root[None, :])


def data_dependent_printed(mu):
    """The form (47)-(50) of Lai and Bernstein with Γ = I: λ_k = (1 - μ_k) μ_{k-1} / μ_k."""
    return lambda s: s.P * mu[s.k + 1] / ((1 - mu[s.k + 1]) * mu[s.k])


# -------------------------------------------------------------------- excitation


def exciting(rng, runs, samples, rows, n, window, blur=0.2):
    """Regressors that excite n directions in every `window` samples: φ (B, T, p, n).

    The axes follow each other with period `window`, turned at random for each run and
    blurred, so that windows differ. Needs rows x window >= n.
    """
    order = np.floor(np.arange(rows * window) * n / (rows * window)).astype(int)
    pattern = np.eye(n)[order].reshape(window, rows, n)
    phi = np.tile(pattern, (-(-samples // window), 1, 1))[:samples]
    turn = np.linalg.qr(rng.normal(size=(runs, 1, n, n)))[0]
    return phi[None] @ turn + blur * rng.uniform(-1, 1, (runs, samples, rows, n))
