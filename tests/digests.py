"""Digests of observations: equal runs have equal ones."""

from hashlib import sha256

from rosbeat.records_json import to_json


def digest(observation):
    """Return the SHA-256 of an observation, in hexadecimal."""
    return sha256(to_json(observation).encode("utf-8", "surrogatepass")).hexdigest()
