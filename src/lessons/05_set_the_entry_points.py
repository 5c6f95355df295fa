# ---
# title: Set the entry points
# minutes: 30
# needs: ["02", "03", "04"]
# summary: Tell setup.py which functions become programs, and see what chmod +x does and does not do.
# ---

# %% [markdown]
# # Set the entry points
#
# **Goal:** you turn the two files of your package into programs that `ros2 run` can start.
#
# **Time:** 30 minutes. **You need:** [create a package](02_create_a_package.ipynb),
# [write a publisher](03_write_a_publisher.ipynb) and [write a subscriber](04_write_a_subscriber.ipynb).
#
# The files are there, and nobody knows yet that they are programs. What is missing is one entry for
# each in `setup.py`. The next cell makes what earlier pages would have left here, if it is not there.
# (The star in the commands below stands for any text.)

# %%
from rosbeat import check, hint, predict, progress, workspace

workspace.catch_up("05")

# %% terminal="build"
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# ls

# %% [markdown]
# ## Make a file executable
#
# A file is data until the system is told that it may be run. That permission is one letter, `x`, for
# *execute*. `stat` shows what is known of a file, here its permissions and its name.

# %% terminal="build"
# stat -c "%A %n" temperature_*.py

# %% [markdown]
# The first character says what it is: `-` stands for a file, `d` would be a folder. Then come three
# times three: `r` is *read*, `w` is *write*, first for you, then for your group, then for all
# others. There is no `x`. You can start such a file with `python3 temperature_publisher.py`, because then
# Python only reads it. To start it by its own name it needs the `x`. `chmod` means *change mode*, and
# `+x` adds it:

# %% terminal="build"
# chmod +x temperature_publisher.py
# chmod +x temperature_subscriber.py
# stat -c "%A %n" temperature_*.py

# %% [markdown]
# Now the sensor starts by itself. `./` means *in this folder*: the shell does not look for programs here
# of its own accord. The first line of the file, `#!/usr/bin/env python3`, says who runs it. A sensor never
# ends, so this cell only watches until a reading appears, and the program goes on in its terminal.

# %% terminal="sensor --until Publishing" tags=["nbval-ignore-output"]
# cd "$ROS2_WORKSPACE/src/sensor_simulator/sensor_simulator"
# ./temperature_publisher.py

# %% [markdown]
# A real node, running by itself. In a bare terminal you would press `Ctrl` + `C` to end it. A page has a
# command for that: `%terminal`, with one percent sign, types nothing.

# %% terminal="sensor --ctrl-c" tags=["nbval-ignore-output"]

# %%
workspace.terminal("sensor").exit_code

# %% [markdown]
# Exit code 0: `main` caught the interrupt and tidied up. A program that does not catch it ends with another
# one, and with a traceback on the screen.
#
# ## See what `chmod` does not do
#
# The tutorial says that after `chmod +x` the programs can be started with `ros2 run`. Try it. First the
# package is built and loaded, as on page 02.

# %% terminal="build"
# cd "$ROS2_WORKSPACE"
# colcon build --packages-select sensor_simulator
# source install/setup.bash

# %% [markdown]
# `--packages-select` builds one package and leaves the others alone. **Predict:** does `ros2 run` find
# the sensor?

# %% terminal="build --for 5"
# ros2 run sensor_simulator temperature_publisher

# %% [markdown]
# It does not. `ros2 run` never looks at your files in `src`, and their permissions do not matter to it.
# There is a good reason: on a robot there may be no `src` at all, only what was installed. `ros2 run`
# looks for programs in one folder of the installed package, and there are none. (`ros2 pkg executables`
# would list them.)

# %% terminal="build"
# ros2 pkg executables sensor_simulator

# %% [markdown]
# ## Read setup.py
#
# `setup.py` tells Python how to install your package. It is the instruction manual that colcon follows.

# %% terminal="build"
# cat src/sensor_simulator/setup.py

# %% [markdown]
# | piece | what it says |
# |---|---|
# | `name`, `version` | the package's name, as in `package.xml` |
# | `packages=find_packages(...)` | which folders with Python code to install: all but `test` |
# | `data_files` | what else to copy: the marker and the manifest |
# | `install_requires` | what Python itself needs for it |
# | `zip_safe` | whether it would run from a zip file |
# | `maintainer`, `description`, `license` | the same as in `package.xml`; nobody compares the two, so you do |
# | `extras_require` | what its tests need |
# | `entry_points` | which functions become programs |
#
# Two of them are easy to get wrong. A folder without an `__init__.py` is no Python package, so
# `find_packages` does not see it, and its code is not installed. And a file that is not code, such as a
# picture or a settings file, is installed only if `data_files` names it.
#
# The last piece matters most here.

# %% [markdown]
# ## Understand an entry point
#
# An **entry point** is one line of text. `ros2 run` starts the name before the equals sign, and that
# program calls the function behind the colon:
#
# | `talk = rosie.voice:start` | |
# |---|---|
# | `talk` | the executable: what you type after `ros2 run rosie` |
# | `rosie.voice` | the module: the file `rosie/voice.py`, without `.py`, with dots |
# | `start` | the function in it |
#
# So you type `ros2 run rosie talk`. Three names meet here, and they need not be equal. The
# *executable* is what you type. The *module* is the file in which the code is. The *node's name* stands in
# `super().__init__(...)`; it is what others see in the graph, and `ros2 run` does not know it. For our
# sensor, executable and module are both called `temperature_publisher`, and the node calls itself
# `temperature_sensor`.

# %% [markdown]
# ## Try it: two programs
#
# Write the two entries. The executables are called `temperature_publisher` and `temperature_subscriber`,
# like their files in the Python package `sensor_simulator`, and each of them calls `main`. Mind the
# comma after each line. You may put your own description and licence in, as in your `package.xml`.

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
# `setup.py` is saved and not run: colcon runs it. What you changed in `src` is not yet in `install`, so
# build again.

# %% terminal="build"
# colcon build --packages-select sensor_simulator
# source install/setup.bash
# ros2 pkg executables sensor_simulator

# %% [markdown]
# There they are. colcon has made two small programs out of two lines of text. Each of them imports its
# module and calls its function, and the folder they are in is the one that `setup.cfg` names.

# %% terminal="build"
# ls install/sensor_simulator/lib/sensor_simulator

# %% [markdown]
# ## Try it: write entry points
#
# Complete the function: it returns the text of an entry point.

# %% exercise="05b"
def entry_point(executable, package, module, function="main"):
    # --- answer
    return f"{executable} = {package}.{module}:{function}"
    # --- blank
    # return ____
    # --- end

# %% check="05b"
check("05b", entry_point)

# %% [markdown]
# ## What went wrong: a comma is missing
#
# Two texts side by side, without a comma. **Predict:** how many entries does Python see?

# %% predict=true
entries = [
    "talk = rosie.voice:start"
    "sing = rosie.voice:start"
]
print(entries)
# --- answer
predict("1", len(entries))
# --- blank
# predict("____", len(entries))
# --- end

# %% [markdown]
# One. Python glues texts together that stand side by side. **Symptom:** colcon stops with *setup() was never
# called*, which does not mention a comma. **What shows it:** the list, line by line. **Cause:** the glued
# line is no entry point. **Cure:** a comma after each. And as the build failed, `ros2 run` goes on
# starting what was built before.
#
# ## What went wrong: one letter

# %% terminal="build"
# ros2 run sensor_simulator temprature_publisher

# %% [markdown]
# **Symptom:** *No executable found*. **What shows it:** `ros2 pkg executables`. **Cause:** executables are
# compared letter by letter, like topics. **Cure:** type it as it stands in `setup.py`.
#
# An entry point that names a module or a function that does not exist is worse: the build succeeds, and
# the error comes when you run it. `.py` in the module's name does that. (`:main()` with brackets stops the
# build, with the text of the missing comma.) If an error names a module, compare it with the file.

# %% [markdown]
# ## Remember
#
# - An **entry point** makes a function an executable: `name = package.module:function`.
# - `ros2 run` looks in `install`, so build after every change of `setup.py`.
# - `chmod +x` lets you start a file directly; `ros2 run` does not need it.
#
# **Next:** [build, source, run](06_build_source_run.ipynb): both programs, at the same time.

# %%
progress()
