"""How one file of a batch went."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .plan import Job

__all__ = ("DONE", "FAILED", "KEPT", "Outcome", "counts")

DONE, KEPT, FAILED = "done", "kept", "failed"


@dataclass(frozen=True)
class Outcome:
    """What there is to say of a file."""

    job: Job
    status: str
    """`DONE`, `KEPT` (was done before) or `FAILED`"""
    seconds: float = 0.0
    """that it took, when it was done"""
    report: dict[str, Any] | None = None
    """as the run with one file writes it; None where it failed"""
    error: str = ""
    """one line; empty where it did not fail"""


def counts(outcomes: Sequence[Outcome]) -> dict[str, int]:
    """Return how many files there are of each status."""
    return {
        status: sum(outcome.status == status for outcome in outcomes)
        for status in (DONE, KEPT, FAILED)
    }
