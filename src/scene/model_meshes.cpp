#include "scene/model_meshes.h"

#include <stdexcept>

#include "scene/missing_kinds.h"

namespace sunlit::scene {

const std::vector<MeshPart>* ModelMeshes::partsOf(const std::string& uri, const std::string& from_file,
                                                  const std::string& place) {
  const Found found = finder_.find(uri, from_file);
  if (!found.file) {
    if (finder_.missing() == Missing::kStop) {
      throw std::runtime_error(place + ": there is no mesh " + uri + "; " + placesTried(found) +
                               kDrawTheRest);
    }
    builder_.warn(kMissingMeshes, uri + " of " + place);
    return nullptr;
  }
  if (found.other_case) builder_.warn(kSpeltOtherwise, uri + " is " + *found.file);
  if (parts_by_file_.count(*found.file) == 0 && !read(*found.file)) return nullptr;
  return &parts_by_file_.at(*found.file);
}

bool ModelMeshes::read(const std::string& file) {
  try {
    parts_by_file_[file] = readMeshFile(file, {UpAxis::kZ, looks_}, finder_, builder_);
    return true;
  } catch (const image::ContentMissing& error) {
    leaveOut(kMissingMeshes, error, finder_, builder_);
    return false;
  } catch (const std::runtime_error& error) {
    if (finder_.missing() == Missing::kStop) throw;
    builder_.warn("meshes cannot be read and were left out", error.what());
    return false;
  }
}

}  // namespace sunlit::scene
