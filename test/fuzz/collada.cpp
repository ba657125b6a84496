// COLLADA meshes.
#include "fuzz/reader.h"
#include "fuzz/scene_extras.h"
#include "sunlit/scene/load.h"

namespace sunlit::fuzz {
namespace {

std::string numbers(const std::string& id, const std::string& values, const std::string& axes) {
  const std::string count = std::to_string(3 * axes.size()), stride = std::to_string(axes.size());
  std::string text = "<source id='" + id + "'><float_array id='" + id + "-a' count='" + count + "'>" +
                     values + "</float_array><technique_common><accessor source='#" + id +
                     "-a' count='3' stride='" + stride + "'>";
  for (const char axis : axes) text += std::string("<param name='") + axis + "' type='float'/>";
  return text + "</accessor></technique_common></source>\n";
}

/// A triangle whose faces are told as `faces`, painted as `diffuse`.
std::string collada(const std::string& faces, const std::string& diffuse) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
         "<asset><unit meter='0.01' name='centimeter'/><up_axis>Z_UP</up_axis></asset>\n"
         "<library_images><image id='i' name='i'><init_from>paint.png</init_from></image></library_images>\n"
         "<library_lights><light id='L' name='L'><technique_common><spot><color>1 1 0.5</color>"
         "<constant_attenuation>1</constant_attenuation><quadratic_attenuation>0.1</quadratic_attenuation>"
         "<falloff_angle>60</falloff_angle><falloff_exponent>1</falloff_exponent></spot></technique_common></"
         "light>"
         "</library_lights>\n"
         "<library_effects><effect id='e'><profile_COMMON><newparam sid='su'><surface type='2D'><init_from>i"
         "</init_from></surface></newparam><newparam "
         "sid='sa'><sampler2D><source>su</source></sampler2D></newparam>"
         "<technique sid='c'><phong><emission><color>0 0 0.1 1</color></emission><diffuse>" +
         diffuse +
         "</diffuse><specular><color>0.5 0.5 0.5 1</color></specular><shininess><float>20</float></shininess>"
         "<transparency><float>0.5</float></transparency></phong></technique></profile_COMMON></effect>"
         "</library_effects>\n<library_materials><material id='m' name='m'><instance_effect "
         "url='#e'/></material>"
         "</library_materials>\n<library_geometries><geometry id='g' name='g'><mesh>\n" +
         numbers("p", "0 0 0 100 0 0 0 200 30", "XYZ") + numbers("n", "0 0 1 0 0 1 0 1 0", "XYZ") +
         numbers("t", "0 0 1 0 0.25 0.75", "ST") +
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>\n" + faces +
         "</mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene id='s'><node id='k' "
         "name='k'>"
         "<matrix>1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_geometry url='#g'><bind_material>"
         "<technique_common><instance_material symbol='m' target='#m'><bind_vertex_input semantic='uv' "
         "input_semantic='TEXCOORD' input_set='0'/></instance_material></technique_common></bind_material>"
         "</instance_geometry><node id='q'><translate>0 0 2</translate><rotate>0 0 1 90</rotate><scale>1 2 "
         "1</scale>"
         "<instance_light url='#L'/></node></node></visual_scene></library_visual_scenes><scene>"
         "<instance_visual_scene url='#s'/></scene></COLLADA>\n";
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string inputs =
      "<input semantic='VERTEX' source='#v' offset='0'/><input semantic='NORMAL' source='#n' offset='1'/>"
      "<input semantic='TEXCOORD' source='#t' offset='2' set='0'/>";
  const std::string corners = "<p>0 0 0 1 1 1 2 2 2</p>", picture = "<texture texture='sa' texcoord='uv'/>";
  return {
      collada("<triangles material='m' count='1'>" + inputs + corners + "</triangles>", picture),
      collada("<polylist material='m' count='1'>" + inputs + "<vcount>3</vcount>" + corners + "</polylist>",
              "<color>1 0 0 1</color>"),
      collada("<polygons material='m' count='1'>" + inputs + corners + "</polygons>", picture),
      collada("<tristrips material='m' count='1'>" + inputs + corners + "</tristrips>",
              "<!-- blank --><color> 1 0 0 1</color>")};
}

void read(const std::string& input) {
  layExtras();
  setContent("./input.dae", input);
  requireGood(scene::load("input.dae", {}));
}

std::string named() {
  return "input.dae";
}

}  // namespace sunlit::fuzz
