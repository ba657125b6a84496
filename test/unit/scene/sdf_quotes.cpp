// XML that Gazebo Classic reads although it is not quite XML.
#include "scene/sdf_quotes.h"

#include <gtest/gtest.h>

#include <string>

#include "unit/scene/scene_files.h"
#include "unit/scene/sdf_texts.h"

namespace sunlit::scene {
namespace {

class SdfQuotes : public SceneFiles {};

TEST_F(SdfQuotes, AWorldWithValuesWithoutQuotesIsReadAsGazeboReadsIt) {
  const std::string box = "<model name=m><link name=l>" + boxVisual() + "</link></model>";
  const Scene scene = load(write("test.world", world("<gui fullscreen=1>\n</gui>" + box)), {});
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].name, "m::l::v");
}

TEST_F(SdfQuotes, WhatIsBrokenBesidesNamesItsLine) {
  const std::string file = write("test.world", world("<gui fullscreen=1>\n</gui>\n<model x'></model>"));
  EXPECT_EQ(errorOf(file), file + ":3: the XML is broken here (XML_ERROR_PARSING_ATTRIBUTE)");
}

TEST(QuotedValues, EndAtABlankASlashOrTheEndOfTheTag) {
  EXPECT_EQ(quotedValues("<a b=1 c= 2\td=x/>"), "<a b=\"1\" c= \"2\"\td=\"x\"/>");
  EXPECT_EQ(quotedValues("<a b=>"), "<a b=\"\">");
  EXPECT_EQ(quotedValues("<a b="), "<a b=");
}

TEST(QuotedValues, LeaveAllElseAsItIs) {
  for (const std::string text : {"<a b='c=d>' e=\"f\">g=h</a>", "<!-- <a b=1> --><a/>", "<![CDATA[<a b=1>]]>",
                                 "<?xml version='1.0'?>", "a=b", "<a", "<!-- <a b=1>", "<a b='c=d>", ""})
    EXPECT_EQ(quotedValues(text), text);
}

}  // namespace
}  // namespace sunlit::scene
