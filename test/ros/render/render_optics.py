#!/usr/bin/python3
"""Lens and sensor by the topics: what is darker, what is veiled, what has one colour a pixel; all at once, and the same
again."""
import math
import unittest

import rospy
import rostest
from pixels import linear, pixel
from rendering import Reader, RefusalTest, RenderNode, Sun, parameters

FOCAL_PX = 48 * 3 ** 0.5  # 96 px across 60 degrees
FIXED = {"mode": "fixed", "ev100": 15.0}


class RenderOptics(RefusalTest):

    def picture(self, name, sun, offset=0.0, **changes):
        source = Sun("/a/sun", *sun)
        reader = Reader(["a"], node="/" + name)
        with RenderNode(name, parameters(conditions=["a"], path={"count": 1, "offset": offset}, exit_when_done=True, subscribers={"images": 1},
                                         exposure=FIXED, **changes)) as node:
            image, = reader.wait("/a/camera/image_raw", 1)
            status, said = node.end()
        self.assertEqual((status, image.encoding), (0, "rgb8"), said)
        reader.close()
        source.publisher.unregister()
        return image

    def test_a_plain_lens_darkens_the_corner_by_the_cosine_to_the_fourth(self):
        sun = (-0.6, 0.0, 0.8)
        off = self.picture("even", sun)
        on = self.picture("darker", sun, vignetting={"natural": "cos4"})
        for x, y in ((0, 71), (95, 71), (48, 71), (48, 60)):
            cosine = 1.0 / math.sqrt(1.0 + ((x - 47.5) ** 2 + (y - 35.5) ** 2) / FOCAL_PX ** 2)
            was, found = pixel(off, x, y)[1], pixel(on, x, y)[1]
            self.assertTrue(0.05 < was < 0.95, was)
            # Half a level each of two pictures, of which one is worth 3 % at the darkest of these.
            self.assertAlmostEqual(found / was, cosine ** 4, delta=0.03, msg=(x, y))

    def test_a_sun_beside_the_picture_veils_it_unless_the_hood_keeps_it_out(self):
        # 36 degrees to the left of the axis, of which the picture shows 30.
        sun = (0.78, 0.57, 0.26)
        off = self.picture("clear", sun)
        on = self.picture("veiled", sun, glare={"share": 0.03, "wings": 0.0})
        kept = self.picture("hooded", sun, glare={"share": 0.03, "wings": 0.0, "hood": 30.0})
        darkest = min(range(0, len(off.data), 3), key=lambda i: off.data[i + 1])
        was, veiled, hooded = (linear(image.data[darkest + 1]) for image in (off, on, kept))
        # By the mean of the picture alone; then by the sun, some 1,000 cd/m² of 39,000 that are white at EV 15.
        self.assertTrue(was < hooded < was + 0.03, (was, hooded))
        self.assertTrue(hooded + 0.015 < veiled < hooded + 0.08, (hooded, veiled))

    def test_all_at_once_are_the_same_again(self):
        everything = {"vignetting": {"natural": "cos4", "a1": -0.1}, "glare": {"share": 0.02}, "blur": {"sigma": 0.5},
                      "noise": {"enabled": True, "seed": 5}, "mosaic": {"pattern": "grbg", "demosaic": "edge_aware"}}
        sun = (0.9, 0.3, 0.316)
        first = self.picture("first", sun, **everything)
        again = self.picture("again", sun, threads=1, **everything)
        self.assertEqual(again.data, first.data)
        for left_out in everything:
            others = {key: value for key, value in everything.items() if key != left_out}
            self.assertNotEqual(self.picture("without_" + left_out, sun, **others).data, first.data, left_out)

    def test_a_second_drive_has_grain_of_its_own(self):
        # A micrometre to the left, so that nothing but the grain differs.
        sun = (0.6, 0.0, 0.8)

        def differing(name, **changes):
            first = self.picture(name + "_first", sun, **changes)
            second = self.picture(name + "_second", sun, offset=1e-6, **changes)
            return sum(a != b for a, b in zip(first.data, second.data)) / len(first.data)

        self.assertLess(differing("clean"), 0.01)
        self.assertGreater(differing("grainy", noise={"enabled": True}), 0.3)

    def test_what_no_lens_has_is_refused_by_its_name(self):
        self.assert_refused(parameters(glare={"share": 0.3}), "/refused/glare/share is 0.3, but must be from 0 to 0.2")
        self.assert_refused(parameters(vignetting={"a1": -1.5}), "/refused/vignetting", "a1 is -1.5, but must be such that")
        self.assert_refused(parameters(mosaic={"pattern": "xtrans"}), "/refused/mosaic/pattern", "none, rggb, bggr, grbg, gbrg")


if __name__ == "__main__":
    rospy.init_node("render_optics")
    rostest.rosrun("sunlit", "render_optics", RenderOptics)
