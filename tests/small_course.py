"""A checkout of a very small course, for the tests of what learners get."""

from grading_files import BLANK, cell, notebook

#: What a checkout holds besides its pages; what learners must not get has a SECRET in it.
FILES = {
    "environment/course": "#!/bin/sh\necho course\n",
    "environment/README.md": "# The environment\n",
    "environment/course_tool/__pycache__/cli.pyc": "SECRET",
    "src/rosbeat/__init__.py": '"""The package."""\n',
    "src/rosbeat/exercises/solved/03a.txt": "SECRET",
    "src/rosbeat/workspace/finished/package.xml": "<package/>\n",
    "src/rosbeat/workspace/finished/setup.py": "SECRET",
    "src/rosbeat/workspace/finished/sensor_simulator/temperature_publisher.py": "node\n",
    "src/rosbeat/workspace/finished/sensor_simulator/temperature_subscriber.py": "node\n",
    "src/rosbeat.egg-info/PKG-INFO": "SECRET",
    "src/lessons/03_write.py": "SECRET",
    "src/ros2_command/pyproject.toml": "[project]\n",
    "src/rosie/pyproject.toml": "[project]\n",
    "solutions/03_write.ipynb": "SECRET",
    "tests/test_course.py": "SECRET",
    "docs/exercises.md": "SECRET",
    "docs/troubleshooting.md": "# Troubleshooting\n",
    ".git/HEAD": "SECRET",
    ".venv/bin/python": "SECRET",
    ".rosbeat/progress.json": "SECRET",
    "notebooks/kept/03_write.ipynb": "SECRET",
    "ROS2_and_RL_Tutorials/src/node.py": "SECRET",
    "pyproject.toml": "[project]\n",
    "README.md": "SECRET",
    "LICENSE": "Apache\n",
}


def course_page(lesson, exercise, links=""):
    return notebook(
        cell(f"# Page {lesson[:2]}\n{links}", "markdown", f"{exercise}-title"),
        cell(BLANK, id=f"{exercise}-cell", exercise=exercise),
        cell(f'check("{exercise}", Beat)', id=f"{exercise}-check", check=exercise),
        lesson=lesson,
    )


PAGES = {
    "03_write": course_page("03_write", "03a", "On [page 04](04_listen.ipynb#a), [here](x.png)."),
    "04_listen": course_page("04_listen", "04a", "Back to [page 03](03_write.ipynb)."),
    "06_build": course_page("06_build", "06a"),
}


def small_course(root):
    """Make the checkout and return its folder."""
    pages = {f"notebooks/{lesson}.ipynb": text for lesson, text in PAGES.items()}
    for name, text in {**FILES, **pages}.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (root / "environment/course").chmod(0o755)
    return root


def tree(folder):
    """Every file of a folder with its text, but the release's own marker."""
    return {
        path.relative_to(folder).as_posix(): path.read_text()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != ".rosbeat-release.json"
    }
