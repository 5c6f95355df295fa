# ---
# title: Create a package
# minutes: 30
# needs: ["00", "01"]
# summary: Make the package of the temperature sensor, learn what each of its files is for, build it and load it.
# ---

# %% [markdown]
# # Create a package
#
# **Goal:** you make the package that will hold the sensor and the monitor, you know what each of its
# files is for, and you build and load it.
#
# **Time:** 30 minutes. **You need:** [create a workspace](01_create_a_workspace.ipynb).
#
# A **package** is a folder with code and a few files that say what it is. It is the smallest thing
# that ROS can build, install and find, and it is what people share: a camera driver is a package, and
# so is a set of messages.
#
# The next cell makes the workspace of the last page if it is not there yet, and leaves it alone if it
# is.

# %%
from rosbeat import check, hint, progress, workspace

workspace.catch_up("02")

# %% [markdown]
# ## Make it
#
# Packages live in `src`. One command makes one:

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src"
# ros2 pkg create --build-type ament_python sensor_simulator --dependencies rclpy std_msgs

# %% [markdown]
# Read the command piece by piece:
#
# | piece | means |
# |---|---|
# | `ros2` | the command-line tool of ROS 2 |
# | `pkg create` | make a new package |
# | `--build-type ament_python` | a Python package, not C++ |
# | `sensor_simulator` | its name: lower case, words joined by `_` |
# | `--dependencies rclpy std_msgs` | what it needs: the Python library of ROS, and standard messages such as `Float32` and `String` |
#
# What follows `--dependencies` is only written down, not installed: a **dependency** is a package that
# yours needs, and other tools read there what to install on a robot. The warning at the end is about
# the licence. You choose one below.

# %% terminal="build"
# find sensor_simulator -type f | sort

# %% [markdown]
# `find ... -type f` lists files. There are eight, and you wrote none of them. Here is what they are for:
#
# | file | what for |
# |---|---|
# | `package.xml` | what the package is called, who looks after it, what it needs |
# | `setup.py` | how Python installs it; page 05 is about this one |
# | `setup.cfg` | where its programs are installed |
# | `resource/sensor_simulator` | the marker by which ROS finds the package |
# | `sensor_simulator/__init__.py` | makes the inner folder a Python package |
# | `test/test_*.py` | tests of style, run by `colcon test` |
#
# There are two folders `sensor_simulator`. The outer one is the ROS package, the inner one is the
# Python package. Your nodes go into the inner one.
#
# ## Look inside
#
# Three of the files are so small that you can look at them at once. `cat` shows a file, and `wc -c`
# counts its bytes.

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src/sensor_simulator"
# cat setup.cfg
# wc -c resource/sensor_simulator sensor_simulator/__init__.py

# %% [markdown]
# Both counted files are empty: that they are there is all that matters. `setup.cfg` says that
# programs go to `lib/sensor_simulator`, because that is where `ros2 run` looks for them. Without
# it, they would be installed where it never looks.
#
# Now the longest one:

# %% terminal="build"
# cat package.xml

# %% [markdown]
# This is the **manifest**: name, version, what it is, who looks after it, under which licence others
# may use it (the tag is spelt `license`), and what it needs. `<depend>` names packages that it needs to run, `<test_depend>` those
# that only its tests need. `<build_type>` tells colcon how to build it.
#
# Two places say `TODO`. Nobody minds today, but a package that you share needs both: without a
# licence, nobody else may use it. The name of the maintainer is a guess from this computer's settings.

# %% [markdown]
# ## Try it: fill in the manifest
#
# A cell that begins with `%%save` becomes a file of your workspace. If that changes a file, the
# version before is kept. Write a description of your own, and choose a licence: `Apache-2.0` is the
# one that ROS itself uses. You may put in your name and address, too.

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
# colcon found the package by its `package.xml`, built it, and said so: started, finished. For a Python
# package, building means copying, and making its programs: the code, the manifest and the marker go to
# where ROS looks for them. A C++ package would be compiled as well. With many packages, colcon
# builds those first that others depend on. The result is in `install`, one folder for each package:

# %% terminal="build"
# ls -d install/*/
# ls install/sensor_simulator

# %% [markdown]
# **Predict:** the package is built. Does `ros2` find it now?

# %% terminal="build"
# ros2 pkg prefix sensor_simulator

# %% [markdown]
# ## Load it
#
# Not yet. This terminal's environment knows the packages that came with ROS, and nobody told it about
# yours. `source` runs a file in this very shell, and that file adds your packages to the
# environment:

# %% terminal="build"
# source install/setup.bash
# ros2 pkg prefix sensor_simulator

# %% [markdown]
# Now it is found, and `ros2 pkg prefix` says where it is installed. Your workspace lies on top of ROS like
# a transparent sheet, and that is what it is called: an **overlay**. It adds packages and leaves the
# others as they are.
#
# `source` has changed this terminal and no other. **Predict:** what does a second terminal say?

# %% terminal="other"
# ros2 pkg prefix sensor_simulator

# %% [markdown]
# It has to load the workspace itself. This is the most frequent surprise of the first weeks with ROS:
# a package is built, and a new terminal does not find it. Whenever you read *Package not found*, ask
# two questions. Is it built: is there a folder of its name in `install`? And is it loaded: did *this*
# terminal run `source install/setup.bash`?

# %% terminal="other"
# cd "$ROS2_WORKSPACE"
# source install/setup.bash
# ros2 pkg prefix sensor_simulator

# %% [markdown]
# ## Look for programs
#
# A package can bring programs that `ros2 run` starts. Which ones does yours have?

# %% terminal="build"
# ros2 pkg executables sensor_simulator

# %% [markdown]
# None, because there is no code in it. Compare with `std_msgs`, a package that comes with ROS: it brings
# messages and no programs, and what a message looks like you can read. (In ROS a message type is one
# kind of **interface**: what two nodes have to agree on.)

# %% terminal="build"
# ros2 interface show std_msgs/msg/Float32

# %% [markdown]
# That is the message that your sensor will send: one field, `data`, a number with 32 bits. The lines
# above it are a remark of its authors: it is here for examples, and for a robot of your own, messages with
# more meaning are better.
#
# ## Try it: a second package
#
# Make a package `room_display` in `src`, a Python package that needs `rclpy` and `sensor_msgs`.
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
# ## What went wrong: it exists already
#
# **Predict:** what happens if you make `sensor_simulator` once more?

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src"
# ros2 pkg create --build-type ament_python sensor_simulator

# %% [markdown]
# **Symptom:** *Aborted*, and exit code 1. **What shows it:** the path in the message. **Cause:** the
# folder is there. **Cure:** use it as it is, or choose another name. The command never overwrites a
# package, so nothing was lost.
#
# Two more traps lie in this command. It makes the package in the folder where you are; that should be
# `src`. And if you forget `--build-type ament_python`, a full ROS makes a C++ package, without a
# `setup.py`. Then remove the folder and begin again. (The `ros2` of this course makes Python packages only,
# and says so.)

# %% [markdown]
# ## Remember
#
# - A **package** has a manifest, `package.xml`, and for Python a `setup.py`.
# - `ros2 pkg create` makes one, in `src`.
# - `colcon build`, in the workspace, builds what is in `src` and puts it into `install`.
# - `source install/setup.bash` loads it, in one terminal.
# - The workspace is an **overlay** on top of ROS.
#
# **Next:** [write a publisher](03_write_a_publisher.ipynb), the first node for this package.

# %%
progress()
