# ---
# title: Build, source, run
# minutes: 35
# needs: ["05"]
# summary: Start the sensor in one terminal and the monitor in another, and see what crosses from one process to the other.
# ---

# %% [markdown]
# # Build, source, run
#
# **After this page, you can:**
#
# - build, source and run two programs that talk to each other (06a, 06.3);
# - give a node another name when you start it (06a);
# - explain why a change has no effect yet, and fix that (06b, 06.1);
# - predict what happens when one of two programs stops (06.2).
#
# **Time:** 35 minutes. **You need:** [set the entry points](05_set_the_entry_points.ipynb).
#
# A process is a running program. It has its own memory, which no other process can read. Two nodes in two processes
# share nothing but the messages that ROS carries between them. The next cell creates whatever earlier pages would
# have left here, if it's missing.

# %%
import os
import signal

from rosbeat import Session, check, hint, predict, progress, quiz, viz, workspace

workspace.catch_up("06")

# %% [markdown]
# ## Build
#
# Build in the workspace, not in `src`. `--packages-select` builds only the package that you name, which saves time
# in a workspace with many packages. There are three steps, always in this order: **build** puts your code into
# `install`, **source** adds it to a terminal's environment, and **run** starts it. After a change, build again; a
# terminal that has sourced the workspace once doesn't need to source it again.

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

# %% terminal="sensor --until Publishing --lines 3" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run sensor_simulator temperature_publisher

# %% [markdown]
# On your screen, each line has a level, a time, the node's name and the text. Stored copies of this page leave out
# the time. It's the real time, in seconds since 1970: no session is involved that could jump ahead, so this page
# really waits.
#
# ## Start the monitor
#
# **Predict:** the sensor has been running for a while. Which reading does the monitor see first?

# %% terminal="monitor --until Status --lines 3" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run sensor_simulator temperature_subscriber

# %% [markdown]
# The next one published after it connects. The earlier readings are gone: a topic doesn't store old messages.
#
# The tutorial doesn't source the workspace in its second terminal. If a new terminal of yours finds the package
# anyway, something sources it automatically when the terminal opens.
#
# Both programs keep running while you read this.
#
# ## See which messages crossed
#
# Both programs log what they do. `logs()` reads those lines from a terminal, and `viz.crossing` draws
# them: one row per process, and an arrow for each reading that appears in both.

# %%
sensor, monitor = workspace.terminal("sensor"), workspace.terminal("monitor")
monitor.wait_for("Status", lines=12, timeout=30)
heard = monitor.logs()[1:11]
sent = sensor.logs()

# %% tags=["nbval-ignore-output"]
viz.crossing(sent, heard)

# %% [markdown]
# The arrows are almost vertical, because a message takes only a few thousandths of a second. The first readings
# have no arrow: there was no subscriber yet. The last ones have none because `heard` holds only ten lines.
#
# Now compare the numbers themselves. `numbers` extracts them from the log lines. The lines that begin with `places`
# and `fits` look for the monitor's ten readings, in a row, among the readings that were sent. They allow a
# difference of one hundredth, because a `Float32` may round the last digit the other way. **Predict:** once the
# monitor receives readings, does it miss any?

# %% predict=true
def numbers(lines):
    return [float(line.text.split()[1].rstrip("C")) for line in lines if "Started" not in line.text]

told, noted = numbers(heard), numbers(sent)
places = range(len(noted) - len(told) + 1)
fits = any(all(abs(a - b) < 0.02 for a, b in zip(told, noted[place:])) for place in places)
# --- answer
predict("no", not fits)
# --- blank
# predict("____", not fits)
# --- end

# %% [markdown]
# Ten readings, the same ten, in the same order. They were generated in one process and evaluated in another. How
# did they get there? The publisher passed each message to the middleware in its own process, which turned it
# into a few bytes. The middleware in the other process turned those bytes back into a message.
#
# ## Look from another terminal
#
# A third terminal can look at the running programs, too. `ros2 topic list` prints the topics that are in use, and
# `ros2 topic echo` prints the messages on one of them. With `--once`, it stops after the first message. Both
# commands come with ROS, so this terminal doesn't have to source your workspace.

# %% terminal="look" tags=["nbval-ignore-output"]
# ros2 topic list
# ros2 topic echo --once /temperature

# %% [markdown]
# `echo` subscribed to the topic, received one message, and stopped. The other two topics come with every node:
# `/rosout` carries log lines, and `/parameter_events` reports changes of parameters. You'll use these commands on
# page 07.
#
# ## Look from this page
#
# This page is a process as well. A session on this page sees none of these nodes, because it is private unless it
# joins a [**domain**](../docs/glossary.md#domain). A domain is identified by a number: nodes in the same domain
# find each other, and nodes in different domains never do. Your terminals have a domain number in their
# environment, and a session can join that domain:

# %%
ros = Session(domain_id=int(os.environ["ROS_DOMAIN_ID"]))
ros.start()
ros.wait_for_nodes("temperature_sensor", "temperature_monitor")
viz.graph(ros.graph())

# %% [markdown]
# You know this graph from page 04. There, a session simulated both processes; here, the nodes run in two real ones,
# and the picture is the same. Nodes don't depend on where the other nodes run: on a robot, they may even run on
# different computers. There's also no central program that keeps a list of nodes: each process tells the others
# what it offers and what it needs. This is called [**discovery**](../docs/glossary.md#discovery).
#
# ## Stop one of them
#
# **Predict:** the sensor stops. What does the monitor do?

# %% terminal="sensor --ctrl-c" tags=["nbval-ignore-output"]

# %% terminal="monitor" tags=["nbval-ignore-output"]

# %%
sensor.exit_code, monitor.busy

# %% [markdown]
# The sensor ended normally, with exit code 0. The monitor got no error; the lines above are from before the stop,
# and no more follow. It's still running, and waiting. To a subscriber, silence isn't unusual. Start the sensor
# again:

# %% terminal="sensor --until Publishing --lines 2" tags=["nbval-ignore-output"]
# ros2 run sensor_simulator temperature_publisher

# %% terminal="monitor --until Status --lines 2" tags=["nbval-ignore-output"]

# %% [markdown]
# The monitor continues as if nothing had happened. It may miss the first reading, because the two have to discover
# each other first. The terminal `sensor` is still in the right folder and has already sourced the workspace, so a
# single line was enough to start the sensor.
#
# ## Try it: one more monitor
#
# Start a second monitor in a terminal of its own, called `third`. The sensor doesn't have to change for that. Two
# nodes shouldn't have the same name, because you couldn't tell them apart. Everything after `--ros-args` is meant
# for ROS: `-r` is short for *remap*, and with `__node` (two underscores) it gives the node another name. Fill in
# what to run.

# %% terminal="third --until Status" exercise="06a" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# --- answer
# ros2 run sensor_simulator temperature_subscriber --ros-args -r __node:=second_monitor
# --- blank
# # ros2 run ____ --ros-args -r __node:=second_monitor
# --- end

# %% check="06a"
check("06a", workspace.terminal("third"))

# %% [markdown]
# ## Know what is installed
#
# `ros2 run` uses only what is in `install`, and colcon has **copied** your files there. `diff` compares a file
# with its copy; the star stands for any text. `&&` runs `echo` only if both files are the same:

# %% terminal="build"
# cd "$ROS2_WORKSPACE"
# diff src/sensor_simulator/sensor_simulator/temperature_publisher.py install/sensor_simulator/lib/python3*/site-packages/sensor_simulator/ && echo "the same"

# %% [markdown]
# They're the same, for now. If you change the file in `src` and run the program, you run the *old* code, and ROS
# doesn't tell you. Sooner or later, this costs everyone an afternoon. Either build after each change, or let colcon
# create a link instead of a copy: then a change takes effect the next time the program starts. Changes to
# `setup.py` still need a build.
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
# source the workspace again: `source install/setup.bash`.
#
# ## Test the package
#
# `ros2 pkg create` put three tests into the folder `test`, and `colcon test` runs them. Two of them check the style
# of your code, and the third, about copyright notices, is skipped.

# %% terminal="build --timeout 120"
# colcon test --packages-select sensor_simulator
# colcon test-result

# %% [markdown]
# ## What went wrong: a new terminal
#
# **Predict:** why does this fail, although the package is built?

# %% terminal="fresh"
# ros2 run sensor_simulator temperature_publisher

# %% [markdown]
# **Symptom:** *Package 'sensor_simulator' not found*. **Where to look:** has *this* terminal sourced the workspace?
# **Cause:** it hasn't. **Fix:** `source install/setup.bash`, in the workspace.
#
# ## Clean up
#
# Press `Ctrl` + `C` in every terminal. The tutorial's own sensor would print a traceback here, as you saw on the
# page about publishers. Your programs print nothing and end with exit code 0.

# %% tags=["nbval-ignore-output"]
for name in ("sensor", "monitor", "third"):
    workspace.terminal(name).ctrl_c()

# %%
ros.close()
sensor.exit_code, monitor.exit_code

# %% [markdown]
# ## Rehearse in a session
#
# To try out a change, you need neither terminals nor a build. A session can run the same two files in virtual
# time, each as a process of its own, and it can press `Ctrl` + `C`, too.
#
# **Predict:** both programs start at the same instant. How many of the first three readings does the monitor receive?

# %% predict=true
package = workspace.folder() / "src/sensor_simulator/sensor_simulator"

with Session(seed=8) as rehearsal:
    names = ("temperature_publisher", "temperature_subscriber")
    programs = [rehearsal.spawn(package / f"{name}.py") for name in names]
    rehearsal.run(seconds=3)
    for program in programs:
        program.send_signal(signal.SIGINT)
    judged = [line for line in rehearsal.logs("temperature_monitor") if "Status" in line.text]

print("exit codes:", [program.returncode for program in programs])
# --- answer
predict("3", len(judged))
# --- blank
# predict("____", len(judged))
# --- end

# %% [markdown]
# All three: a session connects the programs immediately. Real programs need a moment to discover each other.
#
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
# You've now done everything that the tutorial does, on your own. The last check looks at the whole system: it
# builds your package in another place, runs both programs, and checks what they publish, what they log, and how they
# end. It takes up to half a minute.

# %% tags=["nbval-ignore-output"]
check("system", workspace.folder())

# %% [markdown]
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
# Topics are the first of three patterns. **Services** are for questions that have an answer, and **actions** are for
# work that takes time. You can meet both on page 12.
#
# This is the end of the tutorial, and of the core of the course. The pages from 07 on are electives: take the ones
# that you like. **Next:** [look inside the graph](07_look_inside_the_graph.ipynb), where you examine a running system.

# %%
progress()
