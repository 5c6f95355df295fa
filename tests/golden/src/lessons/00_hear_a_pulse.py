# ---
# title: Hear a pulse
# minutes: 5
# needs: []
# summary: A short page that uses everything a lesson source knows.
# ---

# %% [markdown]
# # Hear a pulse
#
# **Goal:** count a pulse in one minute. You need five minutes and nothing else.
#
# This page belongs to the tests of the builder. It is short, it needs no ROS, and it uses each
# feature of a lesson source once, so it is also the shortest example of one.

# %% [markdown]
# ## A beat is a moment
#
# A heart does not send a number. It beats, and whoever listens counts the beats and looks at a
# clock. The number of beats in a minute is something the listener makes. The heart knows nothing
# about minutes, about listeners, or about how many of them there are.
#
# Keep this in mind when you read about publishers later. A publisher sends what it has, when it
# has it. What the messages mean together is up to those who receive them.

# %%
beats = [0.0, 0.8, 1.6, 2.4, 3.2]
print(f"{len(beats)} beats in {beats[-1]} s")

# %% [markdown]
# The first line holds the moments of five beats, in seconds. The second line prints how many there
# are and when the last one came. Between two beats pass eight tenths of a second, always the same.

# %% [markdown]
# ## Predict
#
# How many beats are there in a minute, if they keep coming like this? Say a number before you read
# on. The gap between two beats is all you need, and the answer is a little more than one per
# second.

# %%
gap = beats[1] - beats[0]
round(60 / gap)

# %% [markdown]
# Seventy-five beats in a minute. A resting heart does that, so the number is a plausible one. It is
# good to ask this of every number that a program gives you, before you use it for anything.
#
# The number is also the same on every run. Nothing on this page depends on the time of day, on the
# speed of your machine, or on what you ran before.

# %% [markdown]
# ## What goes wrong
#
# Two beats at the same moment leave no gap, and a rate cannot be computed from no gap. The next
# cell shows what Python says about it. Read the last line of an error first: it names the kind of
# the error and the reason.

# %% tags=["raises-exception"]
60 / (beats[0] - beats[0])

# %% [markdown]
# ## Exercise 00a
#
# Complete the method, so that it returns the beats per minute. Replace each `____` and run the
# cell, then run the check below it. You may run both as often as you like.


# %% exercise="00a"
class Listener:
    """Counts beats."""

    def __init__(self, moments):
        self.moments = moments

    def rate(self):
        # --- answer
        seconds = self.moments[1] - self.moments[0]
        return round(60 / seconds)
        # --- blank
        # seconds = ____
        # return ____
        # --- end


# %% [markdown] only="notebook"
# An untouched page runs to the bottom: the check says that nothing was attempted, and goes on.

# %% [markdown] only="solution"
# Two moments are enough, because all gaps are the same. With a real heart you would take the mean
# of many gaps.

# %% check="00a"
try:
    print("right" if Listener(beats).rate() == 75 else "not yet")
except NameError:
    print("not attempted yet")

# %% [markdown]
# ## Recap
#
# Beats are moments, a rate is made by who listens, and a rate needs a gap. The page on
# [what you heard](#A-beat-is-a-moment) is this one; the next pages do the same with nodes that
# publish, nodes that subscribe, and a clock that everyone can agree on.
