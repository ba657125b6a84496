#!/usr/bin/python3
"""What moves, and what comes late, by the topics: rows that see one after another, smear, and an exposure that depends on
poses that nobody gets."""
import csv
import os
import tempfile

import numpy
import rospy
import rostest
from geometry_msgs.msg import Pose, Quaternion, TransformStamped
from pixels import right_edge
from rendering import BOX_FACE_M, Reader, RefusalTest, RenderNode, Sun, Transforms, parameters, service
from sunlit.srv import RenderView

FIXED = {"mode": "fixed", "ev100": 15.0}
SUN = (-0.6, 0.0, 0.8)
FOCAL_PX = 48 * 3 ** 0.5  # 96 px across 60 degrees
LINE_S = 1e-3
CAMERA_X_M = 5.0


def steepest(image):
    """The largest step of green from pixel to pixel along a row."""
    rows = [image.data[y * image.step + 1:(y + 1) * image.step:3] for y in range(image.height)]
    return max(abs(b - a) for row in rows for a, b in zip(row, row[1:]))


class RenderShutter(RefusalTest):

    def taken(self, name, conditions, count, **changes):
        """Images and captures of each condition, and depths, of a run that ends by itself."""
        names = list(conditions)
        suns = [Sun("/%s/sun" % one, *SUN) for one in names]
        reader = Reader(names, node="/" + name)
        tree = parameters(conditions=conditions, exit_when_done=True, subscribers={"images": 1, "truth": 1}, **changes)
        with RenderNode(name, tree) as node:
            found = {one: [reader.wait("/%s/camera/%s" % (one, topic), count) for topic in ("image_raw", "capture")]
                     for one in names}
            depths = reader.wait("/camera/depth/image_raw", count)
            status, said = node.end()
        self.assertEqual(status, 0, said)
        reader.close()
        for sun in suns:
            sun.publisher.unregister()
        return found, depths

    def test_conditions_differ_in_their_shutter_and_share_the_truth(self):
        # From the side of the path: 4 m/s beside a box, turned by 60 degrees.
        path = {"count": 2, "yaw": 40.0}
        plain, depth = self.taken("plain", {"a": {"cover": 0}}, 2, path=path, exposure=FIXED)
        self.assertEqual({capture.exposure_mode for capture in plain["a"][1]}, {"fixed"})
        several, same_depth = self.taken("several", {"a": {"cover": 0}, "rolls": {"line_delay": 1000.0},
                                                     "smears": {"shutter": {"exposure_time": 300.0}},
                                                     "stands": {"line_delay": 0.0, "exposure_time": "auto"}}, 2,
                                         path=path, exposure=FIXED)
        pictures = {name: [image.data for image in images] for name, (images, _) in several.items()}
        self.assertEqual(pictures["a"], [image.data for image in plain["a"][0]])
        self.assertEqual(pictures["stands"], pictures["a"])  # 0.24 ms at EV 15: not a tenth of a pixel
        self.assertEqual([image.data for image in same_depth], [image.data for image in depth])
        for name in ("rolls", "smears"):
            self.assertNotEqual(pictures[name][0], pictures["a"][0], name)
        self.assertLess(steepest(several["smears"][0][0]), steepest(several["a"][0][0]))
        # Twice the speed smears more, and none at all not.
        fast, _ = self.taken("fast", {"smears": {"exposure_time": 300.0}}, 2, path=dict(path, speed=8.0), exposure=FIXED)
        self.assertNotEqual([image.data for image in fast["smears"][0]], pictures["smears"])
        stands, _ = self.taken("stands", {"smears": {"exposure_time": 300.0}}, 2, path=dict(path, speed=0.0), exposure=FIXED)
        self.assertEqual(stands["smears"][0][0].data, pictures["a"][0])

    def test_a_late_exposure_is_the_same_wherever_a_run_begins(self):
        conditions = {"late": {"adaptation": 0.3, "delay": 1}, "at_once": {"cover": 0}}
        whole, _ = self.taken("whole", conditions, 12, path={"count": 12})
        evs = [capture.ev100 for capture in whole["late"][1]]
        self.assertEqual({capture.exposure_mode for capture in whole["late"][1]}, {"auto"})
        metered = [capture.ev100 for capture in whole["at_once"][1]]
        # By hand, of what each meters.
        ev, expected = metered[0], []
        for i in range(12):
            if i > 0:
                ev += 0.3 * (metered[max(0, i - 1)] - ev)
            expected.append(ev)
        for i, (found, by_hand) in enumerate(zip(evs, expected)):
            self.assertAlmostEqual(found, by_hand, delta=1e-9, msg=i)
        self.assertNotEqual(evs[-1], metered[-1])
        part, _ = self.taken("part", conditions, 4, path={"first": 8, "count": 4})
        with tempfile.TemporaryDirectory() as folder:
            nth, _ = self.taken("nth", conditions, 3, path={"count": 12, "stride": 5}, output_dir=folder)
            with open(os.path.join(folder, "timing.csv")) as file:
                lit = {row["what"]: int(row["count"]) for row in csv.DictReader(file) if row["stage"] == "daylight"}
        # What is skipped is lit where it is metered: from 0 to 10.
        self.assertEqual(lit, {"late": 11, "at_once": 3})
        for found, indices in ((part, range(8, 12)), (nth, (0, 5, 10))):
            for name in conditions:
                self.assertEqual([capture.ev100 for capture in found[name][1]],
                                 [whole[name][1][i].ev100 for i in indices], name)
                self.assertEqual([image.data for image in found[name][0]], [whole[name][0][i].data for i in indices], name)

    def test_a_late_exposure_meters_pose_by_pose_and_hears_meanwhile(self):
        sun = Sun("/a/sun", *SUN)
        reader = Reader(["a"], node="/metering")
        # 112 poses that nobody gets, of a tenth of a second or so each.
        with tempfile.TemporaryDirectory() as folder:
            tree = parameters(conditions={"a": {"adaptation": 0.05}}, path={"first": 150, "count": 1, "spacing": 0.05},
                              camera={"width": 1280, "height": 960, "baseline": 0.2}, output_dir=folder, exit_when_done=True,
                              subscribers={"images": 1})
            with RenderNode("metering", tree) as node:
                line = node.line_with("Waiting for an exposure that lags to meter poses ")
                self.assertIn(" to 149 before pose 150", line)
                answer = service("/metering/render_view", RenderView)(pose=Pose(orientation=Quaternion(w=1.0)), condition="a")
                self.assertTrue(answer.success, answer.message)
                node.process.send_signal(2)
                status, said = node.end()
            with open(os.path.join(folder, "timing.csv")) as file:
                drawn = {row["what"]: int(row["count"]) for row in csv.DictReader(file) if row["stage"] == "geometry"}
        self.assertEqual(status, 0, said)
        self.assertEqual(reader.of("/a/camera/image_raw"), [])
        # Neither what is metered nor a view has a picture of the right camera.
        self.assertEqual(list(drawn), ["pose"])
        self.assertLess(drawn["pose"], 112)
        reader.close()
        sun.publisher.unregister()

    def follow(self, name, before):
        """The picture of a camera CAMERA_X_M east, which TF knows from `before`, metres north of there 20 ms earlier, too."""
        transforms = Transforms()
        sun = Sun("/a/sun", *SUN)
        reader = Reader(["a"], node="/" + name, says_progress=False)
        tree = parameters(conditions={"a": {"line_delay": 1e6 * LINE_S}}, exposure=FIXED, subscribers={"images": 1},
                          publish_tf=False, start_stamp="now")
        tree.pop("path"), tree.pop("start_stamp")
        tree["camera"] = dict(tree["camera"], follow="tf", follow_frame="body", supersampling=4)
        with RenderNode(name, tree) as node:
            node.line_with("Waiting for the TF frame body")
            transforms.wait_for_readers(2)  # the node, and the reader here
            sent = []
            for seconds, north in ((999.98, before), (1000.0, 0.0)):
                message = TransformStamped(child_frame_id="body")
                message.header.frame_id = "map"
                message.header.stamp = rospy.Time.from_sec(seconds)
                message.transform.translation.x, message.transform.translation.y = CAMERA_X_M, north
                message.transform.translation.z = 1.0
                message.transform.rotation.w = 1.0
                sent.append(message)
            transforms.send(*sent)
            image, = reader.wait("/a/camera/image_raw", 1)
            self.assertEqual(image.header.stamp, rospy.Time.from_sec(1000.0))
            node.process.send_signal(2)
        reader.close()
        transforms.close()
        sun.publisher.unregister()
        return image

    def test_a_camera_that_follows_tf_moves_as_tf_says(self):
        stands = self.follow("stands_on_tf", 0.0)
        moves = self.follow("moves_on_tf", 0.4)  # southwards, so that the box goes to the left, by 20 m/s
        rows = numpy.arange(24, 48)  # that the box fills: six bands of four, which is what moves as one here
        found = numpy.array([right_edge(stands, row) - right_edge(moves, row) for row in rows])
        px_a_row = FOCAL_PX * 20.0 * LINE_S / (BOX_FACE_M - CAMERA_X_M)
        off = found - px_a_row * rows
        slope = numpy.polyfit(rows, found, 1)[0]
        print("skew: %.3f px in row %d, %.3f px in row %d; off by %.3f px in the mean, %.3f px at most; %.4f px a row of %.4f" %
              (found[0], rows[0], found[-1], rows[-1], off.mean(), abs(off).max(), slope, px_a_row))
        # A row is at most one and a half from the middle of its band, and each of the two edges is known to an eighth of a pixel,
        # half of what is between samples.
        self.assertLess(abs(off).max(), 1.5 * px_a_row + 2 * 0.125)
        # Bands are even about their middles, and their eighths differ: what is left is that of the box that stands.
        self.assertLess(abs(off.mean()), 0.2)
        # Three standard deviations of the slope through six places that are known so well.
        self.assertAlmostEqual(slope, px_a_row, delta=0.013)

    def test_what_no_shutter_does_is_refused_by_its_name(self):
        self.assert_refused(parameters(shutter={"line_delay": -1.0}), "/refused/shutter/line_delay is -1",
                            "must be from 0 to 1000 us")
        self.assert_refused(parameters(shutter={"exposure_time": "long"}), "/refused/shutter/exposure_time", "auto")
        self.assert_refused(parameters(exposure={"adaptation": 0.0}), "/refused/exposure/adaptation is 0", "from 0.05 to 1")
        self.assert_refused(parameters(conditions={"a": {"glare": {"share": 0.9}}}), "/refused/conditions/a/glare/share is 0.9",
                            "from 0 to 0.2")


if __name__ == "__main__":
    rospy.init_node("render_shutter")
    rostest.rosrun("sunlit", "render_shutter", RenderShutter)
