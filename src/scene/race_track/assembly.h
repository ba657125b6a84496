/// Where the parts of the world come together: materials, and triangles sorted into compact meshes.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "scene/race_track/canvas.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene::race_track {

/// What a surface is made of and how it is tinted.
struct Paint {
  int material = 0;
  Color color{1.0f, 1.0f, 1.0f};  ///< multiplies the material's
};

/// The part of a texture that a surface shows, in texture coordinates.
struct PictureRect {
  Eigen::Vector2f top_left{0.0f, 0.0f};
  Eigen::Vector2f bottom_right{1.0f, 1.0f};
};

/// A picture on a sheet that it shares with others, so that few materials are needed.
struct Picture {
  int material = 0;
  PictureRect rect;
};

/// Groups of lamps; what each of the first two gives along its axis, and how large its glass is, which shows
/// as much.
constexpr const char *kStreetLamps = "street_lamps", *kGrandstandLamps = "grandstand",
                     *kWindowLamps = "windows";
inline const LinearRgb kStreetLamp_cd(1500.0f, 1164.0f, 720.0f),
    kGrandstandLamp_cd(1600.0f, 1480.0f, 1250.0f);
constexpr float kStreetLamp_m2 = 0.5f * 0.22f, kGrandstandLamp_m2 = 1.2f * 0.3f;

/// The materials that have no picture of their own; each is tinted by its Paint.
struct Palette {
  int matte = 0;  ///< house paint, plastic
  int satin = 0;  ///< car paint, smooth plastic
  int metal = 0;  ///< galvanised steel
  int concrete = 0;
  int plaster = 0;
  int roof = 0;
  int wood = 0;
  int rubber = 0;
  int glass = 0;
  int street_lamp = 0, grandstand_lamp = 0;  ///< glass that is lit while those lamps burn
  int bark = 0;
  int stone = 0;
  int grass = 0;
  int gravel = 0;
  int cloth = 0;
  int straw = 0;
};

class Assembly {
 public:
  Assembly();

  const Palette& palette() const { return palette_; }
  int addTexture(Texture texture);
  int addMaterial(Material material);
  /// Puts an opaque picture on a sheet.
  Picture addPicture(const Canvas& canvas) { return place(canvas, &pictures_); }
  /// Puts the front of a house on a sheet, with what its windows show while their lamps burn; of one size.
  Picture addFacade(const Canvas& front, const Canvas& lit) { return place(front, &facades_, &lit); }
  /// Puts a picture with holes on a sheet.
  Picture addCutOut(const Canvas& canvas) { return place(canvas, &cut_outs_); }
  /// The same, of something thin that light shines through.
  Picture addLeaves(const Canvas& canvas) { return place(canvas, &leaves_); }
  /// The same, but to be seen from the front only.
  Picture addBlades(const Canvas& canvas) { return place(canvas, &blades_); }

  /// The mesh of that material in which parts near `place` are gathered.
  Mesh& mesh(int material, const Eigen::Vector3f& place);
  void add(Mesh mesh) { whole_.push_back(std::move(mesh)); }
  void addLamp(Lamp lamp) { scene_.lamps.push_back(std::move(lamp)); }
  /// All of it.
  Scene finish(const std::string& name);

 private:
  // Pictures stand side by side on shelves, each about as high as its pictures.
  struct Shelf {
    int y;
    int height;
    int filled;  ///< from the left, px
  };
  struct Sheet {
    const char* name;
    int width_px;
    int height_px;
    bool masked;
    bool double_sided;
    float transmission = 0.0f;
    bool lit = false;  ///< with a second page, for what it shows while lamps of kWindowLamps burn
    int texture = -1;
    int lit_texture = -1;
    int material = -1;
    std::vector<Shelf> shelves{};
  };
  Picture place(const Canvas& canvas, Sheet* sheet, const Canvas* lit = nullptr);
  int addPage(const std::string& name, const Sheet& sheet);
  void copyTo(int texture, const Canvas& canvas, const Eigen::Vector2i& corner);
  void openSheet(Sheet* sheet);
  /// Where a picture of this size goes; opens a shelf or a sheet if need be.
  Shelf* findShelf(Sheet* sheet, int width, int height);

  Scene scene_;
  Sheet pictures_{"pictures", 2048, 1024, false, true};
  Sheet facades_{"facades", 2048, 1024, false, true, 0.0f, true};
  Sheet cut_outs_{"cut-outs", 1536, 1280, true, true};
  // Leaves send on about as much light as they reflect; blades of grass, which stand close, less.
  Sheet leaves_{"leaves", 1728, 1024, true, true, 0.45f};
  Sheet blades_{"blades", 1024, 512, true, false, 0.3f};
  Palette palette_;
  std::vector<Mesh> whole_;                           // added as such
  std::map<std::tuple<int, int, int>, Mesh> meshes_;  // by material and cell
};

}  // namespace sunlit::scene::race_track
