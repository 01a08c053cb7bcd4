"""The list of claims: read from claims.toml, checked, and compared with what was measured."""

import sys
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

FOLDER = Path(__file__).parent
#: The list of claims
CLAIMS = FOLDER / "claims.toml"

#: How the reference value is known
PROVENANCE = {
    "READ": "read in the cited source",
    "COMPUTED": "computed independently of any finite-element code",
    "DERIVED": "closed form derived from the cited source",
    "CONSISTENCY": "two runs that must agree, as the source says, are compared with each other; no value is verified",
}
COMPARISONS = ("relative", "absolute", "at_most")


class ClaimError(ValueError):
    """A claim in claims.toml that cannot stand."""


@dataclass(frozen=True)
class Claim:
    """One row of claims.toml."""

    id: str
    title: str
    #: Name of the case, a module in cases/
    script: str
    #: Where the reference value comes from: publication with figure, table or equation; never litz itself
    source: str
    provenance: str
    quantity: str
    unit: str
    #: A number or a list of numbers; for `at_most` what others need, in words or numbers
    reference: object
    #: "relative", "absolute" (largest difference over a list) or "at_most" (the value itself is bounded)
    comparison: str
    tolerance: float
    #: Why the tolerance is what it is
    reason: str
    quick: bool = False

    def __post_init__(self):
        for field in fields(self):
            if field.type is str and not str(getattr(self, field.name)).strip() and field.name != "unit":
                raise self._error(f"{field.name} is empty")
        if self.provenance not in PROVENANCE:
            raise self._error(f"provenance is {self.provenance!r}; allowed are {', '.join(PROVENANCE)}")
        if self.comparison not in COMPARISONS:
            raise self._error(f"comparison is {self.comparison!r}; allowed are {', '.join(COMPARISONS)}")
        if self.source.strip().lower().split()[0].strip(".,:;`") == "litz" or len(self.source.split()) < 4:
            raise self._error(f"the source {self.source!r} is none outside litz")
        if not self.tolerance > 0:
            raise self._error("the tolerance must be positive")
        if self.comparison == "relative" and np.any(np.asarray(self.reference) == 0.0):
            raise self._error("a reference of zero needs an absolute tolerance")
        if not (FOLDER / "cases" / f"{self.script}.py").is_file():
            raise self._error(f"there is no cases/{self.script}.py")

    @property
    def verifies(self):
        """Whether litz is compared with something else than litz."""
        return self.provenance != "CONSISTENCY"

    def _error(self, what):
        return ClaimError(f"claim {self.id!r}: {what}")


@dataclass(frozen=True)
class Verdict:
    """A claim beside what litz gives."""

    claim: Claim
    #: What was measured, or None when the case failed before
    value: object
    difference: float
    passed: bool
    remark: str = ""


def read_claims(path=CLAIMS):
    """All claims, in the order of the file; a claim takes over what its case says and it does not say itself."""
    names = {field.name for field in fields(Claim)}
    claims = []
    for case in tomllib.loads(Path(path).read_text(encoding="utf-8"))["case"]:
        common = {key: value for key, value in case.items() if key != "claim"}
        claims += [_claim(common | entry, names) for entry in case["claim"]]
    ids = [claim.id for claim in claims]
    if twice := {name for name in ids if ids.count(name) > 1}:
        raise ClaimError(f"claims that are there twice: {', '.join(sorted(twice))}")
    return claims


def _claim(entry, names):
    what = f"claim {entry.get('id', '?')!r}"
    if unknown := set(entry) - names:
        raise ClaimError(f"{what}: unknown {', '.join(sorted(unknown))}; allowed are {', '.join(sorted(names))}")
    if missing := names - {"quick"} - set(entry):
        raise ClaimError(f"{what}: no {', '.join(sorted(missing))}")
    return Claim(**entry)


def judge(claim, value):
    """Compare a measured value with its claim."""
    measured = np.asarray(value, dtype=float)
    if claim.comparison == "at_most":
        worst = float(measured.max())
        return Verdict(claim, value, worst, bool(np.all(measured <= claim.tolerance)))
    reference = np.asarray(claim.reference, dtype=float)
    if measured.shape != reference.shape:
        return missed(claim, f"measured {measured.shape} values, the claim has {reference.shape}")
    difference = np.abs(measured - reference)
    if claim.comparison == "relative":
        difference = difference / np.abs(reference)
    worst = float(difference.max())
    return Verdict(claim, value, worst, bool(worst <= claim.tolerance))


def missed(claim, remark):
    """The verdict on a claim that could not be measured."""
    return Verdict(claim, None, float("nan"), False, remark)
