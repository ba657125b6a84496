/// COLLADA of one triangle, with two sets of texture coordinates.
#pragma once

#include <string>

namespace sunlit::scene {

inline std::string colladaSource(const std::string& id, const std::string& values, int stride) {
  const std::string names = stride == 3 ? "XYZ" : "ST";
  std::string parameters;
  for (const char name : names) parameters += std::string("<param name='") + name + "' type='float'/>";
  return "<source id='" + id + "'><float_array id='" + id + "-a' count='" + std::to_string(3 * stride) +
         "'>" + values + "</float_array><technique_common><accessor source='#" + id +
         "-a' count='3' stride='" + std::to_string(stride) + "'>" + parameters +
         "</accessor></technique_common></source>";
}

inline std::string colladaInput(const std::string& id, int set) {
  return "<input semantic='TEXCOORD' source='#" + id + "' offset='" + (id == "u" ? "1" : "2") + "' set='" +
         std::to_string(set) + "'/>";
}

inline std::string colladaBinding(const std::string& name, int set) {
  return "<bind_vertex_input semantic='" + name + "' input_semantic='TEXCOORD' input_set='" +
         std::to_string(set) + "'/>";
}

/// A triangle whose set u has s = 0 everywhere, and w has s = 1.
inline std::string colladaTriangle(const std::string& effect, const std::string& inputs,
                                   const std::string& binds) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
         "<asset><up_axis>Z_UP</up_axis></asset><library_images><image "
         "id='i'><init_from>paint.png</init_from>"
         "</image></library_images><library_effects><effect id='e'><profile_COMMON><newparam "
         "sid='f'><surface "
         "type='2D'><init_from>i</init_from></surface></newparam><newparam "
         "sid='s'><sampler2D><source>f</source>"
         "</sampler2D></newparam><technique sid='c'><lambert>" +
         effect +
         "</lambert></technique></profile_COMMON></effect></library_effects><library_materials><material "
         "id='m' "
         "name='m'><instance_effect url='#e'/></material></library_materials><library_geometries><geometry "
         "id='g'>"
         "<mesh>" +
         colladaSource("p", "0 0 0 1 0 0 0 1 0", 3) + colladaSource("u", "0 0 0 0 0 1", 2) +
         colladaSource("w", "1 0 1 0 1 1", 2) +
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles material='x' "
         "count='1'>"
         "<input semantic='VERTEX' source='#v' offset='0'/>" +
         inputs +
         "<p>0 0 0 1 1 1 2 2 2</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
         "<visual_scene id='vs'><node id='n'><instance_geometry url='#g'><bind_material><technique_common>"
         "<instance_material symbol='x' target='#m'>" +
         binds +
         "</instance_material></technique_common></bind_material></instance_geometry></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url='#vs'/></scene></COLLADA>";
}

inline std::string colladaTexture(const std::string& part, const std::string& name) {
  return "<" + part + "><texture texture='s' texcoord='" + name + "'/></" + part + ">";
}

}  // namespace sunlit::scene
