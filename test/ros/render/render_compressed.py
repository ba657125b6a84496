#!/usr/bin/python3
"""Pictures in PNG are those of raw images, to the byte."""
import unittest

import cv2
import numpy
import rospy
import rostest
from rendering import Reader, RenderNode, Sun, parameters


class RenderCompressed(unittest.TestCase):

    def images(self, name, **changes):
        compressed = changes.get("compressed", False)
        sun = Sun("/a/sun")
        reader = Reader(["a"], node="/" + name, compressed=compressed)
        tree = parameters(conditions=["a"], path={"count": 3}, exit_when_done=True, subscribers={"images": 1, "others": 1},
                          noise={"enabled": True}, **changes)
        topic = "/a/camera/image_raw" + ("/compressed" if compressed else "")
        with RenderNode(name, tree) as node:
            images = reader.wait(topic, 3)
            infos = reader.wait("/a/camera/camera_info", 3)
            published = {topic for topic, _ in rospy.get_published_topics("/a")}
            status, said = node.end()
        self.assertEqual(status, 0, said)
        self.assertIn(topic, published)
        self.assertNotEqual("/a/camera/image_raw" in published, compressed)
        reader.close()
        sun.publisher.unregister()
        return images, infos

    def test_png_has_the_very_bytes_of_raw_images(self):
        raw, raw_infos = self.images("raw")
        packed, packed_infos = self.images("packed", compressed=True)
        self.assertEqual(packed_infos, raw_infos)
        for png, image in zip(packed, raw):
            self.assertEqual((png.header, png.format), (image.header, "rgb8; png compressed bgr8"))
            self.assertEqual(png.data[:8], b"\x89PNG\r\n\x1a\n")
            decoded = cv2.imdecode(numpy.frombuffer(png.data, numpy.uint8), cv2.IMREAD_UNCHANGED)
            self.assertEqual(cv2.cvtColor(decoded, cv2.COLOR_BGR2RGB).tobytes(), image.data)


if __name__ == "__main__":
    rospy.init_node("render_compressed")
    rostest.rosrun("sunlit", "render_compressed", RenderCompressed)
