#include "sunlit/studio/stopwatch.h"

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sunlit::studio {

namespace {

const char* const kHeader = "stage,what,count,seconds";

/// The innermost stage that this thread is in.
thread_local void* innermost = nullptr;

bool parse(const std::string& line, Stopwatch::Entry* entry) {
  std::istringstream fields(line);
  char comma = 0;
  return std::getline(fields, entry->stage, ',') && std::getline(fields, entry->what, ',') &&
         fields >> entry->count >> comma >> entry->seconds && comma == ',' && entry->count >= 0 &&
         entry->seconds >= 0.0 && fields.peek() == std::char_traits<char>::eof();
}

}  // namespace

double Stopwatch::steadyTime() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Stopwatch::Charge::Charge(Stopwatch& watch, const std::string& stage, const std::string& what)
    : watch_(watch),
      stage_(stage),
      what_(what),
      around_(static_cast<Charge*>(innermost)),
      begin_s_(watch.clock_()) {
  innermost = this;
}

Stopwatch::Charge::~Charge() {
  const double seconds = watch_.clock_() - begin_s_;
  innermost = around_;
  if (around_ != nullptr) around_->inner_s_ += seconds;
  const std::lock_guard<std::mutex> lock(watch_.mutex_);
  watch_.add(Entry{stage_, what_, 1, seconds - inner_s_});
}

void Stopwatch::add(const Entry& other) {
  for (Entry& known : entries_) {
    if (known.stage != other.stage || known.what != other.what) continue;
    known.count += other.count;
    known.seconds += other.seconds;
    return;
  }
  entries_.push_back(other);
}

void Stopwatch::add(const std::vector<Entry>& others) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Entry& other : others) add(other);
}

std::vector<Stopwatch::Entry> Stopwatch::entries() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return entries_;
}

void writeTimeSheet(const std::vector<Stopwatch::Entry>& entries, std::ostream& out) {
  out << kHeader << '\n';
  for (const Stopwatch::Entry& entry : entries) {
    out << entry.stage << ',' << entry.what << ',' << entry.count << ',' << entry.seconds << '\n';
  }
}

std::vector<Stopwatch::Entry> readTimeSheet(const std::string& file) {
  std::vector<Stopwatch::Entry> entries;
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    Stopwatch::Entry entry;
    const bool good = number == 1 ? line == kHeader : parse(line, &entry);
    if (!good) {
      throw std::runtime_error(file + ":" + std::to_string(number) + ": is not a line of a time sheet (" +
                               kHeader + "): \"" + line + "\"");
    }
    if (number > 1) entries.push_back(entry);
  }
  return entries;
}

}  // namespace sunlit::studio
