"""`course doctor`: looks, changes nothing, and says what works, with the cure for what does not."""

from __future__ import annotations

import os
from collections.abc import Sequence

from course_tool import diagnosis_commands, diagnosis_machine, diagnosis_ros, surroundings
from course_tool.findings import Finding
from course_tool.layout import Layout
from course_tool.messages import say


def doctor(layout: Layout, arguments: Sequence[str]) -> int:
    """Print every finding; return 1 when something needs a cure."""
    clean = surroundings.cleaned(os.environ, layout)
    findings = look(layout, clean)
    for finding in findings:
        say(line(finding))
    problems = sum(finding.state == "problem" for finding in findings)
    say(closing(problems))
    return 1 if problems else 0


def look(layout: Layout, clean: surroundings.Surroundings) -> list[Finding]:
    """Look at everything; at ROS and its commands only in a `.venv` that can be used."""
    findings = diagnosis_machine.findings(layout, clean)
    if all(finding.state == "ok" for finding in findings if finding.subject == ".venv"):
        findings += diagnosis_ros.findings(layout, clean)
        findings += diagnosis_commands.findings(layout, clean)
    return [*findings, diagnosis_commands.workspace(layout, clean.environ)]


def line(finding: Finding) -> str:
    """Return a finding as a person reads it."""
    text = f"{finding.state:8} {finding.subject:18} {finding.text}"
    if finding.cure:
        text += f"\n{'':8} {'':18} -> {finding.cure}"
    return text


def closing(problems: int) -> str:
    """Return the last line."""
    if not problems:
        return "\nEverything that the course needs works here."
    things = "One thing needs" if problems == 1 else f"{problems} things need"
    return f"\n{things} a cure; the arrow beside each says which."
