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
# A process is a running program. It has memory of its own, and no other process can look into it.
# Two nodes in two processes share nothing but what ROS carries between them. The next cell makes
# what earlier pages would have left here, if it is missing.

# %%
import os
import signal

from rosbeat import Session, check, hint, predict, progress, viz, workspace

workspace.catch_up("06")

# %% [markdown]
# ## Build
#
# In the workspace, not in `src`. `--packages-select` builds only the package that it names, which
# saves time in a workspace with many. Three commands, always in this order: **build** puts your code
# into `install`, **source** makes a terminal know it, **run** starts it. After a change you build
# again, and a terminal that is loaded already stays loaded.

# %% terminal="build"
# cd "$ROS2_WORKSPACE"
# colcon build --packages-select sensor_simulator
# ros2 node list

# %% [markdown]
# `ros2 node list` shows which nodes run. There is none. (If yours shows one, it still runs on another page
# or in another terminal: end it there with `Ctrl` + `C`, or it will talk, too.)
#
# ## Start the sensor
#
# A new terminal knows nothing of your workspace, so `source` comes first. The cell watches until three
# readings have appeared. Then the page goes on, and so does the sensor.

# %% terminal="sensor --until Publishing --lines 3" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run sensor_simulator temperature_publisher

# %% [markdown]
# On your screen, each line has a level, a time, the node's name and the text. (Pages with stored outputs
# leave the time out.) It is the real time, in seconds since 1970: there is no session here that could
# make it jump, so this page really waits.
#
# ## Start the monitor
#
# **Predict:** the sensor has been running for a while. Which reading does the monitor see first?

# %% terminal="monitor --until Status --lines 3" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 run sensor_simulator temperature_subscriber

# %% [markdown]
# The next one that was published. What was sent before it came is gone: a topic is no archive.
#
# (The tutorial does not load the workspace in its second terminal. If a new terminal of yours finds the
# package without that, something loads it when the terminal opens.)
#
# Both go on while you read this.
#
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
# The arrows are almost upright: a message needs a few thousandths of a second. The first readings have no
# arrow: nobody was there to hear them.
#
# Now compare the numbers themselves: `numbers` takes them out of the lines, and the two lines at the end look
# whether the ten stand side by side anywhere among those that were sent. (To a hundredth: a `Float32` may round
# the last digit the other way.) **Predict:** once the monitor hears the sensor, does it miss a reading?

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
# Ten readings, the same ten, in the same order. They were made in one process and judged in another. How
# did they cross? The publisher handed each message to the middleware in its own process. That turned it
# into a few bytes, and the middleware of the other process made a message of them again.
#
# ## Look from here
#
# The page is a third process, and a session on it sees nothing of this: it is in a **domain** of its own.
# A domain is a number. Nodes with the same number find each other, nodes with different numbers never do.
# Your terminals have one in their environment, and a session can join it:

# %%
ros = Session(domain_id=int(os.environ["ROS_DOMAIN_ID"]))
ros.start()
ros.wait_for_nodes("temperature_sensor", "temperature_monitor")
viz.graph(ros.graph())

# %% [markdown]
# You know this graph from the first pages. There a session played both nodes, here two programs run them, and
# the picture is the same: nodes do not care where the others run. On a robot they may even run on
# different computers. And no program in the middle keeps a list of them: each process tells the others
# what it has and what it wants. That is called **discovery**.
#
# ## Stop one of them
#
# **Predict:** the sensor ends. What does the monitor do?

# %% terminal="sensor --ctrl-c" tags=["nbval-ignore-output"]

# %% terminal="monitor" tags=["nbval-ignore-output"]

# %%
sensor.exit_code, monitor.busy

# %% [markdown]
# The sensor ended with exit code 0, in good order. The monitor got no error, its lines only stop: it is still
# busy, and waits. For a subscriber, silence is nothing special. Start the sensor again:

# %% terminal="sensor --until Publishing --lines 2" tags=["nbval-ignore-output"]
# ros2 run sensor_simulator temperature_publisher

# %% terminal="monitor --until Status --lines 2" tags=["nbval-ignore-output"]

# %% [markdown]
# The monitor goes on as if nothing had happened. The first reading may be missing: the two have to find each
# other first. The terminal `sensor` is in the right folder and has loaded the workspace, so one line was
# enough to start it.
#
# ## Try it: one more monitor
#
# Start a second monitor in a third terminal. Nobody has to ask the sensor. Two nodes should not have
# the same name, or people mix them up. What follows `--ros-args` is for ROS: `-r` stands for *remap*, and
# with `__node` (two underscores) it gives the node another name. Fill in what is run.

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
# For `ros2 run`, only `install` counts, and colcon has **copied** your files to it. `diff` compares a file
# with its copy (the star stands for any text), and `echo` speaks only if both are the same, which is what
# `&&` means:

# %% terminal="build"
# cd "$ROS2_WORKSPACE"
# diff src/sensor_simulator/sensor_simulator/temperature_publisher.py install/sensor_simulator/lib/python3*/site-packages/sensor_simulator/ && echo "the same"

# %% [markdown]
# The same, for now. If you change the file in `src` and run, the *old* program runs, and ROS does not tell
# you. That costs everybody an afternoon once. Build after each change, or let colcon make a link
# instead of a copy: then a change counts the next time that the program starts. Only what `setup.py` says
# still needs a build.
#
# ## Try it: link instead of copy
#
# Build `sensor_simulator` once more, with links. colcon itself knows what the option is called:

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
# A link lies in another place than a copy. So, this once, terminals that are open already have to load the
# workspace again: `source install/setup.bash`.
#
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
# **Symptom:** *Package not found*. **What shows it:** the question whether *this* terminal has loaded the
# workspace. **Cause:** it has not. **Cure:** `source install/setup.bash`, in the workspace.
#
# ## Clean up
#
# Press `Ctrl` + `C` in every terminal. The tutorial's own sensor would show a traceback here, as you saw on the
# page about publishers. Your programs say nothing and end with 0.

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
# time, each as a process of its own, and press `Ctrl` + `C` as well.
#
# **Predict:** both start at the same instant. How many of the first three readings does the monitor hear?

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
# All three: a session connects them at once. Real programs need a moment to find each other.
#
# ## Remember
#
# - **Build** in the workspace, **source** in each terminal, then **run**.
# - Messages cross from process to process; nodes share nothing else.
# - One node can end and come back, and the other need not notice.
# - `ros2 run` starts what is installed, not what is in `src`.
#
# In JupyterLab, open two terminals with *File, New, Terminal*, and do the same there by hand. Then you have
# done all that the tutorial does, on your own. One more check looks at everything at once: in a new cell,
# `check("system", workspace.folder())` builds your package elsewhere, runs both programs and compares.

# %%
progress()
