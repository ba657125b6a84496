/// Puts a Scene together from what the importers find.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/texture_alpha.h"
#include "scene/triangle_budget.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// How a material's cut-outs are told.
enum class AlphaRule {
  kDeclared,     ///< the file says so
  kFromTexture,  ///< the file's format cannot say: cut out if the texture has a considerable transparent
                 ///< share
  kNotAskedFor,  ///< the format could, and the file does not: cut out where nothing is painted beneath, else
                 ///< opaque, and named
};

/// How a material's normal map is taken.
enum class NormalsRule {
  kDeclared,      ///< the file says that it is one
  kMaybeHeights,  ///< the file's format has one word for maps of normals and of heights
};

/// px. A larger texture shows nothing that a camera could see, and takes its memory: 8192² texels with their
/// smaller copies are 0.36 GB.
constexpr int kLongestTextureSide = 8192;

/// Kinds of warnings that several importers have.
constexpr const char* kMissingTextures = "textures are missing, neutral ones take their place";
constexpr const char* kNotRendered = "features of materials are not rendered";
constexpr const char* kPicturesOfGazebo =
    "materials have a picture that comes with Gazebo, a colour like it takes its place";
constexpr const char* kOtherLights =
    "lights that are no points and no spots were not read: the sky takes their place";
constexpr const char* kDarkLights =
    "lights were left out: their colour and intensity must be at least 0, their range, angle, direction and "
    "attenuation above 0, and all finite";
constexpr const char* kSpeltOtherwise = "files are spelt otherwise on disk";

/// Whether what a file says of a lamp makes one; else it is among kDarkLights.
bool canShine(const Lamp& lamp);

/// "; " before each of the warnings of a scene in which there is nothing: why that is so.
std::string reasonsOf(const std::vector<std::string>& warnings);

/// How a texture goes on to the sides, and up and down, and whether its texels are squares with nothing
/// blended between them.
struct Wraps {
  Wrap u = Wrap::kRepeat, v = Wrap::kRepeat;
  bool squares = false;
};

/// A picture of how opaque another is.
struct OpacityPicture {
  std::string file = {};         ///< empty: there is none
  bool is_transparency = false;  ///< it says how much is lacking
  bool of_colors = false;        ///< its alpha does not count
  float share = 1.0f;            ///< 0 … 1, of what it says
};

class SceneBuilder {
 public:
  explicit SceneBuilder(const std::string& name) { scene_.name = name; }

  /// Index of the texture in `file`, by the opacity of another picture if there is one (image::coveredBy()),
  /// then white if there is no `file`; the same for the same files and wraps. It is decoded in finish().
  int textureFromFile(const std::string& file, const Wraps& wraps = {}, const OpacityPicture& opacity = {});
  /// Index of a texture inside another file, known as `name`; the same for the same name and wraps.
  int textureFromBytes(const std::string& name, std::vector<std::uint8_t> bytes, const Wraps& wraps = {});

  int addMaterial(const Material& material, AlphaRule alpha, NormalsRule normals = NormalsRule::kDeclared);
  /// The same, but invisible from behind; the same one each time.
  int oneSided(int material);
  /// The same, but to be seen from either side; the same one each time.
  int twoSided(int material);
  enum class Faces { kOne, kTwo };  ///< that a ray meets on its way through a shape
  /// The same, but there by a share of `opacity`, 0 … 1, of all faces of a shape together; the same one each
  /// time for the same. Glass stays as clear as it is.
  int veiled(int material, float opacity, Faces faces);
  const Material& material(int index) const { return scene_.materials.at(static_cast<std::size_t>(index)); }

  /// `mesh` moved by `map_from_mesh`, without its broken triangles (counted for a warning of finish()).
  /// Throws as TriangleBudget::take().
  void addMesh(const Mesh& mesh, const Eigen::Affine3d& map_from_mesh);
  /// The same of a piece of a file. Where something is to be seen through it, a triangle that another stands
  /// back to back with and looks like (pairsFrom()) becomes one of two sides with it: light crosses one
  /// sheet.
  void addPiece(const Mesh& mesh, const Eigen::Affine3d& map_from_mesh);

  /// Not one that is too far away, which is counted for a warning of finish().
  void addLamp(Lamp lamp);

  std::size_t lampCount() const { return scene_.lamps.size(); }
  std::size_t meshCount() const { return scene_.meshes.size(); }

  /// Adds a line to Scene::warnings, once for equal lines.
  void warn(const std::string& line);
  /// One line for all of one kind, however many: "<count> <what>: <the first few of where>", of different
  /// subjects, which stand before ": ", if there are such. Equal ones count once. `what` is in the plural and
  /// says what was made of it: "textures are missing, a neutral grey takes their place".
  void warn(const std::string& what, const std::string& where);
  /// The same where equal ones count each; "<count> <what>" where none is named.
  void count(const std::string& what, const std::string& where = "");

  /// Decodes the textures, settles the cut-outs and checks the scene. A texture with a side of more than
  /// kLongestTextureSide is scaled down, one that cannot be decoded makes room for a neutral grey, and a
  /// normal map that is all grey, or may be one of heights and looks like no normals, is dropped; a mesh
  /// without texture coordinates has the mean colour of its picture; all are warnings. The builder is empty
  /// afterwards.
  Scene finish();

 private:
  struct TextureSource {
    std::string name;                 ///< path of the file, unless `bytes`; empty: white
    std::vector<std::uint8_t> bytes;  ///< of an embedded picture
    bool embedded = false;
    Wraps wraps = {};
    OpacityPicture opacity = {};  ///< without a file: its own
  };
  /// A texture as decoded, and the size that its file has if that is another.
  struct Decoded {
    Texture texture;
    std::string size_in_file, lost_opacity;  ///< the latter: why it cannot be decoded
    bool blended = false;                    ///< although its texels were to be squares
  };
  struct Kind {
    std::size_t times = 0;
    std::vector<std::string> examples;
    std::set<std::string> known;
  };
  int addTexture(const std::string& key, TextureSource source);
  static Decoded decoded(const TextureSource& source);
  void repairCoordinates(const std::string& mesh, std::vector<Eigen::Vector2f>& coordinates);
  void decodeTextures();
  void forgetTexture(int texture);
  void settleAlpha();
  void settleByTexture(AlphaRule rule, AlphaMeans means, Material* material);
  void dropHeights();
  void paintByMeans();
  bool hasMaps(int material);
  void joinPairs();

  Scene scene_;
  TriangleBudget budget_;
  std::vector<TextureSource> sources_;
  std::map<std::pair<std::string, int>, int> texture_by_key_;  ///< by name and wraps
  std::vector<AlphaRule> alpha_rules_;                         ///< of each material
  std::vector<NormalsRule> normals_rules_;                     ///< of each material
  std::map<int, int> one_sided_;                               ///< of materials that are not
  std::map<int, int> two_sided_;                               ///< of materials that are not
  std::vector<std::size_t> pairs_;                             ///< meshes from pairsFrom()
  std::map<std::tuple<int, float, Faces>, int> veiled_;        ///< by material, opacity and faces
  std::map<std::string, Kind> kinds_;
};

}  // namespace sunlit::scene
