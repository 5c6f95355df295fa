import pytest

from course_tool import checks, installing, making, prepare, proof, stamp
from course_tool.messages import Problem, Untouched


@pytest.fixture
def work(made, monkeypatch):
    """What preparing does, as a list of words, without doing it."""
    done = []
    monkeypatch.setattr(checks, "before_installing", lambda layout: done.append("check"))
    monkeypatch.setattr(making, "make_or_keep", lambda layout, environ: done.append("venv"))
    monkeypatch.setattr(installing, "fill", lambda layout, level, environ: done.append(level))

    def ask_ros(layout, environ):
        done.append("listen")
        return {"milliseconds": 200.0, "rclpy": "7.1.6"}

    monkeypatch.setattr(proof, "ask_ros", ask_ros)
    return done


def fails(problem):
    def fill(layout, level, environ):
        raise problem

    return fill


def test_everything_is_done_in_order_and_the_stamp_comes_last(made, work):
    environ = prepare.ready(made, "course")
    assert work == ["check", "venv", "course", "listen"]
    assert stamp.satisfied(made, "course")
    assert environ["VIRTUAL_ENV"] == str(made.venv)


def test_nothing_is_done_twice(made, work):
    prepare.ready(made, "course")
    del work[:]
    prepare.ready(made, "course")
    assert work == []


def test_a_refresh_keeps_the_tools_for_tests(made, work):
    prepare.ready(made, "test")
    del work[:]
    made.lock("test").write_text("newer\n")
    prepare.ready(made, "course")
    assert work == ["check", "venv", "test", "listen"]


def test_what_another_command_has_just_done_is_not_done_again(made, work):
    stamp.write(made, "course")
    prepare._complete(made, "course", {})
    assert work == []


def test_an_interrupted_one_has_no_stamp(made, work, monkeypatch):
    stamp.write(made, "course")
    made.lock("course").write_text("newer\n")
    monkeypatch.setattr(installing, "fill", fails(KeyboardInterrupt()))
    with pytest.raises(KeyboardInterrupt):
        prepare.ready(made, "course")
    assert not made.stamp.exists()


def test_a_disk_that_filled_leaves_no_stamp(made, work, monkeypatch):
    stamp.write(made, "course")
    made.lock("course").write_text("newer\n")
    monkeypatch.setattr(installing, "fill", fails(Problem("disk", "", "")))
    with pytest.raises(Problem):
        prepare.ready(made, "course")
    assert not made.stamp.exists()


def test_offline_the_old_environment_is_not_lost(made, work, monkeypatch):
    stamp.write(made, "course")
    before = stamp.read(made)
    made.lock("course").write_text("newer\n")
    monkeypatch.setattr(installing, "fill", fails(Untouched("network", "", "")))
    with pytest.raises(Untouched):
        prepare.ready(made, "course")
    assert stamp.read(made) == before
    assert not stamp.satisfied(made, "course")


def test_ros_that_is_not_heard_leaves_no_stamp(made, work, monkeypatch):
    def ask_ros(layout, environ):
        raise proof.unheard()

    monkeypatch.setattr(proof, "ask_ros", ask_ros)
    with pytest.raises(Problem, match="hears nothing"):
        prepare.ready(made, "course")
    assert not made.stamp.exists()


def test_the_first_time_is_announced(layout, made, work, capsys):
    prepare.ready(made, "course")
    assert "Completing .venv" in capsys.readouterr().out
    made.lock("course").write_text("newer\n")
    prepare.ready(made, "course")
    assert "Something changed" in capsys.readouterr().out
