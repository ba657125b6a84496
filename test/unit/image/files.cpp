#include "sunlit/image/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "sunlit/image/unfinished_file.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::image {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  std::size_t fileCount() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  void put(const std::string& name, const std::string& bytes) const { setContent(path(name), bytes); }

  const TemporaryFolder folder_;
};

Rgb8Image pattern() {
  Rgb8Image picture(37, 21);
  for (std::size_t i = 0; i < picture.data.size(); ++i) {
    picture.data[i] = static_cast<std::uint8_t>((i * 7919) >> 3);
  }
  return picture;
}

TEST_F(Files, AFolderIsMadeWithAllAboveItOrTheReasonIsTold) {
  makeFolder(path("a/b/c"));
  EXPECT_TRUE(fs::is_directory(path("a/b/c")));
  makeFolder(path("a/b/c"));
  fs::create_symlink(path("a/b"), path("whole"));
  makeFolder(path("whole/d"));
  EXPECT_TRUE(fs::is_directory(path("a/b/d")));
  put("file", "");
  const auto refusal = [this](const std::string& name) {
    return messageOf<std::runtime_error>([&] { makeFolder(path(name)); });
  };
  EXPECT_EQ(refusal("file/below"), path("file/below") + ": the folder cannot be made: Not a directory");
  EXPECT_EQ(refusal("file"), path("file") + ": the folder cannot be made: Not a directory");
  fs::create_symlink("/nowhere", path("link"));
  for (const char* name : {"link", "link/below"})
    EXPECT_EQ(refusal(name), path(name) + ": the folder cannot be made: " + path("link") +
                                 " is a link to /nowhere, which is not there");
}

TEST_F(Files, LeftUnfinishedByProcessesThatHaveEndedAreRemoved) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  fs::create_directories(path("images/h12"));
  const std::string ended = "." + std::to_string(child) + ".7.part";
  const std::string alive = "." + std::to_string(::getpid()) + ".7.part";
  for (const std::string name : {"frames.csv", "images/h12/000001.png"}) {
    put(name + ended, "half");
    put(name + alive, "half");
  }
  for (const std::string name : {"film.mp4", "film.mp4.notes.mp4"}) {
    put(name + ended + ".mp4", "half");
    put(name + alive + ".mp4", "half");
  }
  removeUnfinishedOf(path("film.mp4"));  // that alone
  EXPECT_FALSE(fs::exists(path("film.mp4" + ended + ".mp4")));
  EXPECT_TRUE(fs::exists(path("film.mp4" + alive + ".mp4")));
  EXPECT_TRUE(fs::exists(path("frames.csv" + ended)));
  const std::vector<std::string> others = {"notes.part", ".1.2.part", "frames.csv", "a.99.part",
                                           "a.x.1.part"};
  for (const std::string& name : others) put(name, "whole");
  removeUnfinished(folder_.path());
  EXPECT_FALSE(fs::exists(path("film.mp4.notes.mp4" + ended + ".mp4")));
  for (const std::string name : {"frames.csv", "images/h12/000001.png"}) {
    EXPECT_FALSE(fs::exists(path(name + ended)));
    EXPECT_TRUE(fs::exists(path(name + alive)));
  }
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(path(name))) << name;
  removeUnfinished(path("nowhere"));  // nothing to do
  removeUnfinishedOf(path("nowhere/film.mp4"));
}

TEST_F(Files, BeingWrittenByProcessesThatAreNotSeenHereStay) {
  // In a container, or on another computer: their numbers are of no process here.
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  const std::string elsewhere = path("frames.csv." + std::to_string(child) + ".7.part");
  {
    const UnfinishedFile file(path("frames.csv"));
    ASSERT_EQ(fileCount(), 1u);
    fs::rename(fs::directory_iterator(folder_.path())->path(), elsewhere);
    removeUnfinished(folder_.path());
    EXPECT_TRUE(fs::exists(elsewhere));
  }
  removeUnfinished(folder_.path());
  EXPECT_FALSE(fs::exists(elsewhere));
}

TEST_F(Files, WhatFindsNoRoomLeavesTheOldFileAndSaysWhatToDo) {
  writeFileAtomically(path("kept"), "old");
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &little), 0);
  const std::string said =
      messageOf<std::runtime_error>([&] { writeFileAtomically(path("kept"), std::string(2000, 'x')); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(said,
            path("kept") + ": write: File too large; raise the limit (ulimit -f) and start the same again");
  EXPECT_EQ(readWholeFile(path("kept")), "old");
  EXPECT_EQ(fileCount(), 1u) << "nothing unfinished";
  EXPECT_EQ(reasonOf(ENOSPC), "No space left on device; make room there and start the same again");
  EXPECT_EQ(reasonOf(EACCES), "Permission denied");
}

TEST_F(Files, PngReturnsTheSamePixels) {
  writePng(path("a.png"), pattern());
  const Rgb8Image back = readPng(path("a.png"));
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 21);
  EXPECT_EQ(back.data, pattern().data);
}

TEST_F(Files, RedStaysRed) {
  // One red pixel: signature, IHDR 1×1 8-bit RGB, IDAT holding filter 0 and ff 00 00, IEND.
  static const unsigned char kRedPng[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
      0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x08,
      0xd7, 0x63, 0xf8, 0xcf, 0xc0, 0x00, 0x00, 0x03, 0x01, 0x01, 0x00, 0x18, 0xdd, 0x8d,
      0xb0, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  put("red.png", std::string(reinterpret_cast<const char*>(kRedPng), sizeof kRedPng));
  const Rgb8Image red = readPng(path("red.png"));
  EXPECT_EQ(red.data, (std::vector<std::uint8_t>{255, 0, 0}));
  writePng(path("again.png"), red);  // the reader is right, so it may judge the writer
  EXPECT_EQ(readPng(path("again.png")).data, red.data);
}

TEST_F(Files, PhotographsAreReadInAnyFormat) {
  put("a.ppm", std::string("P6\n2 1\n255\n") + "\xff\x80\x01" + "\x02\x03\x04");
  const Rgb8Image picture = readPhotograph(path("a.ppm"));
  EXPECT_EQ(picture.width, 2);
  EXPECT_EQ(picture.data, (std::vector<std::uint8_t>{255, 128, 1, 2, 3, 4}));
  put("text.ppm", "P3\n2 1\n255\n255 128 1 2 3 4");
  EXPECT_EQ(readPhotograph(path("text.ppm")).data, picture.data);
  put("deep.ppm", std::string("P6\n1 1\n65535\n\xff\xff\x80\x80\x01\x01", 19));
  EXPECT_EQ(readPhotograph(path("deep.ppm")).data,
            (std::vector<std::uint8_t>{255, 128, 1}));  // v · 255 / 65535
  writePng(path("a.png"), pattern());
  EXPECT_EQ(readPhotograph(path("a.png")).data, pattern().data);
  const std::string whole = encodePng(pattern());
  put("cut.png", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readPhotograph(path("cut.png")); }),
            path("cut.png") + ": read: the file is cut off");
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", cv::Mat(21, 37, CV_8UC3, cv::Scalar(10, 200, 90)), jpeg);
  put("whole.jpg", std::string(jpeg.begin(), jpeg.end()));
  EXPECT_EQ(readPhotograph(path("whole.jpg")).height, 21);
  put("cut.jpg", std::string(jpeg.begin(), jpeg.end() - 40));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readPhotograph(path("cut.jpg")); }),
            path("cut.jpg") + ": read: the file is cut off");
  put("text.png", "text");
  EXPECT_EQ(
      messageOf<std::runtime_error>([&] { readPhotograph(path("text.png")); }).rfind(path("text.png"), 0),
      0u);
  EXPECT_NE(messageOf<std::runtime_error>([&] { readPhotograph(path("absent.png")); }), "");
}

TEST_F(Files, TheSamePictureGivesTheSameBytes) {
  EXPECT_EQ(encodePng(pattern()), encodePng(pattern()));
}

TEST_F(Files, PngOfSixteenBitsComesBackToTheBit) {
  Grey16Image steps(37, 21);
  for (std::size_t i = 0; i < steps.data.size(); ++i) steps.data[i] = static_cast<std::uint16_t>(i * 7919);
  writePng(path("steps.png"), steps);
  const Grey16Image read = readGrey16Png(path("steps.png"));
  EXPECT_EQ(read.width, 37);
  EXPECT_EQ(read.height, 21);
  EXPECT_EQ(read.data, steps.data);
  EXPECT_THROW(readPng(path("steps.png")), std::runtime_error);  // 16 bits would be lost
  writePng(path("grey.png"), Grey8Image(4, 3));
  writePng(path("colour.png"), pattern());
  for (const std::string name : {"grey.png", "colour.png"}) {
    EXPECT_EQ(messageOf<std::runtime_error>([&] { readGrey16Png(path(name)); }),
              path(name) + ": read: not one channel of 16 bits");
  }
  EXPECT_THROW(writePng(path("none.png"), Grey16Image()), std::invalid_argument);
  EXPECT_THROW(writePng(path("none.png"), Grey8Image()), std::invalid_argument);
}

TEST_F(Files, PngOfOneChannelOfEightBitsIsRead) {
  Grey8Image grey(5, 3);
  for (std::size_t i = 0; i < grey.data.size(); ++i) grey.data[i] = static_cast<std::uint8_t>(17 * i);
  writePng(path("grey.png"), grey);
  const Rgb8Image read = readPng(path("grey.png"));
  for (std::size_t i = 0; i < read.data.size(); ++i) EXPECT_EQ(read.data[i], grey.data[i / 3]);
}

TEST_F(Files, WritingReplacesTheOldFileAndLeavesNothingElse) {
  put("a.png", "old");
  writePng(path("a.png"), pattern());
  EXPECT_EQ(readPng(path("a.png")).data, pattern().data);
  EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Files, AFailedWriteNamesThePathAndLeavesNothing) {
  const std::string missing = path("no_such_folder/a.png");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writePng(missing, pattern()); }),
            missing + ": create: No such file or directory");
  fs::create_directory(path("taken"));  // a file cannot replace a folder
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writePng(path("taken"), pattern()); }),
            path("taken") + ": rename: Is a directory");
  EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Files, AFinishedFileMovesIntoPlaceOrStays) {
  put("film.part", "new");
  put("film", "old");
  moveIntoPlace(path("film.part"), path("film"));
  EXPECT_EQ(readWholeFile(path("film")), "new");
  EXPECT_EQ(fileCount(), 1U);
  fs::create_directory(path("taken"));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { moveIntoPlace(path("film"), path("taken")); }),
            path("taken") + ": rename: Is a directory");
  EXPECT_EQ(readWholeFile(path("film")), "new");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { moveIntoPlace(path("none"), path("a")); }),
            path("a") + ": open: No such file or directory");
}

TEST_F(Files, AnEmptyPictureIsRefused) {
  EXPECT_THROW(writePng(path("a.png"), Rgb8Image()), std::invalid_argument);
  EXPECT_EQ(fileCount(), 0U);
}

TEST_F(Files, UnreadablePngsSayWhichAndWhy) {
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readPng(path("none.png")); }),
            path("none.png") + ": open: No such file or directory");
  put("text.png", "not a picture");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readPng(path("text.png")); }),
            path("text.png") + ": read: not a PNG file");
  const std::string whole = encodePng(pattern());
  put("cut.png", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readPng(path("cut.png")); }),
            path("cut.png") + ": read: the file is cut off");
  put("head.png", whole.substr(0, 10));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readPng(path("head.png")); }),
            path("head.png") + ": read: the file is cut off");
}

TEST_F(Files, PngsMayHaveMoreBehindTheirEnd) {
  put("more.png", encodePng(pattern()) + std::string(7, '\0'));
  EXPECT_EQ(readPng(path("more.png")).data, pattern().data);
  EXPECT_EQ(readPhotograph(path("more.png")).data, pattern().data);
}

TEST_F(Files, FloatMapsAreExactToTheBit) {
  LinearImage image(5, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    image.data[i] = 0.1F * static_cast<float>(i) - 0.3F;
  }
  writePfm(path("a.pfm"), image);
  EXPECT_EQ(readLinearPfm(path("a.pfm")).data, image.data);
  DepthImage depth(3, 2);
  depth.data = {1.5F, std::numeric_limits<float>::quiet_NaN(), 3.0F, 4.0F, 5.0F, 1e-40F};
  writePfm(path("d.pfm"), depth);
  const DepthImage back = readDepthPfm(path("d.pfm"));
  ASSERT_EQ(back.data.size(), depth.data.size());
  EXPECT_EQ(std::memcmp(back.data.data(), depth.data.data(), depth.data.size() * sizeof(float)), 0);
}

TEST_F(Files, TheBottomRowOfAFloatMapComesFirst) {
  DepthImage depth(1, 2);
  depth.data = {1.0F, 2.0F};
  writePfm(path("d.pfm"), depth);
  std::ifstream in(path("d.pfm"), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  float first = 0.0F;
  std::memcpy(&first, bytes.data() + bytes.size() - 2 * sizeof(float), sizeof first);
  EXPECT_EQ(first, 2.0F);
}

TEST_F(Files, BadFloatMapsSayWhichAndWhy) {
  writePfm(path("d.pfm"), DepthImage(4, 4));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readLinearPfm(path("d.pfm")); }),
            path("d.pfm") + ": read: not a little-endian \"PF\" float map");
  fs::resize_file(path("d.pfm"), 40);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readDepthPfm(path("d.pfm")); }),
            path("d.pfm") + ": read: 40 bytes do not hold 4×4 pixels");
}

TEST(ProgramsDeathTest, ThatBeginWithoutStandardStreamsGiveTheirNumbersToNoFile) {
  const auto begin = [] {
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) ::close(stream);
    prepareProcess();
    std::_Exit(::dup(STDERR_FILENO) > STDERR_FILENO ? 3 : 1);
  };
  EXPECT_EXIT(begin(), testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace sunlit::image
