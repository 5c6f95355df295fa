# ---
# title: Find your way
# minutes: 5
# needs: []
# summary: The whole course on one page, with how far you are.
# ---

# %% [markdown]
# # Find your way
#
# Welcome! On these pages, you build a small robot system with ROS 2. Its nodes really run, and each page checks
# what you write. Take the core pages in order. After the last one, your package is finished, `rosbeat certificate`
# in a terminal makes a certificate of what you have built, and you can choose among the electives.
#
# The list below shows the whole course, and how far you are. It stays up to date while you work on the pages.

# %%
progress()

# %% [markdown]
# If the list is out of date, click its cell and press `Shift` + `Enter`. In the list, `00a` is the first exercise of
# page 00; on a page, `00.2` is the second question at its end.
#
# In a class, you can let your instructor see which exercises the class is stuck on. Checks share nothing until you
# turn that on; `rosbeat share`, typed in a terminal, explains what it means.
