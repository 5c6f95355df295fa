"""Keep an old import line of page 07; everything about exercises is in `rosbeat.exercises`."""
