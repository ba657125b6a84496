/// One kind of input and what reads it. Each file of this folder that is named after a reader defines these.
#pragma once

#include <string>
#include <vector>

namespace sunlit::fuzz {

/// Small inputs that are read without complaint, from which others are made.
std::vector<std::string> seeds();

/// Reads `input` as a user has it read. The current folder is the reader's own, and keeps what it writes
/// there. Throws as the reader does.
void read(const std::string& input);

/// What every refusal says, such as the name of the file; empty: anything.
std::string named();

/// What stands between the files of an input that consists of several.
constexpr const char* kNextFile = "\n=====\n";

/// The files of `input`, `count` of them; empty where it has fewer.
std::vector<std::string> filesOf(const std::string& input, std::size_t count);

/// What is wrong with how `input` was refused, or empty where it was read or refused as it should be: by an
/// error that names what it was, and not for want of memory.
std::string faultOf(const std::string& input);

}  // namespace sunlit::fuzz
