/// Lines of text files that hold columns.
#pragma once

#include <string>
#include <vector>

namespace sunlit {

/// Without blanks, tabs and carriage returns at both ends.
std::string trimmed(const std::string& text);

/// Each trimmed; one more than there are commas.
std::vector<std::string> splitAtCommas(const std::string& line);

/// At any number of blanks; none is empty.
std::vector<std::string> splitAtBlanks(const std::string& line);

}  // namespace sunlit
