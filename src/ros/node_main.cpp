#include "sunlit/ros/node_main.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <clocale>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>
#include <thread>

#include "sunlit/image/files.h"
#include "sunlit/quantity/memory.h"

namespace sunlit::ros_interface {

namespace {

volatile std::sig_atomic_t is_interrupted = 0;
std::atomic<bool> are_interrupts_held = false;

void onInterrupt(int number) {
  is_interrupted = 1;
  std::signal(number, SIG_DFL);
}

// As roscpp's own handler of SIGINT.
void onTermination(int) {
  ros::requestShutdown();
}

/// As the first SIGINT does, which is still to come where somebody else ends what roslaunch left, and would
/// be the second.
void endInOrder() {
  if (are_interrupts_held)
    is_interrupted = 1;
  else
    ros::requestShutdown();
}

/// roslaunch tells each node where to log.
bool isOfRoslaunch(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (std::strncmp(argv[i], "__log:=", 7) == 0) return true;
  return false;
}

/// While it lives, the end of the process that started this one ends it, as Ctrl-C does: a roslaunch that was
/// killed, or whose master was, leaves behind what it had started, which would keep what it holds, and wait
/// for ever for that master.
class EndsWithItsParent {
 public:
  EndsWithItsParent() : parent_(getppid()), watch_([this] { watch(); }) {}
  EndsWithItsParent(const EndsWithItsParent&) = delete;
  EndsWithItsParent& operator=(const EndsWithItsParent&) = delete;
  ~EndsWithItsParent() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      done_ = true;
    }
    changed_.notify_all();
    watch_.join();
  }

  /// From here on it ends in order.
  void haveMaster() {
    const std::lock_guard<std::mutex> lock(mutex_);
    has_master_ = true;
  }

 private:
  void watch() {
    constexpr std::chrono::milliseconds kPeriod(200);
    constexpr std::chrono::seconds kGrace(20);  // after which roslaunch would have killed it, too
    const auto is_done = [this] { return done_; };
    std::unique_lock<std::mutex> lock(mutex_);
    while (getppid() == parent_)
      if (changed_.wait_for(lock, kPeriod, is_done)) return;
    std::fputs("roslaunch has gone: this node ends, too\n", stderr);
    if (has_master_) {
      endInOrder();
      if (changed_.wait_for(lock, kGrace, is_done)) return;
    }
    std::_Exit(1);
  }

  const pid_t parent_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  bool has_master_ = false;
  std::thread watch_;
};

/// As __master:= or ROS_MASTER_URI tells it, of which roscpp ends the process where it is none.
void requireMasterAddress(int argc, char** argv) {
  const char* const told = std::getenv("ROS_MASTER_URI");
  std::string name = "ROS_MASTER_URI", address = told != nullptr ? told : "";
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "__master:=", 10) != 0) continue;
    name = "__master";
    address = argv[i] + 10;
  }
  if (std::regex_match(address, std::regex("https?://[^/:]+:[0-9]{1,5}(/.*)?"))) return;
  throw std::invalid_argument(name + " is \"" + address + "\", but must be as http://localhost:11311");
}

int refuseWord(const std::string& word, const std::string& name) {
  const bool help = word == "--help" || word == "-h";
  if (!help) std::fprintf(stderr, "%s: there is no option %s\n", name.c_str(), word.c_str());
  std::fprintf(help ? stdout : stderr,
               "%s_node takes ROS parameters; config/%s.yaml explains them, launch/%s.launch sets them\n",
               name.c_str(), name.c_str(), name.c_str());
  return help ? 0 : 1;
}

}  // namespace

int runNode(int argc, char** argv, const std::string& name, const std::function<int()>& node) {
  image::prepareProcess();
  // All text is UTF-8, of which the console writes ? for each byte that the locale does not know.
  std::setlocale(LC_CTYPE, "C.UTF-8");
  std::optional<EndsWithItsParent> of_roslaunch;
  if (isOfRoslaunch(argc, argv)) of_roslaunch.emplace();
  // roscpp and its console end with the last handle: without this one, an exception that destroys the node's
  // own handles on its way here could no longer be printed.
  std::optional<ros::NodeHandle> alive;
  // Bad names throw, of the node, its namespace and what is remapped; so far there is no log.
  try {
    requireMasterAddress(argc, argv);
    ros::init(argc, argv, name);
    if (argc > 1) return refuseWord(argv[1], name);  // ROS has taken what it knows
    std::signal(SIGTERM, onTermination);
    alive.emplace();  // waits for a master
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return 1;
  }
  if (of_roslaunch) of_roslaunch->haveMaster();
  try {
    return node();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", reasonInWords(error).c_str());
    return 1;
  }
}

void holdInterrupts() {
  are_interrupts_held = true;
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
}

bool isInterrupted() {
  return is_interrupted != 0;
}

}  // namespace sunlit::ros_interface
