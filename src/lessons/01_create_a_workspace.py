# ---
# title: Create a workspace
# minutes: 35
# needs: ["00"]
# summary: Type your first commands in a real terminal, and make the folder that everything you build will live in.
# ---

# %% [markdown]
# # Create a workspace
#
# **After this page, you can:**
#
# - create nested folders with one command (01a, 01.2);
# - move around with absolute and relative paths (01b, 01.1);
# - explain why two terminals can behave differently (01.3).
#
# **Time:** 35 minutes. **You need:** [hear the heartbeat](00_hear_the_heartbeat.ipynb).
#
# Rosie needs a place for her programs to live. You'll build it on this page, but first, let's see what a program of
# hers does when it runs on its own, in a terminal and in real time.
#
# ## Open a terminal
#
# People who work with ROS type commands into a [**terminal**](../docs/glossary.md#terminal). Your page has terminals
# of its own. Begin with the map:

# %%
viz.diagram("01")

# %% [markdown]
# A cell that begins with `%%terminal` and a name types its lines into the terminal with that name. It's a real
# terminal, and it stays open from one cell to the next. This one starts Rosie, and keeps her running:

# %% terminal="rosie --until waits" tags=["nbval-ignore-output"] shows=true
# ros2 run rosie rover

# %% [markdown]
# Rosie is awake. Look at her:

# %% shows=true
watch_robot()

# %% [markdown]
# Hold an arrow and she drives; drag the slider and she gets faster. The orange marks are what her laser scanner sees.
# All of this is messages, and any other terminal can listen in:

# %% terminal="look" shows=true
# ros2 topic list
# ros2 topic echo --once /rosie/pose

# %% [markdown]
# `ros2 topic list` prints the topics that exist now, and `ros2 topic echo --once` prints the next message about where
# she is: `x` and `y` are in meters, and `theta` is her direction.
#
# Can a terminal also talk to her? Watch the picture while you run the next cell:

# %% terminal="look" tags=["nbval-ignore-output"] shows=true
# ros2 topic pub --once /rosie/cmd_vel geometry_msgs/msg/Twist "{linear: {x: 0.4}, angular: {z: 1.0}}"

# %% [markdown]
# She drove for a second and stopped, because a robot that hears nothing more should not drive on. To her, it makes no
# difference whether a button, a terminal or another node publishes the command, as long as the message has the right
# type: `geometry_msgs/msg/Twist`, which comes with ROS. You'd type the same lines on any robot.
#
# In an ordinary terminal, you'd press `Ctrl` + `C` to end the program. On a page, `%terminal` with one percent sign
# presses the keys for you:

# %% terminal="rosie --ctrl-c" tags=["nbval-ignore-output"] shows=true

# %% [markdown]
# JupyterLab has terminals of its own, too: choose *File, New, Terminal*. Every command of a terminal cell works there.
# Soon, Rosie will run programs that *you* wrote. They need files, arranged in a certain way, and the folder that holds
# these files is called a [**workspace**](../docs/glossary.md#workspace).
#
# ## Find out where you are
#
# `pwd` is short for *print working directory*: it prints the folder you're in.

# %% terminal="one"
# pwd

# %% [markdown]
# The line with the `$` shows the command. The text before the `$` is the current folder, in short form. The line
# below is the output: the folder in which the terminal starts. For you, that's the folder of your pages. A `~` in
# such a path is short for your home folder.
#
# ## Make the folder
#
# `mkdir` (*make directory*) creates a folder, and `cd` (*change directory*) moves into it. The course stores the
# location of your workspace under the name `ROS2_WORKSPACE`. `echo` prints text, and a `$` before a name
# stands for the value stored under that name.

# %% terminal="one"
# echo $ROS2_WORKSPACE
# mkdir -p "$ROS2_WORKSPACE"
# cd "$ROS2_WORKSPACE"
# pwd

# %% [markdown]
# The quotes keep a path in one piece even if it contains a space. You'll see below what `-p` does.
#
# The new folder also appears in JupyterLab's file browser on the left, beside your pages. This folder is yours: the
# course never deletes what you put there.
#
# Terminal `one` stays in the new folder from now on. Which folder is a second terminal in?

# %% terminal="two"
# pwd

# %% [markdown]
# Not in the new one: terminal `two` has a current folder of its own. Later, one terminal will run the sensor and
# another will run the monitor.
#
# ## Add the folders inside
#
# A workspace has a few standard folders, and the tutorial that this course follows creates all of them in one line.
# `ls` lists what's in a folder. The option `-1` prints one name per line. With `-d` and these stars, `ls` lists
# only the folders here and in `resources`.

# %% terminal="one"
# mkdir -p src docs scripts resources/images
# ls -1d */ resources/*/

# %% [markdown]
# | folder | what it's for |
# |---|---|
# | `src` | source code: the packages you'll create on the next page |
# | `docs` | your documentation |
# | `scripts` | small helper scripts |
# | `resources/images` | pictures and other files |
#
# Only `src` matters to ROS. The others are for you, and for the people you work with.
#
# ## Understand `-p`
#
# `-p` is short for *parents*, the folders that contain a folder. With `-p`, `mkdir` creates any missing parent
# folders, and doesn't complain if a folder already exists.
#
# What happens without it? The next cell tries both.

# %% terminal="one"
# mkdir resources/maps/kitchen
# mkdir -p resources/maps/kitchen
# ls resources

# %% [markdown]
# The first command fails, because `resources/maps` doesn't exist yet; the second creates both folders. Every command
# ends with an [**exit code**](../docs/glossary.md#exit-code): 0 means success, and any other number means that
# something went wrong. Lines that begin with `#` are notes from this course; an ordinary terminal doesn't print them.
#
# ## Find your way
#
# A [**path**](../docs/glossary.md#path) says where a file or folder is:
#
# | path | means |
# |---|---|
# | `src` | the folder `src` inside the current folder |
# | `..` | the folder one level up |
# | `../docs` | one level up, then into `docs` |
# | `~` | your home folder |
# | `/` | the top of the file system |
#
# A path that begins with `/` or `~` means the same place wherever you are: it's an
# [**absolute**](../docs/glossary.md#absolute-path) path. Any other path starts from the current folder: it's a
# [**relative**](../docs/glossary.md#relative-path) path.

# %% terminal="one"
# cd "$ROS2_WORKSPACE/resources/images"
# cd ..
# pwd

# %% [markdown]
# ## Try it: a folder in a folder
#
# The first line goes back to the workspace. From there, create the folder `resources/sounds/alarm`. A single command
# is enough. Replace the blank `____` with what's missing, and run both cells.

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
# The first line takes terminal `two` to `resources/images`. From there, go to `src` with a relative path. One `cd` is
# enough.

# %% terminal="two" exercise="01b"
# cd "$ROS2_WORKSPACE/resources/images"
# --- answer
# cd ../../src
# --- blank
# # cd ____
# --- end

# %% check="01b"
check("01b", workspace.terminal("two"))

# %% [markdown]
# ## Check that ROS is there
#
# `ROS2_WORKSPACE` is one of many names that a terminal stores. Together they are called its
# [**environment**](../docs/glossary.md#environment), and every command that you run receives a copy of the names that
# are exported. On a robot, you would first type `source /opt/ros/jazzy/setup.bash`, which sets up the environment so
# that ROS can be found. In this course, every terminal starts with that already done.

# %% terminal="one"
# echo $ROS_DISTRO
# ros2 pkg list | grep rclpy

# %% [markdown]
# `jazzy` is the name of a *distribution*, a version of ROS 2 with all its packages, and a good word to add to any web
# search. `ros2` is the command-line tool. Here it lists the packages that are
# installed. `| grep rclpy` keeps only the lines that contain `rclpy`, the ROS library for Python. A robot has the
# original `ros2`. Yours was written for this course, because pip doesn't offer the original, and it answers alike.
#
# You can add a name of your own to the environment with `export`. Then other programs get it, too, such as a second
# `bash`:

# %% terminal="one"
# export ROBOT=Rosie
# bash -c 'echo "I am $ROBOT"'

# %% [markdown]
# What does terminal `two` print?

# %% terminal="two"
# echo "I am $ROBOT"

# %% [markdown]
# Only "I am": a name that hasn't been set counts as empty, and that's not an error. Each terminal has its own
# environment. You'll see this again when you learn about `source`.
#
# ## Build an empty workspace
#
# `colcon` is the tool that builds a workspace. It looks for packages in the current folder and below, builds them so
# that ROS can find them and start their programs, and puts the results into new folders.

# %% terminal="one"
# cd "$ROS2_WORKSPACE"
# colcon build
# ls

# %% [markdown]
# There's no package yet, so there was nothing to build. But you now have three new folders: `install` holds the
# result, `build` holds intermediate files, and `log` holds a record of each build. You never edit these folders. You
# can delete all three at any time, because the next build creates them again.

# %% shows=true
viz.diagram("workspace")

# %% [markdown]
# ## What went wrong: one character
#
# The tutorial begins with this line. Why does it fail?

# %% terminal="one"
# mkdir /Documents/ROS2_and_RL_Tutorials/

# %% [markdown]
# **Symptom:** an error and exit code 1. **Where to look:** the path in the message. **Cause:** the path begins with
# `/`, so it starts at the top of the file system, where there is no folder `Documents`. **Fix:** the tutorial means
# `~/Documents/...`, in your home folder. A single character makes the difference. Where even your home folder has no
# `Documents`, as on many servers, `mkdir -p ~/Documents/ROS2_and_RL_Tutorials` creates both.
#
# ## What went wrong: the wrong folder
#
# `colcon build` works in any folder, and that's a trap.

# %% terminal="one"
# cd "$ROS2_WORKSPACE/src"
# colcon build
# ls

# %% [markdown]
# Now `src` has its own `build`, `install` and `log`. Nothing will ever look there. **Fix:** remove them, and build in the
# workspace itself. `rm` removes files; `rm -r` removes folders and everything in them. What `rm` removes is gone,
# because there is no recycle bin, so read the line twice before you press `Enter`.

# %% terminal="one"
# cd "$ROS2_WORKSPACE/src"
# rm -r build install log

# %% [markdown]
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("01")

# %% only="solution"
quiz("01", "b", "c", "a")

# %% [markdown]
# ## Remember
#
# - A **workspace** is a folder; its `src` folder holds the source code.
# - `mkdir -p` creates folders, `cd` moves into one, `pwd` prints where you are, and `ls` lists what's there.
# - Exit code 0 means success.
# - Each terminal has its own current folder and its own environment.
# - Run `colcon build` in the workspace, not in `src`.
#
# | here | on a robot |
# |---|---|
# | a cell with `%%terminal one` | a terminal window |
# | `%terminal one --ctrl-c` | `Ctrl` + `C` in that window |
# | ROS is there in every terminal | `source /opt/ros/jazzy/setup.bash` first |
# | `watch_robot()` | RViz, or the robot itself |
#
# **Rosie can now** drive where you tell her, and has a place for her programs.
#
# **Next:** [create a package](02_create_a_package.ipynb) in `src`.

# %% shows=true
progress()
