// A stroke alphabet of our own: each letter is a row of pen lines on a grid 4 wide and 6 high, y down. Pairs
// of digits are points; a blank lifts the pen.
#include <array>
#include <cstring>

#include "scene/race_track/canvas.h"

namespace sunlit::scene::race_track {
namespace {

struct Letter {
  char sign;
  const char* strokes;
};

constexpr Letter kLetters[] = {{'A', "062046 1434"},
                               {'B', "0006364443330300304142330"},
                               {'C', "4130100105163645"},
                               {'D', "00062645412000"},
                               {'E', "40000646 0333"},
                               {'F', "400006 0333"},
                               {'G', "413010010516364543 4323"},
                               {'H', "0006 4046 0343"},
                               {'I', "2026"},
                               {'J', "404536160504"},
                               {'K', "0006 400346"},
                               {'L', "000646"},
                               {'M', "0600234046"},
                               {'N', "06004640"},
                               {'O', "10300141453616050110"},
                               {'P', "06003041423303"},
                               {'Q', "1030414536160501 10 2446"},
                               {'R', "0600304142330323 2346"},
                               {'S', "413010010213334445361605"},
                               {'T', "0040 2026"},
                               {'U', "000516364540"},
                               {'V', "002640"},
                               {'W', "0016233640"},
                               {'X', "0046 4006"},
                               {'Y', "002340 2326"},
                               {'Z', "00400646"},
                               {'0', "1030414536160501 1001 0541"},
                               {'1', "112026 1636"},
                               {'2', "0110304142 420646"},
                               {'3', "0110304142331323 233344453616 1605"},
                               {'4', "36300444"},
                               {'5', "400003334445361605"},
                               {'6', "4130100105163645443303"},
                               {'7', "004016"},
                               {'8', "1030414233130201 1013 1304051636454433 10"},
                               {'9', "4313020110304145361605"},
                               {'-', "1333"},
                               {'.', "2526"},
                               {'/', "0640"},
                               {'+', "1333 2224"},
                               {'!', "2024 2526"},
                               {'>', "014305"}};

constexpr float kAdvance = 5.6f / 6.0f;  // of the height

const char* strokesOf(char sign) {
  for (const Letter& letter : kLetters) {
    if (letter.sign == sign) return letter.strokes;
  }
  return "";
}

}  // namespace

float textWidth(const std::string& letters, float height) {
  return kAdvance * height * letters.size();
}

void Canvas::text(const std::string& letters, const LetterFrame& frame, const Ink& ink) {
  const float width = 1.1f / 6.0f * 0.5f * (frame.right.norm() + frame.down.norm());
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const Pixel corner = frame.corner + kAdvance * static_cast<float>(i) * frame.right;
    std::vector<Pixel> pen;
    for (const char* c = strokesOf(letters[i]); *c != '\0';) {
      if (*c == ' ' || c[1] == '\0') {
        line(pen, width, ink);
        pen.clear();
        ++c;
        continue;
      }
      pen.push_back(corner + ((c[0] - '0') * frame.right + (c[1] - '0') * frame.down) / 6.0f);
      c += 2;
    }
    line(pen, width, ink);
  }
}

void Canvas::text(const std::string& letters, const Pixel& place, float height, const Ink& ink) {
  text(letters, {place, {height, 0.0f}, {0.0f, height}}, ink);
}

}  // namespace sunlit::scene::race_track
