// What an earlier run left in its folder, taken up by the next: one of frames.csv, captures.csv, path.csv,
// problems.csv, verified.csv and run.yaml, by its first line.
#include <filesystem>

#include "fuzz/reader.h"
#include "sunlit/evaluate/run/evaluation.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {
namespace {

const char* const kFolder = "run";

evaluate::EvaluationOptions options() {
  evaluate::EvaluationOptions options;
  options.streams = {"h04", "h12"};
  options.output_dir = kFolder;
  options.comparer.differences = {"boolean_rgb", "orb"};
  options.images = evaluate::KeptImages::kNone;
  return options;
}

/// Takes up what lies in the folder, and ends at once.
void takeUp() {
  evaluate::Evaluation evaluation(options(), {});
  evaluation.finish(evaluate::StopToken([] { return true; }));
}

/// As a run that found nothing leaves it.
const std::string& settings() {
  static const std::string text = [] {
    std::filesystem::remove_all(kFolder);
    takeUp();
    return contentOf(std::string(kFolder) + "/run.yaml");
  }();
  return text;
}

std::string fileFor(const std::string& input) {
  const std::pair<const char*, const char*> kBeginnings[] = {
      {"stream,", "captures.csv"}, {"pose,stamp,x", "path.csv"},
      {"kind,", "problems.csv"},   {"pose,stamp,a,b,detector", "verified.csv"},
      {"#", "run.yaml"},           {"", "frames.csv"}};
  for (const auto& [beginning, file] : kBeginnings) {
    if (input.rfind(beginning, 0) == 0) return file;
  }
  return "";
}

}  // namespace

std::vector<std::string> seeds() {
  return {
      evaluate::framesHeader() +
          "\n0,1000.000000000,h04,h12,boolean_rgb,0.5,0,0,0,0,0.5,0.5,0,0\n0,1000.000000000,h04,h12,orb,0.25,"
          "12,"
          "13,5,0,0.5,0.75,4,3\n1,1000.100000000,h04,h12,boolean_rgb,nan,0,0,0,0,nan,nan,0,0\n1,1000."
          "100000000,"
          "h04,h12,orb,0.25,12,13,5,0,0.5,0.75,4,3\n",
      "stream,pose,stamp,ev100,exposure_mode,sun_azimuth_deg,sun_elevation_deg,moon_azimuth_deg,"
      "moon_elevation_deg,moon_illuminated_fraction,scene_illuminance,utc,utc_s\n"
      "h04,0,1000.000000000,14,auto,90.5,20,nan,nan,nan,50000,2024-07-01T01:00:00.000Z,773110800\n"
      "h12,0,1000.000000000,14,fixed,180,50,10,-20,0.5,90000,,nan\n",
      "pose,stamp,x,y,z,yaw_deg\n0,1000.000000000,0,0,1,90\n1,1000.100000000,1,0,1,90\n",
      "kind,pose,stamp,where,reason\nmissing_partner,3,1000.300000000,h04-h12,\"no, \"\"h12\"\" "
      "came\"\nlost,,"
      ",h04,x\n",
      evaluate::verifiedHeader() + "\n",
      settings()};
}

void read(const std::string& input) {
  const std::string file = fileFor(input), run = settings();
  std::filesystem::remove_all(kFolder);
  setContent(std::string(kFolder) + "/run.yaml", run);
  setContent(std::string(kFolder) + "/" + file, input);
  takeUp();
}

std::string named() {
  return kFolder;
}

}  // namespace sunlit::fuzz
