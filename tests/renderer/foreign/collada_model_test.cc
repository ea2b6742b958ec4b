// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/collada_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;

constexpr char kTriangles[] =
    R"(<triangles material="s" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
       <p>0 1 2</p></triangles>)";
constexpr char kHoled[] =
    R"(<polygons material="s" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
       <ph><p>0 1 2 3</p><h>4 7 6 5</h></ph></polygons>)";

struct Parts {
  std::string faces = kTriangles;
  std::string transform = "";
  std::string axis = "Z_UP";
  std::string effect = "<diffuse><color>1 0 0 1</color></diffuse>";
};

// A wall of 10 m by 3 m with corners for a window of 2 m by 1 m.
std::string Collada(const Parts& parts) {
  return R"(<COLLADA version="1.4.1"><asset><unit meter="1"/><up_axis>)" + parts.axis +
         R"(</up_axis></asset>
  <library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong>)" +
         parts.effect + R"(</phong></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="m" name="Wall"><instance_effect url="#e"/></material>
  </library_materials><library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="a" count="24">0 0 0 10 0 0 10 0 3 0 0 3 4 0 1 6 0 1 6 0 2 4 0 2
  </float_array><technique_common><accessor source="#a" count="8" stride="3">
  <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
  </accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)" +
         parts.faces + R"(</mesh></geometry></library_geometries>
  <library_nodes><node id="kept" name="Kept"><instance_geometry url="#g"><bind_material>
  <technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material>
  </instance_geometry></node></library_nodes>
  <library_visual_scenes><visual_scene id="s"><node id="n" name="House">)" +
         parts.transform + R"(<instance_node url="#kept"/></node></visual_scene>
  </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

class ColladaModel : public testing::Test {
 protected:
  Model Read(const Parts& parts) { return ReadCollada(folder_.Write("a.dae", Collada(parts))); }
  std::string Complaint(const std::string& content) {
    try {
      ReadCollada(folder_.Write("a.dae", content));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
};

TEST_F(ColladaModel, NodesStandInDoublePrecision) {
  const Model model = Read({.transform = "<translate>2600000.123 1200000.456 500</translate>"
                                         "<rotate>0 0 1 90</rotate><scale>1 2 1</scale>"});
  EXPECT_THAT(model.mesh.vertices, Contains(Vector3d(2600000.123, 1200010.456, 500)));
  EXPECT_EQ(model.mesh.surfaces[0].layer, "Kept");
  EXPECT_EQ(model.mesh.surfaces[0].material, "Wall");
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(1, 0, 0));
}

TEST_F(ColladaModel, EveryAxisMayPointUp) {
  EXPECT_THAT(Read({.axis = "Y_UP"}).mesh.vertices, Contains(Vector3d(10, -3, 0)));
  EXPECT_THAT(Read({.axis = "X_UP"}).mesh.vertices, Contains(Vector3d(0, -3, 10)));
}

TEST_F(ColladaModel, UnitsAndAxesThatAreNotStatedAreTold) {
  EXPECT_THAT(Read({.axis = ""}).mesh.vertices, Contains(Vector3d(10, -3, 0)));
  EXPECT_THAT(Read({.axis = "W_UP"}).warnings, Contains(HasSubstr("W_UP")));
  const auto with = [this](const std::string& unit) {
    std::string text = Collada({});
    return ReadCollada(folder_.Write("a.dae", text.replace(text.find("<unit"), 17, unit)));
  };
  EXPECT_EQ(with("").metres_per_unit, std::nullopt);
  EXPECT_THAT(with("<unit name=\"feet\"/>").warnings,
              Contains(HasSubstr("\"feet\" has no length: taken as 1 m")));
  EXPECT_THAT(with("<unit meter=\"1\" name=\"centimeter\"/>").warnings,
              Contains(HasSubstr("called \"centimeter\" and stated to be 1 m")));
  const Model inches = with("<unit meter=\"0.0254\" name=\"inches\"/>");
  EXPECT_EQ(inches.metres_per_unit, 0.0254);
  EXPECT_TRUE(inches.warnings.empty());
}

TEST_F(ColladaModel, WhatIsElsewhereOrNotThereCostsOnlyItself) {
  const Model model = Read({.transform = "<instance_geometry url=\"#lost\"/>"
                                         "<instance_geometry url=\"b.dae#g\"/>"
                                         "<instance_controller url=\"#lost\"/>"});
  EXPECT_EQ(model.mesh.triangles.size(), 1u);
  EXPECT_EQ(model.skipped.at({"geometry", "\"#lost\" is named and not there"}), 1);
  EXPECT_EQ(model.skipped.at({"controller", "\"#lost\" is named and not there"}), 1);
  EXPECT_EQ(model.skipped.at({"geometry of another file", "not read: b.dae#g"}), 1);
}

TEST_F(ColladaModel, FacesThatAreMissingAreCounted) {
  std::string triangles = kTriangles;
  triangles.replace(triangles.find("count=\"1\""), 9, "count=\"9\"");
  triangles.replace(triangles.find("0 1 2"), 5, "0 1 2 0 1");
  const Model model = Read({.faces = triangles});
  EXPECT_EQ(model.skipped.at({"face", "stated by its count and not there"}), 8);
  EXPECT_EQ(model.skipped.at({"corners", "too few for a last triangle"}), 1);
}

TEST_F(ColladaModel, HolesStayOpen) { EXPECT_NEAR(AreaOf(Read({.faces = kHoled}).mesh), 28, 1e-9); }

TEST_F(ColladaModel, OpacityInFourWays) {
  const auto opacity = [this](const std::string& opaque, const std::string& color,
                              const std::string& transparency) {
    return Read({.effect = "<transparent" + opaque + "><color>" + color +
                           "</color></transparent><transparency><float>" + transparency +
                           "</float></transparency>"})
        .mesh.surfaces[0]
        .opacity;
  };
  EXPECT_NEAR(opacity(R"( opaque="A_ONE")", "1 1 1 1", "0.4"), 0.4, 1e-6);
  EXPECT_NEAR(opacity(R"( opaque="RGB_ZERO")", "0.3 0.3 0.3 1", "1"), 0.7, 1e-6);
  EXPECT_NEAR(opacity(R"( opaque="RGB_ONE")", "0.3 0.3 0.3 1", "1"), 0.3, 1e-6);
  EXPECT_NEAR(opacity(R"( opaque="A_ZERO")", "0 0 0 1", "0.4"), 0.6, 1e-6);
  EXPECT_EQ(opacity("", "0 0 0 1", "0"), 1);  // what programs write and mean
}

TEST_F(ColladaModel, FaultsAreNamed) {
  const std::string good = Collada({});
  EXPECT_EQ(Complaint(good), "");
  const auto with = [&](const std::string& old, const std::string& replacement) {
    std::string text = good;
    return Complaint(text.replace(text.find(old), old.size(), replacement));
  };
  EXPECT_THAT(with("0 1 2</p>", "0 1 8</p>"), HasSubstr("names VERTEX 8, expected 0 to 7"));
  EXPECT_THAT(with("0 1 2</p>", "0 1 x</p>"), HasSubstr("expected whole numbers"));
  EXPECT_THAT(with("10 0 3", "10 0"), HasSubstr("holds 7 rows, expected 8"));
  EXPECT_THAT(with("10 0 3", "10 0 x"), HasSubstr("a position that is no number"));
  EXPECT_EQ(with("10 0 3", "10 0 -1.#IND"), "");          // it costs its faces
  EXPECT_EQ(with("url=\"#kept\"", "url=\"#lost\""), "");  // it costs itself
  EXPECT_THAT(with("url=\"#kept\"", "url=\"#n\""), HasSubstr("over 1000 deep"));
}

}  // namespace
}  // namespace insitu
