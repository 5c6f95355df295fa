"""Run real ROS nodes in virtual time or live, and record their behavior.

Only this folder imports rclpy. `docs/simulation.md` explains how virtual time works.

- The session: `session` (the public interface), `session_core` (its state), `errors` (its
  refusals, and what it prints).
- Virtual time: `virtual_time` (the loop), `processes` (nodes, their entities, simulated processes),
  `wait_set` (what goes through rclpy's own wait set), `clock` (the nodes' clocks, and functions
  that block), `spinning` (rclpy's `spin` functions), `simulated_program` (a file with `main()`).
- Live mode: `live`, against the wall clock.
- Parts of nodes: `launch` (starting a node), `context` (rclpy's default context), `qos_events`
  (deadlines and lifespans by the session's clock), `actions`.
- The distribution of ROS: `distribution` (which rclpy is refused), `differences` (what differs
  between the supported ones).
- Observation: `recording` (taps, hooks, recorder), `exception_origin` (from an exception to a
  line), `graph` (nodes and endpoints, in other processes too), `listening` (their messages),
  `logs` (the log lines of a session's code).
- Running an answer: `isolation` (with a deadline and seeded random numbers), `scenario` (`observe`
  and the steps of a run), `test_nodes` (nodes of the course's own), `programs` (operating-system
  processes).
- Tests: `tester` (publishes, calls services and sends goals, for `rosbeat.testing`).
"""

from rosbeat.ros.distribution import check

check()
