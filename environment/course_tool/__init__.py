"""What `./environment/course` does, once a suitable Python is found. Standard library only.

The launcher runs this with the Python behind ``.venv``, never with ``.venv`` itself, so that the
environment can be remade while this runs.
"""
