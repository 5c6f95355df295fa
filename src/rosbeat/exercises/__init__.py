"""Run, judge and hint at exercises: one module for each page, and what they share.

- `page_NN`: scenario, judge and hints of each exercise of a page, side by side.
- `exercise`, `registry`: what an exercise is, and all of them by id.
- `check`, `hint`, `predict`, `progress`, `quiz`: what a learner calls; `outcome_display` shows
  their answers, and `questions.md` has the questions of `quiz`.
- `scenarios`: runs an answer; `random_inputs`: draws the inputs, the same on each page, and from a
  secret seed when a class is graded; `evidence`: what was seen, as JSON.
- `model`: right models and suspects, and how one of them names the mistake.
- `workspace_model`: what workspaces and packages should hold; `system`: both programs at once;
  `greenhouse`: the weather, rubric and requirements of page 13.
"""
