#include "render/gl/device.h"

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace sunlit::render::gl {

std::shared_ptr<Device> Device::of(RasterizerKind kind) {
  static std::mutex mutex;
  static std::array<std::weak_ptr<Device>, 2> devices;
  static std::array<bool, 2> ends_with_process{};
  const std::lock_guard<std::mutex> lock(mutex);
  const std::size_t number = kind == RasterizerKind::kOsmesa ? 0 : 1;
  std::shared_ptr<Device> device = devices[number].lock();
  if (device) return device;
  devices[number] = device = std::make_shared<Device>(kind);
  if (!std::exchange(ends_with_process[number], true)) {
    // Registered after the driver's own, so called before it.
    std::atexit([] {
      for (const std::weak_ptr<Device>& last : devices) {
        if (const auto still = last.lock()) still->end();
      }
    });
  }
  return device;
}

Device::Device(RasterizerKind kind) : kind_(kind), thread_([this] { serve(); }) {
  try {
    run([this](const Functions& gl) {
      renderer_ = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    });
  } catch (...) {
    end();
    throw;
  }
}

Device::~Device() {
  end();
}

void Device::end() {
  const std::lock_guard<std::mutex> alone(one_at_a_time_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool Device::run(const Work& work) {
  const std::lock_guard<std::mutex> alone(one_at_a_time_);
  std::unique_lock<std::mutex> lock(mutex_);
  if (ends_) return false;
  work_ = &work;
  changed_.notify_all();
  changed_.wait(lock, [this] { return work_ == nullptr; });
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  return true;
}

void Device::start() {
  switch (kind_) {
#ifdef SUNLIT_HAS_OSMESA
    case RasterizerKind::kOsmesa:
      context_ = makeOsmesaContext();
      break;
#endif
#ifdef SUNLIT_HAS_EGL
    case RasterizerKind::kEgl:
      context_ = makeEglContext();
      break;
#endif
    default:
      throw std::logic_error("no device of OpenGL is called " + nameOf(kind_));
  }
  functions_ = std::make_unique<const Functions>(*context_);
}

void Device::serve() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ends_ || work_; });
    if (ends_) break;
    try {
      if (!functions_) start();
      (*work_)(*functions_);
    } catch (...) {
      thrown_ = std::current_exception();
    }
    work_ = nullptr;
    changed_.notify_all();
  }
  functions_ = nullptr;
  context_ = nullptr;  // by the thread that made it
}

}  // namespace sunlit::render::gl
