"""Quality of service, as a bag stores it and as the records have it."""

from __future__ import annotations

from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)

from rosbeat.records import QoS

# How ROS writes "no limit": the longest time that it can express.
_UNLIMITED = QosTime(9223372036, 854775807)


def stored(qos: QoS) -> Qos:
    """Quality of service as a bag stores it; what the records do not have is ROS's default."""
    return Qos(
        QosHistory[qos.history],
        qos.depth,
        QosReliability[qos.reliability],
        QosDurability[qos.durability],
        _UNLIMITED,
        _UNLIMITED,
        QosLiveliness.AUTOMATIC,
        _UNLIMITED,
        False,
    )


def read(qos: Qos) -> QoS:
    """Quality of service as a bag stores it, as a record."""
    return QoS(qos.reliability.name, qos.durability.name, qos.history.name, qos.depth)
