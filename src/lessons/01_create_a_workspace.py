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
# People who work with ROS type commands into a **terminal**. The program that reads them is called
# the **shell**; here it is `bash`. This cell brings terminals to your page:

# %%
from rosbeat import check, workspace

# %% [markdown]
# A cell that begins with `%%terminal` and a name types its lines into the terminal of that name. It
# is a real one, and it stays open from cell to cell. `pwd` means *print working directory*: it
# says in which folder you are.

# %% terminal="one"
# pwd

# %% [markdown]
# The line with the `$` is what was typed. In front of the `$` the shell says where it is, in short:
# `~` is your home folder. Below is the answer. On your computer the path is another one.
#
# JupyterLab has terminals of its own: *File, New, Terminal*. Everything that you type on these pages
# you can type there, too.
#
# ## Make the folder
#
# `mkdir` makes a folder (*make directory*), `cd` goes there (*change directory*). With `-p`, `mkdir`
# is content if the folder is there already.

# %% terminal="one"
# mkdir -p ROS2_and_RL_Tutorials
# cd ROS2_and_RL_Tutorials
# pwd

# %% [markdown]
# You see it in JupyterLab's file browser on the left, too: a click on the folder icon at the top goes
# up to where it is. It is yours: nothing in this course deletes what you put there.
#
# **Predict:** the next cell uses the same terminal. In which folder does it begin?

# %% terminal="one"
# pwd

# %% [markdown]
# In the new one. The terminal remembers. Another terminal knows nothing of that:

# %% terminal="two"
# pwd

# %% [markdown]
# Terminal `two` is a shell of its own, in a folder of its own. Later, one terminal will run the
# sensor and another the monitor.
#
# ## Give it an order
#
# A workspace has a few folders. The tutorial that this course follows makes all of them in one line:

# %% terminal="one"
# mkdir -p src docs scripts resources/images
# find . -type d | sort

# %% [markdown]
# `find . -type d` lists all folders below this one, and `| sort` puts the lines in order. The dot
# means *here*.
#
# | folder | what goes in |
# |---|---|
# | `src` | the source code of your packages; the next page makes one |
# | `docs` | what you write about it |
# | `scripts` | small helpers of your own |
# | `resources/images` | pictures and other files |
#
# ROS cares about `src` only. The others are for you, and for the people you work with.
#
# ## Understand `-p`
#
# `-p` stands for *parents*. It does three things: it makes a folder in a folder in one step, it makes
# the parents that are missing, and it is no error if the folder exists.
#
# **Predict:** what happens without it?

# %% terminal="one"
# mkdir resources/maps/kitchen

# %% [markdown]
# It refuses: `resources/maps` does not exist. **Exit code 1** tells the same in a number: every
# command ends with one. 0 means that all went well, anything else that it did not. With `-p` it works:

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
# cd resources/images
# cd ..
# pwd
# cd ..

# %% [markdown]
# ## Try it: a folder in a folder
#
# Terminal `one` is in the workspace again. Make the folder `resources/sounds/alarm` with one command.
# Replace the blank `____` by what is missing, and run both cells.

# %% terminal="one" exercise="01a"
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
# cd ROS2_and_RL_Tutorials/resources/images

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
# A terminal finds programs through its **environment**: a set of named values that it hands to every
# command. On a robot you would first type `source /opt/ros/jazzy/setup.bash`, which fills it in. In
# this course, every terminal begins with it. `echo` prints, and `$` in front of a name means its value:

# %% terminal="one"
# echo $ROS_DISTRO
# ros2 pkg prefix rclpy > /dev/null && echo "rclpy is here"

# %% [markdown]
# `jazzy` is the version of ROS 2. `ros2` is the command-line tool of ROS 2. Here it looked up a
# package; `> /dev/null` hides the path it found, and `&&` goes on only if the exit code was 0.
#
# The environment belongs to one terminal. **Predict:** what does terminal `two` print?

# %% terminal="one"
# export ROBOT=Rosie
# echo "I am $ROBOT"

# %% terminal="two"
# echo "I am $ROBOT"

# %% [markdown]
# Nothing: a name that is not set is empty, and there is no error. `export` in one terminal changes
# that terminal only. You meet this again with `source`.
#
# ## Build an empty workspace
#
# `colcon` builds a workspace: it looks for packages below the folder where you are, and puts the
# result in three new folders.

# %% terminal="one"
# colcon build
# ls

# %% [markdown]
# No package yet, so nothing was built. But `build`, `install` and `log` are there. `install` is the
# result, `build` and `log` are colcon's own notes. You never edit them, and you may delete all three at
# any time: the next build makes them again.
#
# ## What went wrong: one character
#
# The tutorial begins with this line. **Predict:** why does it fail?

# %% terminal="one"
# mkdir /Documents/ROS2_and_RL_Tutorials/

# %% [markdown]
# **Symptom:** an error and exit code 1. **Instrument:** the path in the message. **Cause:** it begins
# with `/`, so it begins at the top of the disk, and there is no folder `Documents` up there. **Cure:**
# `~/Documents/...` was meant, in your home folder. One character decides.
#
# ## What went wrong: the wrong folder
#
# `colcon build` works wherever you are, and that is a trap.

# %% terminal="one"
# cd src
# colcon build
# ls

# %% [markdown]
# Now the three folders are in `src`, and later `source install/setup.bash` would load the wrong ones.
# **Cure:** remove them, and build in the workspace itself.

# %% terminal="one"
# rm -r build install log
# cd ..

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
