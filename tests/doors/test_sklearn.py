"""`RecursiveRegressor` of scikit-learn: its own checks, and what they do not ask."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from sklearn.base import clone
from sklearn.linear_model import BayesianRidge
from sklearn.model_selection import GridSearchCV, TimeSeriesSplit, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.utils.estimator_checks import parametrize_with_checks

import forgetting as fg
from forgetting.sklearn import RecursiveRegressor

FORGETS = {
    "check_sample_weight_equivalence_on_dense_data": (
        "a recursion over time: the check shuffles the rows, and a sample of weight 2 is one step "
        "of time where two samples are two. It passes where nothing depends on the order: without "
        "forgetting, from a given covariance."
    )
}


def expected_failures(model: RecursiveRegressor) -> dict[str, str]:
    ordered = model.rule != "none" or model.initial_covariance is None
    return FORGETS if ordered else {}


@parametrize_with_checks(
    [
        RecursiveRegressor(),
        RecursiveRegressor(fg.Exponential(fg.Fortescue())),
        RecursiveRegressor("subspace", fit_intercept=False, weighting=fg.Huber()),
        RecursiveRegressor("none", initial_covariance=1e3),
    ],
    expected_failed_checks=expected_failures,
)
def test_scikit_learns_own_checks(estimator, check):
    check(estimator)


def record(rows: int = 400, targets: int = 0, seed: int = 1):
    rng = np.random.default_rng(seed)
    x = rng.normal(size=(rows, 3)) * [1.0, 10.0, 0.1] + [300.0, 0.0, -4.0]
    theta = rng.normal(size=(3, targets or 1))
    y = x @ theta + 5.0 + 0.1 * rng.normal(size=(rows, targets or 1))
    return x, y if targets else y[:, 0]


def ridge(x, y, weight, covariance):
    """Weighted least squares from theta = 0 with covariance c I, the constant first."""
    phi = np.column_stack([np.ones(len(x)), x])
    information = phi.T @ (weight[:, None] * phi) + np.eye(phi.shape[1]) / covariance
    return np.linalg.solve(information, phi.T @ (weight * y))


def test_without_forgetting_it_is_weighted_ridge_regression():
    x, y = record()
    weight = np.random.default_rng(2).choice([0.0, 0.5, 1.0, 4.0], size=len(x))
    model = RecursiveRegressor("none", initial_covariance=100.0).fit(x, y, weight)
    theta = ridge(x, y, weight, 100.0)
    assert np.append(model.intercept_, model.coef_) == pytest.approx(theta, rel=1e-7)
    assert model.n_samples_seen_ == (weight > 0).sum()


def test_it_follows_coefficients_that_change_where_a_regression_does_not():
    rng = np.random.default_rng(3)
    x = rng.normal(size=(2000, 2))
    slopes = np.where(np.arange(2000)[:, None] < 1500, [1.0, -2.0], [3.0, 0.5])
    y = 7.0 + (x * slopes).sum(axis=1) + 0.05 * rng.normal(size=2000)
    model = RecursiveRegressor().fit(x, y)
    # a twentieth of the change
    assert model.coef_ == pytest.approx([3.0, 0.5], abs=0.1)
    assert model.intercept_ == pytest.approx(7.0, abs=0.1)
    batch = BayesianRidge().fit(x, y)
    assert np.abs(batch.coef_ - [3.0, 0.5]).max() > 1.0


@pytest.mark.parametrize("rule", ["auto", "subspace", fg.Exponential(0.95)])
@pytest.mark.parametrize("targets", [0, 1, 2])
def test_any_split_of_the_rows_is_one_fit(rule, targets):
    x, y = record(targets=targets)
    weight = np.random.default_rng(4).choice([0.0, 1.0, 2.0], size=len(x))
    whole = RecursiveRegressor(rule).fit(x, y, weight)
    parts = RecursiveRegressor(rule)
    for piece in np.split(np.arange(len(x)), [1, 2, 70, 71, 300]):
        parts.partial_fit(x[piece], y[piece], weight[piece])
    for got, expected in zip(
        parts.predict(x, return_std=True), whole.predict(x, return_std=True), strict=True
    ):
        assert got.shape == y.shape
        assert got == pytest.approx(expected, rel=1e-9)
    assert parts.fit(x, y, weight).coef_ == pytest.approx(whole.coef_, rel=0)  # fit starts again


def test_several_targets_are_as_many_models_of_one():
    x, y = record(targets=2)
    both = RecursiveRegressor("none").fit(x, y)
    assert both.coef_.shape == (2, 3)
    assert both.intercept_.shape == (2,)
    for k in range(2):
        one = RecursiveRegressor("none").fit(x, y[:, k])
        assert both.coef_[k] == pytest.approx(one.coef_, rel=1e-9)
        assert both.intercept_[k] == pytest.approx(one.intercept_, rel=1e-9)
        for got, expected in zip(
            both.predict(x, return_std=True), one.predict(x, return_std=True), strict=True
        ):
            assert got[:, k] == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("walk", [0.0, 0.002, 0.02])
@pytest.mark.parametrize("rule", ["auto", None], ids=["bank", "random walk"])
def test_the_deviation_covers_the_next_measurement(rule, walk):
    rng = np.random.default_rng(8)
    x = rng.normal(size=(1200, 3)) * [1.0, 10.0, 0.1] + [300.0, 0.0, -4.0]
    theta = np.cumsum(walk * rng.normal(size=x.shape), axis=0) * [1.0, 0.1, 10.0] + 1.0
    y = (x * theta).sum(axis=1) + 0.1 * rng.normal(size=1200)
    model, z = RecursiveRegressor(rule).fit(x[:200], y[:200]), []
    for k in range(200, 1200):
        mean, deviation = model.predict(x[k : k + 1], return_std=True)
        z.append((y[k] - mean[0]) / deviation[0])
        model.partial_fit(x[k : k + 1], y[k : k + 1])
    # of a thousand normal numbers 950 are within 1.96; the standard error of the count is 7
    assert np.mean(np.abs(z) < 1.96) == pytest.approx(0.95, abs=0.021)


def test_the_variance_of_the_noise_is_that_of_least_squares_exactly():
    x, y = record(rows=60)
    weight = np.random.default_rng(5).uniform(0.5, 2.0, size=60)
    model = RecursiveRegressor("none", initial_covariance=1e9).fit(x, y, weight)
    phi = np.column_stack([np.ones(60), x])
    root = np.sqrt(weight)
    _, squares, *_ = np.linalg.lstsq(root[:, None] * phi, root * y, rcond=None)
    leverage = np.einsum("ti,ij,tj->t", phi, np.linalg.inv(phi.T @ (weight[:, None] * phi)), phi)
    expected = np.sqrt(squares[0] / (60 - 4) * (1 + leverage))
    # what the prior changes of the first four samples, whose squares are not counted
    assert model.predict(x, return_std=True)[1] == pytest.approx(expected, rel=1e-3)
    few = RecursiveRegressor().fit(x[:4], y[:4])
    assert np.isnan(few.predict(x, return_std=True)[1]).all()


def test_units_and_zeros_of_scales_change_no_prediction():
    x, y = record()
    scale, shift = np.array([1e-6, 1.0, 1e5]), np.array([1e-3, -40.0, 7e6])
    model = RecursiveRegressor().fit(x[:300], y[:300])
    other = RecursiveRegressor().fit(x[:300] * scale + shift, 1e3 * y[:300] - 50.0)
    expected, deviation = model.predict(x, return_std=True)
    got, other_deviation = other.predict(x * scale + shift, return_std=True)
    assert got == pytest.approx(1e3 * expected - 50.0, rel=1e-6)
    assert other_deviation == pytest.approx(1e3 * deviation, rel=1e-4)


def test_only_the_ratios_of_weights_matter():
    x, y = record()
    weight = np.random.default_rng(7).choice([0.25, 1.0, 4.0], size=len(x))
    for rule, weighting in (("auto", None), (fg.Subspace(0.98), fg.Huber())):
        one = RecursiveRegressor(rule, weighting=weighting).fit(x, y, weight)
        other = RecursiveRegressor(rule, weighting=weighting).fit(x, y, 1e6 * weight)
        assert other.predict(x) == pytest.approx(one.predict(x), rel=1e-6)
    equal = RecursiveRegressor().fit(x, y, np.full(len(x), 9.0))
    assert equal.predict(x) == pytest.approx(RecursiveRegressor().fit(x, y).predict(x), rel=1e-6)


def test_a_search_sets_the_parameters_of_a_rule_in_a_pipeline_on_two_cores():
    rng = np.random.default_rng(6)
    x = rng.normal(size=(600, 2))
    walk = np.cumsum(0.1 * rng.normal(size=(600, 2)), axis=0)
    y = (x * walk).sum(axis=1) + 0.1 * rng.normal(size=600)
    rule = fg.Exponential(0.999)
    model = make_pipeline(StandardScaler(), RecursiveRegressor(rule))
    name = "recursiveregressor__rule__forgetting_factor"
    factors, split = [0.5, 0.9, 0.99, fg.UnityZone()], TimeSeriesSplit(5)
    search = GridSearchCV(model, {name: factors}, cv=split, n_jobs=2, error_score="raise")
    search.fit(x, y)
    alone = [
        make_pipeline(StandardScaler(), RecursiveRegressor(fg.Exponential(f))) for f in factors
    ]
    scores = [cross_val_score(each, x, y, cv=split).mean() for each in alone]
    assert len(set(scores)) == len(factors)
    assert search.cv_results_["mean_test_score"] == pytest.approx(scores, rel=1e-12)
    best = fg.Exponential(factors[int(np.argmax(scores))])
    assert search.best_estimator_[-1].estimator_.rule == best
    assert rule == fg.Exponential(0.999)


def test_scores_are_the_standard_ones():
    x, y = record()
    model = RecursiveRegressor().fit(x[:300], y[:300])
    late, error = y[300:], y[300:] - model.predict(x[300:])
    r2 = 1.0 - (error**2).sum() / ((late - late.mean()) ** 2).sum()
    assert model.score(x[300:], late) == pytest.approx(r2, rel=1e-12)
    assert cross_val_score(model, x, y, cv=TimeSeriesSplit(3)).min() > 0.99


RULES = [
    "auto",
    "none",
    fg.Component(blocks=[1, 3], factors=[0.9, 0.99]),
    fg.Component([0.9, 0.8, 0.7, 0.9]),
    fg.CovarianceResetting(rule=fg.Subspace(fg.Fortescue())),
    fg.Exponential(fg.Schedule([0.9, 0.99])),
]


@pytest.mark.parametrize("rule", RULES, ids=repr)
def test_clones_and_pickles_are_the_same(rule):
    x, y = record()
    model = RecursiveRegressor(rule)
    copy = clone(model)
    assert copy.get_params()["rule"] == model.rule
    fitted = model.fit(x, y)
    restored = pickle.loads(pickle.dumps(fitted))
    assert (restored.predict(x) == fitted.predict(x)).all()
    restored.partial_fit(x, y)
    fitted.partial_fit(x, y)
    assert (restored.predict(x) == fitted.predict(x)).all()
    assert (copy.fit(x, y).partial_fit(x, y).predict(x) == fitted.predict(x)).all()


def test_feature_names_are_kept_and_checked():
    pd = pytest.importorskip("pandas")
    x, y = record()
    frame = pd.DataFrame(x, columns=["T", "u", "v"])
    model = RecursiveRegressor().fit(frame, pd.Series(y))
    assert list(model.feature_names_in_) == ["T", "u", "v"]
    with pytest.raises(ValueError, match="feature names should match"):
        model.predict(frame[["u", "T", "v"]])


BAD = [
    ({}, "sample_weight", np.zeros(10), "sample_weight is zero"),
    ({}, "sample_weight", -np.ones(10), r"sample_weight\[0\] = -1.0, allowed"),
    (
        {"rule": "subspase"},
        "sample_weight",
        None,
        "rule = .subspase., allowed: none, .*; close are .subspace.",
    ),
    ({"rule": fg.Exponential(1.5)}, "sample_weight", None, "forgetting_factor = 1.5"),
    ({"initial_covariance": -1.0}, "sample_weight", None, "initial_covariance"),
]


@pytest.mark.parametrize(("settings", "name", "value", "message"), BAD, ids=lambda a: str(a)[:30])
def test_what_is_wrong_is_said(settings, name, value, message):
    x, y = record(rows=10)
    with pytest.raises(ValueError, match=message):
        RecursiveRegressor(**settings).fit(x, y, **{name: value})


def test_a_refused_part_changes_nothing():
    x, y = record()
    model = RecursiveRegressor().fit(x, y)
    before = model.predict(x, return_std=True)
    for bad in ((x[:, :2], y), (x, np.column_stack([y, y])), (np.full_like(x, np.nan), y)):
        with pytest.raises(ValueError, match=r"features|shape|NaN"):
            model.partial_fit(*bad)
    with pytest.raises(fg.InvalidInput, match="rule"):
        model.set_params(rule="subspase").fit(x[:, :2], y)
    model.set_params(rule="auto").partial_fit(x, y, np.zeros(len(x)))  # all left out
    for now, then in zip(model.predict(x, return_std=True), before, strict=True):
        assert (now == then).all()
