// What a tool tells on stderr of how far it is, by what stderr is.
#include "tools/progress_line.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <string>

#include "support/temporary_folder.h"
#include "tools/terminal.h"

namespace sunlit::tools {
namespace {

/// What `work` says on stderr where that is `descriptor`.
template <typename Work>
void saying(int descriptor, const Work& work) {
  std::fflush(stderr);
  const int kept = ::dup(STDERR_FILENO);
  ::dup2(descriptor, STDERR_FILENO);
  work();
  std::fflush(stderr);
  ::dup2(kept, STDERR_FILENO);
  ::close(kept);
}

template <typename Work>
std::string saidInAFile(const Work& work) {
  const TemporaryFolder folder;
  const int file = ::open(folder.file("said").c_str(), O_WRONLY | O_CREAT, 0600);
  saying(file, work);
  ::close(file);
  return contentOf(folder.file("said"));
}

/// Two works with a warning in the first; both last.
void twoWorks() {
  ProgressLine line;
  const studio::Reports reports = onTerminal();
  line.show("painting", 0.01, 100.0);
  line.show("painting", 0.02, 99.0);
  reports.warning("no paint");
  line.show("painting", 0.03, 98.0);
  line.end();
  line.show("drying", 0.03, 9.0);
}

TEST(ProgressLine, WritesWholeLinesIntoAFileAndNotMany) {
  EXPECT_EQ(saidInAFile(twoWorks),
            "painting: 1 %, 1 min 40 s left\nwarning: no paint\ndrying: 3 %, 9 s left\n");
}

TEST(ProgressLine, IsWrittenOverAtATerminalAndWarningsStandBelow) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(master >= 0 && ::grantpt(master) == 0 && ::unlockpt(master) == 0);
  const int terminal = ::open(::ptsname(master), O_RDWR | O_NOCTTY);
  saying(terminal, twoWorks);
  std::string said;
  char text[4096];
  while (said.find("drying") == std::string::npos || said.back() != '\n') {  // it takes its time to arrive
    const ssize_t count = ::read(master, text, sizeof text);
    ASSERT_GT(count, 0);
    said.append(text, static_cast<std::size_t>(count));
  }
  EXPECT_NE(said.find("\rpainting: 1 %, 1 min 40 s left      \rpainting: 2 %"), std::string::npos) << said;
  EXPECT_NE(said.find("\r\nwarning: no paint\r\n\rpainting: 3 %"), std::string::npos) << said;
  EXPECT_NE(said.find("\r\n\rdrying: 3 %"), std::string::npos) << said;  // though of the same share
  EXPECT_EQ(said.substr(said.size() - 2), "\r\n");
  ::close(terminal);
  ::close(master);
}

TEST(ProgressLine, SaysNothingOfAWorkOfAMomentAfterOneThatLasted) {
  const auto works = [] {
    ProgressLine line;
    line.show("painting", 0.5, 5.0);
    line.end();
    line.show("drying", 0.25, 0.1);
    line.show("drying", 1.0, 0.0);
  };
  EXPECT_EQ(saidInAFile(works), "painting: 50 %, 5 s left\n");
}

// A model in centimetres is seen to be 383 m high before minutes are spent on it.
TEST(ProgressLine, OfABakeThatLastsStandsBelowWhatIsSaidOfTheWorld) {
  const auto works = [](double seconds_left) {
    return saidInAFile([&] {
      const studio::Reports reports = onTerminal();
      reports.note("World shop.glb: 9 triangles, 90 × 60 × 383 m");
      reports.note("Surfaces wet");
      reports.baking(0.25, seconds_left);
      reports.baking(0.5, seconds_left);
    });
  };
  EXPECT_EQ(works(60.0),
            "World shop.glb: 9 triangles, 90 × 60 × 383 m\nbaking light: 25 %, 1 min 00 s left\n");
  EXPECT_EQ(works(61.0),
            "World shop.glb: 9 triangles, 90 × 60 × 383 m\n"
            "baking light: 25 %, 1 min 01 s left (--bounced off: without it)\n");
  EXPECT_EQ(works(0.1), "");
}

}  // namespace
}  // namespace sunlit::tools
