"""Random walks between two limits: what a sensor's readings show of how they were made.

Pure functions. How the walk was driven, and for how long, stands in `scenarios.walks`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from math import isfinite

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.walk_runs import LONG, PHASE, READINGS, stays, widest

#: Room for rounding to 32 bits.
_ROUNDING = 1e-4
#: A walk that has turned leaves a limit within a few steps; more than this many are no chance.
_STUCK = 60
_ADD = (
    "Each reading is drawn anew and does not know the one before. A walk goes on from where it "
    "was: add the step to the old value."
)
_WHOLE = "All readings are whole numbers. Is something rounded, or are the steps whole numbers?"
_STRANGE = "Among the readings is one that is no finite number."


@dataclass(frozen=True)
class Walk:
    """What is asked of a walk.

    Attributes:
        low: The lower limit.
        high: The upper limit.
        step: The widest step.
        unit: What stands behind a number, such as `degrees`.
        aside: A sentence after hints that name a number, with a blank before it.
    """

    low: float
    high: float
    step: float
    unit: str = "degrees"
    aside: str = ""

    def diagnose(self, values: Sequence[float]) -> Diagnosis | None:
        """Say what is wrong with a walk, or None if it is right.

        Args:
            values: Its readings, at least two; the first `PHASE` drift up and the next `PHASE`
                down.
        """
        if not all(map(isfinite, values)):
            return Diagnosis("wrong-values", _STRANGE, "Which calculation gives no number?")
        found = self._shape(values) or self._steps(values)
        found = found or self._memory(values) or self._limits(values) or _chance(values)
        return Diagnosis(found[0], self.evidence(values), found[1]) if found else None

    def decisive(self, values: Sequence[float]) -> Sequence[float]:
        """The readings that decide: those with the drift, or all after them that were needed.

        Args:
            values: Its readings, as many as `scenarios.walks.watch_walk` has asked for.
        """
        if len(values) != READINGS + LONG:
            return values
        first = values[:READINGS]
        found = self.diagnose(first)
        is_open = found is not None and found.mistake == "other-limits" and not self.is_met(first)
        return values[READINGS:] if is_open else first

    def is_met(self, values: Sequence[float]) -> bool:
        """Whether these readings show both ends of the range, wherever the node has put them.

        Numbers that the drift does not reach may wander for long before they meet a limit; then
        more readings are needed. A walk that is cut off stays at its end again and again.
        """
        low, high = min(values, default=0.0), max(values, default=0.0)
        return all(
            there or stays(values, end)
            for end, there in (
                (low, low <= self.low + self.step),
                (high, high >= self.high - self.step),
            )
        )

    def touches(self, values: Sequence[float]) -> bool:
        """Whether a reading is exactly at a limit: then the unit, at least, is right."""
        return any(abs(one - end) < _ROUNDING for one in values for end in (self.low, self.high))

    def stands_or_jumps(self, values: Sequence[float]) -> bool:
        """Whether this is no walk at all, whatever its unit."""
        return widest(values) == 0 or widest(values) > 0.4 * (self.high - self.low)

    def evidence(self, values: Sequence[float]) -> str:
        """What can be seen of a walk, in one sentence."""
        return (
            f"The readings went from {min(values):.2f} to {max(values):.2f} {self.unit}, in steps "
            f"of at most {widest(values):.2f}."
        )

    def _shape(self, values: Sequence[float]) -> tuple[str, str] | None:
        if widest(values) == 0:
            return self._constant(values[0])
        if self.step % 1 and all(one == round(one) for one in values):
            return "wrong-values", _WHOLE
        if max(values) - min(values) <= 2 * self.step + _ROUNDING:
            return "forgets-itself", _ADD
        moves = [b - a for a, b in pairwise(values)]
        if min(moves) >= 0 or max(moves) <= 0:
            way = "rises" if min(moves) >= 0 else "falls"
            return "one-way", f"It only {way}. A step goes up or down, as chance will have it."
        return None

    def _constant(self, value: float) -> tuple[str, str]:
        stays = f"It stays at {value:g} from the first reading on."
        if value == 0.0:
            hint = "A new message holds 0.0. Which line puts the number into its field data?"
            return "wrong-values", hint
        if abs(value - self.high) < _ROUNDING:
            hint = f"{stays} Which of the two, min or max, keeps a number below a limit?"
            return "clamp-swapped", hint
        if abs(value - self.low) < _ROUNDING:
            return "never-changes", (
                f"{stays} Either a step takes the place of the old value instead of being added "
                "to it, or min and max have changed places."
            )
        return "never-changes", "It never changes. Each call has to add a new random number."

    def _steps(self, values: Sequence[float]) -> tuple[str, str] | None:
        found = widest(values)
        beyond = self._beyond(values)
        if _ROUNDING < beyond <= self.step + _ROUNDING and not self._cut_off_elsewhere(values):
            return "clamped-too-early", (
                "It gets past a limit, by less than a step. Which comes first, the step or the "
                "clamp?"
            )
        if found > 0.5 * (self.high - self.low):
            return "forgets-itself", _ADD
        if found > self.step + 10 * _ROUNDING:
            return "step-too-wide", (
                "A step is too wide. random.uniform(a, b) gives a number between a and b."
                + self.aside
            )
        moves = [b - a for a, b in pairwise(values)]
        if min(max(moves), -min(moves)) < 0.8 * self.step:
            return "step-too-small", (
                f"The steps are small. They may be as wide as {self.step:g}, up and down."
                + self.aside
            )
        return None

    def _cut_off_elsewhere(self, values: Sequence[float]) -> bool:
        low, high = min(values), max(values)
        for end, beyond in ((low, self.low - low), (high, high - self.high)):
            # A whole step beyond is as far as a walk gets that is clamped too early.
            if stays(values, end) and _ROUNDING < beyond < self.step - 10 * _ROUNDING:
                return True
        return False

    def _beyond(self, values: Sequence[float]) -> float:
        return max(max(values) - self.high, self.low - min(values))

    def _limits(self, values: Sequence[float]) -> tuple[str, str] | None:
        for end, limit, where in (
            (max(values), self.high, "above"),
            (min(values), self.low, "below"),
        ):
            if abs(end - limit) > 10 * _ROUNDING and stays(values, end) and _is_fine(values):
                if abs(end - (self.low + self.high - limit)) < _ROUNDING:
                    return "clamp-swapped", (
                        f"It never gets {where} {end:g}. Which of the two, min or max, keeps a "
                        "number below a limit?"
                    )
                return "other-limits", (
                    f"Something cuts it off at {end:g}, and {limit:g} was asked for.{self.aside}"
                )
            if (end - limit if where == "above" else limit - end) <= _ROUNDING:
                continue
            return "no-clamp", (
                f"It got {where} {limit:g}. Which function cuts off what is {where}?{self.aside}"
            )
        if self.high - max(values) > self.step or min(values) - self.low > self.step:
            return "other-limits", (
                f"It stays inside narrower limits than {self.low:g} and {self.high:g}. Look at the "
                f"two numbers.{self.aside}"
            )
        return None

    def _memory(self, values: Sequence[float]) -> tuple[str, str] | None:
        for limit, rest in ((self.high, values[PHASE:]), (self.low, values[2 * PHASE :])):
            # Without drift, too, a walk leaves a limit at every second step or so.
            if _longest_stay(rest, limit) > _STUCK:
                return "clamp-not-kept", (
                    f"It stays at {limit:g} for minutes. What is published is cut off, and what "
                    "the node remembers is not: it has to walk all the way back."
                )
        return None


def _chance(values: Sequence[float]) -> tuple[str, str] | None:
    """Whether chance decides: then about every second step turns round."""
    moves = [b - a for a, b in pairwise(values[2 * PHASE :]) if a != b]
    turns = sum((a > 0) != (b > 0) for a, b in pairwise(moves))
    if 0.25 <= turns / max(1, len(moves)) <= 0.75:
        return None
    return "not-random", (
        "It goes up and down by a rule of its own, every time the same way. Let a random number "
        "decide about each step."
    )


def _is_fine(values: Sequence[float]) -> bool:
    """Whether steps have any width; with a few widths only, all numbers come again and again."""
    return len({round(one, 4) for one in values}) > len(values) / 4


def _longest_stay(values: Sequence[float], limit: float) -> int:
    runs = groupby(values, lambda one: abs(one - limit) < _ROUNDING)
    return max((len(list(run)) for same, run in runs if same), default=0)
