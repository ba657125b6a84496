#include "scene/collada_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "scene/sdf_xml.h"

namespace sunlit::scene {
namespace {

using tinyxml2::XMLElement;

constexpr std::uint64_t kMostNodes = 1000000;  ///< once instances stand for what they are instances of
constexpr std::uint64_t kLargest = 0x7FFFFFFF;

bool is(const XMLElement& element, const char* name) {
  return std::strcmp(element.Value(), name) == 0;
}

std::vector<XMLElement*> below(XMLElement& parent, const char* name) {
  std::vector<XMLElement*> found;
  forEachBelow(parent, [&](XMLElement& element) {
    if (is(element, name)) found.push_back(&element);
  });
  return found;
}

/// Its first text, as Assimp reads it.
const char* textIn(const XMLElement& element) {
  for (const tinyxml2::XMLNode* child = element.FirstChild(); child != nullptr;
       child = child->NextSibling()) {
    if (child->ToText() != nullptr) return child->Value();
  }
  return "";
}

/// What an address of this file, "#id", means.
std::string idOf(const std::string& address) {
  return address.empty() || address[0] != '#' ? address : address.substr(1);
}

/// What one source tells, or several of one name.
struct Source {
  std::uint64_t values = std::numeric_limits<std::uint64_t>::max();  ///< in its array: the fewest
  std::uint64_t needed = 0;                                          ///< by its accessor, of those
  std::uint64_t count = 0;                                           ///< of the accessor: the most
  std::uint64_t parameters = 0;                                      ///< of the accessor
  bool is_text = false;
};

class Check {
 public:
  Check(const std::string& file, XMLElement& root) : file_(file), root_(root) {}

  void run() {
    for (const char* name : {"float_array", "Name_array", "IDREF_array"}) {
      for (XMLElement* array : below(root_, name)) readArray(*array);
    }
    for (XMLElement* source : below(root_, "source")) {
      for (XMLElement* accessor : below(*source, "accessor")) readAccessor(*source, *accessor);
    }
    for (XMLElement* mesh : below(root_, "mesh")) checkMesh(*mesh);
    for (XMLElement* skin : below(root_, "skin")) checkSkin(*skin);
    for (XMLElement* effect : below(root_, "effect")) checkParameters(*effect);
    for (const XMLElement* skew : below(root_, "skew"))  // which it asserts not to meet
      fail(*skew, "is not read: export the node with a <matrix>");
    for (XMLElement* image : below(root_, "image")) {
      for (const XMLElement* address : below(*image, "init_from"))  // which it asserts to have a letter
        if (address->GetText() == nullptr && address->NoChildren())
          fail(*address, "is empty: name a picture there, or leave out the image");
    }
    checkNodes();
  }

 private:
  [[noreturn]] void fail(const XMLElement& element, const std::string& wrong) const {
    throw std::runtime_error(placeOf(file_, element) + ": <" + element.Value() + ">: " + wrong);
  }

  /// 0 … kLargest.
  std::uint64_t whole(const XMLElement& element, const char* name, std::uint64_t usual) const {
    const char* const text = element.Attribute(name);
    if (text == nullptr) return usual;
    const std::string digits = text;
    const bool is_whole =
        !digits.empty() && digits.size() <= 10 && digits.find_first_not_of("0123456789") == std::string::npos;
    const std::uint64_t value = is_whole ? std::stoull(digits) : kLargest + 1;
    if (value > kLargest)
      fail(element,
           std::string(name) + " is '" + text + "', but must be a whole number from 0 to 2147483647");
    return value;
  }

  /// Whole numbers between blanks. Assimp takes those below 0 for 0.
  std::vector<std::uint64_t> indices(const XMLElement& element) const {
    std::vector<std::uint64_t> found;
    for (const char* at = textIn(element); *at != '\0';) {
      if (std::strchr(" \t\r\n\f", *at) != nullptr) {
        ++at;
        continue;
      }
      const bool is_negative = *at == '-';
      if (is_negative) ++at;
      std::uint64_t value = 0;
      const char* const begin = at;
      for (; *at >= '0' && *at <= '9'; ++at) value = std::min(kLargest + 1, 10 * value + (*at - '0'));
      if (at == begin || value > kLargest || (*at != '\0' && std::strchr(" \t\r\n\f", *at) == nullptr))
        fail(element, "holds what is no whole number from 0 to 2147483647 behind " +
                          std::to_string(found.size()) + " others");
      found.push_back(is_negative ? 0 : value);
    }
    return found;
  }

  void readArray(const XMLElement& array) {
    Source source;
    source.values = whole(array, "count", 0);
    source.is_text = !is(array, "float_array");
    if (source.values > std::strlen(textIn(array)))
      fail(array, "count is " + std::to_string(source.values) + ", but fewer stand there");
    const std::string id = attributeOf(array, "id");
    if (const auto known = arrays_.find(id); known != arrays_.end()) {
      if (known->second.is_text != source.is_text)
        fail(array, "'" + id + "' is the name of another array, too");
      source.values = std::min(source.values, known->second.values);
    }
    arrays_[id] = source;
  }

  void readAccessor(const XMLElement& parent, XMLElement& accessor) {
    Source& source = sources_[attributeOf(parent, "id")];
    const std::uint64_t count = whole(accessor, "count", 0), stride = whole(accessor, "stride", 1),
                        offset = whole(accessor, "offset", 0);
    const std::vector<XMLElement*> parameters = below(accessor, "param");
    std::uint64_t size = 1;  // of an element; matrices are one parameter
    for (const XMLElement* parameter : parameters)
      size = std::max(size, attributeOf(*parameter, "type") == "float4x4" ? 16 : parameters.size());
    source.parameters = std::max<std::uint64_t>(source.parameters, size);
    source.count = std::max(source.count, count);
    if (count > 0) source.needed = std::max(source.needed, offset + (count - 1) * stride + size);
    const std::string array = idOf(attributeOf(accessor, "source"));
    const auto known = arrays_.find(array);
    if (known == arrays_.end()) return;  // Assimp says so
    source.values = std::min(source.values, known->second.values);
    source.is_text |= known->second.is_text;
    if (source.needed > source.values) {
      fail(accessor, "reaches to value " + std::to_string(source.needed) + " of '" + array + "', which has " +
                         std::to_string(source.values));
    }
  }

  /// A source of numbers that `input` may name; nothing where there is none, which Assimp finds.
  std::optional<Source> sourceOf(const XMLElement& input) const {
    const auto found = sources_.find(idOf(attributeOf(input, "source")));
    return found == sources_.end() ? std::nullopt : std::optional<Source>(found->second);
  }

  void checkInput(const XMLElement& input) const {
    const std::string semantic = attributeOf(input, "semantic");
    if (attributeOf(input, "source").empty()) fail(input, "has no source");
    whole(input, "offset", 0);
    whole(input, "set", 0);
    const std::optional<Source> source = sourceOf(input);
    if (semantic == "VERTEX" || !source) return;
    if (source->is_text) fail(input, "its source holds words, but must hold numbers");
    if (source->parameters > (semantic == "COLOR" ? 4 : 16))
      fail(input, "its source has " + std::to_string(source->parameters) + " numbers an element");
  }

  void checkMesh(XMLElement& mesh) const {
    std::size_t positions = 0;
    for (XMLElement* input : below(mesh, "input")) {
      checkInput(*input);
      positions += attributeOf(*input, "semantic") == "POSITION" ? 1 : 0;
    }
    for (const char* kind :
         {"triangles", "polylist", "polygons", "tristrips", "trifans", "lines", "linestrips"}) {
      for (XMLElement* primitive : below(mesh, kind)) {
        const std::vector<XMLElement*> parts = below(*primitive, "p");
        checkNumberOf(parts, *primitive);
        if (parts.empty()) continue;
        if (positions != 1) {
          fail(*primitive,
               "its mesh has " + std::to_string(positions) + " inputs of POSITION, but must have one");
        }
        checkPrimitive(*primitive, parts);
      }
    }
  }

  /// Assimp, as Debian builds it, ends the process where it does not find as many primitives as are counted.
  void checkNumberOf(const std::vector<XMLElement*>& parts, const XMLElement& primitive) const {
    const std::uint64_t count = whole(primitive, "count", 0);
    const bool is_one = is(primitive, "triangles") || is(primitive, "polylist");
    const std::uint64_t wanted = is_one ? std::min<std::uint64_t>(count, 1) : count;
    if ((is_one || is(primitive, "polygons")) && parts.size() != wanted && (count > 0 || !is_one))
      fail(primitive, "count is " + std::to_string(count) + ", for which there must be " +
                          std::to_string(wanted) + " <p>, and there are " + std::to_string(parts.size()));
  }

  void checkPrimitive(XMLElement& primitive, const std::vector<XMLElement*>& parts) const {
    const std::uint64_t count = whole(primitive, "count", 0);
    std::uint64_t per_corner = 1;
    bool has_corners = false;
    for (XMLElement* input : below(primitive, "input")) {
      per_corner = std::max(per_corner, whole(*input, "offset", 0) + 1);
      has_corners |= attributeOf(*input, "semantic") == "VERTEX";
      if (input->GetLineNum() > parts[0]->GetLineNum()) fail(*input, "stands behind the <p> that it is for");
    }
    if (!has_corners) fail(primitive, "has no input of VERTEX");
    const std::uint64_t least = is(primitive, "tristrips") ? 3 : is(primitive, "linestrips") ? 2 : 0;
    std::uint64_t all = 0;
    for (const XMLElement* part : parts) {
      const std::uint64_t corners = count == 0 ? 0 : indices(*part).size() / per_corner;
      all += corners;
      if (corners < least)
        fail(*part, "has " + std::to_string(corners) + " corners, but must have " + std::to_string(least) +
                        " or more");
    }
    // Memory is taken for what is counted.
    if (count > all)
      fail(primitive,
           "count is " + std::to_string(count) + ", but its <p> have " + std::to_string(all) + " corners");
    checkCounts(primitive, {count, all}, *parts[0]);
  }

  struct Sizes {
    std::uint64_t primitives, corners;
  };
  /// Of corners of each polygon.
  void checkCounts(XMLElement& primitive, const Sizes& sizes, const XMLElement& first) const {
    const std::vector<XMLElement*> lists = below(primitive, "vcount");
    if (is(primitive, "polylist") && sizes.primitives > 0 &&
        (lists.size() != 1 || indices(*lists[0]).size() < sizes.primitives ||
         !standsBefore(*lists[0], first)))
      fail(primitive,
           "must have one <vcount> of " + std::to_string(sizes.primitives) + " numbers before <p>");
    for (const XMLElement* list : lists) {
      std::uint64_t sum = 0;
      for (const std::uint64_t corners : indices(*list)) sum += corners;
      if (sizes.primitives > 0 && sum > sizes.corners)
        fail(*list,
             "asks for " + std::to_string(sum) + " corners, but <p> has " + std::to_string(sizes.corners));
    }
  }

  /// Both are within one parent.
  static bool standsBefore(const XMLElement& a, const XMLElement& b) {
    for (const XMLElement* next = &a; next != nullptr; next = next->NextSiblingElement()) {
      if (next == &b) return true;
    }
    return false;
  }

  /// No less than the mesh has positions.
  std::uint64_t positionsOf(const std::string& geometry) const {
    std::uint64_t most = 0;
    for (XMLElement* one : below(root_, "geometry")) {
      if (attributeOf(*one, "id") != geometry) continue;
      for (XMLElement* input : below(*one, "input")) {
        const std::optional<Source> source = sourceOf(*input);
        if (source && attributeOf(*input, "semantic") == "POSITION") most = std::max(most, source->count);
      }
    }
    return most;
  }

  void checkSkin(XMLElement& skin) const {
    std::uint64_t joints = std::numeric_limits<std::uint64_t>::max(), weights = joints;
    for (XMLElement* input : below(skin, "input")) {
      const std::string semantic = attributeOf(*input, "semantic");
      const std::optional<Source> source = sourceOf(*input);
      if (!source) fail(*input, "its source is not there");
      const std::uint64_t elements = std::min(source->count, source->values);
      if (semantic == "JOINT") joints = std::min(joints, elements);
      if (semantic == "WEIGHT") weights = std::min(weights, elements);
    }
    for (XMLElement* input : below(skin, "input")) {
      const std::optional<Source> source = sourceOf(*input);
      const bool is_matrix = attributeOf(*input, "semantic") == "INV_BIND_MATRIX";
      if (is_matrix && (source->parameters < 16 || source->count < joints))
        fail(*input, "must have a matrix for each of " + std::to_string(joints) + " joints");
      if (attributeOf(*input, "semantic") != "JOINT" || source->values == source->count) continue;
      fail(*input, source->values == Source().values ? "has an accessor that names no array"
                                                     : "must have as many names as its accessor counts");
    }
    for (XMLElement* list : below(skin, "vertex_weights")) {
      const std::uint64_t count = whole(*list, "count", 0);
      if (count < positionsOf(idOf(attributeOf(skin, "source"))))
        fail(*list, "counts fewer vertices than its mesh has");
      for (XMLElement* counts : below(*list, "vcount")) checkWeightCounts(*counts, count);
      for (XMLElement* pairs : below(*list, "v")) {
        const std::vector<std::uint64_t> found = indices(*pairs);
        for (std::size_t i = 0; i < found.size(); ++i) {
          if (found[i] >= (i % 2 == 0 ? joints : weights))
            fail(*pairs,
                 "number " + std::to_string(i) + " is " + std::to_string(found[i]) + ", and there are fewer");
        }
      }
    }
  }

  void checkWeightCounts(const XMLElement& list, std::uint64_t vertices) const {
    const std::vector<std::uint64_t> counts = indices(list);
    std::uint64_t sum = 0;
    for (const std::uint64_t one : counts) sum += one;
    if (counts.size() < vertices || sum > kLargest) fail(list, "must have a number for each vertex");
  }

  /// Of a texture, by way of a sampler and a surface.
  void checkParameters(XMLElement& effect) const {
    std::map<std::string, std::string> next;
    for (XMLElement* parameter : below(effect, "newparam")) {
      std::string& name = next[attributeOf(*parameter, "sid")];
      for (const char* part : {"init_from", "source"}) {
        for (const XMLElement* found : below(*parameter, part)) name = textIn(*found);
      }
    }
    for (const auto& [name, first] : next) {
      std::set<std::string> met{name};
      for (auto at = next.find(first); at != next.end(); at = next.find(at->second)) {
        if (!met.insert(at->first).second) fail(effect, "parameter '" + name + "' leads back to itself");
      }
    }
  }

  void checkNodes() {
    for (XMLElement* library : below(root_, "library_nodes")) {
      for (XMLElement* node : childrenOf(*library)) library_[attributeOf(*node, "id")].push_back(node);
    }
    for (XMLElement* scene : below(root_, "visual_scene"))
      library_[attributeOf(*scene, "id")].push_back(scene);
    for (const char* kind : {"visual_scene", "node"}) {
      for (XMLElement* node : below(root_, kind)) {
        for (const char* name : {"id", "name"}) nodes_[attributeOf(*node, name)].push_back(node);
      }
    }
    for (XMLElement* scene : below(root_, "visual_scene")) {
      if (sizeOf(*scene) > kMostNodes) fail(*scene, "has more than 1000000 nodes, by way of its instances");
    }
  }

  /// All that Assimp may take: of libraries and scenes by id, and only where there is none, what in a scene
  /// has that id or name.
  std::vector<XMLElement*> instancedBy(const XMLElement& instance) const {
    const std::string id = idOf(attributeOf(instance, "url"));
    for (const auto* called : {&library_, &nodes_}) {
      if (const auto found = called->find(id); found != called->end()) return found->second;
    }
    return {};
  }

  /// How many nodes there are below and in place of the instances in it.
  std::uint64_t sizeOf(XMLElement& node) {
    if (const auto known = sizes_.find(&node); known != sizes_.end()) return known->second;
    if (!open_.insert(&node).second) fail(node, "contains an instance of itself");
    std::uint64_t size = 1;
    for (XMLElement* child : childrenOf(node)) {
      if (is(*child, "node")) size += sizeOf(*child);
      if (!is(*child, "instance_node")) continue;
      std::uint64_t largest = 0;
      for (XMLElement* one : instancedBy(*child)) largest = std::max(largest, sizeOf(*one));
      size += largest;
    }
    open_.erase(&node);
    return sizes_[&node] = std::min(size, kMostNodes + 1);
  }

  const std::string& file_;
  XMLElement& root_;
  std::map<std::string, Source> arrays_, sources_;
  std::map<std::string, std::vector<XMLElement*>> library_, nodes_;
  std::map<const XMLElement*, std::uint64_t> sizes_;
  std::set<const XMLElement*> open_;
};

}  // namespace

std::unique_ptr<tinyxml2::XMLDocument> checkedCollada(const std::string& text, const std::string& file) {
  auto document = std::make_unique<tinyxml2::XMLDocument>();
  if (document->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error(file + ": the XML is broken on line " +
                             std::to_string(document->ErrorLineNum()) + " (" + document->ErrorName() + ")");
  }
  XMLElement* const root = document->RootElement();
  if (root == nullptr) throw std::runtime_error(file + ": there is no element in this file");
  Check(file, *root).run();
  return document;
}

}  // namespace sunlit::scene
