#!/usr/bin/python3
"""A node whose master does not tell its parameters ends with an error: it never runs by its defaults instead."""
import os
import subprocess
import sys
import tempfile
import threading
import unittest
import xmlrpc.server

import rosunit

sys.dont_write_bytecode = True
TIMEOUT_S = 60.0
FAILURE, ERROR, SUCCESS = 0, -1, 1  # of the master's API


class SilentMaster(xmlrpc.server.SimpleXMLRPCServer):
    """Takes whatever is registered, and knows no parameter but what stands in the place of those of nodes."""

    def __init__(self, has_param, param=(FAILURE, "out of order", 0)):
        super().__init__(("localhost", 0), logRequests=False, allow_none=True)
        self.has_param, self.param = has_param, param
        self.register_instance(self)

    def _dispatch(self, method, params):
        if method in ("getParam", "hasParam") and params[1] == params[0]:  # a node's own
            return self.has_param if method == "hasParam" else self.param
        if method == "hasParam":
            return SUCCESS, "", False
        if method in ("getParam", "lookupNode"):
            return ERROR, "unknown", 0
        if method == "getPid":
            return SUCCESS, "", os.getpid()
        return SUCCESS, "", []

    def __enter__(self):
        threading.Thread(target=self.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.shutdown()
        self.server_close()


def run(node, master):
    """Exit status and what was said."""
    with tempfile.TemporaryDirectory() as folder:
        environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % master.server_address[1],
                           ROS_HOSTNAME="localhost", ROS_HOME=folder, SUNLIT_CACHE_DIR=folder)
        done = subprocess.run([os.path.join(os.environ["SUNLIT_DEVEL_DIR"], "lib", "sunlit", node)], env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=TIMEOUT_S, check=False)
        return done.returncode, done.stdout.decode()


class ParametersUntold(unittest.TestCase):

    def test_a_node_ends_and_says_why(self):
        for name in ("sun_position", "render", "evaluator"):
            for answer, said in (((FAILURE, "out of order", 0), " does not tell the parameters of /" + name),
                                 ((SUCCESS, "", True), " has parameters of /%s, but does not tell them" % name)):
                with self.subTest(name=name, answer=answer), SilentMaster(answer) as master:
                    status, text = run(name + "_node", master)
                    self.assertEqual(status, 1, text)
                    self.assertIn("the master at http://localhost:%d%s" % (master.server_address[1], said), text)

    def test_a_value_in_the_place_of_all_is_refused(self):
        with SilentMaster((SUCCESS, "", True), (SUCCESS, "", 5)) as master:
            status, text = run("render_node", master)
            self.assertEqual(status, 1, text)
            self.assertIn("/render is 5, but must be a map from names to values", text)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "parameters_untold", ParametersUntold)
