/// A scene as bytes, to be read again by the same build of the program on the same kind of machine.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "sunlit/scene/scene.h"
#include "sunlit/scene/shape.h"

namespace sunlit::scene {

/// Takes bytes in the order in which they come.
using ByteSink = std::function<void(const void* data, std::size_t size)>;

void writeBytes(const FlatScene& flat, const ByteSink& sink);

/// What surfaces and lamps look like, apart from their shapes, and whatever they and their files are called.
void writeLooks(const Scene& scene, const ByteSink& sink);

/// What writeBytes() wrote, all of it. Throws std::runtime_error where the bytes end too soon or go on behind
/// it; whether they are those that were written is the caller's to know. Texels and the shape stay where they
/// are if there is an `owner`, which keeps them there unchanged, and are copied if it is null. With an owner
/// `data` lies at a multiple of image::kKeptAlignment.
FlatScene flatSceneOf(const std::byte* data, std::size_t size,
                      std::shared_ptr<const image::FileBytes> owner = nullptr);

}  // namespace sunlit::scene
