// What of SDF is not drawn, and not missed either.
#include <gtest/gtest.h>

#include <string>

#include "unit/scene/scene_files.h"
#include "unit/scene/sdf_texts.h"

namespace sunlit::scene {
namespace {

class SdfLeftOut : public SceneFiles {
 protected:
  /// Of a world with one box.
  Scene boxWith(const std::string& content, const std::string& version = "1.6") const {
    return load(
        write("test.world",
              world(content + "<model name='m'><link name='l'>" + boxVisual() + "</link></model>", version)),
        {});
  }
};

TEST_F(SdfLeftOut, ModelsThatAreMissingInWhatIsNotDrawnStopNothing) {
  const std::string gone = "<include><uri>model://gone</uri></include>";
  for (const std::string kind : {"population", "plugin", "gui", "actor"}) {
    const std::string begin = "<" + kind + " name='p'>", end = "</" + kind + ">";
    EXPECT_EQ(boxWith(begin + gone + end).meshes.size(), 1u) << kind;
    EXPECT_EQ(boxWith(begin + "<model name='can'>" + gone + "</model>" + end).meshes.size(), 1u) << kind;
  }
  EXPECT_NE(errorOf(write("test.world", world("<model name='n'>" + gone + "</model>")))
                .find("there is no model://gone"),
            std::string::npos);
}

}  // namespace
}  // namespace sunlit::scene
