"""Pages that are broken, forged or from elsewhere."""

import io
import json
import zipfile
from pathlib import Path

from hostile.deed import RIGHT, WRONG, Upload

ROOT = Path(__file__).resolve().parents[2]
PAGE = "03_write_a_publisher.ipynb"


def page(answer=RIGHT, change=None):
    """Page 03 with an answer to 03a, changed further."""
    body = json.loads((ROOT / "notebooks" / PAGE).read_text(encoding="utf-8"))
    cell_of(body, "exercise")["source"] = answer
    if change is not None:
        change(body)
    return json.dumps(body).encode()


def cell_of(body, sort, exercise="03a"):
    found = (c for c in body["cells"] if c["metadata"].get("rosbeat", {}).get(sort) == exercise)
    return next(found)


def _claims(body):
    """Outputs and metadata that say it is passed, everywhere they might be looked for."""
    said = {"output_type": "stream", "name": "stdout", "text": "03a passed: 2 of 2 points\n"}
    for one in body["cells"]:
        if one["cell_type"] == "code":
            one["outputs"] = [said]
        one["metadata"]["rosbeat_outcome"] = {"status": "passed", "points": 2}
    body["metadata"]["rosbeat"]["passed"] = ["03a", "03b", "03c"]


def _edited_check(body):
    cell_of(body, "check")["source"] = "print('passed')\ncheck = lambda *a: 'passed'"


def _other_subject(body):
    cell_of(body, "check")["source"] = 'check("03a", SteadySensor)'


def _no_checks(body):
    body["cells"] = [c for c in body["cells"] if not c["metadata"].get("rosbeat", {}).get("check")]


def _copied_ids(body):
    one = cell_of(body, "exercise")
    wrong = json.loads(json.dumps(one)) | {"source": WRONG}
    body["cells"] = [wrong, *body["cells"], one, wrong]
    for cell in body["cells"]:
        cell["id"] = one["id"]


def _points(body):
    for one in body["cells"]:
        if "nbgrader" in one["metadata"]:
            one["metadata"]["nbgrader"]["points"] = 1e9


def _another_exercise(body):
    """The easy answer under every exercise's name."""
    for one in ("03b", "03c"):
        cell_of(body, "exercise", one)["source"] = RIGHT


def _version_3(body):
    cells = [{"cell_type": c["cell_type"], "metadata": c["metadata"], "input": c["source"]}
             for c in body["cells"]]  # fmt: skip
    for name in list(body):
        del body[name]
    body |= {"nbformat": 3, "nbformat_minor": 0, "metadata": {},
             "worksheets": [{"cells": cells, "metadata": {}}]}  # fmt: skip


def _widgets(body):
    state = {"a" * 32: {"model_module": "<script>alert(1)</script>", "state": {"x": "y" * 10_000}}}
    body["metadata"]["widgets"] = {"application/vnd.jupyter.widget-state+json": {"state": state}}


def _odd_types(body):
    for one in body["cells"]:
        one["metadata"]["rosbeat"] = ["03a"]
        one["id"] = {"a": 1}
        one["outputs"] = "none"


def _sources_are_numbers(body):
    for one in body["cells"]:
        one["source"] = [1, None, {"a": 2}]


def _hidden_base(body):
    """The answer builds on a cell above that does more than it needs."""
    cell_of(body, "exercise")["source"] = RIGHT.replace("(Node)", "(Base)")
    body["cells"].insert(2, {"cell_type": "code", "id": "base", "metadata": {}, "outputs": [],
                             "source": "Base = __import__('os') and Node"})  # fmt: skip


def _above(*cells):
    """Cells above the answer, of which one may define what it needs."""

    def change(body):
        for source in cells:
            body["cells"].insert(1, {"cell_type": "code", "id": "", "metadata": {}, "outputs": [],
                                     "source": source})  # fmt: skip

    return change


def _twice(body):
    """Names of cells as no JSON library of this world writes them."""
    for one in body["cells"]:
        one["id"] = "\ud800" + one["id"]
        one["metadata"]["rosbeat"] = one["metadata"].get("rosbeat", {}) | {"x": [[]] * 100}


def _no_names(body):
    for one in body["cells"]:
        one["metadata"], one["id"] = {}, "same"


#: Names that are defined nowhere, and cells that might define them.
_UNKNOWN = "; ".join(f"n{n}" for n in range(3_000))
_MIGHT = "é = 1\n" + "\n".join(f"y{n} = {n}" for n in range(300))
_SUM = f"BASE = {' + '.join(['1'] * 900)}"
_CHAIN = f"BASE = Node{'.x' * 2_000}"


def _zip(files):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return buffer.getvalue()


_WHOLE = page()
UPLOADS = (
    Upload("no JSON", {PAGE: b"this is no notebook"}, "held", "not a notebook"),
    Upload("JSON that is no notebook", {PAGE: b"[1, 2, 3]"}, "held", "not a notebook"),
    Upload("empty", {PAGE: b""}, "held", "empty"),
    Upload("broken off", {PAGE: _WHOLE[: len(_WHOLE) * 3 // 4]}, "held", "not whole"),
    Upload("NUL bytes", {PAGE: bytes(5_000)}, "held", "empty"),
    Upload("random bytes", {PAGE: bytes(range(256)) * 40}, "held", "not a notebook"),
    Upload("UTF-16", {PAGE: _WHOLE.decode().encode("utf-16")}, ""),
    Upload("a byte order mark", {PAGE: b"\xef\xbb\xbf" + _WHOLE}, "passed"),
    Upload("brackets, 100,000 deep", {PAGE: b"[" * 100_000}, "held", "not a notebook"),
    Upload("a number with a million digits", {PAGE: b'{"cells": [], "nbformat": ' + b"9" * 10**6},
           "held", "breaks off"),
    Upload("forged outputs", {PAGE: page(WRONG, _claims)}, "failed", "readings"),
    Upload("an edited check", {PAGE: page(WRONG, _edited_check)}, "failed", "readings"),
    Upload("a check of another class", {PAGE: page(WRONG, _other_subject)}, "failed", "topic"),
    Upload("deleted checks", {PAGE: page(WRONG, _no_checks)}, "failed", "readings"),
    Upload("copied cell ids", {PAGE: page(WRONG, _copied_ids)}, "failed", ""),
    Upload("points of its own", {PAGE: page(WRONG, _points)}, "failed", "readings"),
    Upload("one answer for all", {PAGE: page(RIGHT, _another_exercise)}, "passed"),
    Upload("version 3", {PAGE: page(WRONG, _version_3)}, "held", "not a notebook"),
    Upload("version 99", {PAGE: page(WRONG, lambda body: body.update(nbformat=99))}, "failed"),
    Upload("widgets", {PAGE: page(RIGHT, _widgets)}, "passed"),
    Upload("odd types", {PAGE: page(WRONG, _odd_types)}, "failed"),
    Upload("sources that are numbers", {PAGE: page(RIGHT, _sources_are_numbers)}, ""),
    Upload("a hidden base", {PAGE: page(RIGHT, _hidden_base)}, "passed"),
    Upload("magics", {PAGE: page("%run /etc/passwd\n" + RIGHT)}, "passed", ""),
    Upload("a shell escape", {PAGE: page("!cat /etc/passwd\n" + RIGHT)}, "passed", ""),
    Upload("a cell magic", {PAGE: page("%%bash\ncat /etc/passwd")}, "not attempted", "No cell"),
    Upload("a terminal where none is", {PAGE: page("%%terminal x\nid")}, "not attempted",
           "No cell"),
    Upload("a file where none is", {PAGE: page("%%save ../../x\nid")}, "failed", "%%save"),
    Upload("control characters", {PAGE: page("\x1b]0;owned\x07\x00" + RIGHT)}, "failed"),
    Upload("letters that look alike", {PAGE: page(RIGHT.replace("Float32(", "Flоat32("))}, "failed",
           "Fl"),
    Upload("half a letter", {PAGE: page('x = "\ud800"\n' + WRONG)}, "failed"),
    Upload("a formula as evidence", {PAGE: page("raise ValueError('=HYPERLINK(1)')")}, "failed"),
    Upload("markup as evidence", {PAGE: page(
        "raise ValueError('<script>alert(1)</script><img src=x onerror=alert(1)>')")}, "failed",
        "script"),
    Upload("a zip bomb", {"all.zip": lambda: _zip({PAGE: b" " * 70_000_000})}, "held", "70 MB"),
    Upload("a zip that leads out", {"all.zip": _zip({f"../../{PAGE}": page(RIGHT)})}, "passed"),
    Upload("a zip that is none", {"all.zip": b"PK\x03\x04" + bytes(100)}, "held", "opened"),
    Upload("a zip in a zip in a zip", {"all.zip": _zip({"a.zip": _zip(
        {"b.zip": _zip({PAGE: _WHOLE})})})}, "held", "in a zip file"),
    Upload("no page of this course", {"x.ipynb": b'{"cells": [], "nbformat": 4, "metadata": {}}'},
           words="not a page"),
    Upload("a program", {"homework.py": RIGHT.encode()}, words="not a notebook"),
    Upload("options of a magic without end", {PAGE: page(f"%time {'-a1' * 40}!x\n{RIGHT}")},
           "failed"),
    Upload("a helper that is a long sum", {PAGE: page(
        RIGHT.replace("0.5", "BASE / 1800"), _above(_SUM))}, "passed"),
    Upload("a helper that is a long chain", {PAGE: page(f"BASE\n{RIGHT}", _above(_CHAIN))},
           "failed"),
    Upload("names that no cell defines", {PAGE: page(
        f"def unused():\n    {_UNKNOWN}\n\n{RIGHT}", _above(*[_MIGHT] * 90))}, "passed"),
    Upload("helpers that need each other", {PAGE: page(f"n0\n{RIGHT}", _above(
        "\n".join(f"n{n} = n{n + 1}" for n in range(2_000))))}, "failed"),
    Upload("a program of 300,000 statements", {PAGE: page("a = 1\n" + "a;" * 300_000 + RIGHT)}, ""),
    Upload("a comparison of 200,000 terms", {PAGE: page(f"x = {'1<' * 200_000}1\n{RIGHT}")}, ""),
    Upload("a call of 50,000 brackets", {PAGE: page(f"x = int{'()' * 40_000}\n{WRONG}")}, "failed"),
    Upload("half letters for ids", {PAGE: page(RIGHT, _twice)}, "passed"),
    Upload("cells without names", {PAGE: page(RIGHT, _no_names)}, "passed"),
    Upload("2,000 copies of a cell", {PAGE: page(RIGHT, _above(*[WRONG] * 1_900))}, "passed"),
    Upload("a name that stands twice", {PAGE: _WHOLE.replace(b'"cells":', b'"cells": 1, "cells":')},
           "passed"),
    Upload("numbers that are none", {PAGE: _WHOLE.replace(b'"nbformat": 4', b'"nbformat": NaN')},
           "passed"),
    Upload("a zip with 20,000 folders in each other", {"all.zip": _zip(
        {"a/" * 20_000 + PAGE: _WHOLE})}, "", "folders"),
    Upload("a zip with 20,001 files", {"all.zip": lambda: _zip(
        {str(n): b"" for n in range(20_001)})}, "held", "entries"),
    Upload("a zip for somebody else", {"all.zip": _zip(
        {f"Ana_4711_assignsubmission_file_/{PAGE}": _WHOLE})}, "passed"),
    Upload("a file for somebody else", {f"ana_4711_1_{PAGE}": _WHOLE}, "passed"),
    Upload("a file of Moodle for somebody else", {f"Ana_4711_assignsubmission_file_{PAGE}": _WHOLE},
           "passed"),
    Upload("a notebook of many lists", {PAGE: b'{"cells": [' + b"[]," * 500_000 + b"[]]}"}, ""),
)  # fmt: skip
