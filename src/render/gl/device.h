/// A context of OpenGL and the thread that it lives on.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "render/gl/function_table.h"
#include "sunlit/render/rasterizer_kind.h"

namespace sunlit::render::gl {

class Device {
 public:
  /// The process's one device of a kind, kOsmesa or kEgl; started by the first that asks for it, and ended
  /// with the last that holds it. Throws std::runtime_error saying why it cannot start.
  static std::shared_ptr<Device> of(RasterizerKind kind);

  explicit Device(RasterizerKind kind);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Runs `work` on the device's thread, in which the context is current, and waits for it. What it throws
  /// comes back. From any thread. False, and nothing was done, once the process ends: drivers take themselves
  /// down then, before the last statics that may draw.
  using Work = std::function<void(const Functions&)>;
  bool run(const Work& work);

  const std::string& renderer() const { return renderer_; }  ///< GL_RENDERER

 private:
  void serve();
  void start();
  void end();

  const RasterizerKind kind_;
  std::string renderer_;
  std::unique_ptr<Context> context_;
  std::unique_ptr<const Functions> functions_;

  std::mutex one_at_a_time_;  ///< held by who waits for work that it gave
  std::mutex mutex_;          ///< of all below
  std::condition_variable changed_;
  const Work* work_ = nullptr;
  std::exception_ptr thrown_;
  bool ends_ = false;
  std::thread thread_;  // last: all above is there when it starts
};

}  // namespace sunlit::render::gl
