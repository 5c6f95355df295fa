"""The course's configuration, with what a test has of its own."""

import os

load_subconfig(os.environ["ROSBEAT_TEST_CONFIG"])  # noqa: F821 - traitlets gives both names
c = get_config()  # noqa: F821
c.JupyterHub.bind_url = os.environ["ROSBEAT_TEST_ADDRESS"]
c.PAMAuthenticator.allowed_groups = {os.environ["ROSBEAT_TEST_GROUP"]}
