#include "scene/sdf_files.h"

#include <cstring>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <regex>
#include <sdf/Exception.hh>
#include <sdf/Frame.hh>
#include <sdf/Link.hh>
#include <sdf/World.hh>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "scene/missing_kinds.h"
#include "scene/sdf_console.h"
#include "scene/sdf_library.h"
#include "scene/sdf_mend.h"
#include "scene/sdf_model_folder.h"
#include "scene/sdf_parse.h"
#include "scene/sdf_pose.h"
#include "scene/sdf_state.h"
#include "scene/sdf_urdf.h"
#include "scene/sdf_xml.h"
#include "sunlit/quantity/range.h"

namespace sunlit::scene {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

/// Of a file, with all that it includes: files that include each other twice double it at each level, and
/// libsdformat takes a millisecond for each.
constexpr std::size_t kMostModels = 20000;

/// As many missing models as a person reads of.
constexpr std::size_t kNamed = 5;

/// One line about the first of `errors`.
[[noreturn]] void fail(const std::string& file, const sdf::Error& error,
                       const std::vector<std::string>& printed) {
  std::ostringstream text;
  text << file;
  if (const std::optional<int> line = lineOf(error)) text << ":" << *line;
  text << ": " << error.Message();
  if (!printed.empty()) text << " (" << printed.front() << ")";
  throw std::runtime_error(text.str());
}

/// One of libsdformat's remarks, with others that differ from it in what stands in brackets alone.
void remark(const std::string& line, SceneBuilder& builder) {
  static const std::regex bracketed("\\[[^\\]]*\\]");
  const std::string kind = std::regex_replace(line, bracketed, "[…]");
  if (kind == line) {
    builder.count("× libsdformat: " + line);
  } else {
    builder.warn("× libsdformat: " + kind, line);
  }
}

/// Each element below `parent` but those within includes, which may be taken out with their includes, and
/// within what is taken out of `sdf`, the root element.
void forEachThatRemains(XMLElement& parent, const XMLElement& sdf,
                        const std::function<void(XMLElement&)>& use) {
  for (XMLElement* child : childrenOf(parent)) {
    use(*child);
    if (std::string(child->Value()) != "include" && !isTakenOut(*child, sdf))
      forEachThatRemains(*child, sdf, use);
  }
}

/// A pose as text that reads back as the same numbers.
void write(const ignition::math::Pose3d& pose, XMLElement& element) {
  std::ostringstream text;
  text << std::setprecision(17) << pose.Pos() << ' ' << pose.Rot().X() << ' ' << pose.Rot().Y() << ' '
       << pose.Rot().Z() << ' ' << pose.Rot().W();
  element.SetAttribute("rotation_format", "quat_xyzw");
  element.SetText(text.str().c_str());
}

/// What an include does not say its model says, which libsdformat 12 overlooks in interface models.
void fillIn(XMLElement& include, const SdfFile& source) {
  const sdf::Model& model = *modelOf(source.root);
  if (childText(include, "name").empty()) childIn(include, "name").SetText(model.Name().c_str());
  if (include.FirstChildElement("pose") == nullptr) write(model.RawPose(), childIn(include, "pose"));
  if (include.FirstChildElement("placement_frame") == nullptr && !source.placement_frame.empty())
    childIn(include, "placement_frame").SetText(source.placement_frame.c_str());
  for (XMLElement* plugin : childrenOf(include, "plugin")) include.DeleteChild(plugin);
}

/// libsdformat 12 merges no interface models, so that the model is nested, under a name by which it is known
/// again, and its parent has a frame wherever the model has a link, frame or model: what is written in the
/// parent finds them there. A name that the parent has, too, remains the parent's.
void merge(XMLElement& include, const SdfFile& source, const std::string& place, SceneBuilder& builder) {
  XMLElement& parent = *include.Parent()->ToElement();
  std::set<std::string> taken;
  for (const XMLElement* child : childrenOf(parent)) {
    const std::string kind = child->Value();
    if (kind == "include" && !child->BoolAttribute("merge")) taken.insert(childText(*child, "name"));
    if (kind == "model" || kind == "link" || kind == "frame" || kind == "joint")
      taken.insert(attributeOf(*child, "name"));
  }
  // As mendSdf() would have it, so that it remains.
  std::string name = kMergedPrefix + childText(include, "name");
  for (std::size_t at = name.find("::"); at != std::string::npos; at = name.find("::"))
    name.replace(at, 2, "_");
  while (taken.count(name) == 1) name += "-";
  childIn(include, "name").SetText(name.c_str());
  std::set<std::string> added;
  const auto add = [&](const std::string& part) {
    if (isMerged(part) || standsForIncluded(part)) return;  // these have their own frames
    if (!added.insert(part).second) return;
    if (taken.count(part) == 1) {
      builder.warn(
          "names of merged models are taken where they are included, they mean what is written there",
          part + " of " + place);
      return;
    }
    XMLElement& frame = newChildIn(parent, "frame");
    frame.SetAttribute("name", part.c_str());
    frame.SetAttribute("attached_to", (name + "::" + part).c_str());
  };
  const sdf::Model& model = *modelOf(source.root);
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) add(model.LinkByIndex(i)->Name());
  for (std::uint64_t i = 0; i < model.FrameCount(); ++i) add(model.FrameByIndex(i)->Name());
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) add(model.ModelByIndex(i)->Name());
  for (const SdfFile::Included& one : source.included) {
    if (one.within == model.Name()) add(one.name);
  }
}

}  // namespace

bool isMerged(const std::string& full_name) {
  const std::size_t scope = full_name.rfind("::");
  return full_name.compare(scope == std::string::npos ? 0 : scope + 2, std::strlen(kMergedPrefix),
                           kMergedPrefix) == 0;
}

std::string withoutMerged(const std::string& full_name) {
  std::string kept;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 2) {
    end = full_name.find("::", begin);
    const std::string name = full_name.substr(begin, end == std::string::npos ? end : end - begin);
    if (!isMerged(name)) kept += (kept.empty() ? "" : "::") + name;
  }
  return kept;
}

const SdfFile& SdfFiles::read(const std::string& file) {
  const SdfFile& read = open(file);
  if (missing_.empty()) return read;
  std::ostringstream text;
  text << missing_.begin()->second << ": there is no ";
  std::size_t named = 0;
  for (const auto& [uri, place] : missing_) {
    if (named == kNamed) {
      text << " … (" << missing_.size() << " in all)";
      break;
    }
    text << (named++ == 0 ? "" : ", ") << uri;
  }
  text << "; looked for in " << finder_.rootsOf(missing_.begin()->first) << kDrawTheRest;
  throw std::runtime_error(text.str());
}

const SdfFile& SdfFiles::open(const std::string& path) {
  const auto known = files_.find(path);
  if (known != files_.end()) return *known->second;
  std::unique_ptr<tinyxml2::XMLDocument> document = readSdfXml(path);
  if (isUrdf(*document)) document = sdfOfUrdf(*document, path, finder_, builder_);
  auto file = std::make_unique<SdfFile>();
  file->path = path;
  open_.insert(path);
  XMLElement& sdf = *document->FirstChildElement("sdf");
  keepFirstWorld(sdf, path, builder_);
  file->state = takeState(sdf);
  resolveIncludes(sdf, *file);
  mendSdf(sdf, path, builder_);
  parse(*document, *file);
  open_.erase(path);
  return *(files_[path] = std::move(file));
}

void SdfFiles::resolveIncludes(XMLElement& sdf, SdfFile& file) {
  std::vector<XMLElement*> includes;
  forEachThatRemains(sdf, sdf, [&](XMLElement& element) {
    if (std::string(element.Value()) == "include") includes.push_back(&element);
    if (std::string(element.Value()) == "model") ++file.models;
  });
  for (XMLElement* include : includes) resolveInclude(*include, file);
}

/// Puts a token into the place of the address, or a light into that of the include, or takes it out.
void SdfFiles::resolveInclude(XMLElement& include, SdfFile& file) {
  const SdfFile* found = included(include, file);
  tinyxml2::XMLNode& parent = *include.Parent();
  for (XMLElement* parameters : childrenOf(include, "experimental:params")) {
    builder_.warn("includes have <experimental:params>, their models are drawn as they are without them",
                  childText(include, "uri") + " at " + placeOf(file.path, include));
    include.DeleteChild(parameters);
  }
  if (found != nullptr && modelOf(found->root) != nullptr) {
    file.models += found->models;
    if (file.models > kMostModels)
      throw std::runtime_error(refusal(placeOf(file.path, include) + ": the number of models up to here",
                                       std::to_string(file.models),
                                       "from 0 to " + std::to_string(kMostModels)));
    fillIn(include, *found);
    if (include.BoolAttribute("merge") && std::string(parent.Value()) == "model")
      merge(include, *found, placeOf(file.path, include), builder_);
    include.DeleteAttribute("merge");
    childIn(include, "uri").SetText((kSdfToken + std::to_string(by_token_.size())).c_str());
    by_token_.push_back(found);
    return;
  }
  const sdf::Light* light = found == nullptr ? nullptr : lightOf(found->root);
  if (light != nullptr) {
    tinyxml2::XMLDocument source;
    source.Parse(light->Element()->ToString("").c_str());
    XMLElement* copy = source.FirstChildElement()->DeepClone(include.GetDocument())->ToElement();
    const std::string name = childText(include, "name");
    if (!name.empty()) copy->SetAttribute("name", name.c_str());
    if (const XMLElement* pose = include.FirstChildElement("pose")) {
      if (XMLElement* own = copy->FirstChildElement("pose")) copy->DeleteChild(own);
      copy->InsertEndChild(pose->DeepClone(include.GetDocument()));
    }
    parent.InsertAfterChild(&include, copy);
  } else if (found != nullptr) {
    builder_.warn("includes were left out, there is no model in them",
                  childText(include, "uri") + " at " + placeOf(file.path, include));
  }
  parent.DeleteChild(&include);
}

/// Null, after a warning or a note of what is missing, where there is nothing.
const SdfFile* SdfFiles::included(const XMLElement& include, const SdfFile& file) {
  const std::string uri = childText(include, "uri");
  const std::string place = placeOf(file.path, include);
  if (uri.empty()) {
    builder_.warn("includes were passed over, they have no address", place);
    return nullptr;
  }
  const Found found = finder_.find(uri, file.path, Wanted::kModel);
  const std::string path = found.file ? modelFileOf(*found.file) : "";
  if (path.empty()) {
    if (finder_.missing() == Missing::kStop) {
      missing_.emplace(uri, place);
    } else {
      builder_.warn(kMissingModels, uri);
      builder_.warn("Models were looked for in " + finder_.rootsOf(uri));
    }
    return nullptr;
  }
  if (found.other_case) builder_.warn(kSpeltOtherwise, uri + " is " + *found.file);
  if (open_.count(path) == 1) throw std::runtime_error(place + ": " + path + " includes itself here");
  try {
    return &open(path);
  } catch (const image::ContentMissing& error) {
    leaveOut(kMissingModels, error, finder_, builder_);
    return nullptr;
  } catch (const std::runtime_error& error) {
    if (finder_.missing() == Missing::kStop) throw;
    open_.erase(path);
    builder_.warn("models cannot be read and were left out", error.what());
    return nullptr;
  }
}

void SdfFiles::parse(tinyxml2::XMLDocument& document, SdfFile& file) {
  const SdfConsole console;
  sdf::Errors errors;
  try {
    errors = loadRoot(document, by_token_, file);
  } catch (const sdf::Exception& error) {  // which is no std::exception
    throw std::runtime_error(file.path + ": libsdformat gives up: " + error.GetErrorStr());
  } catch (const std::exception& error) {
    throw std::runtime_error(file.path + ": libsdformat gives up: " + error.what());
  }
  const std::vector<std::string> printed = console.lines();
  for (const std::string& error : console.errors()) errors.emplace_back(sdf::ErrorCode::STRING_READ, error);
  if (!errors.empty()) fail(file.path, errors.front(), printed);
  for (const std::string& line : printed) remark(line, builder_);
}

}  // namespace sunlit::scene
