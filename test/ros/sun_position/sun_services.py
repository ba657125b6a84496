#!/usr/bin/python3
"""The services, by hand and from a program, on three suns at once; topics, TF and services agree."""
import math
import unittest

import rospy
import rostest
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray, KeyValue
from geometry_msgs.msg import QuaternionStamped
from sun_reading import Latest, TIMEOUT_S, by_hand
from sunlit.msg import MoonPosition, SunPosition
from sunlit.srv import GetMoonPosition, GetSunPosition, GetSunTimes, SetDateTime, SetSite
from visualization_msgs.msg import Marker

# The worked example of Reda & Andreas (2008).
GOLDEN = ("{year: 2003, month: 10, day: 17, hour: 12, minute: 30, second: 30, timezone: -7, latitude: 39.742476, "
          "longitude: -105.1786, elevation: 1830.14, pressure: 820, temperature: 11, atmospheric_refraction: 0.5667, "
          "delta_ut1: 0, delta_t: 67, slope: 30, azm_rotation: -10}")
TRACK = dict(latitude=55.792115, longitude=49.122254, elevation=90.0, pressure=1013.25, temperature=0.0)
AU_M = 149597870700.0
FIRST_OF_JULY = dict(year=2024, month=7, day=1, minute=0, second=0.0, timezone=3.0)


def service(name, kind):
    rospy.wait_for_service(name, TIMEOUT_S)
    return rospy.ServiceProxy(name, kind)


def vector(direction):
    return (direction.x, direction.y, direction.z)


def axes(q):
    """Columns of the rotation of a quaternion."""
    x, y, z, w = q.x, q.y, q.z, q.w
    return ((1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
            (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
            (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def on_sphere(longitude, latitude):
    return (math.cos(latitude) * math.cos(longitude), math.cos(latitude) * math.sin(longitude), math.sin(latitude))


class SunServices(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.suns = {name: Latest("/%s/sun" % name, SunPosition) for name in ("h04", "h12", "h20")}
        cls.moons = {name: Latest("/%s/moon" % name, MoonPosition) for name in cls.suns}
        cls.celestials = {name: Latest("/%s/celestial" % name, QuaternionStamped) for name in cls.suns}
        cls.tf = tf2_ros.Buffer()
        cls.listener = tf2_ros.TransformListener(cls.tf)
        cls.get_position = service("/h12/sun_position/get_sun_position", GetSunPosition)
        cls.get_moon = service("/h12/sun_position/get_moon_position", GetMoonPosition)

    def setUp(self):
        for name, hour in (("h04", 4), ("h12", 12), ("h20", 20)):
            prefix = "/%s/sun_position/" % name
            self.assertTrue(service(prefix + "set_date_time", SetDateTime)(hour=hour, rate=0.0, **FIRST_OF_JULY).success)
            self.assertTrue(service(prefix + "set_site", SetSite)(**TRACK).success)
            self.wait_for_hour(name, hour)

    def asked(self, hour, **changes):
        """The sun of that hour at the track, from the service that changes nothing."""
        return self.answer(self.get_position, hour, dict(dict(slope=0.0, azm_rotation=0.0), **changes))

    def asked_moon(self, hour, **changes):
        return self.answer(self.get_moon, hour, changes)

    def answer(self, get, hour, changes):
        request = dict(FIRST_OF_JULY, hour=hour, atmospheric_refraction=0.5667, delta_ut1=0.0, delta_t=69.184, **TRACK)
        request.update(changes)
        answer = get(**request)
        self.assertTrue(answer.success, answer.message)
        return answer.position

    def wait_for_hour(self, name, hour, **changes):
        moon = vector(self.asked_moon(hour, **changes).direction)
        self.moons[name].wait(lambda message: vector(message.direction) == moon)
        expected = vector(self.asked(hour, **changes).direction)
        return self.suns[name].wait(lambda sun: vector(sun.direction) == expected)

    def looked_up(self, frame, stamp):
        return self.tf.lookup_transform("map", frame, stamp, rospy.Duration(TIMEOUT_S)).transform

    def assert_vectors(self, ours, expected, delta):
        for a, b in zip(ours, expected):
            self.assertAlmostEqual(a, b, delta=delta)

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

    def refusal(self, service_name, request, is_by_hand):
        """(success, message) of the sun of noon."""
        name = "/h12/sun_position/" + service_name
        if is_by_hand:
            answer = by_hand(name, "{%s}" % ", ".join("%s: %s" % item for item in request.items()))
            return answer["success"], answer["message"]
        kinds = dict(set_date_time=SetDateTime, set_site=SetSite, get_moon_position=GetMoonPosition, get_sun_position=GetSunPosition,
                     get_sun_times=GetSunTimes)
        answer = service(name, kinds[service_name])(**request)
        return answer.success, answer.message

    def test_wrong_values_are_named_and_change_nothing(self):
        nan = float("nan")
        date = dict(year=2024, month=7, day=1, hour=4, minute=0, second=0, timezone=3, rate=0)
        place = dict(latitude=0, longitude=0, elevation=0, pressure=1013, temperature=0)
        golden = dict(date, **place)
        golden.update(atmospheric_refraction=0.5667, delta_ut1=0, delta_t=67, slope=0, azm_rotation=0)
        del golden["rate"]
        moon = {key: value for key, value in golden.items() if key not in ("slope", "azm_rotation")}
        day = dict(year=2024, month=7, day=1, timezone=3, latitude=0, longitude=0, elevation=0)
        wrong = [
            ("set_date_time", date, dict(month=2, day=31), "day is 31, but must be from 1 to 29 in month 2 of year 2024"),
            ("set_date_time", date, dict(month=13), "month is 13, but must be from 1 to 12"),
            ("set_date_time", date, dict(year=7000), "year is 7000, but must be from -2000 to 6000"),
            ("set_date_time", date, dict(hour=24), "hour is 24, but must be from 0 to 23 h"),
            ("set_date_time", date, dict(second=60), "second is 60, but must be from 0 to less than 60 s"),
            ("set_date_time", date, dict(second=nan), "second is nan, but must be from 0 to less than 60 s"),
            ("set_date_time", date, dict(timezone=nan), "timezone is nan, but must be from -18 to 18 h"),
            ("set_date_time", date, dict(rate=float("inf")), "rate is inf, but must be from -100000000 to 100000000 s/s"),
            ("set_site", place, dict(latitude=91), "latitude is 91, but must be from -90 to 90 deg"),
            ("set_site", place, dict(longitude=nan), "longitude is nan, but must be from -180 to 180 deg"),
            ("set_site", place, dict(pressure=-5), "pressure is -5, but must be from 0 to 1200 hPa"),
            ("get_moon_position", moon, dict(elevation=12001), "elevation is 12001, but must be from -500 to 12000 m"),
            ("get_moon_position", moon, dict(delta_t=200000), "delta_t is 200000, but must be from -100000 to 100000 s"),
            ("get_sun_position", golden, dict(slope=400), "slope is 400, but must be from -360 to 360 deg"),
            ("get_sun_position", golden, dict(delta_ut1=2), "delta_ut1 is 2, but must be from -1 to 1 s"),
            ("get_sun_times", day, dict(month=0), "month is 0, but must be from 1 to 12"),
            ("get_sun_times", day, dict(latitude=-90.5), "latitude is -90.5, but must be from -90 to 90 deg"),
        ]
        before = vector(self.suns["h12"].message.direction)
        typed = set()  # each service once, by hand
        for name, good, changes, message in wrong:
            with self.subTest(service=name, **changes):
                self.assertEqual(self.refusal(name, dict(good, **changes), name not in typed), (False, message))
                typed.add(name)
                self.assertEqual(vector(self.suns["h12"].next().direction), before)

    def test_tf_topic_marker_and_service_agree(self):
        marker = Latest("/h20/sun_marker", Marker)
        for name, hour in (("h04", 4), ("h12", 12), ("h20", 20)):
            sun = self.wait_for_hour(name, hour)
            # TF of the very stamp of the topic.
            at = self.looked_up(name + "/sun", sun.header.stamp)
            self.assert_vectors(vector(at.translation), [100.0 * part for part in vector(sun.direction)], 1e-9)
            self.assert_vectors(axes(at.rotation)[0], vector(sun.direction), 1e-9)
            self.assertEqual(sun.header.frame_id, "map")
            self.assertAlmostEqual(math.asin(sun.direction.z), sun.elevation, delta=1e-9)
            self.assertAlmostEqual(math.atan2(sun.direction.x, sun.direction.y) % (2 * math.pi), sun.azimuth, delta=1e-9)
        self.assertEqual(marker.wait().pose.position.x, 100.0 * self.suns["h20"].message.direction.x)

    def test_moon_topic_tf_marker_and_service_agree(self):
        markers = {name: Latest("/%s/moon_marker" % name, Marker) for name in self.moons}
        for name, hour in (("h04", 4), ("h12", 12), ("h20", 20)):
            sun = self.wait_for_hour(name, hour)
            moon = self.moons[name].next()
            self.assertEqual(moon.header.frame_id, "map")
            at = self.looked_up(name + "/moon", moon.header.stamp)
            self.assert_vectors(vector(at.translation), [100.0 * part for part in vector(moon.direction)], 1e-9)
            self.assert_vectors(axes(at.rotation)[0], vector(moon.direction), 1e-9)
            self.assertAlmostEqual(math.asin(moon.direction.z), moon.elevation, delta=1e-9)
            self.assertAlmostEqual(moon.zenith + moon.elevation, math.pi / 2, delta=1e-12)
            azimuth = math.atan2(moon.direction.x, moon.direction.y)
            self.assertAlmostEqual(math.remainder(azimuth - moon.azimuth, 2 * math.pi), 0.0, delta=1e-9)
            self.assert_vectors(vector(markers[name].wait().pose.position), vector(at.translation), 0.0)
            self.assertAlmostEqual(math.sin(moon.angular_radius) * moon.distance, 1737.4e3, delta=1e-3)

            # The phase from where topics say that sun and moon stand: both without air.
            seen = [on_sphere(math.pi / 2 - body.azimuth, body.elevation_geometric) for body in (sun, moon)]
            elongation, sun_m = math.acos(dot(*seen)), sun.distance_au * AU_M
            phase = math.atan2(sun_m * math.sin(elongation), moon.distance - sun_m * math.cos(elongation))
            # The sun's distance is that from the centre of the Earth: 1/23,000 of it.
            self.assertAlmostEqual(moon.phase_angle, phase, delta=1e-4)
            self.assertAlmostEqual(moon.illuminated_fraction, 0.5 * (1 + math.cos(phase)), delta=1e-4)
        self.assertNotEqual(vector(self.moons["h04"].message.direction), vector(self.moons["h20"].message.direction))

    def test_celestial_topic_and_tf_agree_and_hold_the_sun(self):
        for name, hour in (("h04", 4), ("h12", 12), ("h20", 20)):
            sun = self.wait_for_hour(name, hour)
            celestial = self.celestials[name].next()
            self.assertEqual(celestial.header.frame_id, "map")
            at = self.looked_up(name + "/celestial", celestial.header.stamp)
            self.assertEqual(vector(at.translation), (0.0, 0.0, 0.0))
            self.assertEqual(at.rotation, celestial.quaternion)
            x, y, z = axes(celestial.quaternion)
            # The pole, which precession has moved by 0.14 deg since 2000.
            self.assert_vectors(z, on_sphere(math.pi / 2, math.radians(55.792115)), 0.0025)
            # The sun, whose equinox of date has moved by 0.34 deg since 2000.
            of_date = on_sphere(sun.right_ascension, sun.declination)
            in_map = [dot(row, of_date) for row in zip(x, y, z)]
            self.assert_vectors(in_map, on_sphere(math.pi / 2 - sun.azimuth, sun.elevation_geometric), 0.007)

    def test_the_moon_of_a_full_moon_is_full(self):
        # 21 July 2024, 10:17 UTC; seen about midnight, high in the south Pacific.
        moon = self.asked_moon(13, day=21, minute=17, latitude=-20.0, longitude=-155.0)
        self.assertGreater(moon.illuminated_fraction, 0.995)
        self.assertGreater(moon.elevation, math.radians(60))

    def test_diagnostics_tell_each_sun(self):
        for name in self.suns:
            Latest("/diagnostics", DiagnosticArray).wait(
                lambda array: any(status.name.startswith(name + "/sun_position") for status in array.status))

    def test_diagnostics_tell_of_an_eclipse(self):
        def tells(covered):
            value = KeyValue("sun, fraction that the moon covers", covered)
            Latest("/diagnostics", DiagnosticArray).wait(
                lambda array: any(status.name.startswith("h12/sun_position") and value in status.values for status in array.status))
        prefix = "/h12/sun_position/"
        tells("0.0000")
        # Total at Dallas.
        self.assertTrue(service(prefix + "set_site", SetSite)(**dict(TRACK, latitude=32.78, longitude=-96.8)).success)
        date = dict(FIRST_OF_JULY, month=4, day=8, minute=42, timezone=-5.0)
        self.assertTrue(service(prefix + "set_date_time", SetDateTime)(hour=13, rate=0.0, **date).success)
        tells("1.0000")


if __name__ == "__main__":
    rospy.init_node("sun_services")
    rostest.rosrun("sunlit", "sun_services", SunServices)
