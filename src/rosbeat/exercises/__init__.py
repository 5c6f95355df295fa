"""The exercises: one module for each page, with scenario, judge and hints, and nothing else."""
