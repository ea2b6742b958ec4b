// SPDX-License-Identifier: GPL-3.0-or-later
// ACIS bodies in drawings.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <sstream>
#include <string>

#include "renderer/dxf/dxf.h"
#include "tests/renderer/acis/sat_text.h"
#include "tests/renderer/dxf/dxf_text.h"
#include "tests/renderer/dxf/read_drawing.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

// As AutoCAD writes it, a line a group.
std::string SolidEntity(const std::string& sat, const std::string& handle = "9C",
                        size_t length = 255) {
  std::string entity = "0 3DSOLID\n5 " + handle + "\n100 AcDbEntity\n8 ROOF\n70 1\n";
  std::istringstream lines(sat);
  for (std::string line; std::getline(lines, line);) {
    std::string code = "1 ";
    for (line = DecodedAcisText(line); !line.empty(); code = "3 ") {
      entity += code + line.substr(0, length) + "\n";
      line.erase(0, std::min(length, line.size()));
    }
  }
  return entity;
}

TEST(DxfBody, SolidsOfAcisBecomeFacesAndSpheres) {
  const Model model =
      ReadEntities(SolidEntity(CubeText(400)) + SolidEntity(SphereText(700, {5, 0, 0}, 2), "9D"));
  EXPECT_TRUE(model.skipped.empty());
  EXPECT_EQ(model.entities.at("3DSOLID"), 2);
  EXPECT_NEAR(VolumeOf(model.mesh), 1, 1e-12);
  ASSERT_EQ(model.mesh.surfaces.size(), 1u);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "ROOF");
  ASSERT_EQ(model.mesh.spheres.size(), 1u);
  EXPECT_EQ(model.mesh.spheres[0].center, Vector3d(5, 0, 0));
  EXPECT_EQ(model.mesh.spheres[0].radius, 2);
}

// Wherever a line of text is cut, before or behind a blank too.
TEST(DxfBody, LinesOfTextGoOn) {
  for (size_t length = 15; length < 33; ++length) {
    const Model model = ReadEntities(SolidEntity(CubeText(700), "9C", length));
    EXPECT_TRUE(model.skipped.empty()) << length;
    EXPECT_NEAR(VolumeOf(model.mesh), 1, 1e-12) << length;
  }
}

TEST(DxfBody, AFaceThatIsNotReadIsNamedWithItsSolid) {
  std::string sat = CubeText(700);
  sat.replace(sat.find("plane-surface"), 13, "spline-surface");
  const Model model = ReadEntities(SolidEntity(sat));
  EXPECT_NEAR(AreaOf(model.mesh), 5, 1e-9);
  EXPECT_EQ(model.skipped.at({"face of 3DSOLID 9C",
                              "on a spline-surface: make it a mesh (AutoCAD: MESHSMOOTH)"}),
            1);
}

TEST(DxfBody, SolidsFollowTheirInserts) {
  const std::string block = "0 BLOCK\n2 B\n" + SolidEntity(CubeText(400)) +
                            SolidEntity(SphereText(400, {0, 0, 0}, 1)) + "0 ENDBLK\n";
  const Model mirrored =
      ReadText(DrawingText("0 INSERT\n2 B\n10 7\n20 0\n41 -2\n42 2\n43 2\n", block));
  EXPECT_NEAR(VolumeOf(mirrored.mesh), 8, 1e-12);
  ASSERT_EQ(mirrored.mesh.spheres.size(), 1u);
  EXPECT_EQ(mirrored.mesh.spheres[0].center, Vector3d(7, 0, 0));
  EXPECT_NEAR(mirrored.mesh.spheres[0].radius, 2, 1e-12);
  // An egg is no sphere.
  const Model egg = ReadText(DrawingText("0 INSERT\n2 B\n43 3\n", block));
  EXPECT_TRUE(egg.mesh.spheres.empty());
  EXPECT_NEAR(VolumeOf(egg.mesh), 3 + 4 * std::numbers::pi, 0.1);
}

TEST(DxfBody, SolidsSince2013StandInASectionOfTheirOwn) {
  const std::string sab = SabOf(*ReadSat(SphereText(21800, {1, 2, 3}, 0.5)));
  std::string data = "0 SECTION\n2 ACDSDATA\n0 ACDSRECORD\n90 1\n320 09c\n2 ASM_Data\n";
  for (size_t i = 0; i < sab.size(); i += 100) {
    data += "310 ";
    for (const char c : sab.substr(i, 100)) {
      constexpr char kDigits[] = "0123456789ABCDEF";
      data += kDigits[static_cast<unsigned char>(c) >> 4];
      data += kDigits[static_cast<unsigned char>(c) & 15];
    }
    data += "\n";
  }
  const std::string entity = "0 3DSOLID\n5 9C\n8 0\n0 3DSOLID\n5 9E\n8 0\n";
  const Model model = ReadText(DxfText(EntitiesSection(entity) + data + "0 ENDSEC\n0 EOF\n"));
  ASSERT_EQ(model.mesh.spheres.size(), 1u);
  EXPECT_EQ(model.mesh.spheres[0].center, Vector3d(1, 2, 3));
  EXPECT_EQ(model.skipped,
            (SkippedEntities{{{"3DSOLID 9E", "holds no ACIS body that can be read"}, 1}}));
}

}  // namespace
}  // namespace insitu
