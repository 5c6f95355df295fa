"""Show a live session on a page, with controls to disturb it.

`ros.panel()` opens it. It is a widget on anywidget: Python here, one JavaScript and one CSS file
beside it, nothing from the network.

- `panel` holds it together: the thread that looks 20 times a second, the flow of frames to the
  browser, and the picture that stands where no browser is;
- `session_adapter` asks a session what happens, and does what is clicked; nothing else here knows
  ROS;
- `sampling` turns a session into frames, and places the graph as the pictures of `rosbeat.viz` do.

How it works, and why:

- **It looks, the session records.** A thread looks at the session 20 times a second, whatever
  the nodes do. A look asks the recorder for what came since the last one, which costs the same
  for one message as for a thousand, and draws at most one point of each publisher.
- **Frames wait for answers.** The browser acknowledges what it has received. A tab that sleeps
  says nothing: after six frames one is sent each second, and after ten minutes every half a minute.
  The first frame after the sleep holds all that was missed. A browser that misses one asks for a
  whole one.
- **A kernel that is gone is noticed.** Frames come at least once a second, from a thread, so a busy
  kernel sends them, too. After 2.4 seconds without any the browser says so and disables the
  controls. It counts its own looks, not seconds: a tab that slept had no time to hear anything.
- **Clicks run in a thread of their own.** JupyterLab sends them to a subshell of the kernel, so
  they count while a cell runs (`widget` says what that takes).
- **What the panel does is real.** Its slider publishes through a node in the graph,
  `/instrument_panel`; a fault sits between a node and its publisher, before the recording; a
  load is a slow callback in the same executor. Closing takes all of it away.
- **A picture where no browser is.** While pages are built and tested (`ROSBEAT_STEADY_HOME`),
  and in a terminal, the panel is the picture of the graph and its words. In JupyterLab that
  picture is an output above the widget, and is seen when the widget is not: after its session has
  closed, and on a page that was opened without its kernel.

`./environment/course test tests/browser` clicks through it in a real Chromium (`ROSBEAT_BROWSER`
names one, `ROSBEAT_SCREENSHOTS` a folder for pictures).
"""
