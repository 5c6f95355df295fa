"""Texts of manifests; what colcon's own reader refuses is refused here, too."""

import re

import pytest
from catkin_pkg.package import InvalidPackage, parse_package_string

from rosbeat.exercises.manifests import (
    diagnose_values,
    hint_on_xml,
    is_open,
    remark_on_license,
)
from rosbeat.workspace.manifest import parse_manifest
from rosbeat.workspace.stages import finished

XML = finished("package.xml")


@pytest.mark.parametrize("text", ["", "TODO", "todo", "TODO: x", "____", "...", "None", "a ____"])
def test_a_text_that_is_open(text):
    assert is_open(text)


@pytest.mark.parametrize("text", ["A TODO list.", "TODO lists of a robot", "x", "none of them"])
def test_a_text_that_is_not(text):
    assert not is_open(text)


@pytest.mark.parametrize("text", ["MIT", "apache-2.0", "MIT OR Apache-2.0", "MIT, CC-BY-4.0"])
def test_a_licence_of_the_list(text):
    assert remark_on_license(text) == ()


@pytest.mark.parametrize("text", ["Apache 2.0", "BSD", "mine", "MIT, mine"])
def test_another_licence_gets_a_remark(text):
    (said,) = remark_on_license(text)
    assert text.rpartition(", ")[2] in said


@pytest.mark.parametrize("text", ["Apahce-2.0", "Apache 2.0", "apache2.0", "MIT, Apache-2"])
def test_a_licence_that_is_nearly_one_is_asked_after(text):
    (said,) = remark_on_license(text)
    assert "Did you mean Apache-2.0?" in said


def test_a_licence_like_no_other_is_not_guessed():
    assert "Did you mean" not in remark_on_license("mine")[0]


def test_a_line_before_the_declaration_has_a_hint_of_its_own():
    assert "very first line" in hint_on_xml(parse_manifest(f"\n{XML}".encode()).problem)
    assert "</tag>" in hint_on_xml(parse_manifest(XML[:-9].encode()).problem)


@pytest.mark.parametrize(
    "xml",
    [
        XML,
        *(re.sub('format=".*?"', f'format="{one}"', XML) for one in ("2", "4", "9", "x")),
        *(XML.replace("0.0.0", one) for one in ("1.2.3", "10.0.1", "1.0", "abc", "", "1.0.0.0")),
        *(XML.replace("you@example.com", one) for one in ("a.b@c.org", "you", "a@b", "a@b.c", "")),
    ],
)
def test_colcon_s_reader_agrees(xml):
    try:
        parse_package_string(xml)
        accepted = True
    except (InvalidPackage, AssertionError, ValueError):
        accepted = False
    found = diagnose_values(parse_manifest(xml.encode()))
    assert (found is None) == accepted
    assert found is None or found.mistake == "manifest-value"
