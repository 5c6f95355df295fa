"""Causes outside of the graph: another ROS domain, and a build that is older than its source."""

from __future__ import annotations

from collections.abc import Iterator

from rosbeat.diagnosis.explanation_links import Sides
from rosbeat.diagnosis.explanation_parts import Finding, finding, listing
from rosbeat.diagnosis.situation import OtherDomain, Scene, StaleBuild


def elsewhere(sides: Sides, scene: Scene) -> Iterator[Finding]:
    """Find what is missing here in other domains."""
    for domain in scene.other_domains:
        publishers = domain.publishers if not sides.publishers else ()
        subscriptions = domain.subscriptions if not sides.subscriptions else ()
        if sides.missing and (publishers or subscriptions):
            yield _other_domain(sides.topic, scene.domain_id, domain, publishers, subscriptions)


def _other_domain(
    topic: str,
    here: int,
    domain: OtherDomain,
    publishers: tuple[str, ...],
    subscriptions: tuple[str, ...],
) -> Finding:
    said = [
        f"{listing(names)} {does} {topic}"
        for names, does in ((publishers, "publishes on"), (subscriptions, "subscribes to"))
        if names
    ]
    own = f"; this is domain {here}" if here >= 0 else ""
    return finding(
        "other-domain",
        f"ROS domain {domain.domain_id} has what is missing here",
        f"In ROS domain {domain.domain_id}, {listing(said)}{own}. Nodes in different domains never "
        "hear each other.",
        "Compare `echo $ROS_DOMAIN_ID` in both terminals. Both need the same number, set before "
        "the nodes start; a page joins with `Session(domain_id=...)`.",
    )


def private_domains(scene: Scene) -> str:
    """What to know of domains that were not looked into, as a sentence, or an empty text."""
    ids = [str(one.domain_id) for one in scene.other_domains if one.private]
    if not ids:
        return ""
    word = "domain" if len(ids) == 1 else "domains"
    return (
        f"Somebody also speaks in ROS {word} {listing(ids)}, as the sessions of pages do: each has "
        "a domain to itself, unless it is opened with `Session(domain_id=...)`."
    )


def stale(scene: Scene) -> Iterator[Finding]:
    """Find programs that were edited and not built again."""
    for build in scene.stale_builds:
        yield _not_rebuilt(build) if build.built else _not_built(build)


def _not_rebuilt(build: StaleBuild) -> Finding:
    return finding(
        "not-rebuilt",
        f"{build.executable} was edited and not built again",
        f"{build.module} names this topic, and differs from the copy that `ros2 run "
        f"{build.package} {build.executable}` starts.",
        "Run `colcon build` in the workspace, then end the node and start it again.",
    )


def _not_built(build: StaleBuild) -> Finding:
    return finding(
        "not-built",
        f"{build.package} is not built yet",
        f"{build.module} names this topic, and the package {build.package} was never built, so "
        "nothing of it can run.",
        "In the workspace: `colcon build`, then `source install/setup.bash`, then `ros2 run "
        f"{build.package} {build.executable}`.",
    )
