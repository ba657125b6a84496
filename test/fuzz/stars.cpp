// Star catalogues: places, and types.
#include "fuzz/reader.h"
#include "sunlit/astronomy/star_catalogue.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  return {
      std::string("# places\n-16.7161 6.7525 -1.46 \"Sirius\" 2491\n-52.6958 6.3992 -0.72 \"Canopus\" 2326\n"
                  "19.1825 14.2612 -0.04\n") +
      kNextFile + "Sirius,1.767,-,-1.46,A1\nCanopus,1.675,-,-0.72,F0\n,3.7335,-,-0.04,K1\n"};
}

void read(const std::string& input) {
  const std::vector<std::string> files = filesOf(input, 2);
  setContent("./input.places", files[0]);
  setContent("./input.types", files[1]);
  astronomy::readStarCatalogue({"input.places", "input.types"});
}

std::string named() {
  return "input.";
}

}  // namespace sunlit::fuzz
