"""The instrument panel: a live session on a page, with controls.

`ros.panel()` opens it. It looks at the session 20 times a second, whatever the nodes do, and sends
the browser what has changed; the session records everything in the meantime.

- `instruments` asks a session what happens and acts on it; nothing else here knows ROS;
- `sampling` turns a session into frames, `traffic` decides when one may be sent;
- `layout` places the graph as the pictures of `rosbeat.viz` do;
- `orders` understands what comes from the browser;
- `panel` holds it together; `widget` and the two files beside it are what the browser runs.
"""
