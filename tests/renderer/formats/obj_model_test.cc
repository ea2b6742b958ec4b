// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/obj_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/formats/model_texts.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

class ObjModel : public testing::Test {
 protected:
  Model Read(const std::string& name, const std::string& content) {
    return ReadObj(folder_.Write(name, content));
  }
  std::string Complaint(const std::string& name, const std::string& content) {
    try {
      Read(name, content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
};

TEST_F(ObjModel, KeepsEveryDigitAndItsNames) {
  folder_.Write("house.mtl", "newmtl BRICK\nKd 0.4 0.2 0.1\nd 0.5\nmap_Kd -s 1 1 1 brick.png\n");
  const Model model = Read("house.obj", kObj);
  EXPECT_EQ(model.mesh.vertices[0], Vector3d(2600000.123456, 1200000.654321, 430.5));
  EXPECT_EQ(model.mesh.triangles.size(), 3u);
  ASSERT_EQ(model.mesh.surfaces.size(), 2u);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "house");
  EXPECT_EQ(model.mesh.surfaces[1].layer, "house/roof");
  EXPECT_EQ(model.mesh.surfaces[0].material, "BRICK");
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(0.4, 0.2, 0.1));
  EXPECT_EQ(model.mesh.surfaces[0].opacity, 0.5);
  EXPECT_EQ(model.mesh.surfaces[0].texture, "brick.png");
  EXPECT_THAT(model.mesh.surfaces[0].texture_place, HasSubstr("house.mtl:4"));
  EXPECT_EQ(model.mesh.corner_normals.size(), 9u);
  EXPECT_EQ(model.mesh.corner_uvs[2], Eigen::Vector2f(1, 1));
  EXPECT_EQ(model.entities.at("f"), 2);
  EXPECT_EQ(model.skipped.begin()->first.first, "l");
}

TEST_F(ObjModel, MapsOfItsMaterials) {
  folder_.Write("house.mtl", "newmtl BRICK\nnorm n.png\nmap_Pr r.png\nmap_Bump -bm 2 h.png\n");
  const Model model = Read("house.obj", kObj);
  const SurfaceNames& brick = model.mesh.surfaces[0];
  ASSERT_EQ(brick.maps.size(), 2u);
  EXPECT_EQ(brick.maps[0].kind, SurfaceMap::Kind::kNormal);
  EXPECT_EQ(brick.maps[0].file, "n.png");
  EXPECT_TRUE(brick.maps[1].is_squared);
  EXPECT_THAT(brick.texture_place, HasSubstr("house.mtl:2"));
  const auto bump = model.skipped.lower_bound({"map_Bump", ""});
  ASSERT_NE(bump, model.skipped.end());
  EXPECT_THAT(bump->first.second, HasSubstr("height_map"));
}

TEST_F(ObjModel, WhatOfItsMaterialsIsNotShownIsCounted) {
  folder_.Write("house.mtl",
                "newmtl BRICK\nKd 1 0 0\nmap_Kd old.png\nnewmtl BRICK\nKd 200 0.5 0\n"
                "map_Kd -s 2 2 1 -o 0 0 0 brick.png\n");
  const Model model = Read("house.obj", kObj);
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(1, 0.5, 0));
  EXPECT_EQ(model.mesh.surfaces[0].texture, "brick.png");
  EXPECT_EQ(model.skipped.at({"newmtl", "of a name that is there already: the last one counts"}),
            1);
  EXPECT_EQ(model.skipped.at({"Kd", "over 1: taken as 1"}), 1);
  EXPECT_EQ(model.skipped.at({"-s", "moves an image on its faces: not read"}), 1);
  EXPECT_FALSE(model.skipped.contains({"-o", "moves an image on its faces: not read"}));
}

TEST_F(ObjModel, Faults) {
  const auto complaint = [&](const std::string& line) {
    return Complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + line + "\n");
  };
  EXPECT_EQ(complaint("f 1 2 3"), "");
  EXPECT_THAT(complaint("f 1 2 4"), HasSubstr("a.obj:4: a face names vertex 4, expected 1 to 3"));
  EXPECT_THAT(complaint("f 1 2 -4"), HasSubstr("names vertex -4"));
  EXPECT_THAT(complaint("f 1 2 0"), HasSubstr("names vertex 0"));
  EXPECT_EQ(complaint("f 1 2"), "");
  std::string long_face = "f";
  for (int i = 0; i < 5001; ++i) long_face += " 1 2";
  EXPECT_THAT(complaint(long_face), HasSubstr("a.obj:4: a face has over 10000 corners"));
  EXPECT_THAT(complaint("f 1 2 x"), HasSubstr("a.obj:4: \"x\""));
  EXPECT_THAT(complaint("v 1e300 0 0"), HasSubstr("at most 1e12"));
  EXPECT_THAT(complaint("v 1 2"), HasSubstr("the line ends"));
}

// What costs only itself is counted, and the rest is read.
TEST_F(ObjModel, OneBadLineCostsOnlyItself) {
  folder_.Write("a.mtl", "newmtl Grey\nKd 0.6\nd 1\nTr 1\n");
  const Model model = Read("a.obj",
                           "mtllib a.mtl\nusemtl Grey\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                           "vt -nan(ind) 0\nvn nan nan nan\nf 1/1/1 2/1/1 3/1/1 # roof\nf 1 2\n");
  ASSERT_EQ(model.mesh.triangles.size(), 1u);
  EXPECT_EQ(model.mesh.corner_normals[0], Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(0.6, 0.6, 0.6));
  EXPECT_EQ(model.mesh.surfaces[0].opacity, 1);
  EXPECT_EQ(model.skipped.size(), 3u);
}

TEST_F(ObjModel, WhatIsNoNumberOrNotThereCostsOnlyItself) {
  const Model model = Read("a.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv -1.#IND 0 0\nvn 0 0 1\n"
                           "f 1/1/1 2/7/1 3/1/2#roof\nf 1 2 4\nf 1 3 2 # back\n");
  EXPECT_EQ(model.mesh.triangles.size(), 2u);
  EXPECT_EQ(model.mesh.vertices.size(), 3u);
  EXPECT_EQ(model.mesh.corner_normals[2], Eigen::Vector3f(0, 0, 1));  // the face's own
  EXPECT_EQ(model.skipped.at({"v", "no number: no point"}), 2);
  EXPECT_EQ(model.skipped.at({"vt", "named by corners of faces and not there"}), 3);
  EXPECT_EQ(model.skipped.at({"vn", "named by corners of faces and not there"}), 1);
  EXPECT_EQ(model.skipped.at({"f", "a face at a vertex that is no point"}), 1);
}

TEST_F(ObjModel, MaterialFilesAreFoundAsFarAsTheyAreThere) {
  constexpr char kFace[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder_.Write("b c.mtl", "newmtl Wa\xCC\x88nde\nKd 0 1 0\nmap_Bump b.png\nKs 1 1 1\nKe 0 0 0\n");
  const Model two =
      Read("a.obj", std::string("mtllib lost.mtl \"B C.mtl\"\nusemtl W\xC3\xA4NDE\n") + kFace);
  EXPECT_EQ(two.mesh.surfaces[0].rgb, Vector3d(0, 1, 0));
  ASSERT_EQ(two.warnings.size(), 1u);
  EXPECT_THAT(two.warnings[0], HasSubstr("its material file lost.mtl is not there"));
  EXPECT_EQ(two.files.size(), 1u);
  EXPECT_EQ(two.skipped.at({"map_Bump",
                            "of materials: heights of no stated size, see height_map of "
                            "materials.json"}),
            1);
  EXPECT_EQ(two.skipped.size(), 2u);  // Ke says nothing
  folder_.Write("house.mtl", "newmtl M\nKd 1 0 0\n");
  for (const char* library : {"mtllib old.mtl\n", ""}) {
    const Model beside = Read("house.obj", std::string(library) + "usemtl M\n" + kFace);
    EXPECT_EQ(beside.mesh.surfaces[0].rgb, Vector3d(1, 0, 0));
    ASSERT_EQ(beside.warnings.size(), 1u);
    EXPECT_THAT(beside.warnings[0], HasSubstr("house.mtl beside it is taken"));
  }
}

TEST_F(ObjModel, AnyEncodingAndLineEnd) {
  folder_.Write("my a.mtl", "\xEF\xBB\xBFnewmtl gr\xFCn\rKd 0 1 0\r");
  const Model model = Read("a.obj",
                           "\xEF\xBB\xBFmtllib \"C:\\x\\My A.mtl\"\rusemtl gr\xFCn\r"
                           "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r");
  ASSERT_EQ(model.mesh.surfaces.size(), 1u);
  EXPECT_EQ(model.mesh.surfaces[0].material, "gr\xC3\xBCn");
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(0, 1, 0));
}

TEST_F(ObjModel, FacesOfOldPrograms) {
  EXPECT_EQ(Read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n").mesh.triangles.size(), 1u);
}

TEST_F(ObjModel, CommentsNameTheUnit) {
  const auto unit = [this](const std::string& comment) {
    return Read("a.obj", comment + "\nv 0 0 0\nv 1000 0 0\nv 0 1000 0\nf 1 2 3\n");
  };
  const Model millimetres = unit("# File units = millimeters");
  EXPECT_EQ(millimetres.metres_per_unit, 0.001);
  EXPECT_EQ(millimetres.mesh.vertices[1], Vector3d(1, 0, 0));
  EXPECT_EQ(millimetres.warnings.size(), 1u);
  EXPECT_EQ(unit("#units: Inches").metres_per_unit, 0.0254);
  EXPECT_EQ(unit("# units mm").metres_per_unit, 0.001);
  EXPECT_EQ(unit("# unit cube").warnings.size(), 0u);
  EXPECT_EQ(unit("# exported by Acme, unit cm").metres_per_unit, 0.01);
  EXPECT_EQ(unit("# all units are in decimeters").metres_per_unit, 0.1);
  EXPECT_EQ(unit("# Scale: 1 unit = 0.01 meters").metres_per_unit, 0.01);
  EXPECT_EQ(unit("# 1 unit = 1 foot").metres_per_unit, 0.3048);
  EXPECT_EQ(unit("# Unit of measurement: yards").metres_per_unit, 0.9144);
  EXPECT_EQ(unit("# Units = US survey feet").metres_per_unit, 1200.0 / 3937);
  EXPECT_EQ(unit("# Einheit: Zentimeter").metres_per_unit, 0.01);
  EXPECT_EQ(unit("# what is in the unit in").metres_per_unit, std::nullopt);
  EXPECT_EQ(unit("# one unit = a lot").metres_per_unit, std::nullopt);
  EXPECT_EQ(unit("# File units = furlongs").metres_per_unit, std::nullopt);
  EXPECT_EQ(unit("# File units = furlongs").warnings.size(), 1u);
  EXPECT_EQ(unit("# my house").warnings.size(), 0u);
}

TEST_F(ObjModel, ColoursByVertexAreShownByFace) {
  const Model model = Read("a.obj",
                           "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 1 1 0\n"
                           "f 1 2 3\nf 2 4 3\n");
  ASSERT_EQ(model.mesh.surfaces.size(), 2u);
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(1, 0, 0));
  EXPECT_EQ(model.skipped.begin()->first.first, "mesh with colours by vertex");
  EXPECT_TRUE(Read("b.obj", "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n").skipped.empty());
}

}  // namespace
}  // namespace insitu
