"""Settings of nbgrader for pages of the course: copy this file into your nbgrader course folder."""

c = get_config()  # noqa: F821 - nbgrader defines it where it reads this file

# The pages of `notebooks/` have blanks in place of answers already. Left on, this would replace
# each of their cells, and what is given in it, by `raise NotImplementedError()`.
c.ClearSolutions.enabled = False
# A check cell that somebody has deleted comes back before grading.
c.OverwriteCells.add_missing_cells = True
# Seconds for one cell. The checks of pages 12 and 13 run several programs one after the other.
c.Execute.timeout = 120
