from rosbeat.records import LogRecord
from rosbeat.workspace.terminals.history import Line
from rosbeat.workspace.terminals.log_lines import log_records


def test_lines_of_ros_become_records():
    lines = [
        Line(0, 5, "~$ echo [INFO] [a]: typed", typed=True),
        Line(1, 7, "[INFO] [1732212345.123456789] [temperature_sensor]: Publishing: 22.13C"),
        Line(2, 9, "[WARN] [ns.monitor]: warm [INFO] [b]: c"),
        Line(3, 11, "[HELLO] [a]: b"),
        Line(4, 13, "# exit code 1"),
        Line(5, 15, "[ERROR] [0.5] [a]: "),
    ]
    assert log_records(lines) == (
        LogRecord(1732212345123456789, "INFO", "temperature_sensor", "Publishing: 22.13C", "", 0),
        LogRecord(9, "WARN", "ns.monitor", "warm [INFO] [b]: c", "", 0),
        LogRecord(500_000_000, "ERROR", "a", "", "", 0),
    )
