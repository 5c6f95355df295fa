# ---
# title: Build, source, run
# minutes: 45
# needs: ["05"]
# summary: Start the sensor in one terminal and the monitor in another, and see what crosses from one process to the other.
# ---

# %% [markdown]
# # Build, source, run
#
# **After this page, you can:**
#
# - build, source and run two programs that talk to each other (06.3);
# - explain why a change has no effect yet, and fix that (06a, 06b, 06.1);
# - predict what happens when one of two programs stops (06.2).
#
# **Time:** 45 minutes. **You need:** [set the entry points](05_set_the_entry_points.ipynb).
#
# Each process has its own memory, and by default, no other process can read it. What the nodes of two processes know of
# each other arrives in the messages that ROS carries between them. If something from an earlier page is missing, the
# course creates it when the first terminal opens.

# %%
import os

viz.diagram("06")

# %% [markdown]
# ## Build
#
# There are three steps, always in this order: **build** puts your code into `install`, **source** adds it to a
# terminal's environment, and **run** starts it. After a change, build again; a terminal that has sourced the
# workspace once needs to do so again only if a package is new, or is built in another way.
#
# Build in the workspace, not in `src`. `--packages-select` builds only the package that you name, which saves time in
# a workspace with many packages.

# %% terminal="build"
# cd "$ROS2_WORKSPACE"
# colcon build --packages-select sensor_simulator
# ros2 node list

# %% [markdown]
# `ros2 node list` prints the nodes that are running: none, so far. If it lists one, that node is still running on
# another page or in another terminal. Stop it there with `Ctrl` + `C`; otherwise, its messages will appear here, too.
#
# ## Start the sensor
#
# A new terminal doesn't know your workspace, so `source` comes first. The cell waits until three
# readings have appeared. Then the page continues, and the sensor keeps running.

# %% terminal="sensor --until Publishing --lines 3" tags=["nbval-ignore-output"] shows=true
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run sensor_simulator temperature_publisher

# %% [markdown]
# On your screen, each line has a level, a time, the node's name and the text. Stored copies of this page leave out
# the time. It's the real time, in seconds since 1970, so this page really waits.
#
# ## Start the monitor
#
# In its second terminal, the tutorial types `ros2 run` at once, without sourcing. The first line of the next cell does
# the same; the other lines source the workspace and try again.
#
# The sensor has been running for a while. Which reading does the monitor see first?

# %% terminal="monitor --until Status --lines 10" tags=["nbval-ignore-output"] shows=true
# ros2 run sensor_simulator temperature_subscriber
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run sensor_simulator temperature_subscriber

# %% [markdown]
# The first line fails: the package is built, but this terminal hadn't sourced the workspace yet. If a new terminal
# of yours finds the package anyway, it sources the workspace when it opens, often because of a line in `~/.bashrc`.
#
# The monitor sees the next reading that is published after it connects. The earlier ones are gone: with
# these settings, a topic doesn't store old messages.
#
# ## See the flow of messages
#
# Both programs log what they do. `viz.message_flow` draws what two terminals show: one row per process, and an arrow
# for each reading that appears in both.

# %% tags=["nbval-ignore-output"] shows=true
viz.message_flow(workspace.terminal("sensor"), workspace.terminal("monitor"))

# %% [markdown]
# The arrows are almost vertical, because a message takes only a few thousandths of a second. The first readings
# have no arrow: nobody was listening yet. After that, the monitor logs every reading, in the same order.
#
# The readings were generated in one process and evaluated in another. How did they get there? The publisher passed
# each message to the middleware in its own process, which turned it into a few bytes. The middleware in the other
# process turned those bytes back into a message.
#
# ## Look from another terminal
#
# A third terminal can look at the running programs, too. `ros2 topic list` prints the topics that are in use, and
# `ros2 topic echo` prints the messages on one of them. With `--once`, it stops after the first message. The
# commands and the type `Float32` come with ROS, so this terminal doesn't have to source your workspace.

# %% terminal="look" tags=["nbval-ignore-output"] shows=true
# ros2 topic list
# ros2 topic echo --once /temperature

# %% [markdown]
# `echo` subscribed to the topic, received one message, and stopped. It prints more digits than the 32 bits of a
# `Float32` hold; only about the first seven mean anything. The other two topics come with every node: `/rosout`
# carries log lines, and `/parameter_events` reports changes of parameters. You'll use these commands on page 07.
#
# ## Look from this page
#
# This page is a process as well. A session on this page sees none of these nodes, because it is private unless it
# joins a [**domain**](../docs/glossary.md#domain). A domain is identified by a number: nodes in the same domain
# find each other, and nodes in different domains never do. Your terminals have a domain number in their
# environment, and a session can join that domain:

# %% shows=true
ros = Session(domain_id=int(os.environ["ROS_DOMAIN_ID"]))
ros.wait_for_nodes("temperature_sensor", "temperature_monitor")
viz.graph(ros)

# %% [markdown]
# A session that simulates both nodes, as on page 04, has the same graph. Nodes don't depend on where the other
# nodes run: on a robot, they may even run on different computers. There's also no central program that keeps a list
# of nodes: each process tells the others what it offers and what it needs. This is called
# [**discovery**](../docs/glossary.md#discovery).
#
# ## Stop one of them
#
# The next cell presses `Ctrl` + `C` in the sensor's terminal. **Predict:** is the monitor still running after that?
# Answer `yes` or `no` in the cell below it.

# %% terminal="sensor --ctrl-c" tags=["nbval-ignore-output"] shows=true

# %% predict=true
# --- answer
predict("yes", workspace.terminal("monitor").busy)
# --- blank
# predict("____", workspace.terminal("monitor").busy)
# --- end

# %% [markdown] answers=true
# It is, and it's waiting. It got no error: to a subscriber, silence isn't unusual.

# %% [markdown]
# Start the sensor again:

# %% terminal="sensor --until Publishing --lines 3" tags=["nbval-ignore-output"] shows=true
# ros2 run sensor_simulator temperature_publisher

# %% terminal="monitor" tags=["nbval-ignore-output"] shows=true

# %% [markdown]
# The last lines are the new readings: the monitor continues as if nothing had happened. It may miss the first
# reading, because the two have to discover each other first. The terminal `sensor` is still in the right folder and
# has already sourced the workspace, so a single line was enough to start the sensor.
#
# ## Try it: change the code
#
# When the monitor starts, it logs *Temperature Monitor Node Started*. Let it log *Temperature Monitor Version 2*
# instead. You could change the file in an editor; here, `sed -i` does it: `s/old/new/` replaces the old text with
# the new one, and `.*` stands for any words, so the cell works again after a first try. Fill in the words that
# replace *Node Started*.

# %% terminal="build" exercise="06a"
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# --- answer
# sed -i 's/Monitor .*"/Monitor Version 2"/' temperature_subscriber.py
# --- blank
# # sed -i 's/Monitor .*"/Monitor ____"/' temperature_subscriber.py
# --- end

# %% check="06a"
check("06a", workspace.folder())

# %% [markdown]
# ## What went wrong: the old code
#
# Now start this monitor beside the first one, for three seconds. Two nodes shouldn't have the same name, because you
# couldn't tell them apart. Everything after `--ros-args` is meant for ROS: `-r` is short for *remap*, and with `__node`
# (two underscores) it gives the node another name. Which text does it log first?

# %% terminal="third" tags=["nbval-ignore-output"] shows=true
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# timeout 3 ros2 run sensor_simulator temperature_subscriber --ros-args -r __node:=second_monitor

# %% [markdown]
# The old one. Exit code 124 only means that `timeout` has ended the program. `diff` shows the lines in which a file in
# `src` and its copy in `install` differ.

# %% terminal="build"
# cd "$ROS2_WORKSPACE"
# diff src/sensor_simulator/sensor_simulator/temperature_subscriber.py install/sensor_simulator/lib/python3*/site-packages/sensor_simulator/

# %% [markdown]
# **Symptom:** a change has no effect, and ROS itself doesn't tell you why: the lines that begin with `#` come from this
# course's terminals. **Where to look:** in `install`, with `diff`. Its exit code 1 means that the files differ.
# **Cause:** `ros2 run` uses only what is in `install`, and colcon has copied your files there. **Fix:** build after
# each change, or let colcon create a link instead of a copy: then a change takes effect the next time the program
# starts. Changes to `setup.py` still need a build.
#
# ## Try it: link instead of copy
#
# Build `sensor_simulator` once more, with links. colcon itself can tell you what the option is called:

# %% terminal="build"
# colcon build --help | grep symlink

# %% terminal="build" exercise="06b"
# --- answer
# colcon build --packages-select sensor_simulator --symlink-install
# --- blank
# # colcon build --packages-select sensor_simulator ____
# --- end

# %% check="06b"
check("06b", workspace.folder())

# %% [markdown]
# The linked files are in a different folder from the copies. So this once, terminals that are already open have to
# source the workspace again. Start the second monitor once more:

# %% terminal="third" tags=["nbval-ignore-output"] shows=true
# source install/setup.bash
# timeout 3 ros2 run sensor_simulator temperature_subscriber --ros-args -r __node:=second_monitor

# %% [markdown]
# *Version 2*. From now on, a change to the code takes effect the next time you start the program.
#
# ## Clean up
#
# The next cell presses `Ctrl` + `C` in both terminals. The tutorial's own sensor would print a traceback here,
# as you saw on page 03. Your programs print nothing and end with exit code 0.

# %% tags=["nbval-ignore-output"] shows=true
for name in ("monitor", "sensor"):
    workspace.terminal(name).ctrl_c()

# %% [markdown]
# ## Try it: leave the notebook
#
# Now do it all without this page. JupyterLab has an editor and terminals of its own.
#
# 1. In the file browser, open your workspace `ROS2_and_RL_Tutorials`, then `src`, `sensor_simulator` and, inside
#    it, the second `sensor_simulator`. Double-click `temperature_publisher.py`, change the period of the timer from
#    1.0 to 0.5, and save the file with `Ctrl` + `S`.
# 2. Open a terminal with *File, New, Terminal*. Build, source and run the sensor:
#
#    ```bash
#    cd "$ROS2_WORKSPACE"
#    colcon build --symlink-install --packages-select sensor_simulator
#    source install/setup.bash
#    ros2 run sensor_simulator temperature_publisher
#    ```
#
# 3. Open another terminal, and run the monitor there:
#
#    ```bash
#    cd "$ROS2_WORKSPACE"
#    source install/setup.bash
#    ros2 run sensor_simulator temperature_subscriber
#    ```
#
# 4. The monitor now prints two lines per second. Stop both programs with `Ctrl` + `C`, and change the period back
#    to 1.0.
#
# That's everything the tutorial does, and you did it on your own. The last check builds your package in another
# place, runs both programs, and looks at what they publish, what they log, and how they end. It takes up to half a
# minute.

# %% tags=["nbval-ignore-output"] shows=true
check("system", workspace.folder())

# %% [markdown]
# When the whole core is passed, `rosbeat certificate` in a terminal makes a page to print, with your name and the
# readings of your run.
#
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("06")

# %% only="solution"
quiz("06", "b", "a", "c")

# %% [markdown]
# ## Remember
#
# - **Build** in the workspace, **source** in each terminal, then **run**.
# - Messages travel from process to process; the nodes share nothing else.
# - A node can stop and come back, and the other one keeps running.
# - `ros2 run` starts what is installed, not what is in `src`.
#
# Topics are the first of three patterns of communication. **Services** are for questions that have an answer, and
# **actions** are for work that takes time. Page 12 covers both.
#
# This is the end of the tutorial, and of the core: the [cheat sheet](../docs/cheat_sheet.md) has all of it on one page.
# Two more things to try, if you like:
#
# - **Something real.** `ros2 run rosie computer_thermometer` publishes how warm your computer is, and says first
#   whether it has found a sensor.
# - **Two computers.** Your monitor can listen to [a friend's sensor](../docs/two_computers.md).
#
# The pages from 07 on are electives: take those that you like. **Next:** [look inside the
# graph](07_look_inside_the_graph.ipynb), where you examine a running system.

# %% shows=true
progress()
