#include "fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace sunlit::fuzz {
namespace {

struct Piece {
  std::size_t at, size;
};

bool isOfWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' || c == '+';
}

/// Words and numbers; where there are none, single bytes.
std::vector<Piece> wordsOf(const std::string& text) {
  std::vector<Piece> words;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && isOfWord(text[end])) ++end;
    if (end > at) words.push_back({at, end - at});
    at = std::max(end, at + 1);
  }
  return words;
}

bool isNumber(const std::string& text, const Piece& word) {
  const char first = text[word.at];
  return std::isdigit(static_cast<unsigned char>(first)) != 0 || first == '-' || first == '.';
}

const std::array<const char*, 26> kNumbers = {"nan",
                                              "inf",
                                              "-inf",
                                              "0",
                                              "-0",
                                              "-1",
                                              "1",
                                              "2",
                                              "0.5",
                                              "1e-320",
                                              "1e-30",
                                              "1e30",
                                              "1e308",
                                              "-1e308",
                                              "1e999",
                                              "255",
                                              "65536",
                                              "1000000",
                                              "2147483647",
                                              "2147483648",
                                              "-2147483648",
                                              "4294967295",
                                              "4294967296",
                                              "9223372036854775807",
                                              "-9223372036854775808",
                                              "18446744073709551615"};

/// As files hold them in four bytes or eight.
const std::array<std::uint64_t, 12> kWholes = {0,
                                               1,
                                               0xFF,
                                               0xFFFF,
                                               0x7FFFFFFF,
                                               0x80000000,
                                               0xFFFFFFFF,
                                               0x7FC00000,
                                               0x7F800000,
                                               0x7FFFFFFFFFFFFFFF,
                                               0x8000000000000000,
                                               0xFFFFFFFFFFFFFFFF};

void slipOfWord(std::string& text, const std::vector<std::string>& others, Dice& dice) {
  const std::vector<Piece> words = wordsOf(text);
  if (words.empty()) return;
  const Piece one = words[dice.below(words.size())], other = words[dice.below(words.size())];
  const std::string copy = text.substr(other.at, other.size);
  switch (dice.below(5)) {
    case 0:  // taken for another
      text.replace(one.at, one.size, copy);
      break;
    case 1:
      text.erase(one.at, one.size);
      break;
    case 2:
      text.insert(one.at, copy + " ");
      break;
    case 3: {  // all from one to the other, twice
      const std::size_t from = std::min(one.at, other.at), to = std::max(one.at, other.at) + 1;
      text.insert(to, text.substr(from, to - from));
      break;
    }
    default: {
      const std::string& source = others[dice.below(others.size())];
      const std::vector<Piece> theirs = wordsOf(source);
      if (theirs.empty()) return;
      const Piece taken = theirs[dice.below(theirs.size())];
      text.replace(one.at, one.size, source, taken.at, taken.size);
    }
  }
}

void slipOfNumber(std::string& text, Dice& dice) {
  std::vector<Piece> numbers;
  for (const Piece& word : wordsOf(text)) {
    if (isNumber(text, word)) numbers.push_back(word);
  }
  if (numbers.empty()) return;
  const Piece one = numbers[dice.below(numbers.size())];
  text.replace(one.at, one.size, kNumbers[dice.below(kNumbers.size())]);
}

void slipOfBytes(std::string& text, Dice& dice) {
  const std::size_t at = dice.below(text.size());
  const std::size_t size = 1 + dice.below(std::min<std::size_t>(text.size() - at, 64));
  switch (dice.below(5)) {
    case 0:
      text[at] = static_cast<char>(text[at] ^ (1 << dice.below(8)));
      break;
    case 1:
      text[at] = static_cast<char>(dice.below(256));
      break;
    case 2:
      text.erase(at, size);
      break;
    case 3:
      text.insert(at, text.substr(dice.below(text.size()), size));
      break;
    default: {
      std::uint64_t whole = kWholes[dice.below(kWholes.size())];
      const std::size_t bytes = dice.below(2) == 0 ? 4 : 8;
      for (std::size_t i = at; i < std::min(at + bytes, text.size()); ++i, whole >>= 8)
        text[i] = static_cast<char>(whole & 0xFF);
    }
  }
}

void slipOfParts(std::string& text, const std::vector<std::string>& others, Dice& dice) {
  const std::size_t at = dice.below(text.size());
  const std::string& source = others[dice.below(others.size())];
  if (dice.below(2) == 0) {
    text.resize(at);
  } else if (!source.empty()) {
    text = text.substr(0, at) + source.substr(std::min(at, source.size() - 1));
  }
}

}  // namespace

std::uint64_t Dice::roll() {
  std::uint64_t z = state_ += 0x9E3779B97F4A7C15;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return z ^ (z >> 31);
}

std::string mutated(std::string input, const std::vector<std::string>& others, Dice& dice) {
  for (std::size_t slips = 1 + dice.below(6); slips > 0 && !input.empty(); --slips) {
    const std::size_t kind = dice.below(16);
    if (kind < 6) {
      slipOfNumber(input, dice);
    } else if (kind < 11) {
      slipOfWord(input, others, dice);
    } else if (kind < 15) {
      slipOfBytes(input, dice);
    } else {
      slipOfParts(input, others, dice);
    }
  }
  return input;
}

}  // namespace sunlit::fuzz
