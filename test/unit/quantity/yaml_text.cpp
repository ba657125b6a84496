// Whatever a text holds, a YAML file that it is written into holds it too.
#include "sunlit/quantity/yaml_text.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

namespace sunlit {
namespace {

std::string readBack(const std::string& text) {
  std::size_t position = 5;
  const std::string line = "key: " + yamlQuoted(text) + " # behind it";
  const std::string back = yamlUnquoted(line, &position);
  EXPECT_EQ(line.substr(position), " # behind it");
  return back;
}

/// By a reader that is not ours, from the middle of a file.
std::string readByYamlCpp(const std::string& text) {
  const YAML::Node tree =
      YAML::Load("a: {b: 1}\nc:\n  " + yamlQuoted(text) + ": " + yamlQuoted(text) + "\n  d: 2\n");
  EXPECT_EQ(tree["c"]["d"].as<int>(), 2);
  EXPECT_TRUE(tree["c"][text]) << text;
  return tree["c"][text].as<std::string>("nothing");
}

TEST(YamlText, HoldsWhatSyntaxUsesOtherwise) {
  for (const std::string text :
       {"",     " ",    " both ends ", "a: b", "a #b", "# a",    "- a", "it's",
        "''",   "'",    "say \"x\"",   "\\",   "\\n",  "{a: 1}", "[1]", "&a *b !c |d >e %f @g `h`",
        "true", "null", "~",           "1.0",  "---",  "...",    "?",   "a,b",
        "\ta\t"}) {
    EXPECT_EQ(readBack(text), text);
    EXPECT_EQ(readByYamlCpp(text), text);
  }
}

TEST(YamlText, HoldsLineBreaksAndControlCharactersOnOneLine) {
  for (const std::string& text :
       {std::string("one\ntwo"), std::string("\n"), std::string("end\n"), std::string("a\n\n b: c\n"),
        std::string("a\r\nb"), std::string("it's\n\"so\" \\"), std::string("a\0b\x01\x1b[0m\x7f", 9)}) {
    EXPECT_EQ(yamlQuoted(text).find_first_of(std::string("\n\r\0", 3)), std::string::npos);
    EXPECT_EQ(readBack(text), text);
    EXPECT_EQ(readByYamlCpp(text), text);
  }
}

TEST(YamlText, HoldsAllOfUnicode) {
  for (const std::string text : {"Казань", "naïve", "東京", "🌞", "a\u0085b", "a\u2028b", "a\u2029b", "\ufeff",
                                 "\uffff", "\u009f", "\u00a0"}) {
    EXPECT_EQ(readBack(text), text);
    EXPECT_EQ(readByYamlCpp(text), text);
  }
  EXPECT_EQ(yamlQuoted("Казань"), "'Казань'");
  // Line breaks of YAML 1.1 within quotes would be folded to spaces.
  EXPECT_EQ(yamlQuoted("a\u0085\u2028"), "\"a\\u0085\\u2028\"");
}

TEST(YamlText, KeepsBytesThatAreNotUtf8) {
  // A byte of its own, one that breaks off, a long form of '/', a surrogate, beyond Unicode.
  for (const std::string text :
       {"a\xff", "\xc3", "\xe2\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\x80"}) {
    EXPECT_EQ(yamlQuoted(text)[0], '"');
    EXPECT_EQ(readBack(text), text);
  }
  EXPECT_EQ(readByYamlCpp("\u00ff"), YAML::Load(yamlQuoted("\xff")).as<std::string>());  // as of Latin-1
}

TEST(YamlText, OfAWordThatBreaksOffIsWhatIsThere) {
  for (const std::string line : {"'ab", "\"ab", "\"ab\\"}) {
    std::size_t position = 0;
    EXPECT_EQ(yamlUnquoted(line, &position).substr(0, 2), "ab");
    EXPECT_EQ(position, line.size());
  }
  std::size_t position = 3;
  EXPECT_EQ(yamlUnquoted("abc", &position), "");
}

}  // namespace
}  // namespace sunlit
