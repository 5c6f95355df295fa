"""Keep the import line of page 07; everything else about exercises is in `rosbeat.exercises`."""
