# ---
# title: Create a workspace
# minutes: 25
# needs: ["00"]
# summary: Type your first commands in a real terminal, and make the folder that everything you build will live in.
# ---

# %% [markdown]
# # Create a workspace
#
# **Goal:** you work in a real terminal and make the folder in which everything you build will live.
#
# **Time:** 25 minutes. **You need:** [hear the heartbeat](00_hear_the_heartbeat.ipynb).
#
# So far your nodes lived on a page. To run by themselves, on a robot or on your computer, they need
# files in a certain order. The folder for all of it is called a **workspace**.
#
# ## Open a terminal
#
# People who work with ROS type commands into a **terminal**. This cell brings terminals to your page:

# %%
from rosbeat import check, hint, progress, workspace

# %% [markdown]
# A cell that begins with `%%terminal` and a name types its lines into the terminal of that name. It
# is a real one, and it stays open from cell to cell. `pwd` means *print working directory*: it
# says in which folder you are.

# %% terminal="one"
# pwd

# %% [markdown]
# The line with the `$` is what was typed. In front of the `$` stands the folder, in short: here `~`,
# which is how a terminal writes your home folder. The line below is the answer. Your own lines differ
# a little: these terminals start in the folder of your pages, wherever you put the course.
#
# JupyterLab has terminals of its own: *File, New, Terminal*. Everything that you type on these pages
# you can type there, too.
#
# ## Make the folder
#
# `mkdir` makes a folder (*make directory*), `cd` goes there (*change directory*). The course keeps the
# place of your workspace under the name `ROS2_WORKSPACE`. `echo` prints, and `$` in front of a name
# stands for what is kept under it.

# %% terminal="one"
# echo $ROS2_WORKSPACE
# mkdir -p "$ROS2_WORKSPACE"
# cd "$ROS2_WORKSPACE"
# pwd

# %% [markdown]
# (The quotes keep a path together if there is a blank in it. What `-p` does, you see below.) The folder
# appears in JupyterLab's file browser on the left, too, beside your pages. It is your own: nothing in
# this course deletes what you put there.
#
# **Predict:** the next cell uses the same terminal. In which folder does it begin?

# %% terminal="one"
# pwd

# %% [markdown]
# In the new one. The terminal remembers. Another terminal knows nothing of that:

# %% terminal="two"
# pwd

# %% [markdown]
# Terminal `two` stands in a folder of its own. Later, one terminal will run the sensor and another
# the monitor.
#
# ## Give it an order
#
# A workspace has a few folders. The tutorial that this course follows makes all of them in one line.
# `ls` lists what is in a folder: with `-1` one name on each line, and with `-d` and these stars only the
# folders here and in `resources`.

# %% terminal="one"
# mkdir -p src docs scripts resources/images
# ls -1d */ resources/*/

# %% [markdown]
# | folder | what goes in |
# |---|---|
# | `src` | source code: what you write, in the packages of the next page |
# | `docs` | what you write about it |
# | `scripts` | small helpers of your own |
# | `resources/images` | pictures and other files |
#
# Only `src` matters to ROS. The others are for you, and for the people you work with.
#
# ## Understand `-p`
#
# `-p` stands for *parents*, the folders around a folder. It makes those that are missing, and it is
# content if the folder is there already.
#
# **Predict:** what happens without it?

# %% terminal="one"
# mkdir resources/maps/kitchen

# %% [markdown]
# It refuses: `resources/maps` does not exist. Every command ends with an **exit code**: 0 means that
# all went well, any other number that it did not. Lines that begin with `#` are remarks of this course;
# a bare terminal does not print them.
#
# With `-p` it works:

# %% terminal="one"
# mkdir -p resources/maps/kitchen
# ls resources

# %% [markdown]
# ## Find your way
#
# A **path** says where something is:
#
# | path | means |
# |---|---|
# | `src` | the folder `src` in the folder where you are |
# | `..` | one folder up |
# | `../docs` | one up, then into `docs` |
# | `~` | your home folder |
# | `/` | the top of the whole disk |
#
# Paths that begin with `/` or `~` mean the same place wherever you are: they are **absolute**. The
# others begin where you are: they are **relative**.

# %% terminal="one"
# cd "$ROS2_WORKSPACE/resources/images"
# cd ..
# pwd

# %% [markdown]
# ## Try it: a folder in a folder
#
# The first line goes back to the workspace. Make the folder `resources/sounds/alarm` there with one
# command. Replace the blank `____` with what is missing, and run both cells.

# %% terminal="one" exercise="01a"
# cd "$ROS2_WORKSPACE"
# --- answer
# mkdir -p resources/sounds/alarm
# --- blank
# # mkdir ____
# --- end

# %% check="01a"
check("01a", workspace.folder())

# %% [markdown]
# ## Try it: from here to there
#
# Terminal `two` goes to `resources/images`. From there, go to `src` with one `cd` and a relative path.

# %% terminal="two"
# cd "$ROS2_WORKSPACE/resources/images"

# %% terminal="two" exercise="01b"
# --- answer
# cd ../../src
# --- blank
# # cd ____
# --- end

# %% check="01b"
check("01b", workspace.terminal("two"))

# %% [markdown]
# ## Ask whether ROS is there
#
# `ROS2_WORKSPACE` is one of many names that a terminal keeps. All of them together are its
# **environment**, and it hands them to every command. On a robot you would first type `source
# /opt/ros/jazzy/setup.bash`, which fills the environment in, so that ROS is found. Here, every terminal
# begins with that.

# %% terminal="one"
# echo $ROS_DISTRO
# ros2 pkg list | grep rclpy

# %% [markdown]
# `jazzy` is the version of ROS 2. `ros2` is its command-line tool: here it listed what is installed, and
# `| grep rclpy` kept the lines in which `rclpy` stands, the ROS library for Python.
#
# You may put a name of your own into the environment, with `export`:

# %% terminal="one"
# export ROBOT=Rosie
# echo "I am $ROBOT"

# %% [markdown]
# **Predict:** what does terminal `two` print?

# %% terminal="two"
# echo "I am $ROBOT"

# %% [markdown]
# Nothing: a name that is not there counts as empty, and there is no error. Each terminal has an
# environment of its own. You meet this again with `source`.
#
# ## Build an empty workspace
#
# `colcon` is the tool that builds a workspace: it looks for packages below the folder where you are,
# makes programs of them that ROS can start, and puts the result into new folders.

# %% terminal="one"
# cd "$ROS2_WORKSPACE"
# colcon build
# ls

# %% [markdown]
# No package yet, so nothing was built. But three folders are there: `install` is the result, `build` is
# colcon's workbench, and `log` its diary. You never edit them. You may delete all three at any time: the
# next build makes them again.
#
# ## What went wrong: one character
#
# The tutorial begins with this line. **Predict:** why does it fail?

# %% terminal="one"
# mkdir /Documents/ROS2_and_RL_Tutorials/

# %% [markdown]
# **Symptom:** an error and exit code 1. **What shows it:** the path in the message. **Cause:** it begins
# with `/`, so it begins at the top of the disk, and there is no folder `Documents` up there. **Cure:**
# `~/Documents/...` was meant, in your home folder. One character decides.
#
# ## What went wrong: the wrong folder
#
# `colcon build` works wherever there may be packages, and that is a trap.

# %% terminal="one"
# cd "$ROS2_WORKSPACE/src"
# colcon build
# ls

# %% [markdown]
# Now the three folders are in `src`, too, where nobody looks for them. **Cure:** remove them, and build in
# the workspace itself. `rm` removes files, and with `-r` folders and all that is in them. There is no bin
# to get them back from, so read such a line twice before you run it.

# %% terminal="one"
# cd "$ROS2_WORKSPACE/src"
# rm -r build install log

# %% [markdown]
# ## Remember
#
# - A **workspace** is a folder; `src` in it holds the source code.
# - `mkdir -p` makes folders, `cd` goes there, `pwd` says where you are, `ls` shows what is there.
# - Exit code 0 means that all went well.
# - Each terminal has its own folder and its own environment.
# - `colcon build` is typed in the workspace, not in `src`.
#
# **Next:** [create a package](02_create_a_package.ipynb) in `src`.

# %%
progress()
