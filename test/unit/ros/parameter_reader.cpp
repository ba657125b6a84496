#include "sunlit/ros/parameter_reader.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>

#include "sunlit/ros/conditions.h"
#include "support/message_of.h"

namespace sunlit::ros_interface {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue exampleTree() {
  XmlRpcValue tree;
  tree["site"]["latitude"] = 55.79;
  tree["site"]["elevation"] = 90;
  tree["earth"]["delta_t"] = std::string("auto");
  tree["mode"] = std::string("fixed");
  tree["loop"] = true;
  return tree;
}

/// The message of the exception that `call` throws, or an empty one.
TEST(ParameterReader, ReadsValuesAndFallsBackToDefaults) {
  const ParameterReader reader(exampleTree(), "/node");
  EXPECT_EQ(reader.number("site/latitude", 0.0, {-90, 90}), 55.79);
  EXPECT_EQ(reader.number("site/elevation", 0.0), 90.0);  // a whole number is a number
  EXPECT_EQ(reader.number("site/longitude", 49.1), 49.1);
  EXPECT_EQ(reader.choice("mode", "auto", {"auto", "fixed"}), "fixed");
  EXPECT_TRUE(reader.flag("loop", false));
  EXPECT_FALSE(reader.numberOr("earth/delta_t", "auto", 69.0).has_value());
  EXPECT_EQ(reader.numberOr("earth/delta_ut1", "auto", 0.5).value(), 0.5);
  EXPECT_NO_THROW(reader.rejectUnknown());
}

TEST(ParameterReader, TextsBeginInTheHomeFolderWhereTheySaySo) {
  XmlRpcValue tree;
  tree["folder"] = std::string("~/run");
  tree["folders"][0] = std::string("~/models");
  tree["folders"][1] = std::string("/~/models");
  tree["backup"] = std::string("run~");
  const ParameterReader reader(tree, "/node");
  const std::string home = std::getenv("HOME");
  EXPECT_EQ(reader.text("folder", ""), home + "/run");
  EXPECT_EQ(reader.texts("folders", {}), (std::vector<std::string>{home + "/models", "/~/models"}));
  EXPECT_EQ(reader.text("backup", ""), "run~");
}

TEST(ParameterReader, WholeNamesSayWhereRelativeOnesLie) {
  const std::string here = std::filesystem::current_path().string();
  EXPECT_EQ(wholeName("results"), here + "/results");
  EXPECT_EQ(wholeName("./runs/../results"), here + "/results");
  EXPECT_EQ(wholeName("/tmp/results"), "/tmp/results");
  EXPECT_EQ(wholeName("/tmp/link/../results"),
            "/tmp/link/../results");  // what a link leads to lies elsewhere
  EXPECT_EQ(wholeName(""), "");
}

TEST(ParameterReader, NamesKeyValueAndRangeOfABadValue) {
  XmlRpcValue tree = exampleTree();
  tree["site"]["latitude"] = 91.0;
  const ParameterReader reader(tree, "/node");
  EXPECT_EQ(messageOf([&] {
              reader.number("site/latitude", 0.0, {-90, 90});
            }),
            "parameter /node/site/latitude is 91, but must be from -90 to 90");
  EXPECT_EQ(messageOf([&] {
              reader.choice("mode", "auto", {"auto", "manual"});
            }),
            "parameter /node/mode is \"fixed\", but must be one of auto, manual");
  EXPECT_NE(messageOf([&] { reader.integer("mode", 1); }), "");
  EXPECT_NE(messageOf([&] { reader.flag("site/elevation", true); }), "");
}

TEST(ParameterReader, NanAndInfinityAreNeverNumbers) {
  XmlRpcValue tree;
  tree["a"] = std::numeric_limits<double>::quiet_NaN();
  tree["b"] = std::numeric_limits<double>::infinity();
  const ParameterReader reader(tree, "/node");
  EXPECT_THROW(reader.number("a", 0.0), std::invalid_argument);
  EXPECT_THROW(reader.number("b", 0.0), std::invalid_argument);
}

TEST(ParameterReader, AnUnknownKeyIsAnErrorThatListsTheKnownOnes) {
  XmlRpcValue tree = exampleTree();
  tree["site"]["lattitude"] = 1.0;
  const ParameterReader reader(tree, "/node");
  reader.value("earth");
  reader.text("mode", "");
  reader.flag("loop", true);
  reader.number("site/latitude", 0.0);
  reader.number("site/elevation", 0.0);
  EXPECT_EQ(messageOf([&] { reader.rejectUnknown(); }),
            "parameter /node/site/lattitude is unknown (did you mean site/latitude?); known are earth, loop, "
            "mode, site/elevation, "
            "site/latitude");
}

TEST(ParameterReader, AGroupInWhichNothingStandsIsNoUnknownKey) {
  XmlRpcValue tree;
  tree["features"];  // as of `features: {}` and `features:` in a file
  tree["site"]["air"];
  const ParameterReader reader(tree, "/node");
  EXPECT_EQ(reader.integer("features/orb/n_features", 500), 500);
  EXPECT_EQ(reader.number("site/air/pressure", 1013.25), 1013.25);
  EXPECT_NO_THROW(reader.rejectUnknown());
  tree["feature"];
  const ParameterReader wrong(tree, "/node");
  wrong.integer("features/orb/n_features", 500);
  EXPECT_NE(messageOf([&] { wrong.rejectUnknown(); }).find("/node/feature is unknown"), std::string::npos);
}

TEST(ParameterReader, AValueInPlaceOfAGroupIsToldWhichKeysItMayHave) {
  XmlRpcValue tree;
  tree["site"] = std::string("Kazan");
  const ParameterReader reader(tree, "/node");
  reader.number("site/latitude", 0.0);
  reader.number("site/longitude", 0.0);
  EXPECT_EQ(messageOf([&] { reader.rejectUnknown(); }),
            "parameter /node/site is \"Kazan\", but must be a map with keys among latitude, longitude");
}

TEST(ParameterReader, AKeyLikeNoOtherHasNoSuggestion) {
  XmlRpcValue tree;
  tree["colour"] = 1;
  const ParameterReader reader(tree, "/node");
  reader.text("mode", "");
  EXPECT_EQ(messageOf([&] { reader.rejectUnknown(); }), "parameter /node/colour is unknown; known are mode");
}

TEST(ParameterReader, OverridesAreNamedByWholeKeyOrLastPart) {
  XmlRpcValue overrides;
  overrides["latitude"] = 10.0;
  const ParameterReader base(exampleTree(), "/node");
  const ParameterReader reader = base.withOverrides(overrides, "/node/conditions/south");
  EXPECT_EQ(reader.number("site/latitude", 0.0), 10.0);
  EXPECT_EQ(reader.number("site/elevation", 0.0), 90.0);
  EXPECT_EQ(base.number("site/latitude", 0.0), 55.79);
  EXPECT_NO_THROW(reader.rejectUnknown());

  overrides["site"]["latitude"] = 20.0;
  EXPECT_EQ(messageOf([&] {
              base.withOverrides(overrides, "/node/conditions/south").number("site/latitude", 0.0);
            }),
            "parameters /node/conditions/south/site/latitude and /node/conditions/south/latitude are both "
            "given, and "
            "the same");

  XmlRpcValue mistyped;
  mistyped["hours"] = 4;
  const ParameterReader wrong = base.withOverrides(mistyped, "/node/conditions/south");
  wrong.integer("date_time/hour", 12);
  EXPECT_NE(messageOf([&] { wrong.rejectUnknown(); }).find("/node/conditions/south/hours"),
            std::string::npos);
}

TEST(Conditions, AreAListOfNamesOrAMapOrASingleUnnamedOne) {
  XmlRpcValue list;
  list["conditions"][0] = std::string("noon");
  list["conditions"][1] = std::string("dusk");
  const auto named = readConditions(ParameterReader(list, "/node"));
  ASSERT_EQ(named.size(), 2u);
  EXPECT_EQ(named[0].name, "noon");
  EXPECT_EQ(named[1].frame("sun"), "dusk/sun");

  XmlRpcValue map;
  map["conditions"]["h04"]["hour"] = 4;
  map["conditions"]["h12"]["hour"] = 12;
  const auto hours = readConditions(ParameterReader(map, "/node"));
  ASSERT_EQ(hours.size(), 2u);
  EXPECT_EQ(hours[0].parameters.integer("date_time/hour", 0), 4);
  EXPECT_EQ(hours[1].parameters.integer("date_time/hour", 0), 12);

  XmlRpcValue alike;  // from a launch file, which cannot hand on an empty map
  alike["conditions"]["usual"] = std::string();
  alike["date_time"]["hour"] = 7;
  const auto usual = readConditions(ParameterReader(alike, "/node"));
  ASSERT_EQ(usual.size(), 1u);
  EXPECT_EQ(usual[0].parameters.integer("date_time/hour", 0), 7);

  XmlRpcValue text;
  text["conditions"] = std::string("[noon, dusk]");
  const std::string refused = messageOf([&] { readConditions(ParameterReader(text, "/node")); });
  EXPECT_NE(
      refused.find("{h04: {hour: 4}, h12: {hour: 12}}, not a text (as which rosrun passes on _name:=value)"),
      std::string::npos)
      << refused;

  const auto single = readConditions(ParameterReader(exampleTree(), "/node"));
  ASSERT_EQ(single.size(), 1u);
  EXPECT_EQ(single[0].frame("sun"), "sun");
}

// Of a rule that two keys break together, the refusal begins with one of them.
TEST(Conditions, AreNamedWhereValuesContradictEachOther) {
  XmlRpcValue tree;
  tree["weather"]["cover"] = 3;
  tree["conditions"]["noon"]["cover"] = 4;
  tree["conditions"]["whole"]["weather"]["cover"] = 4;
  tree["conditions"]["closed"]["overcast"] = std::string("cie");
  tree["conditions"]["usual"] = std::string();
  const auto refusal = [](const ParameterReader& reader) {
    reader.has("weather/cover");
    return messageOf(
        [&] { reader.check("weather", [] { throw std::invalid_argument("cover is 4, but must be 8"); }); });
  };
  const ParameterReader base(tree, "/node");
  EXPECT_EQ(refusal(base), "parameter /node/weather/cover is 4, but must be 8");
  std::map<std::string, std::string> said;
  for (const Condition& condition : readConditions(base))
    said[condition.name] = refusal(condition.parameters);
  EXPECT_EQ(said["noon"], "parameter /node/conditions/noon/cover is 4, but must be 8");
  EXPECT_EQ(said["whole"], "parameter /node/conditions/whole/weather/cover is 4, but must be 8");
  EXPECT_EQ(said["closed"], "parameter /node/weather/cover, in /node/conditions/closed, is 4, but must be 8");
  EXPECT_EQ(said["usual"], "parameter /node/weather/cover, in /node/conditions/usual, is 4, but must be 8");
}

TEST(Conditions, BadNamesAreRefused) {
  for (const char* name : {"", "4h", "a/b", "a b"}) {
    XmlRpcValue tree;
    tree["conditions"][0] = std::string(name);
    EXPECT_THROW(readConditions(ParameterReader(tree, "/node")), std::invalid_argument) << name;
  }
  XmlRpcValue twice;
  twice["conditions"][0] = std::string("a");
  twice["conditions"][1] = std::string("a");
  EXPECT_THROW(readConditions(ParameterReader(twice, "/node")), std::invalid_argument);
}

}  // namespace
}  // namespace sunlit::ros_interface
