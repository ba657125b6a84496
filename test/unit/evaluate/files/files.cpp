#include "evaluate/files/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>

#include "sunlit/evaluate/files/frames_file.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

FramesLayout layout() {
  return {{{"h04", "h12"}, {"h04", "h20"}}, {"boolean_rgb", "orb"}};
}

PairRecord record(std::int64_t pose, std::size_t pair) {
  const double value = 0.1 + static_cast<double>(pose) / 3.0;
  return {pose,
          1000000000 * pose + 7,
          pair,
          {{value, value, value}, {std::nan(""), -0.5, 0.25, 5, 6, 7, 8, 3, 4}}};
}

std::string messageOf(const std::string& path) {
  return sunlit::messageOf<std::runtime_error>([&] { loadFrames(path, layout()); });
}

TEST(Numbers, SurviveWritingAndReading) {
  for (const double value : {0.1, 1.0 / 3.0, 0.0, 5e-324, 1.7976931348623157e308}) {
    EXPECT_EQ(parseNumber(formatNumber(value)), value);
  }
  EXPECT_TRUE(std::isnan(parseNumber(formatNumber(std::numeric_limits<double>::quiet_NaN()))));
  EXPECT_THROW(parseNumber("0.5x"), std::runtime_error);
  EXPECT_THROW(parseNumber(""), std::runtime_error);
}

TEST(Stamps, KeepEveryNanosecond) {
  EXPECT_EQ(formatStamp(1719792000000000001), "1719792000.000000001");
  EXPECT_EQ(parseStamp("1719792000.000000001"), 1719792000000000001);
  EXPECT_EQ(parseStamp(formatStamp(-1500000000)), -1500000000);
  EXPECT_THROW(parseStamp("12.5"), std::runtime_error);
}

/// Files of this process end at so many bytes, as on a full disk: what still fits is written first.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*old_handler_)(int);
  rlimit old_limit_{};
};

TEST(AppendFile, HoldsWholeLinesOnlyAfterADiskWasFull) {
  const TemporaryFolder folder;
  const std::string path = folder.file("lines.csv");
  AppendFile file;
  file.open(path, "a,b");
  file.append("1,2\n");
  std::string message;
  {
    const FullDisk disk(contentOf(path).size() + 3);
    message = sunlit::messageOf<std::runtime_error>([&] { file.append("3,44\n"); });
  }
  EXPECT_NE(message.find(path + ": cannot write"), std::string::npos) << message;
  EXPECT_EQ(contentOf(path), "a,b\n1,2\n");
  // There is room again, but a line is missing: what comes after it must not look like its successor.
  EXPECT_THROW(file.append("5,6\n"), std::runtime_error);
  EXPECT_EQ(contentOf(path), "a,b\n1,2\n");
  file.open(path, "a,b");
  file.append("3,44\n");
  EXPECT_EQ(contentOf(path), "a,b\n1,2\n3,44\n");
}

TEST(FramesFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const std::string path = folder.file("frames.csv");
  std::vector<PairRecord> records = {record(2, 0), record(0, 1), record(0, 0), record(2, 0)};
  sortRecords(records);
  ASSERT_EQ(records.size(), 3u);  // pose 2 came twice
  writeFrames(path, layout(), records);
  const LoadedFrames loaded = loadFrames(path, layout());
  EXPECT_EQ(loaded.dropped_lines, 0u);
  std::vector<PairRecord> again = loaded.records;
  sortRecords(again);
  writeFrames(folder.file("again.csv"), layout(), again);
  EXPECT_EQ(contentOf(path), contentOf(folder.file("again.csv")));
  EXPECT_EQ(contentOf(path).substr(0, contentOf(path).find("\n0,0.000000007,h04,h20,orb")),
            "pose,stamp,a,b,difference,value,features_a,features_b,matches,zero_second,symmetric,one_to_one,"
            "matches_back,matches_one_to_one\n"
            "0,0.000000007,h04,h12,boolean_rgb,0.10000000000000001,0,0,0,0,0.10000000000000001,"
            "0.10000000000000001,0,0\n"
            "0,0.000000007,h04,h12,orb,nan,5,6,7,4,-0.5,0.25,8,3\n"
            "0,0.000000007,h04,h20,boolean_rgb,0.10000000000000001,0,0,0,0,0.10000000000000001,"
            "0.10000000000000001,0,0");
}

TEST(FramesFile, LosesOnlyTheTornPairAtAnyLength) {
  const TemporaryFolder folder;
  const std::string path = folder.file("frames.csv");
  writeFrames(path, layout(), {record(0, 0), record(0, 1)});
  const std::string whole = contentOf(path);
  const std::size_t second = whole.find("0,0.000000007,h04,h20");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    setContent(path, whole.substr(0, length));
    const LoadedFrames loaded = loadFrames(path, layout());
    EXPECT_EQ(loaded.records.size(), length >= second ? 1u : 0u) << length;
    const bool is_clean = length == 0 || length == framesHeader().size() + 1 || length == second;
    EXPECT_EQ(loaded.dropped_lines > 0, !is_clean) << length;
  }
}

TEST(FramesFile, NamesPathAndLineOfWhatItCannotRead) {
  const TemporaryFolder folder;
  const std::string path = folder.file("frames.csv");
  const std::string start = framesHeader() + "\n0,1.000000000,h04,h12,orb,0.5,1,1,1,0,0.5,0.5,1,1\n";
  setContent(path, "pose,value\n");
  EXPECT_NE(messageOf(path).find("frames.csv:1: "), std::string::npos);
  setContent(path, start + "0,1.000000000,h04\n");
  EXPECT_NE(messageOf(path).find("frames.csv:3: "), std::string::npos);
  setContent(path, start + "0,1.000000000,h04,h12,sift,0.5,1,1,1,0,0.5,0.5,1,1\n");
  EXPECT_NE(messageOf(path).find("frames.csv:3: the difference sift"), std::string::npos);
  setContent(path, start + "0,1.000000000,h12,h04,orb,0.5,1,1,1,0,0.5,0.5,1,1\n");
  EXPECT_NE(messageOf(path).find("frames.csv:3: the pair h12, h04"), std::string::npos);
  setContent(path, start + "0,1.000000000,h04,h12,orb,half,1,1,1,0,0.5,0.5,1,1\n");
  EXPECT_NE(messageOf(path).find("frames.csv:3: \"half\""), std::string::npos);
}

// A run of many hours has millions of rows, of which what is kept of them takes far less.
TEST(CsvRows, AreReadOneByOne) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "what is given back stays in quarantine, and counts as taken";
#endif
  constexpr int kRows = 300000;
  constexpr long kMost_kB = 16384;  // held as text, they are 6 MB, and cut, more than 50
  const TemporaryFolder folder;
  const std::string path = folder.file("rows.csv");
  {
    std::ofstream file(path);
    file << "a,b,c,d,e\n";
    for (int i = 0; i < kRows; ++i) file << i << ",1,2,3,4\n";
    file << "torn";
  }
  const auto peak_kB = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before_kB = peak_kB();
  int rows = 0;
  const std::size_t torn = forEachCsvRow(path, "a,b,c,d,e", [&](const std::vector<std::string>& fields) {
    EXPECT_EQ(fields[0], std::to_string(rows++));
  });
  EXPECT_EQ(rows, kRows);
  EXPECT_EQ(torn, 1u);
  EXPECT_LT(peak_kB() - before_kB, kMost_kB);
}

TEST(Summary, OfShardsIsThatOfTheWhole) {
  std::vector<PairRecord> whole;
  std::vector<PairRecord> shards;
  for (const int start : {1, 0}) {  // odd poses on one machine, even ones on another
    for (int pose = start; pose < 200; pose += 2) shards.push_back(record(pose, 0));
  }
  for (int pose = 0; pose < 200; ++pose) whole.push_back(record(pose, 0));
  sortRecords(shards);
  const TemporaryFolder folder;
  writeSummary(folder.file("whole.csv"), summarise(layout(), whole));
  writeSummary(folder.file("shards.csv"), summarise(layout(), shards));
  EXPECT_EQ(contentOf(folder.file("whole.csv")), contentOf(folder.file("shards.csv")));
}

TEST(Summary, CountsUndefinedAndHasARowForAnEmptyPair) {
  const auto rows = summarise(layout(), {record(0, 0), record(1, 0)});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].statistics.n, 2u);
  EXPECT_EQ(rows[1].statistics.n, 0u);
  EXPECT_EQ(rows[1].statistics.undefined, 2u);
  EXPECT_EQ(rows[2].a + rows[2].b, "h04h20");
  EXPECT_EQ(rows[2].statistics.n + rows[2].statistics.undefined, 0u);
}

TEST(Stamps, BeyondAllClocksAreNone) {
  for (const std::string text : {"-9223372036.854775808", "9223372036.854775807", "99999999999999.000000000",
                                 "2305843010.000000000", "1.2.4567890", "-.00000000a"})
    EXPECT_NE(sunlit::messageOf<std::runtime_error>([&] { parseStamp(text); }), "") << text;
  EXPECT_EQ(parseStamp("-1.000000001"), -1000000001);
}

TEST(Poses, AreWholeNumbersThatADoubleKnows) {
  EXPECT_EQ(parsePose("-1"), -1);
  for (const std::string text : {"9223372036854775807", "0.5", "nan", "", "1x"})
    EXPECT_NE(sunlit::messageOf<std::runtime_error>([&] { parsePose(text); }), "") << text;
}

}  // namespace
}  // namespace sunlit::evaluate
