# ---
# title: Build, source, run
# minutes: 35
# needs: ["05"]
# summary: Start the sensor in one terminal and the monitor in another, and see what crosses from one process to the other.
# ---

# %% [markdown]
# # Build, source, run
#
# **Goal:** you start the sensor in one terminal and the monitor in another, and see messages cross from
# one process to the other.
#
# **Time:** 35 minutes. **You need:** [set the entry points](05_set_the_entry_points.ipynb).
#
# A **process** is a running program. It has memory of its own, and no other process can look into it.
# Two nodes in two processes share nothing but what ROS carries between them. The next cell makes
# what earlier pages would have left here, if it is missing.

# %%
import os

from rosbeat import Session, check, viz, workspace

workspace.catch_up("06")

# %% [markdown]
# ## Build
#
# In the workspace, not in `src`. `--packages-select` builds only the package that it names, which
# saves time in a workspace with many. Three commands, always in this order: **build** puts your code
# into `install`, **source** makes a terminal know it, **run** starts it. After a change you build
# again, and a terminal that is loaded already stays loaded.

# %% terminal="build"
# cd ROS2_and_RL_Tutorials
# colcon build --packages-select sensor_simulator

# %% [markdown]
# ## Start the sensor
#
# A new terminal knows nothing of your workspace, so `source` comes first. The cell watches until three
# readings have appeared. Then the page goes on, and so does the sensor.

# %% terminal="sensor --until Publishing --lines 3" tags=["nbval-ignore-output"]
# cd ROS2_and_RL_Tutorials
# source install/setup.bash
# ros2 run sensor_simulator temperature_publisher

# %% [markdown]
# Each line has a level, a time, the node's name and the text. The time is the real one this time, in
# seconds since 1970. There is no session here that could make it jump, so this page really waits.
#
# ## Start the monitor
#
# **Predict:** the sensor has been running for a while. Which reading does the monitor see first?

# %% terminal="monitor --until Status --lines 3" tags=["nbval-ignore-output"]
# cd ROS2_and_RL_Tutorials
# source install/setup.bash
# ros2 run sensor_simulator temperature_subscriber

# %% [markdown]
# The next one that was published. What was sent before it came is gone: a topic is no archive.
#
# Both go on while you read this. `%terminal` with one percent sign and no command looks at a terminal
# again:

# %% terminal="monitor --until Status --lines 5" tags=["nbval-ignore-output"]

# %% [markdown]
# ## See what crossed
#
# Both programs log what they do. `logs()` reads those lines from a terminal, and `viz.crossing` draws
# them: one row for each process, and an arrow for each reading that is in both.

# %%
sensor, monitor = workspace.terminal("sensor"), workspace.terminal("monitor")
monitor.wait_for("Status", lines=12, timeout=30)
heard = monitor.logs()[1:11]
sent = sensor.logs()

# %% tags=["nbval-ignore-output"]
viz.crossing(sent, heard)

# %% [markdown]
# The arrows are almost upright: a message needs about a thousandth of a second. The first readings have no
# arrow: nobody was there to hear them.
#
# Now compare the numbers themselves. **Predict:** did any reading get lost after the first?

# %%
def numbers(lines):
    return [line.text.split()[1] for line in lines]

said = numbers(sent[1:])
start = said.index(numbers(heard)[0])
said[start : start + 10] == numbers(heard)

# %% [markdown]
# Ten readings, the same ten, in the same order. They were made in one process and judged in another. How
# did they cross? The publisher handed each message to the middleware in its own process. That turned it
# into a few bytes, passed them to the middleware of the other process, and there they became a
# message again. Neither of your files has a line about that.
#
# ## Look from here
#
# The page is a third process. In a private session it would see nothing of this. A ROS **domain** is
# a number: nodes with the same number find each other, nodes with different numbers never do. Your
# terminals have one, and a session can join it:

# %%
ros = Session(domain_id=int(os.environ["ROS_DOMAIN_ID"]))
ros.start()
ros.wait_for_nodes("temperature_sensor", "temperature_monitor")
viz.graph(ros.graph())

# %% [markdown]
# The graph that you know from the first pages. There it was one process, here there are two, and the picture
# is the same: nodes do not care where the others run. On a robot they may even run on
# different computers. And no program in the middle keeps a list of them: each process tells the others
# what it has and what it wants. That is called **discovery**.
#
# ## Stop one of them
#
# **Predict:** the sensor ends. What does the monitor do?

# %% terminal="sensor --ctrl-c" tags=["nbval-ignore-output"]

# %%
sensor.exit_code, monitor.busy

# %% [markdown]
# The sensor ended with exit code 0, which means in good order. The monitor is still busy: it waits. It got no error,
# because for a subscriber silence is nothing special. Start the sensor again, and the monitor goes on as if
# nothing had happened:

# %% terminal="sensor --until Publishing --lines 2" tags=["nbval-ignore-output"]
# ros2 run sensor_simulator temperature_publisher

# %% terminal="monitor --until Status --lines 2" tags=["nbval-ignore-output"]

# %% [markdown]
# The terminal `sensor` is in the right folder and has loaded the workspace, so one line was enough.
#
# ## Try it: one more monitor
#
# Start a second monitor in a third terminal. Nobody has to ask the sensor. Two nodes should not have
# the same name, or people mix them up. What follows `--ros-args` is for ROS: `-r` stands for *remap*, and
# here it gives the node another name. Fill in what is run.

# %% terminal="third --until Status" exercise="06a" tags=["nbval-ignore-output"]
# cd ROS2_and_RL_Tutorials
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
# For `ros2 run`, only `install` counts, and colcon has **copied** your files to it. `diff` compares two files
# and prints what differs:

# %% terminal="build"
# cd src/sensor_simulator/sensor_simulator
# diff temperature_publisher.py ../../../install/sensor_simulator/lib/python3*/site-packages/sensor_simulator/ && echo "the same"
# cd ../../..

# %% [markdown]
# The same, for now. If you change the file in `src` and run, the *old* program runs, and nothing tells
# you. That costs everybody an afternoon once. Build after each change, or let colcon make a link
# instead of a copy: then what you change counts at once. Only new files and a new `setup.py` still need a
# build.
#
# ## Try it: link instead of copy
#
# Build `sensor_simulator` once more, with the option `--symlink-install`.

# %% terminal="build" exercise="06b"
# --- answer
# colcon build --packages-select sensor_simulator --symlink-install
# --- blank
# # colcon build --packages-select sensor_simulator ____
# --- end

# %% check="06b"
check("06b", workspace.folder())

# %% [markdown]
# ## Test the package
#
# `ros2 pkg create` has put three tests into `test`. `colcon test` runs them: two look at the style of your
# code, and the third, about copyright notes, is skipped.

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
# **Symptom:** *Package not found*. **Instrument:** the question whether *this* terminal has loaded the
# workspace. **Cause:** it has not. **Cure:** `source install/setup.bash`, in the workspace.
#
# ## Clean up
#
# `Ctrl` + `C` ends the three programs. With the tutorial's own `main` you would see a traceback here; yours
# says nothing and ends with 0.

# %% terminal="sensor --ctrl-c" tags=["nbval-ignore-output"]

# %% terminal="monitor --ctrl-c" tags=["nbval-ignore-output"]

# %%
ros.close()
sensor.exit_code, monitor.exit_code

# %% [markdown]
# ## Remember
#
# - **Build** in the workspace, **source** in each terminal, then **run**.
# - Messages cross from process to process; nodes share nothing else.
# - One node can end and come back, and the other need not notice.
# - `ros2 run` starts what is installed, not what is in `src`.
#
# In JupyterLab, open two terminals with *File, New, Terminal*, and do the same there by hand. Then you have
# done all that the tutorial does, on your own.
