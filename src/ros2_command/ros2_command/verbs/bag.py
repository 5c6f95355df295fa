"""Implement `ros2 bag`: record topics, play them back, and describe recordings.

The files use the rosbag2 format, version 9, as in ROS 2 Jazzy; the library `rosbags` writes and
reads them. Messages pass between the middleware and the file as unchanged bytes.
"""

from __future__ import annotations

import mmap
import os
import re
import signal
import time
from argparse import ArgumentTypeError, Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path
from typing import Any

from ros2_command.definitions import definition_of
from ros2_command.errors import CommandError, note
from ros2_command.graph import Graph, open_graph
from ros2_command.names import (
    absolute,
    check_name,
    check_node_name,
    find_type,
    is_hidden,
    suggestion,
)
from ros2_command.registry import Argument, Verb, argument, flag, leave_out
from ros2_command.untyped import Untyped

_STORAGES = ["mcap", "sqlite3"]
_LEVELS = ["debug", "info", "warn", "error", "fatal"]
_TOPICS_ONLY = "only topics are recorded and played here, not the calls of services."
_KEYBOARD = (
    "this subset does not read the keyboard. Start the command when you need it, and stop it "
    "with Ctrl+C."
)
_OVERRIDES = "recording and playing follow the publishers' quality of service here."
_ONE_FILE = "a recording is one plain file here, as the library `rosbags` writes it."
_NO_EFFECT = "(here: no effect)"
_NANOSECONDS = 1_000_000_000


def _error(text: str, *more: str) -> CommandError:
    return CommandError(f"[ERROR] [ros2bag]: {text}", *more)


@contextmanager
def _opened(path: Path) -> Iterator[Any]:
    """Open a recording.

    Raises:
        CommandError: If it is none, or it is damaged.
    """
    from rosbags.rosbag2 import Reader

    try:
        with Reader(path) as reader:
            yield reader
    except (CommandError, KeyboardInterrupt, SystemExit):
        raise
    except Exception as error:  # a damaged file may make the library stumble anywhere
        hint = "Was the recording ended with Ctrl+C? Only then is the bag complete."
        incomplete = path.is_dir() and not (path / "metadata.yaml").is_file()
        raise _error(
            f"'{path}' cannot be read: {error}",
            f"It has no metadata.yaml. {hint}" if incomplete else "",
        ) from None


# Information


def _info(args: Namespace) -> None:
    with _opened(args.bag_path) as reader:
        if args.topic_name:
            for name in reader.topics:
                print(name)
            return
        files = _files(args.bag_path)
        size = sum(one.stat().st_size for one in files)
        first = reader.start_time if reader.message_count else 0
        # The library counts the end after the last message.
        last = reader.end_time - 1 if reader.message_count else 0
        topics = [
            f"Topic: {one.topic} | Type: {one.msgtype} | Count: {one.msgcount} | "
            f"Serialization Format: {one.ext.serialization_format}"
            for one in reader.connections
        ]
        rows = {
            "Files": ("\n" + " " * 19).join(one.name for one in files),
            "Bag size": _size(size),
            "Storage id": "mcap" if ".mcap" in files[0].name else "sqlite3",
            "ROS Distro": reader.ros_distro or _distro_of(files[0]),
            "Duration": f"{_seconds(last - first)}s",
            "Start": _date(first),
            "End": _date(last),
            "Messages": reader.message_count,
            "Topic information": ("\n" + " " * 19).join(topics),
            "Service": 0,
            "Service information": "",
        }
    print()
    for name, value in rows.items():
        print(f"{name + ':':<19}{value}" if len(name) < 18 else f"{name}: {value}")
    print()


def _files(path: Path) -> list[Path]:
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    return [one for one in files if one.name != "metadata.yaml"]


def _distro_of(path: Path) -> str:
    """Return the distribution that a file alone tells of, in the description after its messages."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        place = data.rfind(b"ros_distro: ")
        found = re.match(rb"ros_distro: '?(\w+)", data[place : place + 60]) if place >= 0 else None
    return found[1].decode() if found else "unknown"


def _size(count: float) -> str:
    units = ["B", "KiB", "MiB", "GiB"]
    while count >= 1024 and len(units) > 1:
        count /= 1024
        units.pop(0)
    return f"{count:.0f} B" if units[0] == "B" else f"{count:.1f} {units[0]}"


def _seconds(nanoseconds: int) -> str:
    return "{}.{:09}".format(*divmod(nanoseconds, _NANOSECONDS))


def _date(nanoseconds: int) -> str:
    whole, part = divmod(nanoseconds, _NANOSECONDS)
    text = datetime.fromtimestamp(whole).strftime("%b %e %Y %H:%M:%S")
    return f"{text}.{part:09} ({_seconds(nanoseconds)})"


# Recording


def _record(args: Namespace) -> int:
    folder = Path(args.output or datetime.now().strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    wanted = _wanted_topics(args)
    check_node_name(args.node_name)
    if folder.exists():
        raise _error(f"Output folder '{folder}' already exists.", "Choose another:  -o NAME")
    if args.use_sim_time and args.no_discovery:
        raise _error("--use-sim-time and --no-discovery both set, but are incompatible settings.")
    with open_graph(args, args.node_name) as graph:
        _set_level(graph, args.log_level)
        with _new_bag(folder, args.storage) as writer, _asked_to_stop() as stopped:
            recorder = Recorder(graph, writer, args.use_sim_time)
            recorder.record(wanted, args, stopped)
        recorder.log.info("Recording stopped")
        count = sum(recorder.counts.values())
    if not count:
        missing = [one for one in args.topics if absolute(one) not in recorder.counts]
        hint = suggestion(absolute(missing[0]), recorder.seen) if missing else ""
        note(f"No message was recorded. {hint}")
    return 0


def _wanted_topics(args: Namespace) -> Callable[[str, str], bool]:
    """Return which topics, by name and type, the options ask for.

    Raises:
        CommandError: If they ask for none.
    """
    args.topics += args.topics_positional
    for name in args.topics:
        check_name("topic", name)
    everything = args.all or args.all_topics
    if not (everything or args.topics or args.topic_types or args.regex):
        raise _error(
            "Need to specify at least one option out of --all, --all-topics, --topics, "
            "--topic-types or --regex",
            "For example:  ros2 bag record --all",
        )
    topics = {absolute(name) for name in args.topics}
    without = {absolute(name) for name in args.exclude_topics}

    def wanted(name: str, kind: str) -> bool:
        return (
            (everything or name in topics or kind in args.topic_types
             or bool(args.regex and args.regex.search(name)))
            and (args.include_hidden_topics or not is_hidden(name))
            and not (args.exclude_regex and args.exclude_regex.search(name))
            and name not in without
            and kind not in args.exclude_topic_types
        )  # fmt: skip

    return wanted


@contextmanager
def _new_bag(folder: Path, storage: str) -> Iterator[Any]:
    """Open a new recording, and complete it however the block ends.

    Raises:
        CommandError: If it cannot be written.
    """
    from rosbags.rosbag2 import StoragePlugin, Writer

    writer = Writer(folder, version=9, storage_plugin=StoragePlugin[storage.upper()])
    try:
        writer.open()
    except OSError as error:
        raise _error(f"'{folder}' cannot be written: {error.strerror or error}") from None
    file: Any = writer.storage
    name, close = f"{file.path.stem}_0{file.path.suffix}", file.close
    file.close = lambda version, text: close(version, _as_ros_has_it(text, name))
    try:
        yield writer
    finally:
        writer.close()
        file.path.rename(folder / name)
        about = writer.metapath.read_text(encoding="utf-8")
        writer.metapath.write_text(_as_ros_has_it(about, name), encoding="utf-8")


def _as_ros_has_it(text: str, name: str) -> str:
    """Return the description of a recording with the name of its file, and the distribution.

    The library gives the file the folder's name, and itself as the distribution.
    """
    import yaml

    tree = yaml.safe_load(text)
    about = tree.get("rosbag2_bagfile_information", tree)
    about |= {"relative_file_paths": [name], "ros_distro": os.environ.get("ROS_DISTRO", "jazzy")}
    about["files"][0]["path"] = name
    return str(yaml.safe_dump(tree, sort_keys=False))


@contextmanager
def _asked_to_stop() -> Iterator[Callable[[], bool]]:
    """Note Ctrl+C and other signals: an exception in the middle of a message would tear it."""
    asked: list[int] = []
    before = {
        number: signal.signal(number, lambda number, frame: asked.append(number))
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    }
    try:
        yield lambda: bool(asked)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _set_level(graph: Graph, level: str) -> None:
    from rclpy.logging import LoggingSeverity

    graph.node.get_logger().set_level(LoggingSeverity[level.upper()])


class Recorder:
    """Write what comes on topics into a recording.

    Args:
        graph: Where the topics are.
        writer: The recording.
        sim_time: Whether simulated time stamps the messages.

    Attributes:
        counts: How many messages were written, by topic.
        seen: Every topic that was there.
        log: The node's logger.
    """

    def __init__(self, graph: Graph, writer: Untyped, sim_time: bool) -> None:
        self.counts: dict[str, int] = {}
        self.seen: dict[str, list[str]] = {}
        self.log = graph.node.get_logger()
        self._graph, self._writer = graph, writer
        self._clock = graph.node.get_clock() if sim_time else None
        self._refused: set[str] = set()

    def record(
        self, wanted: Callable[[str, str], bool], args: Namespace, stopped: Callable[[], bool]
    ) -> None:
        """Record until it is stopped, and look again and again for topics that are new."""
        self.log.info("Listening for topics...")
        self._graph.settle(stopped)
        while not stopped():
            self.seen = dict(self._graph.topics())
            for name, types in self.seen.items():
                if name not in self.counts and self._may_be_recorded(name, types, args, wanted):
                    self._subscribe(name, types[0])
            pause = None if args.no_discovery else max(args.polling_interval, 1) / 1000
            self._graph.spin_until(stopped, pause)

    def _may_be_recorded(
        self, name: str, types: list[str], args: Namespace, wanted: Callable[[str, str], bool]
    ) -> bool:
        if name in self._refused or not any(wanted(name, one) for one in types):
            return False
        if len(types) > 1:
            self._refuse(name, f"it has more than one type: {', '.join(types)}")
            return False
        published = self._graph.others(self._graph.publishers(name))
        heard = self._graph.others(self._graph.subscriptions(name))
        return bool(
            (published or args.include_unpublished_topics)
            and (heard or not args.ignore_leaf_topics)
        )

    def _refuse(self, name: str, why: str) -> None:
        self._refused.add(name)
        self.log.warning(f"Topic '{name}' cannot be recorded: {why}")

    def _subscribe(self, name: str, type_name: str) -> None:
        kind = find_type(type_name, "msg")
        if kind is None:
            self._refuse(
                name,
                f"the type {type_name} cannot be loaded: its package is not installed, or its "
                "workspace is not sourced in this terminal",
            )
            return
        text = definition_of(kind, type_name)
        publishers = self._graph.publishers(name)
        ends = publishers or self._graph.subscriptions(name)
        connection = self._writer.add_connection(
            name, type_name, msgdef=text, rihs01=str(ends[0].topic_type_hash),
            offered_qos_profiles=[_stored(one.qos_profile) for one in publishers],
        )  # fmt: skip

        def write(data: bytes, info: dict[str, Any]) -> None:
            stamp = self._clock.now().nanoseconds if self._clock else info["received_timestamp"]
            if not stamp:  # simulated time has not begun
                return
            self._writer.write(connection, stamp, data)
            self.counts[name] += 1
            if self.counts[name] == 1:
                self.log.debug(f"The first message on '{name}' is written")

        self.counts[name] = 0
        offers = [one.qos_profile for one in publishers]
        profile = _profile(offers, all(one.reliability.name == "RELIABLE" for one in offers))
        self._graph.node.create_subscription(kind, name, write, profile, raw=True)
        self.log.info(f"Subscribed to topic '{name}'")


def _profile(offers: list[Any], reliable: bool) -> Untyped:
    """Return a profile that goes with what the publishers of a topic offer, or have offered.

    Args:
        offers: The profile of each, of rclpy or of a recording.
        reliable: Whether to be reliable; only those who are can be heard then.
    """
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    latched = bool(offers) and all(one.durability.name == "TRANSIENT_LOCAL" for one in offers)
    return QoSProfile(
        depth=max([100, *(one.depth for one in offers)]),
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def _stored(profile: Untyped) -> Untyped:
    """Return a profile of rclpy as a recording holds it."""
    from rosbags.interfaces import (
        Qos,
        QosDurability,
        QosHistory,
        QosLiveliness,
        QosReliability,
        QosTime,
    )

    def limit(duration: Untyped) -> QosTime:
        return QosTime(*divmod(duration.nanoseconds, _NANOSECONDS))

    return Qos(
        QosHistory[profile.history.name],
        profile.depth,
        QosReliability[profile.reliability.name],
        QosDurability[profile.durability.name],
        limit(profile.deadline),
        limit(profile.lifespan),
        QosLiveliness[profile.liveliness.name],
        limit(profile.liveliness_lease_duration),
        False,
    )


# Playing


def _play(args: Namespace) -> int:
    from rclpy.duration import Duration

    names = _remapping(args.remap)
    with _opened(args.bag_path) as reader, open_graph(None, "rosbag2_player") as graph:
        _set_level(graph, args.log_level)
        publishers = {}
        for one in reader.connections:
            if _is_played(one.topic, args) and (kind := _class_of(one, graph)):
                offers = one.ext.offered_qos_profiles
                weak = offers and all(end.reliability.name == "BEST_EFFORT" for end in offers)
                publishers[one.id] = graph.node.create_publisher(
                    kind, names.get(one.topic, one.topic), _profile(offers, not weak)
                )
        if not publishers:
            known = ", ".join(reader.topics)
            raise _error(f"Nothing to play: no topic is left of {known or 'none at all'}.")
        graph.settle()  # whoever listens already shall hear the first message, too
        graph.node.get_logger().info(f"Set rate to {args.rate:g}")
        graph.node.get_logger().info("Playback until timestamp: -1")
        with suppress(KeyboardInterrupt):
            player = Player(graph, reader, publishers, args)
            player.play()
            while args.loop:
                player.play()
        patience = args.wait_for_all_acked / 1000 or 1e9
        with suppress(KeyboardInterrupt):
            for publisher in publishers.values():
                publisher.wait_for_all_acked(Duration(seconds=patience))
    return 0


def _remapping(rules: list[str]) -> dict[str, str]:
    pairs = [rule.partition(":=") for rule in rules]
    for old, sign, new in pairs:
        if not sign or not old or not new:
            raise _error(f"'{old}{sign}{new}' is no remapping.", "Write it as  /old:=/new")
        check_name("topic", new)
    return {absolute(old): absolute(new) for old, _, new in pairs}


def _is_played(name: str, args: Namespace) -> bool:
    chosen = {absolute(one) for one in args.topics}
    return (
        ((not chosen and not args.regex) or name in chosen
         or bool(args.regex and args.regex.search(name)))
        and not (args.exclude_regex and args.exclude_regex.search(name))
        and name not in {absolute(one) for one in args.exclude_topics}
    )  # fmt: skip


def _class_of(connection: Untyped, graph: Graph) -> Untyped | None:
    found = find_type(connection.msgtype, "msg")
    if found is None:
        graph.node.get_logger().warning(
            f"Topic '{connection.topic}' is not played: the type {connection.msgtype} is not "
            "installed, or its workspace is not sourced"
        )
    return found


class Player:
    """Publish the messages of a recording as far apart as they were recorded.

    Args:
        graph: Where to publish.
        reader: The recording.
        publishers: One for each connection that is played, by its id.
        args: The options of `ros2 bag play`.
    """

    def __init__(
        self, graph: Graph, reader: Untyped, publishers: dict[int, Any], args: Namespace
    ) -> None:
        from rosgraph_msgs.msg import Clock

        self._graph, self._reader, self._publishers, self._args = graph, reader, publishers, args
        self._clock = graph.node.create_publisher(Clock, "/clock", 10) if args.clock else None
        self._next_clock = 0.0
        self._first = reader.start_time + int(args.start_offset * _NANOSECONDS)
        length = min(args.playback_duration * _NANOSECONDS, reader.end_time - self._first)
        self._end = self._first + int(length) + 1

    def play(self) -> None:
        """Play once, from the beginning to the end that the options say."""
        chosen = [one for one in self._reader.connections if one.id in self._publishers]
        self._graph.spin_for(self._args.delay)
        began = time.monotonic()
        self._next_clock = began
        for connection, stamp, data in self._reader.messages(chosen, self._first, self._end):
            due = began + (stamp - self._first) / _NANOSECONDS / self._args.rate
            while (wait := min(due, self._next_stop()) - time.monotonic()) > 0:
                self._graph.spin_for(wait)
                self._tell_time(began)
            self._tell_time(began)
            self._publishers[connection.id].publish(data)

    def _next_stop(self) -> float:
        return self._next_clock if self._clock else float("inf")

    def _tell_time(self, began: float) -> None:
        """Publish the time of the recording on `/clock` if that is due."""
        from rclpy.time import Time
        from rosgraph_msgs.msg import Clock

        now = time.monotonic()
        if self._clock is None or now < self._next_clock:
            return
        self._next_clock = max(self._next_clock + 1 / self._args.clock, now)
        past = int((now - began) * self._args.rate * _NANOSECONDS)
        self._clock.publish(Clock(clock=Time(nanoseconds=self._first + past).to_msg()))


# The arguments.


def _existing(text: str) -> Path:
    if not Path(text).exists():
        raise ArgumentTypeError(f"Bag path '{text}' does not exist!")
    return Path(text)


def _positive(text: str) -> float:
    value = float(text)
    if not value > 0:
        raise ArgumentTypeError(f"{text} is not in the valid range (> 0.0)")
    return value


def _pattern(text: str) -> re.Pattern[str]:
    try:
        return re.compile(text)
    except re.error as error:
        raise ArgumentTypeError(f"{text!r} is not a regular expression: {error}") from None


def _patterns(word: str, *short: str) -> tuple[Argument, ...]:
    """Return the arguments that choose topics by their names."""
    return (
        argument("-e", "--regex", type=_pattern,
                 help=f"{word} only topics containing provided regular expression."),
        argument(*short, "--exclude-regex", type=_pattern,
                 help="Exclude topics containing provided regular expression."),
        argument("--exclude-topics", nargs="+", default=[], metavar="Topic",
                 help="Space-delimited list of topics to leave out."),
    )  # fmt: skip


_BAG = (
    argument("bag_path", type=_existing, help="Bag to open."),
    argument("-s", "--storage", choices=_STORAGES,
             help="Storage implementation of bag. By default attempts to detect automatically"),
)  # fmt: skip
_LOG_LEVEL = argument("--log-level", choices=_LEVELS, default="info", help="Logging level.")
_RECORD = (
    argument("topics_positional", nargs="*", metavar="Topic", help="Topics to record."),
    argument("-o", "--output", help="Destination of the bagfile to create, "
             "defaults to a timestamped folder in the current directory."),
    argument("-s", "--storage", choices=_STORAGES, default="mcap",
             help="Storage identifier to be used, defaults to 'mcap'."),
    argument("--topics", nargs="+", default=[], metavar="Topic",
             help="Space-delimited list of topics to record."),
    argument("--topic-types", nargs="+", default=[], metavar="TopicType",
             help="Space-delimited list of topic types to record."),
    flag("-a", "--all", help="Record all topics (Exclude hidden topic)."),
    flag("--all-topics", help="Record all topics (Exclude hidden topic)."),
    *_patterns("Record"),
    argument("--exclude-topic-types", nargs="+", default=[], metavar="ExcludeTopicTypes",
             help="Space-delimited list of topic types not being recorded."),
    flag("--include-unpublished-topics",
         help="Discover and record topics which have no publisher."),
    flag("--include-hidden-topics", help="Discover and record hidden topics as well."),
    flag("--no-discovery", help="Only topics present at startup will be recorded."),
    argument("-p", "--polling-interval", type=int, default=100,
             help="Time in ms to wait between querying available topics for recording."),
    flag("--ignore-leaf-topics", help="Ignore topics without a subscription."),
    argument("-f", "--serialization-format", choices=["cdr"],
             help="The rmw serialization format in which the messages are saved"),
    flag("--use-sim-time",
         help="Use simulation time for message timestamps by subscribing to the /clock topic. "
         "Until first /clock message is received, no messages will be written to bag."),
    argument("--node-name", default="rosbag2_recorder", help="Specify the recorder node name."),
    _LOG_LEVEL,
    flag("--disable-keyboard-controls", help=_NO_EFFECT),
    argument("--max-cache-size", type=int, help=_NO_EFFECT),
    leave_out(_TOPICS_ONLY, "--services", "--all-services", "--exclude-services"),
    leave_out(_KEYBOARD, "--start-paused", "--snapshot-mode"),
    leave_out(_OVERRIDES, "--qos-profile-overrides-path"),
    leave_out(_ONE_FILE, "-b,--max-bag-size", "-d,--max-bag-duration", "--custom-data",
              "--storage-config-file", "--storage-preset-profile", "--compression-mode",
              "--compression-format", "--compression-queue-size", "--compression-threads",
              "--compression-threads-priority"),
)  # fmt: skip
_PLAY = (
    *_BAG,
    argument("-r", "--rate", type=_positive, default=1.0,
             help="rate at which to play back messages."),
    argument("--topics", nargs="+", default=[], metavar="Topic",
             help="topics to replay. If none specified, all topics will be replayed."),
    *_patterns("Play", "-x"),
    flag("-l", "--loop",
         help="start back at the beginning on reaching the end, and play indefinitely."),
    argument("-m", "--remap", nargs="+", default=[], metavar="OLD:=NEW",
             help="list of topics to be remapped"),
    argument("--clock", type=_positive, nargs="?", const=40.0, metavar="HZ",
             help="Publish to /clock at a specific frequency in Hz (default: 40)."),
    argument("-d", "--delay", type=_positive, default=0.0,
             help="Sleep duration before play (each loop), in seconds."),
    argument("--playback-duration", type=float, default=float("inf"),
             help="Playback duration, in seconds of the recording."),
    argument("--start-offset", type=float, default=0.0,
             help="Start the playback this many seconds into the bag file."),
    argument("--wait-for-all-acked", type=int, default=500, metavar="MS",
             help="Wait until all published messages are acknowledged by all subscribers, or so "
             "many milliseconds; 0 waits for ever."),
    _LOG_LEVEL,
    argument("--read-ahead-queue-size", type=int, help=_NO_EFFECT),
    flag("--disable-keyboard-controls", help=_NO_EFFECT),
    flag("--disable-loan-message", help=_NO_EFFECT),
    leave_out(_TOPICS_ONLY, "--services", "--exclude-services",
              "--publish-service-requests", "--service-requests-source"),
    leave_out(_KEYBOARD, "-p,--start-paused"),
    leave_out(_OVERRIDES, "--qos-profile-overrides-path"),
    leave_out(_ONE_FILE, "--storage-config-file"),
    leave_out("use --clock HZ.", "--clock-topics", "--clock-topics-all"),
    leave_out("use --playback-duration SECONDS.", "--playback-until-sec",
              "--playback-until-nsec"),
)  # fmt: skip
VERBS = {
    "info": Verb(
        "Print information about a bag to the screen",
        _info,
        *_BAG,
        flag("-t", "--topic-name", help="Only display topic names."),
        flag("-v", "--verbose", help=f"Display information for services {_NO_EFFECT}"),
    ),
    "play": Verb("Play back ROS data from a bag", _play, *_PLAY),
    "record": Verb("Record ROS data to a bag", _record, *_RECORD),
}
