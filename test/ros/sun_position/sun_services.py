#!/usr/bin/python3
"""The four services, by hand and from a program, on three suns at once; topic, TF and service agree."""
import math
import unittest

import rospy
import rostest
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from sun_reading import Latest, TIMEOUT_S, by_hand
from sunlit.msg import SunPosition
from sunlit.srv import GetSunPosition, GetSunTimes, SetDateTime, SetSite
from visualization_msgs.msg import Marker

# The worked example of Reda & Andreas (2008).
GOLDEN = ("{year: 2003, month: 10, day: 17, hour: 12, minute: 30, second: 30, timezone: -7, latitude: 39.742476, "
          "longitude: -105.1786, elevation: 1830.14, pressure: 820, temperature: 11, atmospheric_refraction: 0.5667, "
          "delta_ut1: 0, delta_t: 67, slope: 30, azm_rotation: -10}")
TRACK = dict(latitude=55.792115, longitude=49.122254, elevation=90.0, pressure=1013.25, temperature=0.0)
FIRST_OF_JULY = dict(year=2024, month=7, day=1, minute=0, second=0.0, timezone=3.0)


def service(name, kind):
    rospy.wait_for_service(name, TIMEOUT_S)
    return rospy.ServiceProxy(name, kind)


def vector(direction):
    return (direction.x, direction.y, direction.z)


class SunServices(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.suns = {name: Latest("/%s/sun" % name, SunPosition) for name in ("h04", "h12", "h20")}
        cls.tf = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.tf)
        cls.get_position = service("/h12/sun_position/get_sun_position", GetSunPosition)

    def setUp(self):
        for name, hour in (("h04", 4), ("h12", 12), ("h20", 20)):
            prefix = "/%s/sun_position/" % name
            self.assertTrue(service(prefix + "set_date_time", SetDateTime)(hour=hour, rate=0.0, **FIRST_OF_JULY).success)
            self.assertTrue(service(prefix + "set_site", SetSite)(**TRACK).success)
            self.wait_for_hour(name, hour)

    def asked(self, hour, **changes):
        """The sun of that hour at the track, from the service that changes nothing."""
        request = dict(FIRST_OF_JULY, hour=hour, atmospheric_refraction=0.5667, delta_ut1=0.0, delta_t=69.184,
                       slope=0.0, azm_rotation=0.0, **TRACK)
        request.update(changes)
        answer = self.get_position(**request)
        self.assertTrue(answer.success, answer.message)
        return answer.position

    def wait_for_hour(self, name, hour, **changes):
        expected = vector(self.asked(hour, **changes).direction)
        return self.suns[name].wait(lambda sun: vector(sun.direction) == expected)

    def test_position_by_hand_is_the_worked_example(self):
        answer = by_hand("/h04/sun_position/get_sun_position", GOLDEN)
        self.assertTrue(answer["success"], answer["message"])
        degrees = {key: math.degrees(answer["position"][key]) for key in ("zenith", "azimuth", "hour_angle")}
        # As many digits as the report prints.
        self.assertAlmostEqual(degrees["zenith"], 50.111622, delta=1e-6)
        self.assertAlmostEqual(degrees["azimuth"], 194.340241, delta=1e-6)
        self.assertAlmostEqual(degrees["hour_angle"], 11.10627, delta=1e-5)
        self.assertAlmostEqual(math.degrees(answer["incidence"]), 25.187, delta=1e-6)

    def test_times_by_hand(self):
        answer = by_hand("/h04/sun_position/get_sun_times",
                         "{year: 2003, month: 10, day: 17, timezone: -7, latitude: 39.742476, "
                         "longitude: -105.1786, elevation: 1830.14}")
        self.assertTrue(answer["success"], answer["message"])
        self.assertEqual(answer["sun_state"], "normal")
        # To 1 s: the moment when the centre stands at -0.8333 deg.
        self.assertAlmostEqual(answer["sunset"], 17 + 18 / 60 + 50.5 / 3600, delta=1 / 3600)
        self.assertLess(answer["astronomical_dawn"], answer["nautical_dawn"])
        self.assertLess(answer["nautical_dawn"], answer["civil_dawn"])
        self.assertLess(answer["civil_dawn"], answer["sunrise"])

    def test_times_of_a_polar_night_are_nan(self):
        answer = service("/h04/sun_position/get_sun_times", GetSunTimes)(
            year=2016, month=11, day=6, timezone=-6.0, latitude=74.6973, longitude=-94.8297, elevation=0.0)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.sun_state, "polar_night")
        self.assertTrue(math.isnan(answer.sunrise) and math.isnan(answer.sunset))
        self.assertFalse(math.isnan(answer.transit) or math.isnan(answer.civil_dawn))

    def test_date_by_hand_moves_this_sun_alone(self):
        others = {name: vector(self.suns[name].message.direction) for name in ("h04", "h20")}
        answer = by_hand("/h12/sun_position/set_date_time",
                         "{year: 2024, month: 12, day: 24, hour: 15, minute: 30, second: 0.5, timezone: 3, rate: 0}")
        self.assertTrue(answer["success"], answer["message"])
        self.wait_for_hour("h12", 15, month=12, day=24, minute=30, second=0.5)
        for name, direction in others.items():
            self.assertEqual(vector(self.suns[name].next().direction), direction)

    def test_site_by_hand(self):
        answer = by_hand("/h20/sun_position/set_site",
                         "{latitude: -33.9, longitude: 18.4, elevation: 25, pressure: 1010, temperature: 16.5}")
        self.assertTrue(answer["success"], answer["message"])
        self.wait_for_hour("h20", 20, latitude=-33.9, longitude=18.4, elevation=25.0, pressure=1010.0, temperature=16.5)

    def test_a_node_in_a_namespace_has_its_own_sun(self):
        south = Latest("/south/sun", SunPosition)
        expected = vector(self.asked(12, latitude=-33.9, longitude=18.4).direction)
        south.wait(lambda sun: vector(sun.direction) == expected)
        self.assertGreater(expected[1], 0.0, "at noon the sun stands in the north")
        answer = by_hand("/south/sun_position/set_date_time",
                         "{year: 2024, month: 7, day: 1, hour: 9, minute: 0, second: 0, timezone: 3, rate: 0}")
        self.assertTrue(answer["success"], answer["message"])
        moved = vector(self.asked(9, latitude=-33.9, longitude=18.4).direction)
        south.wait(lambda sun: vector(sun.direction) == moved)

    def test_wrong_values_are_named_and_change_nothing(self):
        nan = ".nan"
        date = dict(year=2024, month=7, day=1, hour=4, minute=0, second=0, timezone=3, rate=0)
        place = dict(latitude=0, longitude=0, elevation=0, pressure=1013, temperature=0)
        golden = dict(date, **place)
        golden.update(atmospheric_refraction=0.5667, delta_ut1=0, delta_t=67, slope=0, azm_rotation=0)
        del golden["rate"]
        day = dict(year=2024, month=7, day=1, timezone=3, latitude=0, longitude=0, elevation=0)
        wrong = [
            ("set_date_time", date, dict(month=2, day=31), "day is 31, but must be from 1 to 29 in month 2 of year 2024"),
            ("set_date_time", date, dict(month=13), "month is 13, but must be from 1 to 12"),
            ("set_date_time", date, dict(year=7000), "year is 7000, but must be from -2000 to 6000"),
            ("set_date_time", date, dict(hour=24), "hour is 24, but must be from 0 to 23 h"),
            ("set_date_time", date, dict(second=60), "second is 60, but must be from 0 to less than 60 s"),
            ("set_date_time", date, dict(second=nan), "second is nan, but must be from 0 to 60 s"),
            ("set_date_time", date, dict(timezone=nan), "timezone is nan, but must be from -18 to 18 h"),
            ("set_date_time", date, dict(rate=".inf"), "rate is inf, but must be from -100000000 to 100000000 s/s"),
            ("set_site", place, dict(latitude=91), "latitude is 91, but must be from -90 to 90 deg"),
            ("set_site", place, dict(longitude=nan), "longitude is nan, but must be from -180 to 180 deg"),
            ("set_site", place, dict(pressure=-5), "pressure is -5, but must be from 0 to 1200 hPa"),
            ("get_sun_position", golden, dict(slope=400), "slope is 400, but must be from -360 to 360 deg"),
            ("get_sun_position", golden, dict(delta_ut1=2), "delta_ut1 is 2, but must be from -1 to 1 s"),
            ("get_sun_times", day, dict(month=0), "month is 0, but must be from 1 to 12"),
            ("get_sun_times", day, dict(latitude=-90.5), "latitude is -90.5, but must be from -90 to 90 deg"),
        ]
        before = vector(self.suns["h12"].message.direction)
        for name, good, changes, message in wrong:
            with self.subTest(service=name, **changes):
                fields = ", ".join("%s: %s" % item for item in dict(good, **changes).items())
                answer = by_hand("/h12/sun_position/" + name, "{%s}" % fields)
                self.assertFalse(answer["success"])
                self.assertEqual(answer["message"], message)
                self.assertEqual(vector(self.suns["h12"].next().direction), before)

    def test_tf_topic_marker_and_service_agree(self):
        marker = Latest("/h20/sun_marker", Marker)
        for name, hour in (("h04", 4), ("h12", 12), ("h20", 20)):
            sun = self.wait_for_hour(name, hour)
            # TF of the very stamp of the topic.
            at = self.tf.lookup_transform("map", name + "/sun", sun.header.stamp, rospy.Duration(TIMEOUT_S)).transform
            for axis in "xyz":
                self.assertAlmostEqual(getattr(at.translation, axis), 100.0 * getattr(sun.direction, axis), delta=1e-9)
            q = at.rotation
            x_axis = (1 - 2 * (q.y ** 2 + q.z ** 2), 2 * (q.x * q.y + q.z * q.w), 2 * (q.x * q.z - q.y * q.w))
            for ours, topic in zip(x_axis, vector(sun.direction)):
                self.assertAlmostEqual(ours, topic, delta=1e-9)
            self.assertEqual(sun.header.frame_id, "map")
            self.assertAlmostEqual(math.asin(sun.direction.z), sun.elevation, delta=1e-9)
            self.assertAlmostEqual(math.atan2(sun.direction.x, sun.direction.y) % (2 * math.pi), sun.azimuth, delta=1e-9)
        self.assertEqual(marker.wait().pose.position.x, 100.0 * self.suns["h20"].message.direction.x)

    def test_diagnostics_tell_each_sun(self):
        for name in self.suns:
            Latest("/diagnostics", DiagnosticArray).wait(
                lambda array: any(status.name.startswith(name + "/sun_position") for status in array.status))


if __name__ == "__main__":
    rospy.init_node("sun_services")
    rostest.rosrun("sunlit", "sun_services", SunServices)
