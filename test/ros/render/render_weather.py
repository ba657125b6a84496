#!/usr/bin/python3
"""Weather by condition, through the topics: its light, its clouds by the stamp, and what is refused."""
import unittest

import numpy
import rospy
import rostest
from rendering import RefusalTest, RenderNode, Reader, Sun, parameters

WEATHERS = {"clear": {}, "grey": {"cover": 8, "overcast": "cie"}, "fog": {"visibility": 60.0},
            "windy": {"cover": 4, "wind": 30.0, "cloud_seed": 3},
            "rainy": {"cover": 8, "overcast": "cie", "rain": 50.0, "wet": 1.0, "puddles": 0.3}, "snowy": {"snow": 0.1}}
BROKEN = {"cover": 4, "cloud_seed": 3}
SOAKED = {"cover": 8, "overcast": "cie", "wet": 1.0, "puddles": 0.5}
# Each beside another that differs in one key. Clouds repeat themselves after 10,240 m, and the first stamp is 1000 s.
DETAILS = {"thin": {"cover": 8, "optical_depth": 3.0}, "thick": {"cover": 8, "optical_depth": 60.0},
           "deep_fog": {"visibility": 60.0, "fog_top": 300.0}, "low_fog": {"visibility": 60.0, "fog_top": 30.0},
           "still": BROKEN, "low": dict(BROKEN, cloud_base=500.0), "other_clouds": dict(BROKEN, cloud_seed=4),
           "round": dict(BROKEN, wind=10.24), "west": dict(BROKEN, wind=5.12, wind_from=270.0),
           "east": dict(BROKEN, wind=5.12, wind_from=90.0), "south": dict(BROKEN, wind=5.12, wind_from=180.0),
           "puddles": SOAKED, "other_puddles": dict(SOAKED, ground_seed=1)}
POSES = 4
SUN_UP = 0.8  # the sine of its elevation, as rendering.Sun has it


def pixels(message):
    return numpy.frombuffer(message.data, numpy.uint8).reshape(message.height, message.width, 3)


def run(name, weathers, resume_at=0, count=POSES):
    """Pictures and illuminances of each weather, pose by pose."""
    poses = count - resume_at
    reader = Reader(list(weathers), node="/" + name)
    suns = [Sun("/%s/sun" % condition) for condition in weathers]
    tree = parameters(conditions=weathers, subscribers={"images": 1}, wait_for=["/reader/progress"], frame_rate=0.1,
                      path={"count": count}, exposure={"mode": "fixed", "ev100": 14.0}, max_ahead=100, resume_at=resume_at)
    with RenderNode(name, tree):
        found = {condition: ([pixels(one) for one in reader.wait("/%s/camera/image_raw" % condition, poses)],
                             [one.scene_illuminance for one in reader.wait("/%s/camera/capture" % condition, poses)])
                 for condition in weathers}
    reader.close()
    del suns
    return found


class RenderWeather(RefusalTest):

    @classmethod
    def setUpClass(cls):
        cls.found = run("weather", WEATHERS)
        cls.found.update(run("weather_details", DETAILS, count=2))

    def lux(self, condition):
        return self.found[condition][1]

    def test_the_standard_overcast_sky_has_its_illuminance(self):
        self.assertAlmostEqual(self.lux("grey")[0], 300.0 + 21000.0 * SUN_UP, delta=0.01 * 17100.0)
        self.assertGreater(self.lux("clear")[0], 4.0 * self.lux("grey")[0])

    def test_what_stands_still_stays_as_it_is(self):
        for condition in ("clear", "grey", "fog"):
            self.assertEqual(len(set(self.lux(condition))), 1, condition)

    def test_fog_dims_the_ground(self):
        # An optical depth of 15: a third to two thirds of the clear hour's light.
        self.assertGreater(self.lux("fog")[0], 0.33 * self.lux("clear")[0])
        self.assertLess(self.lux("fog")[0], 0.67 * self.lux("clear")[0])

    def mean(self, condition):
        """Of the lower half, which is ground for the most part, after the display's curve is undone."""
        lower = self.found[condition][0][0][self.found[condition][0][0].shape[0] // 2:] / 255.0
        return float((lower ** 2.2).mean())

    def test_snow_is_brighter_than_dry_ground(self):
        self.assertGreater(self.mean("snowy"), 1.5 * self.mean("clear"))

    def test_wet_ground_in_rain_looks_otherwise_than_dry_ground(self):
        # Darker where one looks down, brighter where it mirrors the horizon.
        wet, dry = (self.found[condition][0][0].astype(int) for condition in ("rainy", "grey"))
        lower = numpy.abs(wet - dry).max(axis=2)[wet.shape[0] // 2:]
        self.assertGreater(float((lower > 2).mean()), 0.5)

    def test_clouds_move_with_the_stamps(self):
        # 30 m/s and 10 s a pose: 300 m each, of clouds a kilometre wide.
        self.assertEqual(len(set(self.lux("windy"))), POSES)

    def test_the_same_stamps_have_the_same_clouds_wherever_a_run_begins(self):
        again = run("weather_again", {"windy": WEATHERS["windy"]}, resume_at=1)
        for first, second in zip(self.found["windy"][0][1:], again["windy"][0]):
            self.assertTrue(numpy.array_equal(first, second))

    def assert_alike(self, one, other, pose):
        """But for the last bits of where a cloud is, which no level of a picture shows by more than one."""
        self.assertAlmostEqual(self.lux(one)[pose] / self.lux(other)[pose], 1.0, delta=1e-4)
        self.assertLessEqual(self.difference(one, other, pose).max(), 1, (one, other))

    def assert_differs(self, one, other, pose=0):
        self.assertGreater(float((self.difference(one, other, pose) > 2).mean()), 0.02, (one, other))

    def difference(self, one, other, pose=0):
        return numpy.abs(self.found[one][0][pose].astype(int) - self.found[other][0][pose])

    def test_a_thin_cover_lets_more_through(self):
        # Two-stream: 1 / (1 + 0.07 τ) is 0.83 and 0.19, and between ground and cloud a little more.
        self.assertGreater(self.lux("thin")[0], 3.0 * self.lux("thick")[0])
        self.assertLess(self.lux("thin")[0], self.lux("clear")[0])
        self.assert_differs("thin", "thick")

    def test_low_fog_takes_less_light_and_the_same_sight(self):
        # An optical depth of 1.5 instead of 15 above the ground: 0.9 and 0.5 of the light by the same formula.
        self.assertEqual(self.lux("deep_fog"), self.lux("fog")[:2])
        self.assertGreater(self.lux("low_fog")[0], 1.4 * self.lux("deep_fog")[0])
        self.assertLess(self.lux("low_fog")[0], self.lux("clear")[0])
        self.assert_differs("low_fog", "deep_fog")

    def test_clouds_go_where_the_wind_goes(self):
        # Once round the whole map in 1000 s; half of it to the east is half of it to the west, and not to the north.
        self.assert_alike("round", "still", 0)
        self.assert_alike("west", "east", 0)
        for one, other in (("west", "still"), ("west", "south")):
            self.assert_differs(one, other)
        # 51 m the one way and the other are not.
        self.assertNotEqual(self.lux("west")[1], self.lux("east")[1])
        self.assertEqual(len(set(self.lux("still"))), 1)

    def test_clouds_differ_by_their_seed_and_their_height(self):
        self.assert_differs("still", "other_clouds")
        self.assert_differs("still", "low")

    def test_puddles_differ_by_their_seed_and_nothing_else_does(self):
        self.assertEqual(self.lux("puddles"), self.lux("other_puddles"))
        self.assert_differs("puddles", "other_puddles")
        sky = self.difference("puddles", "other_puddles")[:10]
        self.assertEqual(sky.max(), 0)

    def test_weather_that_cannot_be_is_refused(self):
        self.assert_refused(parameters(weather={"cover": 9}), "/refused/weather/cover", "9", "8")
        self.assert_refused(parameters(weather={"overcast": "cie"}), "cover is 0", "8 where overcast is cie")
        self.assert_refused(parameters(weather={"visibility": 90000}, atmosphere={"observer_height": 100}),
                            "/refused/weather/visibility", "90000 m", "that the clear air of this turbidity has")
        self.assert_refused(parameters(conditions={"a": {"visibility": 10}}), "/refused/conditions/a/visibility", "10", "50")
        self.assert_refused(parameters(conditions={"a": {"snow": 2}}), "/refused/conditions/a/snow", "2", "0.5")
        self.assert_refused(parameters(conditions={"a": {"covr": 3}}), "covr", "did you mean cover?")


if __name__ == "__main__":
    rospy.init_node("render_weather")
    rostest.rosrun("sunlit", "render_weather", RenderWeather)
