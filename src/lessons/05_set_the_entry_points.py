# ---
# title: Set the entry points
# minutes: 30
# needs: ["02", "03", "04"]
# summary: Tell setup.py which functions become programs, and see what chmod +x does and does not do.
# ---

# %% [markdown]
# # Set the entry points
#
# **After this page, you can:**
#
# - declare a program in `setup.py` (05a, 05.3);
# - read an entry point, and repair a broken one (05b, 05.1);
# - tell what `chmod +x` does, and what it does not do (05.2).
#
# **Time:** 30 minutes. **You need:** [create a package](02_create_a_package.ipynb),
# [write a publisher](03_write_a_publisher.ipynb) and [write a subscriber](04_write_a_subscriber.ipynb).
#
# The two files are in your package, but nothing marks them as programs yet. For that, `setup.py` needs one entry
# for each. If something from an earlier page is missing, the course creates it when the first terminal opens.

# %%
viz.diagram("05")

# %% [markdown]
# ## Make a file executable
#
# A file is just data until the system is told that it may be run. That permission is shown as one letter, `x`, for
# *execute*. `chmod` is short for *change mode*, and `+x` adds the permission. `stat` prints facts about a file: here,
# its permissions and its name. The star stands for any text.

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# stat -c "%A %n" temperature_*.py
# chmod +x temperature_publisher.py
# chmod +x temperature_subscriber.py
# stat -c "%A %n" temperature_*.py

# %% [markdown]
# The first character is the kind: `-` for a file, `d` for a folder. Then come three groups of three characters.
# `r` is *read*, `w` is *write*, and `x` is *execute*: first for you, then for your group, then for everyone
# else. At first, there was no `x`. You could still have started the file with `python3 temperature_publisher.py`,
# because Python only has to read it. To start it by its own name, it needs the `x`.
#
# Now you can start the sensor directly. `./` means *in this folder*; without it, the shell doesn't look for programs
# in the current folder. The first line of the file, `#!/usr/bin/env python3`, says which program runs it. A sensor
# never ends, so this cell waits only until a reading appears. The program keeps running in its terminal.

# %% terminal="sensor --until Publishing" tags=["nbval-ignore-output"] shows=true
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# ./temperature_publisher.py

# %% [markdown]
# This is a real node, running on its own. `--until` has waited for a text in its output. Stop it as you stopped Rosie;
# afterwards, `$?` holds the exit code of the last command.

# %% terminal="sensor --ctrl-c" tags=["nbval-ignore-output"] shows=true

# %% terminal="sensor" shows=true
# echo $?

# %% [markdown]
# Exit code 0: `main` caught the interrupt and cleaned up. A program that doesn't catch it ends with a different exit
# code, and prints a traceback.
#
# ## See what `chmod` does not do
#
# The tutorial says that after `chmod +x`, `ros2 run` can execute the scripts. Try it. First, build and source the
# workspace, as on page 02.

# %% terminal="build"
# cd "$ROS2_WORKSPACE"
# colcon build --packages-select sensor_simulator
# source install/setup.bash

# %% [markdown]
# `--packages-select` builds one package and ignores the others. Does `ros2 run` find the sensor now? If it does,
# `timeout 5` ends it after five seconds.

# %% terminal="build"
# timeout 5 ros2 run sensor_simulator temperature_publisher

# %% [markdown]
# No. `ros2 run` never looks at your files in `src`, and their permissions make no difference to it.
# There's a good reason: a robot may not have `src` at all, only what was installed. `ros2 run`
# looks for programs in one folder of the installed package, and so far, there are none.
#
# ## Read setup.py
#
# `setup.py` tells Python how to install your package. It's the instruction manual that colcon follows.

# %% terminal="build"
# cat src/sensor_simulator/setup.py

# %% [markdown]
# | piece | what it says |
# |---|---|
# | `name`, `version` | the package's name and version, as in `package.xml` |
# | `packages=find_packages(...)` | which folders of Python code to install: all except `test` |
# | `data_files` | what else to copy: the marker and the manifest |
# | `install_requires` | Python packages that pip would install; ROS packages are listed in `package.xml` |
# | `zip_safe` | whether it could run from a zip file |
# | `maintainer`, `description`, `license` | keep them the same as in `package.xml`: no tool compares them, and yours may still say `TODO` here |
# | `extras_require` | what its tests need |
# | `entry_points` | which functions become programs |
#
# Two of these are easy to get wrong. A folder without an `__init__.py` isn't a Python package: `find_packages`
# skips it, and its code isn't installed. And a file that isn't code, such as a picture or a settings file, is
# installed only if `data_files` lists it.
#
# The last piece matters most here.
#
# ## Understand an entry point
#
# An [**entry point**](../docs/glossary.md#entry-point) is one line of text. The part before the equals sign is the
# name of a program, and that program calls the function named after the colon:
#
# | `talk = rosie.voice:start` | |
# |---|---|
# | `talk` | the executable: what you type after `ros2 run rosie` |
# | `rosie.voice` | the module: the file `rosie/voice.py`, written with a dot and without `.py` |
# | `start` | the function in that module |
#
# If you had a package `rosie`, you would type `ros2 run rosie talk`. Three names are involved, and they can all be
# different. The *executable* is what you type. The *module* is the file that contains the code. The *node name* is
# set in `super().__init__(...)`; it's what others see in the graph, and `ros2 run` doesn't use it. For our sensor,
# the executable and the module are both called `temperature_publisher`, while the node is called
# `temperature_sensor`.

# %% [markdown]
# ## Try it: two programs
#
# Write the two entries. The executables are called `temperature_publisher` and `temperature_subscriber`, like their
# files in the Python package `sensor_simulator`, and each entry calls `main`. Keep the comma at the end of each
# line. You can also fill in your own description and licence, to match your `package.xml`.

# %% save="src/sensor_simulator/setup.py" exercise="05a"
from setuptools import find_packages, setup

package_name = 'sensor_simulator'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='you',
    maintainer_email='you@example.com',
    description='A simulated temperature sensor and a monitor that judges its readings.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            # --- answer
            'temperature_publisher = sensor_simulator.temperature_publisher:main',
            'temperature_subscriber = sensor_simulator.temperature_subscriber:main',
            # --- blank
            # '____',
            # '____',
            # --- end
        ],
    },
)

# %% check="05a"
check("05a", workspace.folder())

# %% [markdown]
# The cell saves `setup.py` but doesn't run it: colcon runs it. What you changed in `src` isn't in `install` yet, so
# build again.

# %% terminal="build"
# colcon build --packages-select sensor_simulator
# source install/setup.bash
# ros2 pkg executables sensor_simulator

# %% [markdown]
# There they are: `ros2 pkg executables` lists a package's programs. From two lines of text, colcon has created two
# small programs. Each one imports its module and calls its function, and both are in the folder that `setup.cfg` names.

# %% terminal="build"
# ls install/sensor_simulator/lib/sensor_simulator

# %% shows=true
viz.diagram("entry point")

# %% [markdown]
# ## What went wrong: a comma is missing
#
# Here are two entries, one after the other, without a comma between them.

# %% shows=true
[
    "talk = rosie.voice:start"
    "sing = rosie.voice:start"
]

# %% [markdown]
# Python joins two strings if nothing separates them, so this is only one entry. **Symptom:** colcon stops with
# *setup() was never called*, which doesn't mention a comma. **Where to look:** the list, line by line. **Cause:** the
# joined line isn't a valid entry point. **Fix:** put a comma after each entry. Because the build failed, `ros2 run`
# still starts what was built before.
#
# ## What went wrong: one letter
#
# Why does this fail, although the program is built?

# %% terminal="build"
# ros2 run sensor_simulator temprature_publisher

# %% [markdown]
# **Symptom:** *No executable found*. **Where to look:** `ros2 pkg executables`. **Cause:** the names of executables,
# like those of topics, have to match letter for letter. **Fix:** type the name exactly as it is in `setup.py`.
#
# It's worse if an entry point names a module or a function that doesn't exist: the build succeeds, and
# the error appears only when you run the program. One way to cause this is to write `.py` after the module's name.
# If an error names a module, compare it with the file's name. `:main()` with parentheses stops the build instead,
# with the same message as a missing comma.
#
# ## Try it: repair a setup.py
#
# A friend sends you a package, `lamp_control`. It has two programs, `lamp` and `switch`, in files of the same
# names, and each file defines `main`. The next cell stands for what you receive: it creates the package and the two
# files. `> lamp.py` writes a text into a file, and `> /dev/null` throws it away.

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src"
# ros2 pkg create --build-type ament_python lamp_control > /dev/null
# cd lamp_control/lamp_control
# echo 'def main(): print("The lamp is on.")' > lamp.py
# echo 'def main(): print("The switch is on.")' > switch.py
# cd "$ROS2_WORKSPACE"

# %% [markdown]
# But your friend's `setup.py` doesn't build. Its two entry points contain four mistakes. Repair them; the check
# names one mistake at a time.

# %% save="src/lamp_control/setup.py" exercise="05b"
from setuptools import find_packages, setup

package_name = 'lamp_control'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    entry_points={
        'console_scripts': [
            # --- answer
            'lamp = lamp_control.lamp:main',
            'switch = lamp_control.switch:main',
            # --- blank
            # # Repair the two lines below, and delete this line: ____
            # 'lamp = lamp_control/lamp.py:main'
            # 'switch = lamp_control.switch:main()',
            # --- end
        ],
    },
)

# %% check="05b"
check("05b", workspace.folder())

# %% [markdown]
# A `setup.py` that passes the check also builds:

# %% terminal="build"
# colcon build --packages-select lamp_control
# source install/setup.bash
# ros2 run lamp_control lamp

# %% [markdown]
# ## Three questions
#
# Choose the best answer to each question. You can try as often as you like.

# %% only="notebook"
quiz("05")

# %% only="solution"
quiz("05", "b", "a", "c")

# %% [markdown]
# ## Remember
#
# - An **entry point** turns a function into an executable: `name = package.module:function`.
# - `ros2 run` looks in `install`, so build again after every change to `setup.py`.
# - `chmod +x` lets you start a file directly; `ros2 run` doesn't need it.
#
# **Next:** [build, source, run](06_build_source_run.ipynb): both programs, at the same time.

# %% shows=true
progress()
