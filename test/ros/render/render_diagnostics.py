#!/usr/bin/python3
"""What /diagnostics is told of a render node, while it waits, after pictures, and where it cannot go on."""
import itertools
import os
import re
import tempfile
import threading
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from rendering import SUPPORT, TIMEOUT_S, Process, Reader, RefusalTest, RenderNode, Sky, Transforms, following, parameters, service
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Trigger
from sunlit.msg import SunPosition


EARLY = "ROS time to reach %s, the stamp of pose %d"


class Diagnostics:
    """Every status that a node told, in turn."""

    def __init__(self, node):
        self.node = node
        self.changed = threading.Condition()
        self.told = []  # (stamp, status, its values)
        self.subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self._keep, queue_size=None)

    def _keep(self, array):
        with self.changed:
            self.told += [(array.header.stamp, status, {v.key: v.value for v in status.values})
                          for status in array.status if status.name.startswith(self.node + ": ")]
            self.changed.notify_all()

    def of(self, part, level, **expected):
        """All of this part and level whose values are as expected."""
        with self.changed:
            return [t for t in self.told if t[1].name == self.node + ": " + part and t[1].level == level
                    and all(t[2].get(key.replace("_", " ")) == value for key, value in expected.items())]

    def wait(self, part, level, count=1, **expected):
        """The first `count` of them."""
        with self.changed:
            if not self.changed.wait_for(lambda: len(self.of(part, level, **expected)) >= count, TIMEOUT_S):
                raise AssertionError("%s, %s: never told, but %s" % (part, expected, self.told[-2:]))
            return self.of(part, level, **expected)[:count]

    def close(self):
        self.subscriber.unregister()


def clock_owner(**changes):
    """A camera that owns time, which stands still while it waits."""
    return parameters(**dict(dict(conditions=["a"], publish_clock=True, diagnostic_period=0.05,
                                  subscribers={"images": 1}), **changes))


def sun_by_the_clock(name="suns"):
    """A sun for each time on /clock."""
    return Process(name, {"conditions": ["a"], "date_time": {"rate": 0.0}}, "sun_position_node")


def wait_until(reached):
    end = time.monotonic() + TIMEOUT_S
    while not reached():
        if time.monotonic() > end:
            raise AssertionError("it does not come")
        time.sleep(0.01)


class RenderDiagnostics(RefusalTest):

    def enter(self, context):
        """As enterContext(), which is in Python 3.11 and newer."""
        context.__enter__()
        self.addCleanup(context.__exit__, None, None, None)

    def setUp(self):
        rospy.set_param("/use_sim_time", True)  # a renderer that was the clock takes this back as it ends

    def test_a_wait_is_told_by_the_wall_clock_and_progress_after_pictures(self):
        diagnostics = Diagnostics("watched")
        reader = Reader(["a"], node="/watched")
        with tempfile.TemporaryDirectory() as folder:
            tree = clock_owner(wait_for=["/reader/progress"], max_ahead=3, output_dir=folder,
                               transport={"cache_dir": os.path.join(folder, "bakes")})
            with RenderNode("watched", tree):
                waits = diagnostics.wait("run", DiagnosticStatus.WARN, count=3, waits_for="a sun on /a/sun")
                self.assertEqual(len({stamp for stamp, _, _ in waits}), 1)  # ROS time stood still
                self.assertEqual(waits[0][1].message, "waits for a sun on /a/sun")
                self.assertEqual((waits[0][2]["poses done"], waits[0][2]["poses to do"]), ("0", "20"))
                diagnostics.wait("a/camera", DiagnosticStatus.OK, images="0", images_a_second="0.00")

                self.enter(sun_by_the_clock())
                reader.done(2)
                _, status, run = diagnostics.wait("run", DiagnosticStatus.WARN, poses_done="5")[0]
                self.assertEqual(status.message, "waits for progress on /reader/progress, which stands at 2")
                self.assertEqual((run["poses to do"], run["poses ahead of the slowest reader"]), ("15", "3"))
                self.assertEqual(run["robot"], "none")
                with open(os.path.join(folder, "rasterizer.yaml")) as file:
                    self.assertEqual(file.read(), "rasterizer: '%s'\n" % run["rasterizer"])
                with open(os.path.join(folder, "ground.yaml")) as file:
                    self.assertRegex(file.read(), r"^ground_albedo: 0\.\d+\n$")
                bakes = os.path.join(folder, "bakes")
                self.assertEqual(run["cache of bakes"], bakes)
                size = sum(entry.stat().st_size for entry in os.scandir(bakes) if entry.name.endswith(".light"))
                self.assertGreater(size, 0)
                self.assertEqual(run["size of the cache"], "%.1f of 6000.0 MB" % (size / 1e6))

                newest = reader.wait("/a/camera/capture", 5)[4]
                camera = diagnostics.wait("a/camera", DiagnosticStatus.OK, images="5")[0][2]
                self.assertEqual(camera["EV100 of the newest"], "%.3f" % newest.ev100)
                self.assertEqual(newest.exposure_mode, "auto")
                self.assertEqual(camera["age of the newest by ROS time, s"], "0.000")
                rates = [float(values.get("images a second", 0)) for _, _, values in diagnostics.told]
                self.assertGreater(max(rates), 0.0)

                reader.done(20)
                done = diagnostics.wait("run", DiagnosticStatus.OK, activity="done")[0][2]
                self.assertEqual((done["poses done"], done["poses to do"], done["waits for"]), ("20", "0", "nothing"))
        reader.close()
        diagnostics.close()

    def test_a_sky_that_went_on_without_the_pose_is_an_error(self):
        diagnostics = Diagnostics("stuck")
        reader = Reader(["a"], node="/stuck")
        sky = Sky("/a/")
        ended = threading.Event()

        def go_on():
            stamp = 2000.0
            while not ended.wait(0.1):  # as a sun does; what the node says holds the newest
                sky.send_sun(stamp, rate=1.0)
                stamp += 0.1
        sun = threading.Thread(target=go_on)
        sun.start()
        self.addCleanup(sun.join)
        self.addCleanup(ended.set)
        with RenderNode("stuck", clock_owner()):
            status = diagnostics.wait("run", DiagnosticStatus.ERROR, poses_done="0")[0][1]
            self.assertTrue(status.message.startswith("cannot go on without the sky of 1000.000000000 on /a/sun"), status)
        ended.set()
        sun.join()
        for publisher in sky.publishers:
            publisher.unregister()
        reader.close()
        diagnostics.close()

    def test_two_nodes_that_send_one_sky_are_a_warning_while_both_are_there(self):
        clock, diagnostics = rospy.Publisher("/clock", Clock, queue_size=1, latch=True), Diagnostics("mixed")
        times = itertools.count(1)

        def is_told():
            clock.publish(Clock(rospy.Time(next(times))))  # and both send a sun
            return diagnostics.of("a/camera", DiagnosticStatus.WARN, topics_of_several_senders="/a/sun")

        with sun_by_the_clock(), RenderNode("mixed", parameters(conditions=["a"], start_stamp=1e6, diagnostic_period=0.05)) as node:
            with sun_by_the_clock("left_over"):
                wait_until(is_told)
                self.assertEqual(is_told()[0][1].message, "several nodes send /a/sun")
                said = node.line_with("in turn")
                for part in ("/suns", "/left_over", "a sun on /a/sun"):
                    self.assertIn(part, said)
            diagnostics.close()
            diagnostics = Diagnostics("mixed")
            diagnostics.wait("a/camera", DiagnosticStatus.OK, topics_of_several_senders="none")
        clock.unregister()
        diagnostics.close()

    def test_a_pose_whose_time_does_not_come_is_told_of(self):
        clock, sky, diagnostics = rospy.Publisher("/clock", Clock, queue_size=1, latch=True), Sky("/a/"), Diagnostics("early")
        reader = Reader(["a"], node="/early")
        clock.publish(Clock(rospy.Time(5)))
        sky.send_sun(5.0)
        with RenderNode("early", parameters(conditions=["a"], diagnostic_period=0.05, path={"count": 3}, subscribers={"images": 1},
                                            autostart=False)) as node:
            diagnostics.wait("run", DiagnosticStatus.WARN, waits_for="the service /early/start")
            service("/early/start", Trigger)()
            diagnostics.wait("run", DiagnosticStatus.OK, activity="rendering")
            status = diagnostics.wait("run", DiagnosticStatus.WARN, poses_done="0", waits_for=EARLY % ("1000.000000000", 0))[0][1]
            self.assertTrue(status.message.startswith("waits for ROS time to reach 1000"), status)
            clock.publish(Clock(rospy.Time(1000)))  # where it stops
            diagnostics.wait("run", DiagnosticStatus.OK, poses_done="1", waits_for="nothing")
            diagnostics.wait("run", DiagnosticStatus.WARN, poses_done="1", waits_for=EARLY % ("1000.125000000", 1))
            clock.publish(Clock(rospy.Time(5)))  # as a simulation that is reset
            self.assertIn("set back from 1000.000000000 to 5.000000000: start_stamp stands", node.line_with("The clock was"))
            diagnostics.wait("run", DiagnosticStatus.ERROR, poses_done="1", waits_for=EARLY % ("1000.125000000", 1))
            clock.publish(Clock(rospy.Time.from_sec(1000.125)))
            diagnostics.wait("run", DiagnosticStatus.WARN, poses_done="2", waits_for=EARLY % ("1000.250000000", 2))
            clock.publish(Clock(rospy.Time(1001)))
            reader.wait("/a/camera/image_raw", 3)
        for publisher in sky.publishers + [clock]:
            publisher.unregister()
        reader.close()
        diagnostics.close()

    def test_a_picture_between_two_suns_that_are_far_apart_is_warned_of(self):
        clock, sky = rospy.Publisher("/clock", Clock, queue_size=1, latch=True), Sky("/a/")
        clock.publish(Clock(rospy.Time(1000)))
        with RenderNode("fast", parameters(conditions=["a"], path={"count": 1})) as node:
            wait_until(lambda: sky.publishers[0].get_num_connections() == 1)
            for step in range(10):
                sky.send_sun(999.55 + 0.1 * step, rate=86400.0)
                time.sleep(0.1)  # its queue holds one
            found = re.search(r"every (\S+) s, in which its clock goes on by (\d+) s", node.line_with("never stood there"))
            self.assertEqual(int(found.group(2)), round(86400.0 * float(found.group(1))))
        for publisher in sky.publishers + [clock]:
            publisher.unregister()

    def test_a_camera_on_a_path_that_began_now_goes_on_when_time_begins_anew(self):
        clock, sky = rospy.Publisher("/clock", Clock, queue_size=1, latch=True), Sky("/a/")
        tree = parameters(conditions=["a"], start_stamp="now", path={"count": 4}, subscribers={"images": 1})

        def moment(now):
            clock.publish(Clock(rospy.Time.from_sec(now)))
            wait_until(lambda: rospy.Time.now() == rospy.Time.from_sec(now))
            sky.send_sun(now, rate=1.0)

        moment(100.0)
        with RenderNode("loop", tree) as node:
            reader = Reader(["a"], node="/loop")
            reader.wait("/a/camera/image_raw", 1)
            moment(100.125)
            reader.wait("/a/camera/image_raw", 2)
            clock.publish(Clock(rospy.Time.from_sec(7.0)))  # the sun is still that of before
            self.assertIn("set back from 100.125000000 to 7.000000000: start_stamp is now", node.line_with("The clock was"))
            for step in range(200):
                moment(7.125 + 0.125 * step)
                if len(reader.of("/a/camera/image_raw")) == 4:
                    break
                time.sleep(0.1)
            stamps = [image.header.stamp.to_sec() for image in reader.wait("/a/camera/image_raw", 4)]
            self.assertEqual(stamps[:2], [100.0, 100.125])
            self.assertLess(stamps[2], 50.0)
            self.assertEqual(stamps[3], stamps[2] + 0.125)
            poses = [capture.pose_index for capture in reader.wait("/a/camera/capture", 4)]
            self.assertEqual(poses, [0, 1, 2, 3])
            path = reader.of("/path")[-1]
            self.assertEqual(path.poses[2].header.stamp.to_sec(), stamps[2])
        for publisher in sky.publishers + [clock]:
            publisher.unregister()
        reader.close()

    def test_a_path_whose_first_pose_cannot_be_now_says_when_it_comes(self):
        clock, sky = rospy.Publisher("/clock", Clock, queue_size=1, latch=True), Sky("/a/")
        clock.publish(Clock(rospy.Time.from_sec(0.5)))
        sky.send_sun(0.5)
        tree = parameters(conditions=["a"], start_stamp="now", path={"first": 16, "count": 1}, subscribers={"images": 1})
        with RenderNode("young", tree) as node:
            reader = Reader(["a"], node="/young")
            self.assertIn("is now, 0.500000000, but", node.line_with("pose 16 comes at 2.000000001 at the earliest"))
            clock.publish(Clock(rospy.Time(3)))
            self.assertEqual(reader.wait("/a/camera/image_raw", 1)[0].header.stamp, rospy.Time(2, 1))
        for publisher in sky.publishers + [clock]:
            publisher.unregister()
        reader.close()

    def test_a_camera_that_follows_goes_on_when_time_begins_anew(self):
        clock = rospy.Publisher("/clock", Clock, queue_size=1, latch=True)
        sky, sender = Sky("/a/"), Transforms()
        tree = following(conditions=["a"], frame_rate=10.0, camera={"follow_frame": "robot"},
                         subscribers={"images": 1}, shutter={"line_delay": 10.0})

        def moment(now, suns=()):
            clock.publish(Clock(rospy.Time.from_sec(now)))
            wait_until(lambda: rospy.Time.now() == rospy.Time.from_sec(now))
            for stamp in suns or [now]:
                sky.send_sun(stamp, rate=1.0)
            transform = TransformStamped()
            transform.header.frame_id, transform.child_frame_id = "map", "robot"
            transform.header.stamp = rospy.Time.from_sec(now)
            transform.transform.translation.z = transform.transform.rotation.w = 1.0
            sender.send(transform)

        clock.publish(Clock(rospy.Time.from_sec(0.005)))
        with RenderNode("again", tree) as node:
            reader = Reader(["a"], node="/again")
            sender.wait_for_readers(2)  # the node, and the reader here
            moment(0.01)  # sooner after the beginning than a motion takes to be seen
            reader.wait("/a/camera/image_raw", 1)
            moment(100.0, suns=[99.0])  # its sky does not come any more
            node.line_with("Waiting for the sky of 100")
            for now in range(1, 50):  # what comes before the clock itself is lost
                moment(now)
                if len(reader.of("/a/camera/image_raw")) > 1:
                    break
                time.sleep(0.1)
            first, second = [image.header.stamp.to_sec() for image in reader.wait("/a/camera/image_raw", 2)]
            self.assertEqual(first, 0.01)
            self.assertIn(second, range(1, 50))
        for publisher in sky.publishers + [clock]:
            publisher.unregister()
        sender.close()
        reader.close()

    def test_what_is_refused_or_guessed_is_a_warning_until_all_is_well_again(self):
        diagnostics = Diagnostics("guesses")
        reader = Reader(["a"], node="/guesses")
        publisher = rospy.Publisher("/a/sun", SunPosition, queue_size=1, latch=True)
        bad = SunPosition(distance_au=1.0)
        bad.header.frame_id, bad.direction.z = "odom", 1.0
        publisher.publish(bad)
        robot = {"file": os.path.join(SUPPORT, "pole.urdf"), "joints": "tf", "tf_patience": 0.01}
        with RenderNode("guesses", clock_owner(robot=robot, path={"count": 2})):
            status = diagnostics.wait("a/camera", DiagnosticStatus.WARN, messages_of_its_sky_refused="1")[0][1]
            self.assertEqual(status.message, "messages of its sky refused: 1")
            self.enter(sun_by_the_clock())
            diagnostics.wait("a/camera", DiagnosticStatus.OK, images="2", messages_of_its_sky_refused="1")
            status = diagnostics.wait("run", DiagnosticStatus.WARN, activity="done")[0][1]
            self.assertIn("in rest position for want of a transform on TF", status.message)
            self.assertIn("in 2 of 2 poses", status.message)
        publisher.unregister()
        reader.close()
        diagnostics.close()

    def test_a_period_out_of_range_is_refused(self):
        self.assert_refused(clock_owner(diagnostic_period=0), "diagnostic_period is 0", "0.01 to 3600 s")


if __name__ == "__main__":
    rospy.init_node("render_diagnostics")
    rostest.rosrun("sunlit", "render_diagnostics", RenderDiagnostics)
