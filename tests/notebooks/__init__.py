"""Pages as tests: nbval, with its holes closed.

`plugin` collects, `page` runs a page cell by cell, `kernel` starts and watches the kernel,
`comparison` says what counts as a difference. `docs/authoring.md` lists what nbval does not see
and what covers it.
"""
