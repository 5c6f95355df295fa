# ---
# title: Find your way
# minutes: 5
# needs: []
# summary: The whole course on one page, with how far you are.
# ---

# %% [markdown]
# # Find your way
#
# Welcome! On these pages you build a robot's software with ROS 2, from small nodes that really run,
# and each page checks what you write. Take the core pages in order: at their end your package is
# finished, and you choose among the electives.
#
# The cell below shows the whole course and how far you are. Click into it and press
# `Shift` + `Enter`: from then on the list keeps itself up to date while you work on the pages.

# %%
from rosbeat import progress

progress()
