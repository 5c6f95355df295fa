"""Run a learner's page from top to bottom, in a sandbox, and judge what was seen.

`rosbeat check`, `rosbeat grade` and what autograders call all come here.

- What is run: `notebook` (a page as it was handed in, and the course's own), `submitted_page`
  (which of its cells run, and what is checked), `jobs` (what goes in and comes out).
- Inside: `page_process` (the cells, and a fork for each check), `tampering` (what reaches for what
  observes it), `worker` (process 1 of a sandbox, which forks for each page).
- Outside: `sandbox` with `system_calls`, `transcript` (what a page has written; it runs again
  without a cell that ended it), `pool` (several submissions at a time).
- Judging: `judging`, and `traces` of what answers did, for reports.
"""
