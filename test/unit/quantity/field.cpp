#include "sunlit/quantity/field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/message_of.h"

namespace sunlit {
namespace {

enum class Mode { kFixed, kAuto };

struct Options {
  double hazy = 2.0;
  Angle latitude;
  int rays = 3;
  std::size_t poses = 0;
  bool enabled = true;
  std::string file;
  std::vector<std::string> folders;
  Mode mode = Mode::kAuto;
  std::optional<double> start;
  std::int64_t stride = 1;
  std::vector<std::string> colours = {"red", "blue"};
};

Choices someOf(std::vector<std::string>* colours) {
  return {{"red", "green", "blue"},
          [colours] { return *colours; },
          [colours](const std::vector<std::string>& some) { *colours = some; }};
}

std::vector<Field> fieldsOf(Options& options) {
  return {{"hazy", &options.hazy, "m", {1, 10}, "haze"},
          {"latitude", &options.latitude, "deg", {-90, 90}, "north"},
          {"rays", &options.rays, "", {1, 64}, "of light"},
          {"poses", &options.poses, "", Range::atLeast(0), "expected"},
          {"enabled", &options.enabled, "", {}, "or not"},
          {"file", &options.file, "", {}, "to read"},
          {"folders", &options.folders, "", {}, "to look in"},
          {"mode", choiceOf(&options.mode, {"fixed", "auto"}), "", {}, "how"},
          {"start", NumberOrWord{&options.start, "now"}, "s", Range::above(0, 4e9), "first stamp"},
          {"stride", &options.stride, "", {1, 1e9}, "every n-th"},
          {"colours", someOf(&options.colours), "", {}, "to look at"},
          {"pairs", OwnForm{"[]"}, "", {}, "of streams"}};
}

const double kNan = std::numeric_limits<double>::quiet_NaN();

/// A text comes as std::string: GCC before 10 takes one in quotes for true.
std::string refusalOf(const std::string& key, const Field::Value& value) {
  Options options;
  return messageOf([&] { fieldOf(fieldsOf(options), key).set(value, key); });
}

TEST(Field, TakesNumbersWithAnExponentThatYamlTakesForTexts) {
  Options options;
  const std::vector<Field> rows = fieldsOf(options);
  fieldOf(rows, "hazy").set(std::string("1e1"), "hazy");
  EXPECT_EQ(options.hazy, 10.0);
  fieldOf(rows, "rays").set(std::string("1.6E1"), "rays");
  EXPECT_EQ(options.rays, 16);
  fieldOf(rows, "start").set(std::string("+5e-1"), "start");
  EXPECT_EQ(options.start, 0.5);
  EXPECT_EQ(refusalOf("hazy", std::string("1e2")), "hazy is 100, but must be from 1 to 10 m");
  for (const char* text : {"5", "e1", "1e", "1e1m", "1e999", "0x1e1", " 1e1", ""}) {
    EXPECT_EQ(refusalOf("hazy", std::string(text)),
              "hazy is \"" + std::string(text) + "\", but must be a number from 1 to 10 m");
  }
}

TEST(Range, SaysWhatItHoldsInWordsAndSymbols) {
  EXPECT_EQ((Range{1, 10}.words()), "from 1 to 10");
  EXPECT_EQ((Range{1, 10}.symbols()), "1 … 10");
  EXPECT_EQ(Range::below(0, 60).words(), "from 0 to less than 60");
  EXPECT_EQ(Range::below(0, 60).symbols(), "0 … < 60");
  EXPECT_EQ(Range::above(0, 1e6).words(), "above 0 and up to 1000000");
  EXPECT_EQ(Range::above(0).symbols(), "> 0");
  EXPECT_EQ(Range::atLeast(0).words(), "at least 0");
  EXPECT_EQ(Range{}.words(), "a finite number");
}

TEST(Range, HoldsItsEndsUnlessToldOtherwiseAndNeverNan) {
  EXPECT_TRUE((Range{1, 10}.contains(1)));
  EXPECT_TRUE((Range{1, 10}.contains(10)));
  EXPECT_FALSE(Range::below(0, 60).contains(60));
  EXPECT_FALSE(Range::above(0).contains(0));
  EXPECT_FALSE(Range{}.contains(kNan));
  EXPECT_FALSE(Range{}.contains(std::numeric_limits<double>::infinity()));
}

TEST(Field, OfSeveralWordsTakesEachOnce) {
  Options options;
  const Field colours = fieldOf(fieldsOf(options), "colours");
  EXPECT_EQ(colours.text(), "[red, blue]");
  EXPECT_EQ(colours.symbols(), "red, green, blue");
  colours.set(std::vector<std::string>{"green"}, "colours");
  EXPECT_EQ(options.colours, std::vector<std::string>{"green"});
  const std::string allowed = ", but must be a list of some of red, green, blue, each once";
  EXPECT_EQ(refusalOf("colours", std::vector<std::string>{"pink"}), "colours is [pink]" + allowed);
  EXPECT_EQ(refusalOf("colours", std::vector<std::string>{"red", "red"}), "colours is [red, red]" + allowed);
  EXPECT_EQ(refusalOf("colours", std::vector<std::string>{}), "colours is []" + allowed);
  EXPECT_EQ(refusalOf("colours", std::string("red")), "colours is \"red\"" + allowed);
  colours.setText("blue,red", "--colours");
  EXPECT_EQ(options.colours, (std::vector<std::string>{"blue", "red"}));
  colours.setText(" red , green ", "--colours");
  EXPECT_EQ(options.colours, (std::vector<std::string>{"red", "green"}));
  EXPECT_EQ(messageOf([&] { colours.setText("blue,,red", "--colours"); }),
            "--colours is [blue, , red]" + allowed);
}

TEST(Field, OfSeveralWordsTakesNoneWhereThatIsAllowed) {
  std::vector<std::string> colours = {"red"};
  Choices choices = someOf(&colours);
  choices.may_be_empty = true;
  const Field row{"colours", choices, "", {}, "to look at"};
  row.set(std::vector<std::string>{}, "colours");
  EXPECT_TRUE(colours.empty());
  EXPECT_EQ(row.text(), "[]");
  EXPECT_NO_THROW(row.require());
  EXPECT_EQ(messageOf([&] { row.set(std::vector<std::string>{"pink"}, "colours"); }),
            "colours is [pink], but must be a list of some of red, green, blue, each once, or []");
}

TEST(Field, OfTheWordsOnAndOffTakesWhatYamlMakesOfThem) {
  enum class When { kAuto, kOn, kOff } when = When::kAuto;
  const Field row{"lamps", choiceOf(&when, {"auto", "on", "off"}), "", {}, ""};
  row.set(true, "lamps");
  EXPECT_EQ(row.text(), "on");
  row.set(false, "lamps");
  EXPECT_EQ(row.text(), "off");
  row.set(std::string("auto"), "lamps");
  EXPECT_EQ(row.text(), "auto");
  Options options;
  const Field mode = fieldOf(fieldsOf(options), "mode");
  EXPECT_THROW(mode.set(true, "mode"), std::invalid_argument);
}

TEST(Field, OfAWholeNumberOf64BitsTakesNoOther) {
  Options options;
  const Field stride = fieldOf(fieldsOf(options), "stride");
  stride.set(1e9, "stride");
  EXPECT_EQ(options.stride, 1000000000);
  EXPECT_EQ(stride.text(), "1000000000");
  EXPECT_EQ(refusalOf("stride", 2.5), "stride is 2.5, but must be a whole number from 1 to 1000000000");
  EXPECT_EQ(refusalOf("stride", 0), "stride is 0, but must be from 1 to 1000000000");
}

TEST(Field, TakesWhatItsTypeAndRangeAllow) {
  Options options;
  const auto rows = fieldsOf(options);
  fieldOf(rows, "hazy").set(3, "hazy");  // a whole number is a number
  fieldOf(rows, "rays").set(4.0, "rays");
  fieldOf(rows, "latitude").set(90.0, "latitude");
  fieldOf(rows, "poses").set(12, "poses");
  fieldOf(rows, "mode").set(std::string("fixed"), "mode");
  fieldOf(rows, "start").set(5.0, "start");
  fieldOf(rows, "folders").set(std::vector<std::string>{"a", "b"}, "folders");
  EXPECT_EQ(options.hazy, 3.0);
  EXPECT_EQ(options.rays, 4);
  EXPECT_EQ(options.latitude.rad(), 0.5 * kPi);
  EXPECT_EQ(options.poses, 12u);
  EXPECT_EQ(options.mode, Mode::kFixed);
  EXPECT_EQ(options.start, 5.0);
  EXPECT_EQ(fieldOf(rows, "folders").text(), "[a, b]");
  fieldOf(rows, "start").set(std::string("now"), "start");
  EXPECT_FALSE(options.start.has_value());
}

TEST(Field, RefusesInOneWording) {
  EXPECT_EQ(refusalOf("hazy", 11.0), "hazy is 11, but must be from 1 to 10 m");
  EXPECT_EQ(refusalOf("hazy", -kNan), "hazy is nan, but must be from 1 to 10 m");
  EXPECT_EQ(refusalOf("hazy", std::string("thick")),
            "hazy is \"thick\", but must be a number from 1 to 10 m");
  EXPECT_EQ(refusalOf("rays", 2.5), "rays is 2.5, but must be a whole number from 1 to 64");
  EXPECT_EQ(refusalOf("poses", -1), "poses is -1, but must be at least 0");
  EXPECT_EQ(refusalOf("enabled", 1), "enabled is 1, but must be true or false");
  EXPECT_EQ(refusalOf("mode", std::string("manual")), "mode is \"manual\", but must be one of fixed, auto");
  EXPECT_EQ(refusalOf("start", std::string("then")),
            "start is \"then\", but must be \"now\" or a number above 0 and up to 4000000000 s");
  EXPECT_EQ(refusalOf("folders", std::string("one")),
            "folders is \"one\", but must be a list of words, [a, b]");
}

TEST(Field, ReadsTheWordsOfACommandLine) {
  Options options;
  const auto rows = fieldsOf(options);
  fieldOf(rows, "hazy").setText("2.5", "--hazy");
  fieldOf(rows, "enabled").setText("false", "--enabled");
  fieldOf(rows, "file").setText("7", "--file");  // a text that looks like a number stays one
  EXPECT_EQ(options.hazy, 2.5);
  EXPECT_FALSE(options.enabled);
  EXPECT_EQ(options.file, "7");
  for (const char* bad : {"", "2x", "nan", "inf", "2 3"})
    EXPECT_NE(messageOf([&] { fieldOf(rows, "hazy").setText(bad, "--hazy"); }), "") << bad;
  EXPECT_EQ(options.hazy, 2.5);  // nothing that was refused
}

TEST(Field, AnAngleAtTheEndOfItsRangeIsWithinIt) {
  for (const double end : {-90.0, 90.0}) {
    Options options;
    options.latitude = Angle::degrees(end);
    EXPECT_NO_THROW(requireFields(options)) << end;
  }
  Options options;
  options.latitude = Angle::degrees(90.001);
  EXPECT_EQ(messageOf([&] { requireFields(options); }), "latitude is 90.001, but must be from -90 to 90 deg");
}

TEST(Field, DefaultsAreThoseOfTheStruct) {
  Options options;
  std::vector<std::string> texts;
  for (const Field& field : fieldsOf(options)) texts.push_back(field.text());
  EXPECT_EQ(texts, (std::vector<std::string>{"2", "0", "3", "0", "true", "", "[]", "auto", "now", "1",
                                             "[red, blue]", "[]"}));
}

}  // namespace
}  // namespace sunlit
