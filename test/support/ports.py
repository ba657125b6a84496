"""Ports of this machine."""
import socket


def free_port():
    """One that nobody listens at, for a master of a test's own."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]
