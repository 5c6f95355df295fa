import errno

import pytest

from rosbeat.workspace.troubles import trouble


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EACCES, errno.ENOTDIR, errno.ENAMETOOLONG, 0])
def test_three_parts_whatever_the_system_says(says, code):
    says(trouble("a.py cannot be saved", OSError(code, "text")), "a.py cannot be saved")
