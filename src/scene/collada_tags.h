/// Tags of COLLADA as they stand in its text, for what is mended before Assimp reads it.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace sunlit::scene {

/// Calls use(name, tag, at) for each tag that opens an element.
void forEachTag(
    const std::string& text,
    const std::function<void(const std::string& name, const std::string& tag, std::size_t at)>& use);

/// Where the value of an attribute stands in its tag, and how long it is; nowhere, and 0, where there is
/// none.
std::pair<std::size_t, std::size_t> placeInTag(const std::string& tag, const std::string& attribute);

/// By their places in a text that stays as it is meanwhile: how much goes there, and what comes.
using TextChanges = std::map<std::size_t, std::pair<std::size_t, std::string>>;

/// `text` with them, but for those within what others take away.
std::string changed(const std::string& text, const TextChanges& changes);

/// Up to the next tag.
std::string contentBehind(std::size_t at, const std::string& text);

/// Of an address within the file.
std::string withoutHash(const std::string& address);

/// Empty where there is none.
std::string valueInTag(const std::string& tag, const std::string& attribute);

}  // namespace sunlit::scene
