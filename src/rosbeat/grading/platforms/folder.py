"""Take a folder, or a zip file, for each learner: what no platform has named."""

from __future__ import annotations

from rosbeat.grading.platforms.base import Owner, Platform, rest_of


class Folder(Platform):
    """Describe folders that were collected by hand; a folder's name is the learner's id."""

    name = "folder"
    title = "a folder for each learner"
    has_free_names = True

    def owners(self, parts: tuple[str, ...]) -> tuple[Owner, ...]:
        """Return the learner of the first folder, or of a zip file in its place."""
        if len(parts) == 1 and parts[0].lower().endswith(".zip"):
            parts = (parts[0][: -len(".zip")], parts[0])
        if len(parts) < 2:
            return ()
        return (Owner(parts[0], parts[0], rest_of(*parts[1:]), self.name),)
