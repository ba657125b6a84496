// Worlds in SDF, with a model that they include and a material script.
#include "fuzz/reader.h"
#include "fuzz/scene_extras.h"
#include "sunlit/scene/load.h"

namespace sunlit::fuzz {
namespace {

const std::string kModel =
    "<?xml version='1.0'?><sdf version='1.7'><model name='m'><pose>1 0 0 0 0 0.5</pose><static>true</static>"
    "<link name='l'><pose relative_to='f'>0 0 1 0 0 0</pose><visual name='v'><geometry><mesh><uri>"
    "triangle.obj</uri><scale>1 2 3</scale></mesh></geometry><material><script><uri>m.material</uri><name>"
    "paint</name></script></material></visual><light name='lamp' type='spot'><diffuse>1 .9 .8 1</diffuse>"
    "<attenuation><range>20</range><constant>0.2</constant></attenuation><direction>0 0 -1</direction><spot>"
    "<inner_angle>0.4</inner_angle><outer_angle>1.2</outer_angle><falloff>1</falloff></spot></light></link>"
    "<frame name='f' attached_to='__model__'><pose>0 1 0 0 0 0</pose></frame><link name='k'/>"
    "<joint name='j' type='revolute'><parent>l</parent><child>k</child><axis><xyz>0 0 1</xyz></axis></joint>"
    "</model></sdf>";

const std::string kScript =
    "material base\n{\n technique\n {\n  pass\n  {\n   diffuse 0.5 0.4 0.3 1\n   emissive 0 0 0.1\n   "
    "alpha_rejection greater 128\n  }\n }\n}\nmaterial paint : base\n{ technique { pass { texture_unit { "
    "texture paint.png\n scale 2 2 } } } }\n";

std::string worldOf(const std::string& content, const std::string& version = "1.9") {
  return "<?xml version='1.0'?>\n<sdf version='" + version + "'>\n<world name='w'>" + content +
         "</world></sdf>" + kNextFile + kModel + kNextFile + kScript;
}

std::string visuals(const std::string& geometry, const std::string& material = "") {
  return "<model name='a'><static>1</static><pose>1 2 3 0.1 0.2 0.3</pose><link name='l'><inertial><mass>1"
         "</mass></inertial><collision name='c'><geometry>" +
         geometry +
         "</geometry></collision><visual name='v'><cast_shadows>1</cast_shadows><transparency>0.1"
         "</transparency><geometry>" +
         geometry + "</geometry>" + material + "</visual></link></model>";
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string look =
      "<material><ambient>0.3 0.3 0.3 1</ambient><diffuse>0.7 0.2 0.1 0.5</diffuse><emissive>0 0.1 0 1"
      "</emissive><specular>0.5 0.5 0.5 1</specular></material>";
  const std::string pbr =
      "<material><diffuse>1 1 1 "
      "1</diffuse><pbr><metal><albedo_map>paint.png</albedo_map><normal_map>paint.png"
      "</normal_map><roughness>0.4</roughness><metalness>0.5</metalness><emissive_map>paint.png</"
      "emissive_map>"
      "</metal></pbr></material>";
  const std::string include =
      "<include><uri>model://m</uri><name>n</name><pose>0 0 1 0 0 0</pose><placement_frame>f"
      "</placement_frame></include>";
  return {
      contentOf(SUNLIT_SOURCE_DIR "/test/support/worlds/two_boxes.world") + kNextFile + kModel + kNextFile +
          kScript,
      worldOf(visuals("<box><size>2 4 6</size></box>", look) + include),
      worldOf(visuals("<sphere><radius>1.5</radius></sphere>", pbr) +
              "<model name='o'><include merge='true'><uri>model://m</uri></include></model>"),
      worldOf(visuals("<cylinder><radius>0.5</radius><length>2</length></cylinder>") +
              "<light name='sun' type='directional'><direction>0.1 0.2 -1</direction></light>"),
      worldOf(visuals("<plane><normal>0 0 1</normal><size>10 20</size></plane>",
                      "<material><script><uri>file://media/x.material</uri><name>Gazebo/Grey</name></script>"
                      "</material>")),
      worldOf(visuals("<capsule><radius>0.5</radius><length>2</length></capsule>") +
              visuals("<ellipsoid><radii>0.2 1.3 0.5</radii></ellipsoid>").replace(13, 1, "b")),
      worldOf(visuals("<polyline><point>0 0</point><point>4 0</point><point>4 3</point><point>1 1</point>"
                      "<height>2</height></polyline>")),
      worldOf(
          visuals("<heightmap><uri>paint.png</uri><size>20 20 3</size><pos>0 0 1</pos><texture><diffuse>"
                  "paint.png</diffuse><normal>paint.png</normal><size>4</size></texture><texture><diffuse>"
                  "paint.png</diffuse><normal>paint.png</normal><size>2</size></texture><blend><min_height>1"
                  "</min_height><fade_dist>1</fade_dist></blend></heightmap>")),
      worldOf(visuals("<mesh><uri>model://m/triangle.obj</uri><submesh><name>x</name><center>1</center>"
                      "</submesh></mesh>") +
              visuals("<box><size>1 1 1</size></box>").replace(13, 1, "b")),
      worldOf(
          "<road name='r'><width>3</width><point>0 0 0</point><point>10 0 0</point><point>10 9 0.5</point>"
          "<material><diffuse>.1 .1 .1 1</diffuse></material></road>",
          "1.6"),
      worldOf(
          visuals("<box><size>2 4 6</size></box>") +
              "<state world_name='w'><sim_time>1 2</sim_time><model name='a'><pose>9 0 0 0 0 "
              "0</pose><scale>2 2 "
              "1</scale><link name='l'><pose>9 0 0 0 0 1</pose></link></model><insertions><model "
              "name='z'><link "
              "name='l'><visual name='v'><geometry><box><size>1 1 1</size></box></geometry></visual></link>"
              "</model></insertions><deletions><name>q</name></deletions></state>",
          "1.5")};
}

void read(const std::string& input) {
  layExtras();
  const std::vector<std::string> files = filesOf(input, 3);
  setContent("./input.world", files[0]);
  setContent("./models/m/model.sdf", files[1]);
  setContent("./models/m/model.config",
             "<?xml version='1.0'?><model><name>m</name><sdf version='1.7'>model.sdf</sdf></model>");
  setContent("./models/m/triangle.obj", contentOf("triangle.obj"));
  setContent("./models/m/m.material", files[2]);
  requireGood(scene::load("input.world", {}));
}

std::string named() {
  return ".";  // the file, or the model in whose file it is, or a mesh in it
}

}  // namespace sunlit::fuzz
