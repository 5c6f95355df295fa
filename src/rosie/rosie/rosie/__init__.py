"""Run Rosie, a robot on wheels that looks after a greenhouse."""
