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


def share_in_teams(collected: Collection, teams: Mapping[str, Sequence[str]]) -> Collection:
    """Give each member of a team what any of them handed in.

    Args:
        collected: The class.
        teams: The ids of the members of each team. A submission under the name of the team itself,
            such as a folder, belongs to the team, and is no learner's.

    Returns:
        The class. Of a page that several members handed in, the newest that can be read counts.
    """
    by_id = {submission.learner: submission for submission in collected.submissions}
    members = {learner for several in teams.values() for learner in several}
    for team, several in teams.items():
        own = [by_id[learner] for learner in several]
        of_team = [
            submission
            for submission in collected.submissions
            if submission.learner not in members and has_name_of(team, submission)
        ]
        by_id |= {
            submission.learner: _with_all(submission, team, [*own, *of_team]) for submission in own
        }
        for submission in of_team:
            by_id.pop(submission.learner, None)
    return replace(collected, submissions=tuple(by_id.values()))


def has_name_of(team: str, submission: Submission) -> bool:
    """Return whether a submission is under the name of a team, such as a folder."""
    return _plain(team) in (_plain(submission.learner), _plain(submission.name))


def _plain(text: str) -> str:
    return " ".join(text.casefold().split())


def _with_all(member: Submission, team: str, everybody: Sequence[Submission]) -> Submission:
    """Return a member's submission with every page of the team."""
    pages: list[HandedIn] = []
    remarks = list(member.remarks)
    for lesson in sorted({page.page for submission in everybody for page in submission.pages}):
        handed = (page for submission in everybody for page in submission.pages)
        best = max((page for page in handed if page.page == lesson), key=_rank)
        pages.append(best)
        if best not in member.pages:
            who = printable(team, 60)
            text = f"It was handed in by the team {who}, and counts for all its members."
            remarks.append(Remark("team", best.path, text))
    unread = tuple(
        dict.fromkeys(remark for submission in everybody for remark in submission.unread)
    )
    return replace(member, pages=tuple(pages), remarks=tuple(remarks), unread=unread)


def _rank(page: HandedIn) -> tuple[bool, float, int]:
    return bool(page.notebook.cells), page.modified, len(page.notebook.cells)
