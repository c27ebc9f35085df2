"""The page of `forgetting certify`: the judgement, and what theory says beside it."""

from __future__ import annotations

from pathlib import Path

from matplotlib import pyplot as plt

from forgetting import plot
from forgetting.analysis import Certificate
from forgetting.files import check_outputs
from forgetting.record.identification import Identification
from forgetting.record.theory import reservation
from forgetting.report.page import Block, Page, Table, write
from forgetting.report.single import figures, parameters, signals
from forgetting.report.svg import inline
from forgetting.report.trust import trust


def save_certificate(
    found: Identification, certificate: Certificate, first: int, path: str | Path
) -> None:
    """Write the certificate of an identification as one HTML file.

    Parameters
    ----------
    found, certificate, first
        The identification, and what `forgetting.record.theory` returned for it.
    path : str or Path
        Where to.
    """
    check_outputs({"report": Path(path)}, found.samples.found.path)
    with plot.styled():
        blocks = [
            trust(found),
            theory(found, certificate, first),
            conditions(certificate),
            *(signals(found, output) for output in range(len(found.samples.outputs))),
            parameters(found),
        ]
    page = Page(
        title=f"Certificate of {found.samples.source}",
        subtitle=f"{found.samples.model} · {found.rule_in_words}",
        facts=found.samples.facts(),
        judgement=found.judgement,
        figures=figures(found),
        blocks=blocks,
    )
    write(page, path)


def theory(found: Identification, certificate: Certificate, first: int) -> Block:
    """The conclusions of Theorem 2."""
    rows = [
        (item.name, item.outcome, f"{item.meaning} ({item.reason})")
        for item in certificate.stability.conclusions
    ]
    part = f" Rows from {first + 1} on." if first else ""
    text = (
        "What generalized forgetting guarantees of the estimator if the model is right and its "
        "parameters stand still (Lai and Bernstein, Theorem 2). It says nothing of whether the "
        f"model is right.{part} {reservation(found.samples) or ''}".rstrip()
    )
    table = Table(("the error is", "", "because"), rows, prose=True)
    return Block("Stability of the estimator", text, table)


def conditions(certificate: Certificate) -> Block:
    """The conditions A1 to A4, with P drawn against the constants found."""
    rows = [
        (f"{item.name}: {item.statement}", item.verdict, item.reason)
        for item in certificate.conditions
        if item.constants or item.name < "A5"
    ]
    figure, ax = plt.subplots(figsize=(9.4, 2.8), layout="constrained")
    plot.conditions(certificate.conditions, ax)
    picture = inline(figure, "extreme eigenvalues of P over time with the bounds found")
    table = Table(("condition", "", "found"), rows, prose=True)
    text = str(certificate.confidence) if certificate.confidence is not None else ""
    return Block("Conditions and intervals", text, table, [picture])
