"""Arrays inside pages: as exact as they say, read back here and by the script of the page."""

import base64
import gzip
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import litz
from litz.viewer.packed import Numbers, as_part, as_text, resolution

SCRIPT = Path(litz.__file__).parent / "viewer" / "web" / "data.js"


def read(part):
    """JSON and arrays of a part, by numpy."""
    content = gzip.decompress(base64.b64decode(part))
    start = 4 + int.from_bytes(content[:4], "little")

    def unpacked(value):
        if "planes" not in value:
            return value
        rows, columns, planes = value["rows"], len(value["steps"]), value["planes"]
        low_first = np.frombuffer(content, np.uint8, planes * rows * columns, start + value["at"]).reshape(
            planes, columns, rows
        )
        folded = (low_first.astype(np.int64) * 256 ** np.arange(planes)[:, None, None]).sum(axis=0)
        counts = np.cumsum(np.where(folded % 2, -(folded + 1) // 2, folded // 2), axis=1).T
        values = counts * np.array(value["steps"])
        if "none" in value:
            values[counts == value["none"]] = np.nan
        return values

    return json.loads(content[4:start], object_hook=unpacked)


def read_by_script(part):
    """The same by the script."""
    program = (
        "import { readFileSync } from 'node:fs'; import { gunzipSync } from 'node:zlib';"
        f"const {'{ unpack }'} = await import('data:text/javascript,' + encodeURIComponent(readFileSync('{SCRIPT}', 'utf-8')));"
        "const content = gunzipSync(Buffer.from(readFileSync(0, 'utf-8'), 'base64'));"
        "const data = unpack(new Uint8Array(content).buffer);"
        "console.log(JSON.stringify(data, (_, v) => ArrayBuffer.isView(v) ? Array.from(v, (x) => isNaN(x) ? null : x) : v));"
    )
    done = subprocess.run(
        ["node", "--input-type=module", "-e", program], input=part, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture
def data():
    random = np.random.default_rng(3)
    field = random.normal(size=(500, 3)) * [1e-9, 1.0, 1e6]
    field[7, 1] = np.nan
    return {
        "name": "a µ",
        "field": Numbers(field),
        "places": Numbers(np.cumsum(random.normal(size=(40, 4, 3)), axis=0), step=1e-4),
        "pairs": Numbers(random.integers(0, 100000, (60, 2)), np.int32, 1.0),
        "nothing": Numbers(np.zeros((0, 4, 3))),
        "zero": Numbers(np.zeros(5)),
        "inside": {"last": Numbers(np.arange(-3, 4), np.int32, 1.0)},
    }


def test_fields_have_a_part_of_their_largest_value(data):
    found, field = read(as_part(data)), data["field"].values
    assert np.isnan(found["field"][7, 1])
    error = np.abs(found["field"] - field)
    # half a step of 2^-14, columns apart from each other
    assert (np.nanmax(error, axis=0) <= 0.501 * 2**-14 * np.nanmax(np.abs(field), axis=0)).all()
    assert (found["zero"] == 0).all()
    assert found["nothing"].size == 0


def test_places_have_the_step_that_is_given_and_whole_numbers_are_exact(data):
    found = read(as_part(data))
    assert np.abs(found["places"].reshape(40, 4, 3) - data["places"].values).max() <= 0.501e-4
    assert (found["pairs"] == data["pairs"].values).all()
    assert found["inside"]["last"].ravel().tolist() == [-3, -2, -1, 0, 1, 2, 3]
    assert found["name"] == "a µ"


def test_where_size_does_not_count_all_digits_are_there(data):
    text = json.loads(as_text(data))["places"]
    assert (np.frombuffer(base64.b64decode(text), np.float32) == data["places"].values.astype(np.float32).ravel()).all()


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_the_script_of_the_page_reads_the_same(data):
    part = as_part(data)
    expected, found = read(part), read_by_script(part)
    for name in ("field", "places", "pairs", "zero", "nothing"):
        values = np.array([np.nan if one is None else one for one in found[name]])
        # the script has 32 bits
        np.testing.assert_allclose(values, expected[name].ravel(), rtol=1e-7)
    assert found["inside"]["last"] == [-3, -2, -1, 0, 1, 2, 3]


def test_small_displacements_are_as_exact_as_they_are_shown_enlarged():
    assert resolution(np.array([1e-9, 0]), 1e-4) == pytest.approx(1e-9 / 2**15)
    assert resolution(np.array([100.0]), 1e-4) == 1e-4
    assert resolution(np.zeros(0), 1e-4) == 1e-4


def test_a_part_is_much_smaller_than_all_digits():
    """A wave along a wire of 2000 elements."""
    x = np.linspace(0, 20, 2000)
    data = {"curve": Numbers(np.stack([x, np.sin(x), np.cos(x)], axis=1), step=1e-4)}
    assert len(as_part(data)) < 0.3 * len(gzip.compress(as_text(data).encode())) * 4 / 3
