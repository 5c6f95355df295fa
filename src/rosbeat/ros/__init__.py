"""Nodes in a page: the only room of the house that imports rclpy.

`session` is the door. Behind it: `world` (what one session owns and learns of its nodes),
`virtual_time` and `live` (the two executors), `recording` (how nodes are observed without being
changed), `context` (what `rclpy.init` and `rclpy.spin` do in a page).
"""
