#include "ros/evaluator/bag_list.h"

#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "sunlit/evaluate/run/run_folder.h"
#include "sunlit/image/files.h"

namespace sunlit::ros_interface {
namespace {

constexpr const char* kFile = "/bags.csv";
constexpr const char* kHeader = "size,begin,end,messages,name";

/// "size,begin,end,messages,".
std::string identityOf(const rosbag::Bag& bag) {
  rosbag::View view(bag);
  std::string text = std::to_string(bag.getSize());
  for (const ros::Time& time : {view.getBeginTime(), view.getEndTime()})
    text += ',' + std::to_string(view.size() == 0 ? 0 : time.toNSec());
  return text + ',' + std::to_string(view.size()) + ',';
}

/// Below the first.
std::vector<std::string> linesOf(const std::string& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) lines.push_back(line);
  return lines;
}

}  // namespace

void requireSameBags(const std::string& folder, const std::vector<std::unique_ptr<rosbag::Bag>>& bags) {
  if (!evaluate::holdsResults(folder)) return;
  std::vector<std::string> given;
  for (const auto& bag : bags) given.push_back(identityOf(*bag));
  for (const std::string& line : linesOf(folder + kFile)) {
    const auto is_it = [&](const std::string& identity) { return line.rfind(identity, 0) == 0; };
    if (std::any_of(given.begin(), given.end(), is_it)) continue;
    throw std::invalid_argument(
        folder + ": this folder holds results of another bag, " + line.substr(line.rfind(',') + 1) +
        ", which would be taken for those of one run; give it, too, or choose another "
        "folder");
  }
}

void noteBags(const std::string& folder, const std::vector<std::unique_ptr<rosbag::Bag>>& bags) {
  std::string text = std::string(kHeader) + '\n';
  for (const auto& bag : bags)
    text += identityOf(*bag) + std::filesystem::path(bag->getFileName()).filename().string() + '\n';
  image::writeFileAtomically(folder + kFile, text);
}

}  // namespace sunlit::ros_interface
