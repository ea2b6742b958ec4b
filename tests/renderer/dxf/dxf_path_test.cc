// SPDX-License-Identifier: GPL-3.0-or-later
// Drawn lines with thickness and width, smoothed meshes, and binary drawings.
#include "renderer/dxf/dxf_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>

#include "calibration/files/error.h"
#include "renderer/dxf/dxf.h"
#include "renderer/mesh/solids.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/dxf/dxf_text.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Model ReadEntities(const std::string& entities, const std::string& blocks = "",
                   const DxfOptions& options = {}) {
  const ScratchFolder folder;
  return ReadDxf(folder.Write("drawing.dxf", DrawingText(entities, blocks)), options);
}

bool IsClosed(Model model) { return MendSolids(&model.mesh).open_edges == 0; }

TEST(DxfPath, LineWithThicknessIsAWall) {
  const Model model = ReadEntities("0 LINE\n10 0\n20 0\n30 1\n11 3\n21 4\n31 1\n39 2\n");
  EXPECT_NEAR(AreaOf(model.mesh), 10, 1e-12);
  EXPECT_EQ(model.mesh.triangles.size(), 2u);
}

// The extrusion direction is x: the wall of a line along y stands out to x.
TEST(DxfPath, ThicknessGoesAlongTheExtrusion) {
  const Model model = ReadEntities("0 LINE\n10 0\n20 0\n11 0\n21 4\n39 2\n210 1\n220 0\n230 0\n");
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : model.mesh.vertices) box.extend(v);
  EXPECT_NEAR((box.max() - Vector3d(2, 4, 0)).norm(), 0, 1e-12);
}

// Where it has neither width nor thickness it is a mere line, no face of no area.
TEST(DxfPath, WidthOfOneSegmentOnly) {
  const Model model = ReadEntities(
      "0 LWPOLYLINE\n90 3\n70 0\n10 0\n20 0\n40 0.5\n41 0.5\n10 4\n20 0\n40 0\n41 0\n10 4\n20 9\n");
  EXPECT_NEAR(AreaOf(model.mesh), 2, 1e-12);
  EXPECT_EQ(model.degenerate_faces, 0);
}

TEST(DxfPath, CircleIsAClosedCylinderWithinTheTolerance) {
  for (const double tolerance : {0.1, 0.001}) {
    DxfOptions options;
    options.chord_tolerance = tolerance;
    const Model model = ReadEntities("0 CIRCLE\n10 5\n20 6\n40 2\n39 3\n", "", options);
    EXPECT_TRUE(IsClosed(model));
    const double volume = VolumeOf(model.mesh), cylinder = kPi * 4 * 3;
    EXPECT_LT(volume, cylinder);
    const double thinner = 2 - tolerance;
    EXPECT_GT(volume, kPi * thinner * thinner * 3);
  }
}

// The block is faceted where it stands: ten times as large, ten times as fine.
TEST(DxfPath, ToleranceHoldsAfterTheInsertsScale) {
  const Model model = ReadEntities("0 INSERT\n2 B\n41 10\n42 10\n43 10\n",
                                   "0 BLOCK\n2 B\n0 CIRCLE\n10 0\n20 0\n40 1\n39 1\n0 ENDBLK\n");
  for (const auto& t : model.mesh.triangles) {
    const Vector3d middle = (model.mesh.vertices[t[0]] + model.mesh.vertices[t[1]]) / 2;
    if (std::abs(model.mesh.vertices[t[0]].z() - model.mesh.vertices[t[1]].z()) > 1e-9) continue;
    if (std::abs(model.mesh.vertices[t[2]].z() - model.mesh.vertices[t[1]].z()) < 1e-9) continue;
    EXPECT_GT(middle.head<2>().norm(), 10 - 0.0021);
  }
}

TEST(DxfPath, ArcIsAnOpenWall) {
  const Model model = ReadEntities("0 ARC\n10 0\n20 0\n40 2\n50 350\n51 80\n39 1\n");
  EXPECT_NEAR(AreaOf(model.mesh), kPi, 0.002);  // a quarter of 2 pi r, 1 m high
}

TEST(DxfPath, PolylineWithWidthIsARibbonAndWithThicknessAPrism) {
  const std::string corner =
      "0 LWPOLYLINE\n90 3\n70 0\n43 0.2\n38 5\n10 0\n20 0\n10 4\n20 0\n10 4\n20 3\n";
  const Model ribbon = ReadEntities(corner);
  EXPECT_NEAR(AreaOf(ribbon.mesh), 7 * 0.2, 1e-12);  // mitred: the length along the middle
  EXPECT_NEAR(ribbon.mesh.vertices[0].z(), 5, 1e-12);
  const Model prism = ReadEntities(corner + "39 2\n");
  EXPECT_TRUE(IsClosed(prism));
  EXPECT_NEAR(VolumeOf(prism.mesh), 7 * 0.2 * 2, 1e-12);
  const Model sunk = ReadEntities(corner + "39 -2\n");
  EXPECT_NEAR(VolumeOf(sunk.mesh), 7 * 0.2 * 2, 1e-12);
}

// A donut: two half circles of bulge 1, as wide as its ring.
TEST(DxfPath, BulgedRingHasItsArea) {
  const Model ring =
      ReadEntities("0 LWPOLYLINE\n90 2\n70 1\n43 0.5\n10 -1\n20 0\n42 1\n10 1\n20 0\n42 1\n");
  EXPECT_NEAR(AreaOf(ring.mesh), kPi * (1.25 * 1.25 - 0.75 * 0.75), 0.02);
}

TEST(DxfPath, OldPolylineIsReadLikeTheNew) {
  const Model model = ReadEntities(
      "0 POLYLINE\n70 1\n39 3\n30 7\n0 VERTEX\n10 0\n20 0\n0 VERTEX\n10 2\n20 0\n"
      "0 VERTEX\n10 2\n20 2\n0 SEQEND\n");
  EXPECT_NEAR(AreaOf(model.mesh), 3 * (4 + std::sqrt(8)), 1e-12);
  EXPECT_NEAR(model.mesh.vertices[0].z(), 7, 1e-12);
  EXPECT_EQ(model.entities.at("POLYLINE"), 1);
}

TEST(DxfPath, LinesWithoutEitherAreCounted) {
  const Model model = ReadEntities("0 LINE\n10 0\n20 0\n11 1\n21 0\n0 CIRCLE\n10 0\n20 0\n40 1\n");
  EXPECT_TRUE(model.mesh.triangles.empty());
  EXPECT_EQ(model.skipped.size(), 2u);
}

// The drawing as AutoCAD would write it in binary; until R12 a group code is one byte.
std::string Binary(const std::string& text, bool long_codes) {
  std::string binary("AutoCAD Binary DXF\r\n\x1a\0", 22);
  std::istringstream lines(text);
  std::string code_line, value;
  const auto append = [&binary](auto number) {
    binary.append(reinterpret_cast<const char*>(&number), sizeof(number));
  };
  while (std::getline(lines, code_line) && std::getline(lines, value)) {
    const int code = std::stoi(code_line);
    if (long_codes) {
      append(static_cast<int16_t>(code));
    } else {
      append(static_cast<uint8_t>(code));
    }
    if (code >= 10 && code < 60) {
      append(std::stod(value));
    } else if (code >= 60 && code < 80) {
      append(static_cast<int16_t>(std::stoi(value)));
    } else if (code >= 90 && code < 100) {
      append(std::stoi(value));
    } else {
      binary += value + '\0';
    }
  }
  return binary;
}

TEST(DxfBinary, IsReadAsTheTextIs) {
  const ScratchFolder folder;
  const std::string text = DrawingText(
      UnitSquare("WALL") + "0 INSERT\n2 B\n10 0.1\n20 -7.25\n30 1e-3\n70 2\n44 3.5\n",
      "0 BLOCK\n2 B\n" + UnitSquare("GLASS") + "0 CIRCLE\n8 C\n10 0\n20 0\n40 1\n39 1\n0 ENDBLK\n");
  const Model ascii = ReadDxf(folder.Write("a.dxf", text));
  for (const bool long_codes : {false, true}) {
    const Model binary = ReadDxf(folder.Write("b.dxf", Binary(text, long_codes)));
    EXPECT_EQ(binary.mesh.vertices, ascii.mesh.vertices);
    EXPECT_EQ(binary.mesh.triangles, ascii.mesh.triangles);
    EXPECT_EQ(binary.mesh.surfaces, ascii.mesh.surfaces);
    EXPECT_EQ(binary.entities, ascii.entities);
    EXPECT_THAT(binary.format, HasSubstr("binary"));
  }
}

TEST(DxfBinary, CutAnywhereIsRefused) {
  const ScratchFolder folder;
  const std::string whole = Binary(DrawingText(UnitSquare("W")), true);
  for (size_t length = 22; length < whole.size(); length += 3) {
    try {
      ReadDxf(folder.Write("cut.dxf", whole.substr(0, length)));
      ADD_FAILURE() << length;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("cut.dxf: byte "));
    }
  }
}

}  // namespace
}  // namespace insitu
