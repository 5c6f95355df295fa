"""Run real ROS nodes in virtual time or live, and record their behavior.

Only this folder imports rclpy. `docs/simulation.md` explains how virtual time works, and
`docs/architecture.md` has the floors: who imports whom.

- The session: `session` (the public interface), `session_core` (its state), `node_registry` (which
  nodes and entities there are), `node_lives` (how nodes run, rest and end), `entity_watch` (what is
  replaced on each new entity), `reports` (what is recorded and printed of callbacks and faults),
  `ports` (what each lower part asks of it), `errors` (its refusals, and what it prints).
- The engine: `schedule` (what is due when), `waits` (suspending and resuming code, with
  greenlets), `executors` (what wakes rclpy's own executors, and which processes they run),
  `engine` (the loop), `taking` (what has arrived, straight from rclpy's handles), `processes`
  (nodes, their entities, simulated processes).
- What is replaced in rclpy, for good: `hooks`.
- What code of nodes meets in the place of the operating system: `wait_set` (where rclpy's own
  executors wait), `threads` (threads, locks, queues), `clock` (clocks, and calls that wait).
- Programs: `simulated_program` (a file with `main()`), `context` (contexts, interrupts,
  `rclpy.init`), `arguments` (of a command line), `spinning` (`rclpy.spin` in a page).
- Live mode: `live`, against the wall clock.
- Parts of nodes: `launch` (starting a node), `qos_events` (deadlines and lifespans by the
  session's clock), `actions`.
- The distribution of ROS: `distribution` (which rclpy is refused), `differences` (what differs
  between the supported ones).
- Observation: `recording` (taps, hooks, recorder), `exception_origin` (from an exception to a
  line), `graph` (nodes and endpoints, in other processes too), `listening` (their messages),
  `logs` (the log lines of a session's code, and the levels of each process).
- Running an answer: `isolation` (with a deadline and seeded random numbers), `scenario` (`observe`
  and the steps of a run), `test_nodes` (nodes of the course's own), `programs` (operating-system
  processes).
- Tests: `tester` (publishes, calls services and sends goals, for `rosbeat.testing`).
"""

from rosbeat.ros.distribution import check

check()
