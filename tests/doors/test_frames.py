"""Data frames in and out: the numbers are those of arrays, names and index are those given."""

from __future__ import annotations

import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
import xarray as xr

import forgetting as fg
from forgetting import frames

T = 40
RNG = np.random.default_rng(1)
X = RNG.normal(size=(T, 2))
Y = X @ [[1.0, -1.0], [2.0, 0.5]] + 0.1 * RNG.normal(size=(T, 2))
INDEX = pd.date_range("2024-01-01", periods=T, freq="h", name="when")
NAMES = ["sun", "wind"]


def of_pandas(values, names):
    if values.ndim == 1:
        return pd.Series(values, index=INDEX, name=names[0])
    return pd.DataFrame(values, index=INDEX, columns=names)


def of_xarray(values, names):
    labels = {"time": INDEX.values, "name": names} if values.ndim == 2 else {"time": INDEX.values}
    return xr.DataArray(values, dims=("time", "name")[: values.ndim], coords=labels)


LIBRARIES = {
    "pandas": of_pandas,
    "polars": lambda v, n: pl.Series(n[0], v) if v.ndim == 1 else pl.DataFrame(v, schema=n),
    "pyarrow": lambda v, n: (
        pa.array(v) if v.ndim == 1 else pa.table(dict(zip(n, v.T, strict=True)))
    ),
    "xarray": of_xarray,
}


@pytest.mark.parametrize("library", LIBRARIES)
@pytest.mark.parametrize("make", [fg.RLS, fg.Bank], ids=["RLS", "Bank"])
def test_the_results_are_those_of_arrays_in_the_library_that_was_given(library, make):
    made = LIBRARIES[library]
    phi = made(X, NAMES)
    expected = make(2).run(X, Y[:, 0], outputs=("theta", "error", "leverage", "variance"))
    found = frames.run(
        make(2), phi, made(Y[:, 0], ["power"]), outputs=("theta", "error", "leverage", "variance")
    )
    if library == "xarray":
        assert found.theta.dims == ("time", "name")
        assert (found.theta.sel(name="wind") == expected.theta[:, 1]).all()
        assert found.indexes["time"].equals(INDEX)
        columns = [found[name].values for name in ("theta", "error", "leverage", "variance")]
        assert [c.shape for c in columns] == [(T, 2), (T,), (T,), (T, 2)]
        table = np.column_stack(columns)
    else:
        assert type(found) is type(phi)
        labels = found.column_names if library == "pyarrow" else list(found.columns)
        assert labels == ["sun", "wind", "error", "leverage", "variance[sun]", "variance[wind]"]
        table = np.column_stack([np.asarray(found[label]) for label in labels])
    if library == "pandas":
        assert found.index.equals(INDEX)
        assert found.index.name == "when"
    parts = (
        expected.theta,
        expected.error.reshape(T, 1),
        expected.leverage[:, None],
        expected.variance,
    )
    assert (table == np.hstack(parts)).all()


@pytest.mark.parametrize("library", ["pandas", "xarray"])
def test_the_index_tells_the_time(library):
    made, rule = LIBRARIES[library], fg.Subspace(half_life="12h")
    keep = np.sort(np.random.default_rng(2).choice(T, size=25, replace=False))
    phi, y = made(X, NAMES), made(Y[:, 0], ["power"])
    phi, y = (each.iloc[keep] if library == "pandas" else each[keep] for each in (phi, y))
    found = frames.run(fg.RLS(2, rule=rule), phi, y, outputs="theta", time="index")
    got = found.to_numpy() if library == "pandas" else found.theta.values
    # in hours; the first sample of all takes one unit of time, which is a second of the index
    hours = np.append(keep[0] - 1 / 3600, keep)
    expected = fg.RLS(2, rule=fg.Subspace(half_life=12.0)).run(X[keep], Y[keep, 0], time=hours)
    assert got == pytest.approx(expected.theta, rel=1e-9)
    even = fg.RLS(2, rule=fg.Subspace(half_life=12.0)).run(X[keep], Y[keep, 0])
    assert np.abs(even.theta - expected.theta)[5:].max() > 1e-3
    with pytest.raises(fg.InvalidInput, match="time"):
        frames.run(fg.RLS(2), pl.DataFrame(X), Y[:, 0], time="index")


def test_several_targets_have_a_column_each():
    y = of_pandas(Y, ["power", "flow"])
    found = frames.run(fg.RLS(2, targets=2), of_pandas(X, NAMES), y, outputs=("theta", "error"))
    assert list(found.columns) == [
        "sun[power]", "sun[flow]", "wind[power]", "wind[flow]", "error[power]", "error[flow]",
    ]  # fmt: skip
    plain = fg.RLS(2, targets=2).run(X, Y, outputs=("theta", "error"))
    assert (found["wind[power]"] == plain.theta[:, 1, 0]).all()
    assert (found["error[flow]"] == plain.error.reshape(T, 2)[:, 1]).all()
    cube = frames.run(
        fg.RLS(2, targets=2), of_xarray(X, NAMES), of_xarray(Y, ["power", "flow"]),
        outputs=("theta", "error", "covariance", "skipped"),
    )  # fmt: skip
    assert cube.theta.dims == ("time", "name", "target")
    assert (cube.theta.sel(name="sun", target="flow") == plain.theta[:, 0, 1]).all()
    assert (cube.error.sel(target="flow") == plain.error.reshape(T, 2)[:, 1]).all()
    assert cube.covariance.shape == (T, 2, 2)


def test_codes_are_words_and_missing_values_of_any_kind_are_missing():
    holes = pd.DataFrame({"n": pd.array([1, 2, None, 4], dtype="Int64"), "b": [True, False] * 2})
    y = pl.Series([1.0, None, 3.0, 4.0])
    found = frames.run(fg.RLS(2), holes, y, outputs=("skipped",), missing="skip")
    assert found["skipped"].tolist() == ["", "missing", "missing", ""]
    assert found.index.equals(holes.index)
    with pytest.raises(fg.InvalidInput, match="phi"):
        frames.run(fg.RLS(2), holes, [1.0, 2.0, 3.0, 4.0])


def test_a_data_set_is_a_table_of_its_variables():
    data = xr.Dataset({"sun": ("k", X[:, 0]), "wind": ("k", X[:, 1])})
    found = frames.run(fg.RLS(2), data, Y[:, 0], gamma=xr.DataArray(np.full(T, 2.0), dims="k"))
    assert found.theta.dims == ("k", "parameter")
    assert (found.theta.values == fg.RLS(2).run(X, Y[:, 0], np.full(T, 2.0)).theta).all()


PHI, POWER = of_pandas(X, NAMES), of_pandas(Y[:, 0], ["power"])
MISALIGNED = [
    (
        PHI,
        POWER[::-1],
        r"phi and y have different indexes, in row 0 first: 2024-01-01 00:00:00 and",
    ),
    (PHI, POWER.reset_index(drop=True), "phi and y have different indexes"),
    (PHI, POWER.iloc[:-1], "phi and y have different indexes, of 40 and 39 rows"),
    (PHI, of_xarray(Y[::-1, 0], []).sortby("time", ascending=False), "different indexes"),
    (
        PHI.rename(columns={"sun": "error"}),
        POWER,
        "column 'error' would be one with the output 'error'",
    ),
    (PHI.rename(columns={"sun": "wind"}), POWER, "phi has two columns of the same name"),
    (PHI.assign(wind="calm"), POWER, "phi: column 'wind' holds String, allowed: numbers"),
    (PHI.assign(wind=INDEX), POWER, r"phi: column 'wind' holds Datetime.*, allowed: numbers"),
    (X, POWER, "phi is of type ndarray, expected a data frame"),
    (xr.DataArray(np.zeros((2, 2, 2))), POWER, "phi has 3 dimensions"),
    (pl.DataFrame(X).lazy(), POWER, "phi is of type LazyFrame"),
]


@pytest.mark.parametrize(("phi", "y", "message"), MISALIGNED, ids=lambda a: str(a)[-40:-20])
def test_what_does_not_fit_is_refused(phi, y, message):
    est = fg.RLS(2)
    before = est.to_bytes()
    with pytest.raises(fg.InvalidInput, match=message):
        frames.run(est, phi, y)
    assert est.to_bytes() == before


@pytest.mark.parametrize("library", LIBRARIES)
def test_models_take_frames_and_answer_in_them(library):
    made = LIBRARIES[library]
    u, y = made(X, NAMES), made(Y[:, 0], ["power"])
    if library == "pyarrow":
        y = Y[:, 0]
    model, plain = fg.ARX(na=1, nb=1).fit(u, y), fg.ARX(na=1, nb=1).fit(X, Y[:, 0])
    assert (model.theta_ == plain.theta_).all()
    output = "power" if library in ("pandas", "polars") else "y"
    assert model.names_ == [f"{output}(k-1)", "sun(k)", "wind(k)"]
    assert plain.names_ == ["y(k-1)", "u1(k)", "u2(k)"]
    predicted = model.predict(u, y)
    assert np.asarray(predicted) == pytest.approx(plain.predict(X, Y[:, 0]), rel=0, nan_ok=True)
    if library == "pandas":
        assert predicted.index.equals(INDEX)
        assert predicted.name == "power"
    if library == "xarray":
        assert predicted.indexes["time"].equals(INDEX)


def test_models_refuse_inputs_and_outputs_of_different_rows():
    model = fg.ARX(na=1, nb=1)
    with pytest.raises(fg.InvalidInput, match="u and y have different indexes, in row 0"):
        model.fit(PHI, POWER[::-1])
    model.fit(PHI, POWER)
    both = pd.DataFrame(Y, index=INDEX, columns=["power", "flow"])
    model.fit(PHI, both)
    assert list(model.predict(PHI, both).columns) == ["power", "flow"]
    with pytest.raises(fg.InvalidInput, match="different indexes"):
        model.predict(PHI, both.iloc[::-1])


def test_the_numbers_of_a_cut_out_record_keep_their_index():
    late = PHI.iloc[10:20]
    found = frames.run(fg.Bank(2), late, POWER.iloc[10:20], outputs=("memory", "weights"))
    assert found.index.equals(INDEX[10:20])
    assert [c for c in found.columns if c.startswith("weights")] == [
        f"weights[{k}]" for k in range(8)
    ]


def test_columns_may_be_called_by_numbers():
    plain = pd.DataFrame(X)
    assert frames.read("phi", plain).names == ("0", "1")
    np.testing.assert_array_equal(frames.read("phi", plain).values, X)
