"""Another experiment on the master of one that is to be started, which would shut down the nodes of the first: those of both
have the same names."""

import contextlib
import os
import socket
import xmlrpc.client

from sunlit_experiment.launch import NO_ANSWER

NODE = "/experiment"
PATIENCE_S = 3.0
ONLY_TELL = ("--files", "--args", "--nodes", "--find-node", "--dump-params", "--ros-args")  # with which roslaunch starts nothing


def master(words):
    """Of a roslaunch with these words; None where it is only asked something."""
    if any(word.split("=")[0] in ONLY_TELL for word in words):
        return None
    for word, following in zip(words, [*words[1:], ""]):
        if word in ("-p", "--port"):
            return f"http://localhost:{following}"
        for option in ("--port=", "-p"):
            if word.startswith(option):
                return f"http://localhost:{word[len(option):]}"
    return os.environ.get("ROS_MASTER_URI") or "http://localhost:11311"


def is_running(uri):
    """Whether an experiment answers on this master, which may not be there; nor does one answer that was killed."""
    before = socket.getdefaulttimeout()
    socket.setdefaulttimeout(PATIENCE_S)
    try:
        with contextlib.suppress(*NO_ANSWER, xmlrpc.client.Error, TypeError, ValueError):
            success, _, node = xmlrpc.client.ServerProxy(uri).lookupNode(NODE, NODE)
            return success == 1 and xmlrpc.client.ServerProxy(node).getPid(NODE)[0] == 1
        return False
    finally:
        socket.setdefaulttimeout(before)
