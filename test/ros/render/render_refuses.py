#!/usr/bin/python3
"""What cannot work ends the node with one clear line, which names file and place, and a status that is not 0."""
import os
import re
import shutil
import tempfile
import unittest

import rospy
import rostest
import yaml
from rendering import PACKAGE, WORLD, RefusalTest, RenderNode, following, parameters

BOX = """<sdf version="1.6"><world name="w"><model name="m"><link name="l"><visual name="v"><geometry>
<mesh><uri>file://%s</uri></mesh></geometry></visual></link></model></world></sdf>"""


class RenderRefuses(RefusalTest):

    def setUp(self):
        self.folder = tempfile.mkdtemp()

    def tearDown(self):
        shutil.rmtree(self.folder)

    def file(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as out:
            out.write(text)
        return path

    def test_parameters(self):
        self.assert_refused(parameters(wrold="x"), "/refused/wrold", "unknown", "did you mean world?")
        self.assert_refused(parameters(camera={"widht": 96}), "/refused/camera/widht", "unknown")
        self.assert_refused(parameters(camera={"width": 8}), "/refused/camera/width", "8", "16")
        self.assert_refused(parameters(exposure={"mode": "bright"}), "/refused/exposure/mode", "bright", "fixed, auto")
        self.assert_refused(parameters(subscribers={"of": ["my recorder"]}), "/refused/subscribers/of", "'my recorder'", "no node's name")
        self.assert_refused(parameters(subscribers={"of": [""]}), "/refused/subscribers/of", "''", "empty")
        self.assert_refused(parameters(wait_for=["/evaluator/my progress"]), "/refused/wait_for", "'/evaluator/my progress'",
                            "no topic's name")
        self.assert_refused(parameters(wait_for=["~progress"]), "/refused/wait_for", "~ stands for this node")
        self.assert_refused(parameters(sun_namespace="my suns"), "/refused/sun_namespace", "no namespace's name")
        self.assert_refused(parameters(path={"file": "", "topic": "a path"}), "/refused/path/topic", "no topic's name")
        self.assert_refused(parameters(conditions={"a": {"cover": 2, "weather": {"cover": 8}}}), "conditions/a/weather/cover",
                            "conditions/a/cover are both given")
        for side in ("left", "right"):
            self.assert_refused(parameters(subscribers={side: 1}), "/refused/subscribers/%s is 1" % side, "there is no right camera")
        self.assert_refused(parameters(subscribers={"images": 2, "of": ["/recorder"]}), "/refused/subscribers/images is 2", "names 1")
        self.assert_refused(parameters(camera={"rasterizer": "mesa"}), "/refused/camera/rasterizer", "mesa",
                            "osmesa, egl, builtin")
        self.assert_refused(parameters(transport={"final_gather": 17}), "/refused/transport/final_gather", "17", "16")
        self.assert_refused(parameters(transport={"final_gather": 2, "enabled": False}), "/refused/transport/final_gather",
                            "/refused/transport/enabled is false")
        self.assert_refused(parameters(start_stamp="soon"), "/refused/start_stamp", "soon", "now")
        self.assert_refused(parameters(publish_clock=True, exact_sky=False), "/refused/exact_sky is false",
                            "/refused/publish_clock is true", "leave exact_sky out")
        self.assert_refused(parameters(conditions=["a", "a"]), "/refused/conditions", "twice")
        self.assert_refused(parameters(conditions={"a": {"turbidity": 3}}), "turbidity", "is unknown", "cloud_base, cloud_seed, compensation, cover")
        self.assert_refused(parameters(path={"file": ""}), "/refused/path/file", "race_track")
        self.assert_refused(parameters(path={"count": 1000}), "path/count", "1000", "20 poses")
        self.assert_refused(parameters(path={"topic": "route"}), "path/file", "path/topic")

    def test_a_file_that_is_missing_is_named_by_where_it_was_looked_for(self):
        here = os.getcwd()
        self.assert_refused(parameters(path={"file": "none.csv"}), here + "/none.csv: cannot open this waypoint file")
        self.assert_refused(parameters(camera={"calibration": "none.yaml"}), here + "/none.yaml: cannot be opened")

    def test_what_only_a_path_can_heed_where_a_frame_is_followed(self):
        for key, value in (("wait_for", ["/reader/progress"]), ("count_skipped", True), ("max_ahead", 3), ("resume_at", 5),
                           ("exit_when_done", True), ("start_stamp", 1000.0), ("look_ahead", False), ("path/count", 3)):
            tree = following()
            place = tree.setdefault("path", {}) if key.startswith("path/") else tree
            place[key.rpartition("/")[2]] = value
            self.assert_refused(tree, "/refused/" + key + " is given", "/refused/camera/follow is tf")
        self.assert_refused(parameters(camera={"follow": "tf"}), "/refused/path/file is given")

    def test_every_parameter_is_explained_in_the_shipped_file(self):
        def keys(tree, prefix=""):
            for key, value in tree.items():
                yield from keys(value, prefix + key + "/") if isinstance(value, dict) else [prefix + key]

        with open(os.path.join(PACKAGE, "config", "render.yaml")) as file:
            shipped = yaml.safe_load(file)
        with RenderNode("refused", dict(shipped, unknown_key=1)) as node:  # all but that one are accepted
            _, lines = node.end()
        fatal = [line for line in lines if "FATAL" in line][0]
        self.assertIn("/refused/unknown_key is unknown", fatal)
        known = re.search("known are ([a-z0-9_/, ]*)", fatal).group(1).split(", ")
        in_comments = {"conditions", "camera/rasterizer", "exact_sky", "camera/width", "camera/height", "camera/horizontal_fov"}
        self.assertEqual(sorted(set(known) - in_comments), sorted(keys(shipped)))

    def test_worlds(self):
        missing = os.path.join(self.folder, "missing.world")
        self.assert_refused(parameters(world=missing), "there is no world " + missing)
        self.assert_refused(parameters(world=missing, path={"file": ""}), "there is no world " + missing)
        self.assert_refused(parameters(world=WORLD, missing="ignore"), "/refused/missing", "ignore", "stop, warn")
        self.assert_refused(parameters(world=self.file("world.txt", "")), "world.txt")

    def test_worlds_of_sdf(self):
        broken = self.file("broken.world", "<sdf version='1.6'>\n<world name='w'>\n<model>\n</sdf>")
        said = self.assert_refused(parameters(world=broken), broken)
        if "this build of sunlit reads no SDF" in said:
            self.skipTest(said)
        mesh = self.file("broken.dae", "<COLLADA>\n<library")
        self.assert_refused(parameters(world=self.file("mesh.world", BOX % mesh)), "broken.dae")
        absent = os.path.join(self.folder, "absent.dae")
        self.assert_refused(parameters(world=self.file("absent.world", BOX % absent)), "absent.dae")

    def test_waypoints(self):
        for text, place in (("0,0,0\nnan,1,0\n", ":2"), ("0,0,0\n", "two"), ("0,0,0\n1,0,0\n1,0,0\n", ":3"),
                            ("0,0,0\n1,O,0\n", ":2")):
            waypoints = self.file("waypoints.csv", text)
            self.assert_refused(parameters(path={"file": waypoints}), waypoints, place)

    def test_output(self):
        below_a_file = os.path.join(self.file("a_file", ""), "output")
        self.assert_refused(parameters(output_dir=below_a_file), below_a_file)


if __name__ == "__main__":
    rospy.init_node("render_refuses")
    rostest.rosrun("sunlit", "render_refuses", RenderRefuses)
