"""Nodes in a page: the only room of the house that imports rclpy.

`session` is the door. Behind it: `world` (what one session owns), `virtual_time` and `live` (the two
executors), `hooks` and `recorder` (how nodes are observed without being changed), `learner_calls`
(what `rclpy.init` and `rclpy.spin` do inside a page).
"""
