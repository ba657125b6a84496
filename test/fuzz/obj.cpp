// Wavefront OBJ with its materials.
#include "fuzz/reader.h"
#include "fuzz/scene_extras.h"
#include "sunlit/scene/load.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  const std::string materials =
      "newmtl a\nKa 0.1 0.1 0.1\nKd 0.8 0.7 0.6\nKs 0.5 0.5 0.5\nKe 0 0 0.5\nNs 100\nd 0.5\nTr 0.5\nillum 2\n"
      "map_Kd paint.png\nmap_Bump -bm 0.5 paint.png\nnorm paint.png\nmap_d paint.png\n"
      "newmtl b\nKd 1 0 0\nPr 0.4\nPm 0.1\nmap_Ke paint.png\nNi 1.5\n";
  return {
      "mtllib m.mtl\no one\ng part\ns 1\nv 0 0 0\nv 1 0 0\nv 0 1 0 1.0\nv 0 0 1 0.5 0.5 0.5\nvt 0 0\nvt 1 0\n"
      "vt 0 1 0\nvn 0 0 1\nvn 0 1 0\nusemtl a\nf 1/1/1 2/2/1 3/3/1\nf 1//1 2//2 4//1\nusemtl b\nf 1 2 3 4\n"
      "f -1 -2 -3\n" +
          std::string(kNextFile) + materials,
      "# a ring of squares\nmtllib m.mtl\nusemtl a\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1\nf 1 2 3 "
      "4\nf 1 2 "
      "5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nl 1 2\np 1\n" +
          std::string(kNextFile) + materials,
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 1 3\nf 1 2 4\nusemtl nowhere\nf 1 3 4\n"};
}

void read(const std::string& input) {
  layExtras();
  const std::vector<std::string> files = filesOf(input, 2);
  setContent("./input.obj", files[0]);
  setContent("./m.mtl", files[1]);
  requireGood(scene::load("input.obj", {}));
}

std::string named() {
  return "input.obj";
}

}  // namespace sunlit::fuzz
