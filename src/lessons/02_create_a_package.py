# ---
# title: Create a package
# minutes: 30
# needs: ["00", "01"]
# summary: Make the package of the temperature sensor, learn what each of its files is for, build it and load it.
# ---

# %% [markdown]
# # Create a package
#
# **After this page, you can:**
#
# - create a Python package, and name what each of its files is for (02b, 02.1);
# - describe a package in its manifest (02a, 02.3);
# - build a workspace and source it, and tell when one of the two is missing (02.2).
#
# **Time:** 30 minutes. **You need:** [create a workspace](01_create_a_workspace.ipynb).
#
# A [**package**](../docs/glossary.md#package) is a folder that contains code and a few files that describe it. It's
# the smallest unit that ROS can build, install and find, and it's what people share: a camera driver is a package,
# and so is a set of messages.
#
# If the workspace from the last page is missing, the course creates it as soon as you open a terminal, and says so.
# It never changes what you have made.

# %%
viz.diagram("02")

# %% [markdown]
# ## Create it
#
# Packages live in `src`. A single command creates one:

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src"
# ros2 pkg create --build-type ament_python sensor_simulator --dependencies rclpy std_msgs

# %% [markdown]
# Read the command piece by piece:
#
# | piece | meaning |
# |---|---|
# | `ros2` | the command-line tool of ROS 2 |
# | `pkg create` | create a new package |
# | `--build-type ament_python` | a Python package, not a C++ one |
# | `sensor_simulator` | the package's name: lower case, with words joined by `_` |
# | `--dependencies rclpy std_msgs` | what the package needs: the ROS library for Python, and standard messages such as `Float32` and `String` |
#
# A [**dependency**](../docs/glossary.md#dependency) is a package that yours needs; every Python node needs `rclpy`.
# `--dependencies` doesn't install anything: it writes the names into the package, where `rosdep`, ROS's tool for
# dependencies, can read what to install on a robot. The warning at the end is about the license, which you'll choose
# below; with `--license Apache-2.0`, `ros2 pkg create` would have filled it in.

# %% terminal="build"
# find sensor_simulator -type f | sort

# %% [markdown]
# `find ... -type f` lists files. There are eight of them, and you didn't have to write any. This is what they are for:
#
# | file | what it's for |
# |---|---|
# | `package.xml` | the package's name, who maintains it, and what it needs |
# | `setup.py` | how Python installs the package; page 05 is about this file |
# | `setup.cfg` | where the package's programs are installed |
# | `resource/sensor_simulator` | the marker by which ROS finds the package |
# | `sensor_simulator/__init__.py` | makes the inner folder a Python package |
# | `test/test_*.py` | style checks, run by `colcon test` |
#
# There are two folders called `sensor_simulator`. The outer one is the ROS package; the inner one is the
# Python package. Your nodes go into the inner one.
#
# ## Look inside
#
# Three of the files are tiny, so look at them first. `cat` prints a file, and `wc -c` counts its bytes.

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src/sensor_simulator"
# cat setup.cfg
# wc -c resource/sensor_simulator sensor_simulator/__init__.py

# %% [markdown]
# The two files that were counted are empty: all that matters is that they exist. `setup.cfg` says that programs are
# installed in `lib/sensor_simulator`, which is where `ros2 run` looks for them. Without `setup.cfg`, they would be
# installed somewhere else, and `ros2 run` wouldn't find them.
#
# Now for a longer one, `package.xml`:

# %% terminal="build"
# cat package.xml

# %% [markdown]
# This is the [**manifest**](../docs/glossary.md#manifest): it states the package's name, its version, a
# description, who maintains it, the license under which others may use it, and what it needs. `<depend>` names
# packages that it needs, to be built and to run, and `<test_depend>` names packages that only its tests need.
# `<build_type>` tells colcon how to build it.
#
# Two entries still say `TODO`. That does no harm today, but a package that you share needs both: without a
# license, nobody else is allowed to use it. The maintainer's name and address are guesses.
#
# ## Try it: complete the manifest
#
# A cell that begins with `%%save` becomes a file in your workspace. If the file already exists and is different, the
# course keeps the earlier version. Write a description of your own, and choose a license: ROS itself uses
# `Apache-2.0`. You can also fill in your name and email address.

# %% save="src/sensor_simulator/package.xml" exercise="02a"
# <?xml version="1.0"?>
# <?xml-model href="http://download.ros.org/schema/package_format3.xsd" schematypens="http://www.w3.org/2001/XMLSchema"?>
# <package format="3">
#   <name>sensor_simulator</name>
#   <version>0.0.0</version>
# --- answer
#   <description>A simulated temperature sensor and a monitor that judges its readings.</description>
# --- blank
# #   <description>____</description>
# --- end
#   <maintainer email="you@example.com">you</maintainer>
# --- answer
#   <license>Apache-2.0</license>
# --- blank
# #   <license>____</license>
# --- end
#
#   <depend>rclpy</depend>
#   <depend>std_msgs</depend>
#
#   <test_depend>ament_copyright</test_depend>
#   <test_depend>ament_flake8</test_depend>
#   <test_depend>ament_pep257</test_depend>
#   <test_depend>python3-pytest</test_depend>
#
#   <export>
#     <build_type>ament_python</build_type>
#   </export>
# </package>

# %% check="02a"
check("02a", workspace.folder())

# %% [markdown]
# ## Build it
#
# Go to the workspace and build. `colcon build` builds every package that it finds there.

# %% terminal="build"
# cd "$ROS2_WORKSPACE"
# colcon build

# %% [markdown]
# colcon found the package by its `package.xml`, built it, and reported: started, finished. For a Python
# package, building means copying the code, the manifest and the marker to the places where ROS looks for them, and
# creating the programs. A C++ package would also be compiled. If there are several packages, colcon
# builds a package's dependencies before the package itself. The result is in `install`, with one folder per package:

# %% terminal="build"
# ls -d install/*/
# ls install/sensor_simulator

# %% [markdown]
# The package is built. Does `ros2` find it now?

# %% terminal="build"
# ros2 pkg prefix sensor_simulator

# %% [markdown]
# ## Load it
#
# `ros2` doesn't find it yet: this terminal's environment lists the packages that came with ROS, but not yours. The
# command `source` runs a file in the current terminal. Here, the file adds your packages to the terminal's environment:

# %% terminal="build"
# source install/setup.bash
# ros2 pkg prefix sensor_simulator

# %% [markdown]
# Now `ros2` finds the package, and `ros2 pkg prefix` prints where it's installed. This step is called
# [**sourcing**](../docs/glossary.md#sourcing) the workspace. On a robot, make it a habit to source in a new terminal and
# not in the one that builds, because later builds may pick up what was sourced before. Your workspace lies on top of ROS like a transparent
# sheet, so it's called an [**overlay**](../docs/glossary.md#overlay). It adds packages, and leaves those underneath
# as they are.
#
# Sourcing changed this terminal and no other. What does a second terminal say?

# %% terminal="other"
# ros2 pkg prefix sensor_simulator

# %% shows=true
viz.diagram("overlay")

# %% [markdown]
# The second terminal has to source the workspace itself. This is a common surprise in the first weeks with ROS: a
# package is built, and a new terminal doesn't find it. Whenever you read *Package not found*, ask two
# questions. Is it built? There should be a folder of its name in `install`. Is it loaded? *This* terminal should have
# run `source install/setup.bash`.

# %% terminal="other"
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 pkg prefix sensor_simulator

# %% [markdown]
# ## Look for programs
#
# A package can contain programs, which you start with `ros2 run`. Which programs does yours have?

# %% terminal="build"
# ros2 pkg executables sensor_simulator

# %% [markdown]
# None: the package doesn't declare any programs yet. Page 05 shows how. `std_msgs`, a package that comes with ROS,
# has no programs either: it provides message definitions rather than programs, and you can read each definition. In
# ROS, a message type is one kind of [**interface**](../docs/glossary.md#interface): something that two nodes have
# to agree on.

# %% terminal="build"
# ros2 interface show std_msgs/msg/Float32

# %% [markdown]
# This is the message that your sensor will send. It has one field, `data`, which is a 32-bit number. The lines
# above it are a comment from its authors. They call the type deprecated, which means that they advise against it,
# and recommend more meaningful messages. To learn with, it's good enough.
#
# ## Try it: a second package
#
# Create a package `room_display` in `src`: a Python package that depends on `rclpy` and `sensor_msgs`.
# Replace the blanks.

# %% terminal="build" exercise="02b"
# cd "$ROS2_WORKSPACE/src"
# --- answer
# ros2 pkg create --build-type ament_python room_display --dependencies rclpy sensor_msgs
# --- blank
# # ros2 pkg create ____ room_display ____
# --- end

# %% check="02b"
check("02b", workspace.folder())

# %% [markdown]
# ## What went wrong: it already exists
#
# What happens if you create `sensor_simulator` a second time?

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src"
# ros2 pkg create --build-type ament_python sensor_simulator

# %% [markdown]
# **Symptom:** *Aborted*, and exit code 1. **Where to look:** the path in the message. **Cause:** the
# folder already exists. **Fix:** use the package you have, or choose another name. The command never overwrites a
# package, so nothing was lost.
#
# There are two more traps in this command. First, it creates the package in the current folder, which should be
# `src`. Second, if you forget `--build-type ament_python`, a full ROS installation creates a C++ package, which
# has no `setup.py`. If that happens, remove the folder and start again. The `ros2` command of this course creates
# Python packages only, and tells you so.
#
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("02")

# %% only="solution"
quiz("02", "c", "a", "b")

# %% [markdown]
# ## Remember
#
# - A **package** has a manifest, `package.xml`. A Python package also has a `setup.py`.
# - `ros2 pkg create` creates a package; run it in `src`.
# - `colcon build` builds the packages in `src` and puts the result into `install`; run it in the workspace.
# - `source install/setup.bash` loads the result into one terminal.
# - The workspace is an **overlay** on top of ROS.
#
# **Next:** [write a publisher](03_write_a_publisher.ipynb), the first node of this package.

# %% shows=true
progress()
