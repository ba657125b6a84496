/// What our nodes need of ROS's diagnostic_updater, for systems that have ROS without it (Ubuntu's own
/// packages of 20.04).
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>

#include <algorithm>
#include <boost/function.hpp>
#include <cstdarg>
#include <cstdio>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace diagnostic_updater {

/// One status, filled in by whom it is of.
class DiagnosticStatusWrapper : public diagnostic_msgs::DiagnosticStatus {
 public:
  void summary(unsigned char new_level, const std::string& text) {
    level = new_level;
    message = text;
  }
  /// The worse level and what it says; both texts where neither is well, and the first where both are.
  void mergeSummary(_level_type other_level, const std::string& text) {
    if (other_level != OK && level != OK) {
      message += (message.empty() ? "" : "; ") + text;
    } else if (other_level > level) {
      message = text;
    }
    level = std::max(level, other_level);
  }
  __attribute__((format(printf, 3, 4))) void summaryf(unsigned char new_level, const char* format, ...) {
    std::va_list arguments;
    va_start(arguments, format);
    summary(new_level, formatted(format, arguments));
    va_end(arguments);
  }
  template <typename Value>
  void add(const std::string& key, const Value& value) {
    std::ostringstream text;
    text << value;
    values.emplace_back();
    values.back().key = key;
    values.back().value = text.str();
  }
  __attribute__((format(printf, 3, 4))) void addf(const std::string& key, const char* format, ...) {
    std::va_list arguments;
    va_start(arguments, format);
    add(key, formatted(format, arguments));
    va_end(arguments);
  }

 private:
  static std::string formatted(const char* format, std::va_list arguments) {
    char text[1000];
    std::vsnprintf(text, sizeof text, format, arguments);
    return text;
  }
};

/// Publishes the status of each part on /diagnostics, each named `<node_name>: <part>`, when it is told to,
/// and "Node starting up" of each when it is added.
class Updater {
 public:
  using Tell = boost::function<void(DiagnosticStatusWrapper&)>;

  /// The period is `diagnostic_period` below `private_node`, in s.
  Updater(ros::NodeHandle node, ros::NodeHandle private_node,
          const std::string& node_name = ros::this_node::getName())
      : private_node_(std::move(private_node)),
        prefix_(node_name.substr(1) + ": "),
        publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1)) {
    private_node_.getParamCached("diagnostic_period", period_s_);
  }

  void setHardwareID(const std::string& id) { hardware_id_ = id; }
  double getPeriod() const { return period_s_; }

  void add(const std::string& part, const Tell& tell) {
    parts_.emplace_back(part, tell);
    DiagnosticStatusWrapper status;
    status.name = prefix_ + part;
    status.summary(DiagnosticStatusWrapper::OK, "Node starting up");
    publish({status});
  }
  template <typename Owner>
  void add(const std::string& part, Owner* owner, void (Owner::*tell)(DiagnosticStatusWrapper&)) {
    add(part, [owner, tell](DiagnosticStatusWrapper& status) { (owner->*tell)(status); });
  }

  void force_update() {
    private_node_.getParamCached("diagnostic_period", period_s_);
    std::vector<diagnostic_msgs::DiagnosticStatus> all;
    for (const auto& [part, tell] : parts_) {
      DiagnosticStatusWrapper status;
      status.name = prefix_ + part;
      status.hardware_id = hardware_id_;
      status.summary(DiagnosticStatusWrapper::ERROR, "No message was set");
      tell(status);
      all.push_back(status);
    }
    publish(all);
  }

 private:
  void publish(const std::vector<diagnostic_msgs::DiagnosticStatus>& all) {
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = ros::Time::now();
    message.status = all;
    publisher_.publish(message);
  }

  ros::NodeHandle private_node_;
  std::string prefix_;
  ros::Publisher publisher_;
  std::string hardware_id_;
  double period_s_ = 1.0;
  std::vector<std::pair<std::string, Tell>> parts_;
};

}  // namespace diagnostic_updater
