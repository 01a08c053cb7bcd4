"""The list of claims stands up, and the quick claims hold."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))

from verification.claims import Claim, ClaimError, judge, missed, read_claims  # noqa: E402
from verification.report import write_reports  # noqa: E402
from verification.run import CaseReport  # noqa: E402

CLAIM = {
    "id": "elastica.test",
    "title": "a title",
    "script": "elastica",
    "source": "A. Author, Journal of Beams 1 (1900) 1-10, table 1",
    "provenance": "READ",
    "quantity": "deflection",
    "unit": "m",
    "reference": 2.0,
    "comparison": "relative",
    "tolerance": 1e-3,
    "reason": "three digits in the source",
}


@pytest.fixture
def claim():
    return Claim(**CLAIM)


def test_the_list_of_claims_can_be_read():
    assert len(read_claims()) > 5


@pytest.mark.parametrize("source", ["", "  ", "litz, an earlier run of the same deck", "a paper"])
def test_a_claim_without_a_source_outside_litz_is_refused(source):
    with pytest.raises(ClaimError, match="source"):
        Claim(**CLAIM | {"source": source})


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("provenance", "MEMORY", "allowed are READ"),
        ("reason", "", "reason is empty"),
        ("comparison", "roughly", "allowed are relative"),
        ("reference", 0.0, "needs an absolute tolerance"),
        ("tolerance", 0.0, "must be positive"),
        ("script", "nothing", "no cases/nothing.py"),
    ],
)
def test_a_claim_that_cannot_stand_is_refused(name, value, message):
    with pytest.raises(ClaimError, match=message):
        Claim(**CLAIM | {name: value})


def test_an_unknown_or_missing_entry_and_a_claim_given_twice_are_refused(tmp_path):
    def written(*entries):
        blocks = ["[[case.claim]]\n" + "\n".join(f"{key} = {value!r}" for key, value in entry.items()) for entry in entries]
        (tmp_path / "claims.toml").write_text("\n".join(["[[case]]", *blocks]))
        return tmp_path / "claims.toml"

    assert read_claims(written(CLAIM)) == [Claim(**CLAIM)]
    with pytest.raises(ClaimError, match="unknown tolerence"):
        read_claims(written(CLAIM | {"tolerence": 1.0}))
    with pytest.raises(ClaimError, match="no reason"):
        read_claims(written({key: value for key, value in CLAIM.items() if key != "reason"}))
    with pytest.raises(ClaimError, match=r"twice: elastica\.test"):
        read_claims(written(CLAIM, CLAIM))


@pytest.mark.parametrize(("value", "passed"), [(2.0, True), (2.0019, True), (2.0021, False), (float("nan"), False)])
def test_a_relative_difference_is_judged(claim, value, passed):
    assert judge(claim, value).passed is passed


def test_a_list_is_judged_by_its_worst_value():
    claim = Claim(**CLAIM | {"reference": [0.0, 1.0], "comparison": "absolute"})
    assert judge(claim, [1e-4, 1.0]).passed
    assert not judge(claim, [1e-4, 1.01]).passed
    assert not judge(claim, [1e-4]).passed


def test_a_bound_is_judged():
    claim = Claim(**CLAIM | {"comparison": "at_most", "tolerance": 10, "reference": "36 elsewhere"})
    assert judge(claim, 10).passed
    assert not judge(claim, 11).passed


def test_the_reports_show_misses(tmp_path, claim):
    report = CaseReport("elastica", "A title\n\nSource: ...", [judge(claim, 2.0), missed(claim, "it broke")], None, 1.0)
    write_reports([report], tmp_path)
    for name in ("report.md", "report.html"):
        text = (tmp_path / name).read_text()
        assert "1 hold, 1 missed" in text
        assert "MISS" in text
        assert "it broke" in text
