"""The greenhouse of the last page, run: the weather of each trial, and the trials themselves."""
