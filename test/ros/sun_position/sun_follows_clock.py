#!/usr/bin/python3
"""Sun, moon and stars follow /clock: at its rate, through a pause and back in time. This test is the clock."""
import time
import unittest

import rospy
import rostest
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import QuaternionStamped
from rosgraph_msgs.msg import Clock
from sun_reading import Latest
from sunlit.msg import MoonPosition, SunPosition
from sunlit.srv import GetMoonPosition, GetSunPosition, SetDateTime, SetSite
from tf2_msgs.msg import TFMessage

START_S = 1000
RATE = 60


def vector(direction):
    return (direction.x, direction.y, direction.z)


class SunFollowsClock(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.clock = rospy.Publisher("/clock", Clock, queue_size=1, latch=True)
        cls.sun = Latest("/sun", SunPosition)
        cls.stamped = []
        cls.stamped_subscriber = rospy.Subscriber("/stamped/sun", SunPosition, cls.stamped.append)
        cls.moon = Latest("/moon", MoonPosition)
        cls.celestial = Latest("/celestial", QuaternionStamped)
        cls.diagnostics = Latest("/diagnostics", DiagnosticArray)
        cls.tf = tf2_ros.Buffer()
        # Not a TransformListener: its waiting needs a clock that runs.
        cls.transforms = Latest("/tf", TFMessage, lambda message: [cls.tf.set_transform(transform, "test")
                                                                   for transform in message.transforms])
        rospy.wait_for_service("/sun_position/get_sun_position")
        cls.get_position = rospy.ServiceProxy("/sun_position/get_sun_position", GetSunPosition)
        cls.get_moon = rospy.ServiceProxy("/sun_position/get_moon_position", GetMoonPosition)
        cls.set_date_time = rospy.ServiceProxy("/sun_position/set_date_time", SetDateTime)

    def direction_at(self, sun_second, get=None):
        """Where the sun stands that many seconds after 4 h, by the service that changes nothing."""
        hour, rest = divmod(4 * 3600 + sun_second, 3600)
        answer = (get or self.get_position)(
            year=2024, month=7, day=1, hour=hour, minute=rest // 60, second=rest % 60, timezone=3.0,
            latitude=55.792115, longitude=49.122254, elevation=90.0, pressure=1013.25, temperature=0.0,
            atmospheric_refraction=0.5667, delta_ut1=0.0, delta_t=float("nan"))
        self.assertTrue(answer.success, answer.message)
        return vector(answer.position.direction)

    def go_to(self, ros_second):
        """Sets /clock, and returns the sun of that moment."""
        now = rospy.Time(ros_second)
        tick = lambda: self.clock.publish(Clock(now))
        tick()
        sun = self.sun.wait(lambda message: message.header.stamp.secs == ros_second, tick)
        self.check_company(sun)
        return sun

    def check_company(self, sun):
        """Moon and stars of the same stamp, and so of the same hour."""
        self.moon.wait(lambda moon: moon.header.stamp == sun.header.stamp)
        self.celestial.wait(lambda celestial: celestial.header.stamp == sun.header.stamp)

    def test_rate_pause_and_jump_back(self):
        # Before any clock the sun stands at its date_time, and says why.
        self.wait_for_warning("no time comes on /clock")
        # One whose date is that of a stamp knows of none yet, whatever it is asked.
        self.wait_for_warning("no sun is published before a time comes on /clock")
        set_site = rospy.ServiceProxy("/stamped/sun_position/set_site", SetSite)
        self.assertTrue(set_site(latitude=55.792115, longitude=49.122254, elevation=90.0, pressure=1013.25,
                                 temperature=0.0).success)
        self.assertEqual(vector(self.sun.wait().direction), self.direction_at(0))
        self.assertEqual(vector(self.go_to(START_S).direction), self.direction_at(0))
        first = self.stamped_sun()
        self.assertEqual(first.header.stamp.secs, START_S)
        self.assertEqual(vector(first.direction), self.direction_at(RATE * (START_S - 900)))
        for ros_second in (START_S + 10, START_S + 300):
            self.assertEqual(vector(self.go_to(ros_second).direction), self.direction_at(RATE * (ros_second - START_S)))

        # Paused: a request is still answered by a new sun at once, on the topic and in TF, although time stands still.
        ros_second = START_S + 300
        answer = self.set_date_time(year=2024, month=7, day=1, hour=5, minute=0, second=0.0, timezone=3.0, rate=RATE)
        self.assertTrue(answer.success, answer.message)
        moved = self.direction_at(3600)
        sun = self.sun.wait(lambda message: vector(message.direction) == moved)
        self.assertEqual(sun.header.stamp.secs, ros_second)
        self.check_company(sun)
        moon = vector(self.moon.message.direction)
        self.assertEqual(moon, self.direction_at(3600, self.get_moon))
        self.transforms.wait(lambda message: {t.header.stamp for t in message.transforms} == {sun.header.stamp})
        for frame, direction in (("sun", moved), ("moon", moon)):
            at = self.tf.lookup_transform("map", frame, sun.header.stamp)
            self.assertAlmostEqual(at.transform.translation.x, 100.0 * direction[0], delta=1e-9)
        at = self.tf.lookup_transform("map", "celestial", sun.header.stamp)
        self.assertEqual(at.transform.rotation, self.celestial.message.quaternion)

        self.transforms.subscriber.unregister()

        # On, and back in time, also to before the start of the sun's clock.
        for later in (ros_second + 20, ros_second + 5, ros_second - 7, ros_second + 40):
            sun = self.go_to(later)
            sun_second = 3600 + RATE * (later - ros_second)
            self.assertEqual(vector(sun.direction), self.direction_at(sun_second))
            self.assertEqual(vector(self.moon.message.direction), self.direction_at(sun_second, self.get_moon))
        self.wait_for_warning("since /clock stands at %d.0" % later)

    def stamped_sun(self):
        """The first of all that it published."""
        deadline = time.monotonic() + 30.0
        while not self.stamped and time.monotonic() < deadline:
            time.sleep(0.01)
        return self.stamped[0]

    def wait_for_warning(self, text):
        self.diagnostics.wait(lambda array: any("sun_position" in status.name and status.level == DiagnosticStatus.WARN
                                                and text in status.message for status in array.status))

    def test_waits_for_its_first_subscriber_where_told_to(self):
        # Later than all of the other test, which runs first, since it needs a time without a clock.
        now = START_S + 5000
        tick = lambda: self.clock.publish(Clock(rospy.Time(now)))
        # Who hears of the moon alone does not start the clock.
        moon = Latest("/patient/moon", MoonPosition)
        still = moon.wait(lambda message: message.header.stamp.secs == now, tick)
        self.assertEqual(vector(still.direction), self.direction_at(0, self.get_moon))
        sun = Latest("/patient/sun", SunPosition)
        self.assertEqual(vector(sun.wait().direction), self.direction_at(0))
        for now, sun_second in ((now + 100, 0), (now + 140, RATE * 40)):
            moved = sun.wait(lambda message: message.header.stamp.secs == now, tick)
            self.assertEqual(vector(moved.direction), self.direction_at(sun_second))


if __name__ == "__main__":
    rospy.init_node("sun_follows_clock")
    rostest.rosrun("sunlit", "sun_follows_clock", SunFollowsClock)
