"""What a recording says of itself."""

from dataclasses import replace

from rosbeat.bags import record
from rosbeat.records import GraphSnapshot, Observation


def test_it_describes_itself(tmp_path, make):
    run = make.run([1.0, 2.0])
    door = make.publisher("/door", "/lock", "std_msgs/msg/Bool")
    run = replace(run, graph=GraphSnapshot((), (*run.graph.endpoints, door)))
    assert str(record(run, tmp_path / "run")) == (
        "Recording run, stored as MCAP: 2 messages on 2 topics.\n"
        "The session ran 2 s of virtual time, messages came from 1 s to 2 s.\n"
        "  /temperature: 2 messages of type std_msgs/msg/Float32 from /sensor (reliable, volatile, "
        "keep last 10)\n"
        "  /door: no messages of type std_msgs/msg/Bool from /lock (reliable, volatile, "
        "keep last 10)"
    )
    silent = record(Observation(1_500_000_000, 0), tmp_path / "silent", storage="sqlite3")
    assert str(silent) == (
        "Recording silent, stored as SQLite: no messages on no topics.\n"
        "The session ran 1.5 s of virtual time."
    )
