"""Convert quality of service between a bag's format and the records."""

from __future__ import annotations

from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)

from rosbeat.records import NANOSECONDS, QoS

# How ROS writes "no limit": the longest time that it can express.
_UNLIMITED = QosTime(9223372036, 854775807)
#: From so many seconds on, sixty years, nobody has meant a limit.
_YEARS = 60 * 365 * 24 * 3600


def stored(qos: QoS) -> Qos:
    """Convert QoS to the form in which a bag stores it; other policies have the ROS default."""
    return Qos(
        QosHistory[qos.history],
        qos.depth,
        QosReliability[qos.reliability],
        QosDurability[qos.durability],
        _time(qos.deadline_ns),
        _time(qos.lifespan_ns),
        QosLiveliness.AUTOMATIC,
        _UNLIMITED,
        False,
    )


def read(qos: Qos) -> QoS:
    """Convert QoS from the form in which a bag stores it to a record."""
    return QoS(
        qos.reliability.name,
        qos.durability.name,
        qos.history.name,
        qos.depth,
        _limit_ns(qos.deadline),
        _limit_ns(qos.lifespan),
    )


def _time(limit_ns: int) -> QosTime:
    return QosTime(*divmod(limit_ns, NANOSECONDS)) if limit_ns else _UNLIMITED


def _limit_ns(time: QosTime) -> int:
    # The middleware rounds "no limit" to what it can express, in some versions: 68 years.
    return 0 if time.sec >= _YEARS else time.sec * NANOSECONDS + time.nsec
