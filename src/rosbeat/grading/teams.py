"""Share what a team handed in: each of its members gets it, and a mark of their own for it.

A team is what a column `team` or `group` of the roster says, or several people whom a platform
names for one submission. Marks, deadlines, late days and points by hand stay each learner's own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rosbeat.grading.files import printable
from rosbeat.grading.remarks import Remark
from rosbeat.grading.submissions import Collection, HandedIn, Submission


def share_in_teams(found: Collection, teams: Mapping[str, Sequence[str]]) -> Collection:
    """Give each member of a team what any of them handed in.

    Args:
        found: The class.
        teams: The ids of the members of each team. A submission under the name of the team itself,
            such as a folder, belongs to the team, and is no learner's.

    Returns:
        The class. Of a page that several members handed in, the newest that can be read counts.
    """
    by_id = {one.learner: one for one in found.submissions}
    members = {learner for several in teams.values() for learner in several}
    for team, several in teams.items():
        own = [by_id[learner] for learner in several]
        of_team = [
            submission
            for submission in found.submissions
            if submission.learner not in members and has_name_of(team, submission)
        ]
        by_id |= {one.learner: _with_all(one, team, [*own, *of_team]) for one in own}
        for one in of_team:
            by_id.pop(one.learner, None)
    return replace(found, submissions=tuple(by_id.values()))


def has_name_of(team: str, submission: Submission) -> bool:
    """Return whether a submission is under the name of a team, such as a folder."""
    return _plain(team) in (_plain(submission.learner), _plain(submission.name))


def _plain(text: str) -> str:
    return " ".join(text.casefold().split())


def _with_all(member: Submission, team: str, everybody: Sequence[Submission]) -> Submission:
    """Return a member's submission with every page of the team."""
    pages: list[HandedIn] = []
    remarks = list(member.remarks)
    for lesson in sorted({page.page for one in everybody for page in one.pages}):
        handed = [(one, page) for one in everybody for page in one.pages if page.page == lesson]
        best = max((page for _, page in handed), key=_rank)
        pages.append(best)
        if best not in member.pages:
            who = printable(team, 60)
            text = f"It was handed in by the team {who}, and counts for all its members."
            remarks.append(Remark("team", best.path, text))
    unread = tuple(dict.fromkeys(remark for one in everybody for remark in one.unread))
    return replace(member, pages=tuple(pages), remarks=tuple(remarks), unread=unread)


def _rank(page: HandedIn) -> tuple[bool, float, int]:
    return bool(page.notebook.cells), page.modified, len(page.notebook.cells)
