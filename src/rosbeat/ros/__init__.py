"""Run real ROS nodes in a page, in virtual time or live, and record their behaviour.

Only this folder imports rclpy. `docs/simulation.md` explains how virtual time works.

- The session: `session` (the public interface), `world` (the state of one session), `errors` (its
  refusals), `console` (its output), `randomness` (seeded random numbers).
- Virtual time: `virtual_time` (the loop), `processes` (simulated processes), `clock`, `entities`
  (timers, messages and requests taken from their handles), `wait_set` (what goes through rclpy's
  own wait set), `blocking` and `spinning` (calls that wait), `simulated_program` (a file with
  `main()`).
- Live mode: `live`, against the wall clock.
- Parts of nodes: `launch` (starting a node), `context` (rclpy's default context), `qos_events`
  (deadlines and lifespans by the session's clock), `actions`.
- Observation: `recording` (taps, hooks, recorder), `faults` (from an exception to a line), `graph`
  (nodes and endpoints, in other processes too), `inspection` (why nothing arrives).
- Running an answer: `isolation` (with a deadline), `scenario` (`observe` and the steps of a run),
  `test_nodes` (nodes that run beside an answer), `playback` (a node that plays a bag).
- Further modules: `programs` (operating-system processes), `injection` (faults and load that the
  panel adds).
"""
