"""Run real ROS nodes in a page, in virtual time or live, and record what they do.

This is the only folder that imports rclpy. `docs/simulation.md` explains how virtual time works.

- The session: `session` (the public face), `world` (what one session owns), `errors` (what it
  refuses), `console` (what it prints), `randomness` (seeded random numbers).
- Virtual time: `virtual_time` (the loop), `processes` (simulated processes), `clock`, `entities`
  (timers, messages and requests taken from their handles), `wait_set` (what goes through rclpy's
  own), `blocking` and `spinning` (calls that wait), `simulated_program` (a file with `main()`).
- Live mode: `live`, against the wall clock.
- What nodes are made of: `launch` (how a node is started), `context` (rclpy's default context),
  `qos_events` (deadlines and lifespans by the session's clock), `actions`.
- What is seen: `recording` (taps, hooks, recorder), `faults` (from an exception to a line),
  `graph` (who is there, in other processes too), `inspection` (why nothing arrives).
- Running an answer: `isolation` (with a deadline), `scenario` (`observe` and the steps of a
  run), `test_nodes` (what stands beside an answer), `playback` (a bag's player).
- Beside it: `programs` (operating-system processes), `injection` (what the panel adds).
"""
