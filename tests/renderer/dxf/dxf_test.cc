// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "renderer/dxf/dxf_name.h"
#include "tests/renderer/dxf/dxf_text.h"
#include "tests/renderer/dxf/read_drawing.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

std::vector<std::string> LayersOf(const ModelMesh& mesh) {
  std::vector<std::string> layers;
  for (const SurfaceNames& names : mesh.surfaces) layers.push_back(names.layer);
  return layers;
}

bool Has(const ModelMesh& mesh, const Vector3d& point) {
  return std::ranges::any_of(mesh.vertices,
                             [&](const Vector3d& v) { return (v - point).norm() < 1e-12; });
}

// A 2 x 3 x 4 m box from the origin; vertices in the order x fastest.
const char kBoxMesh[] = R"(
  0 MESH
  8 BOX
  100 AcDbSubDMesh
  71 2
  72 0
  91 0
  92 8
  10 0
  20 0
  30 0
  10 2
  20 0
  30 0
  10 0
  20 3
  30 0
  10 2
  20 3
  30 0
  10 0
  20 0
  30 4
  10 2
  20 0
  30 4
  10 0
  20 3
  30 4
  10 2
  20 3
  30 4
  93 30
)";

const int kBoxFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

Vector3d BoxVertex(int i) { return {i & 1 ? 2. : 0., i & 2 ? 3. : 0., i & 4 ? 4. : 0.}; }

std::string Point(int code, const Vector3d& p) {
  std::ostringstream text;
  text.precision(17);
  text << code << " " << p.x() << "\n" << code + 10 << " " << p.y() << "\n";
  text << code + 20 << " " << p.z() << "\n";
  return text.str();
}

std::string BoxAsMesh() {
  std::string text = kBoxMesh;
  for (const auto& face : kBoxFaces) {
    text += "90 4\n";
    for (const int corner : face) text += "90 " + std::to_string(corner) + "\n";
  }
  return text + "94 0\n95 0\n90 0\n";
}

std::string BoxAsFaces() {
  std::string text;
  for (const auto& face : kBoxFaces) {
    text += "0 3DFACE\n8 BOX\n";
    for (int i = 0; i < 4; ++i) text += Point(10 + i, BoxVertex(face[i]));
  }
  return text;
}

// Every second edge is invisible: its first corner is negative.
std::string BoxAsPolyface() {
  std::string text = "0 POLYLINE\n8 BOX\n66 1\n70 64\n";
  for (int i = 0; i < 8; ++i) text += "0 VERTEX\n8 BOX\n70 192\n" + Point(10, BoxVertex(i));
  for (const auto& face : kBoxFaces) {
    text += "0 VERTEX\n8 0\n70 128\n10 0\n20 0\n";
    for (int i = 0; i < 4; ++i) {
      text += std::to_string(71 + i) + (i % 2 ? " -" : " ") + std::to_string(face[i] + 1) + "\n";
    }
  }
  return text + "0 SEQEND\n";
}

std::string BoxAsSolid() {
  return R"(
  0 SOLID
  8 BOX
  10 0
  20 0
  11 2
  21 0
  12 0
  22 3
  13 2
  23 3
  39 4
)";
}

class DxfBox : public testing::TestWithParam<std::string> {};

TEST_P(DxfBox, HasItsAreaAndVolume) {
  const Model model = ReadEntities(GetParam());
  EXPECT_EQ(model.mesh.triangles.size(), 12u);
  EXPECT_EQ(LayersOf(model.mesh), std::vector<std::string>{"BOX"});
  EXPECT_NEAR(AreaOf(model.mesh), 52, 1e-12);
  EXPECT_NEAR(VolumeOf(model.mesh), 24, 1e-12);
}

// A mirrored, rotated, scaled copy stays a body whose faces look outwards.
TEST_P(DxfBox, KeepsItsOutsideWhenMirrored) {
  const Model model = ReadEntities("0 INSERT\n2 B\n10 5\n20 6\n30 7\n41 -2\n50 30\n",
                                   "0 BLOCK\n2 B\n" + GetParam() + "0 ENDBLK\n");
  EXPECT_NEAR(VolumeOf(model.mesh), 48, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Entities, DxfBox,
                         testing::Values(BoxAsMesh(), BoxAsFaces(), BoxAsPolyface(), BoxAsSolid()));

TEST(Dxf, PolygonMeshClosedBothWaysHasNoBorder) {
  std::string torus = "0 POLYLINE\n8 T\n70 49\n71 5\n72 4\n";
  for (int m = 0; m < 5; ++m) {
    for (int n = 0; n < 4; ++n) {
      const double u = 2 * std::numbers::pi * m / 5, v = 2 * std::numbers::pi * n / 4;
      const double r = 3 + std::cos(v);
      torus += "0 VERTEX\n70 64\n" + Point(10, {r * std::cos(u), r * std::sin(u), std::sin(v)});
    }
  }
  const ModelMesh mesh = ReadEntities(torus + "0 SEQEND\n").mesh;
  EXPECT_EQ(mesh.triangles.size(), 2u * 5 * 4);
  std::set<std::pair<int, int>> edges;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second);
  }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
}

TEST(Dxf, OpenPolygonMeshHasOneFaceLessThanVerticesEachWay) {
  std::string sheet = "0 POLYLINE\n70 16\n71 3\n72 2\n";
  for (int m = 0; m < 3; ++m) {
    for (int n = 0; n < 2; ++n) sheet += "0 VERTEX\n70 64\n" + Point(10, Vector3d(m, n, 0));
  }
  const Model model = ReadEntities(sheet + "0 SEQEND\n");
  EXPECT_EQ(model.mesh.triangles.size(), 4u);
  EXPECT_NEAR(AreaOf(model.mesh), 2, 1e-15);
}

TEST(Dxf, ConcaveMeshFaceCoversItsOutlineOnly) {
  std::string text = "0 MESH\n8 L\n100 AcDbSubDMesh\n92 6\n";
  const double outline[6][2] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (const auto& p : outline) text += Point(10, Vector3d(p[0], p[1], 2 * p[0]));
  text += "93 7\n90 6\n90 0\n90 1\n90 2\n90 3\n90 4\n90 5\n";
  const Model model = ReadEntities(text);
  EXPECT_EQ(model.mesh.triangles.size(), 4u);
  EXPECT_NEAR(AreaOf(model.mesh), 6 * std::sqrt(5.0), 1e-12);  // slope 2
}

TEST(Dxf, InsertScalesThenTurnsThenMoves) {
  const Model model =
      ReadEntities("0 INSERT\n2 b\n10 10\n20 20\n30 30\n41 2\n42 3\n43 4\n50 90\n",
                   "0 BLOCK\n2 B\n10 1\n20 0\n30 0\n0 3DFACE\n" + Point(10, {1, 2, 3}) +
                       Point(11, {2, 0, 0}) + Point(12, {1, 0, 0}) + "0 ENDBLK\n");
  EXPECT_EQ(model.mesh.triangles.size(), 1u);
  EXPECT_TRUE(Has(model.mesh, {4, 20, 42}));
  EXPECT_TRUE(Has(model.mesh, {10, 22, 30}));
  EXPECT_TRUE(Has(model.mesh, {10, 20, 30}));
  EXPECT_EQ(model.entities.at("INSERT"), 1);
  EXPECT_EQ(model.entities.at("3DFACE"), 1);
}

TEST(Dxf, InsertInRowsAndColumns) {
  const Model model = ReadEntities("0 INSERT\n2 B\n10 0\n20 0\n70 3\n71 2\n44 10\n45 20\n50 90\n",
                                   "0 BLOCK\n2 B\n" + UnitSquare("W") + "0 ENDBLK\n");
  EXPECT_NEAR(AreaOf(model.mesh), 6, 1e-12);
  EXPECT_TRUE(Has(model.mesh, {0, 0, 0}));
  EXPECT_TRUE(Has(model.mesh, {-20, 20, 0}));  // last row and column, turned by 90 degrees
  EXPECT_EQ(model.entities.at("3DFACE"), 1);   // as often as the file holds it
}

// AutoCAD's arbitrary axis algorithm, by hand: z' = -z has x' = -x; z' = x has x' = y.
TEST(Dxf, ExtrusionTurnsTheInsert) {
  const std::string block = "0 BLOCK\n2 B\n0 3DFACE\n" + Point(10, {1, 2, 3}) +
                            Point(11, {2, 0, 0}) + Point(12, {0, 1, 0}) + "0 ENDBLK\n";
  const std::string insert = "0 INSERT\n2 B\n10 10\n20 0\n30 0\n";
  const Model down = ReadEntities(insert + Point(210, {0, 0, -1}), block);
  EXPECT_TRUE(Has(down.mesh, {-11, 2, -3}));
  const Model aside = ReadEntities(insert + Point(210, {2, 0, 0}), block);
  EXPECT_TRUE(Has(aside.mesh, {3, 11, 2}));
}

TEST(Dxf, LayerZeroTakesTheLayerOfItsInsertThroughAllLevels) {
  const std::string blocks = "0 BLOCK\n2 INNER\n" + UnitSquare("0") + UnitSquare("GLASS") +
                             "0 ENDBLK\n0 BLOCK\n2 OUTER\n0 INSERT\n8 0\n2 INNER\n0 ENDBLK\n";
  const Model model = ReadEntities("0 INSERT\n8 WALL\n2 OUTER\n", blocks);
  EXPECT_EQ(LayersOf(model.mesh), (std::vector<std::string>{"WALL", "GLASS"}));
  EXPECT_EQ(model.mesh.surface_of_triangle, (std::vector<int>{0, 0, 1, 1}));
}

TEST(Dxf, UnitsBecomeMetres) {
  const auto read = [](const std::string& units) {
    return ReadText(DxfText("0 SECTION\n2 HEADER\n9 $INSUNITS\n70 " + units + "\n0 ENDSEC\n" +
                            EntitiesSection(UnitSquare("W")) + "0 EOF"));
  };
  EXPECT_TRUE(Has(read("4").mesh, {1e-3, 1e-3, 0}));
  EXPECT_TRUE(Has(read("2").mesh, {0.3048, 0.3048, 0}));
  EXPECT_EQ(read("5").metres_per_unit, 0.01);
  EXPECT_EQ(read("0").metres_per_unit, std::nullopt);
  EXPECT_TRUE(Has(read("0").mesh, {1, 1, 0}));
}

TEST(Dxf, WhatCadDoesNotShowIsLeftOut) {
  const std::string layers =
      "0 SECTION\n2 TABLES\n0 TABLE\n2 LAYER\n0 LAYER\n2 FROZEN\n70 1\n62 7\n"
      "0 LAYER\n2 OFF\n70 0\n62 -7\n0 LAYER\n2 SHOWN\n70 0\n62 7\n0 ENDTAB\n0 ENDSEC\n";
  const std::string block =
      "0 SECTION\n2 BLOCKS\n0 BLOCK\n2 B\n" + UnitSquare("SHOWN") + "0 ENDBLK\n0 ENDSEC\n";
  const Model model = ReadText(
      DxfText(layers + block +
              EntitiesSection(
                  UnitSquare("SHOWN") + UnitSquare("frozen") + UnitSquare("OFF") +
                  UnitSquare("SHOWN") + "60 1\n" + UnitSquare("SHOWN") + "67 1\n" +
                  "0 INSERT\n2 B\n8 FROZEN\n 0 INSERT\n2 B\n8 OFF\n 0 LINE\n 0 POLYLINE\n70 1\n" +
                  "0 VERTEX\n10 1\n20 1\n0 SEQEND\n") +
              "0 EOF"));
  EXPECT_NEAR(AreaOf(model.mesh), 2, 1e-15);  // one square, and one in the block on OFF
  EXPECT_EQ(LayersOf(model.mesh), (std::vector<std::string>{"SHOWN", "SHOWN"}));
  EXPECT_EQ(model.mesh.surfaces[1].block, "B");
  EXPECT_EQ(model.skipped,
            (SkippedEntities{{{"3DFACE", "invisible"}, 1},
                             {{"3DFACE", "layer \"OFF\" is switched off"}, 1},
                             {{"3DFACE", "layer \"frozen\" is frozen"}, 1},
                             {{"3DFACE", "paper space"}, 1},
                             {{"INSERT", "layer \"FROZEN\" is frozen"}, 1},
                             {{"LINE", "without thickness or width, no surface"}, 1},
                             {{"POLYLINE", "without thickness or width, no surface"}, 1}}));
}

// What is not known is not said to have no surface: it may be a roof.
TEST(Dxf, EntitiesThatAreNotReadHaveTheirReason) {
  const Model model = ReadEntities(
      "0 TEXT\n0 SPLINE\n0 REGION\n0 LIGHT\n0 AEC_ROOF\n0 R\xFF\x01\n" + UnitSquare("W"));
  std::map<std::string, std::string> reasons;
  for (const auto& [what, count] : model.skipped) reasons[what.first] = what.second.substr(0, 12);
  EXPECT_EQ(reasons, (std::map<std::string, std::string>{{"TEXT", "lettering, s"},
                                                         {"SPLINE", "a line or po"},
                                                         {"REGION", "holds no ACI"},
                                                         {"LIGHT", "a view, pict"},
                                                         {"AEC_ROOF", "is not known"},
                                                         {"R??", "is not known"}}));
  EXPECT_EQ(model.entities.at("R??"), 1);
}

// A hole is reached by an edge that is gone along twice.
TEST(Dxf, MeshFaceWithAHole) {
  std::string text = "0 MESH\n100 AcDbSubDMesh\n92 8\n";
  for (const auto& p :
       {Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(4, 4, 0), Vector3d(0, 4, 0),
        Vector3d(1, 1, 0), Vector3d(1, 3, 0), Vector3d(3, 3, 0), Vector3d(3, 1, 0)}) {
    text += Point(10, p);
  }
  text += "93 11\n90 10\n";
  for (const int corner : {0, 1, 2, 3, 0, 4, 5, 6, 7, 4})
    text += "90 " + std::to_string(corner) + "\n";
  const ModelMesh mesh = ReadEntities(text).mesh;
  EXPECT_NEAR(AreaOf(mesh), 12, 1e-12);
  for (const auto& t : mesh.triangles) {
    const Vector3d middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    EXPECT_GT((middle - Vector3d(2, 2, 0)).cwiseAbs().maxCoeff(), 1);
  }
}

TEST(Dxf, FacesWithoutAreaAreCounted) {
  const Model model = ReadEntities("0 3DFACE\n" + Point(10, {0, 0, 0}) + Point(11, {1, 1, 1}) +
                                   Point(12, {2, 2, 2}) + "0 3DFACE\n" + Point(10, {0, 0, 0}) +
                                   Point(11, {1, 1, 1}) + Point(12, {1, 1, 1}) + UnitSquare("W"));
  EXPECT_EQ(model.degenerate_faces, 2);
  EXPECT_EQ(model.mesh.vertices.size(), 4u);  // theirs are gone with them
}

TEST(Dxf, LinesMayEndInCarriageReturnsAndCarryComments) {
  std::string text = DrawingText("999 drawn by hand\n" + UnitSquare("W"));
  for (size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2)
    text.replace(i, 1, "\r\n");
  EXPECT_NEAR(AreaOf(ReadText("\xEF\xBB\xBF" + text).mesh), 1, 1e-15);
}

TEST(Dxf, LayersNotToBePlottedAreLeftOut) {
  const Model model = ReadText(DxfText(
      "0 SECTION\n2 TABLES\n0 LAYER\n2 HELP\n70 0\n62 7\n290 0\n0 ENDSEC\n" +
      EntitiesSection(UnitSquare("HELP") + UnitSquare("W") + UnitSquare("Defpoints")) + "0 EOF"));
  EXPECT_EQ(LayersOf(model.mesh), std::vector<std::string>{"W"});
  EXPECT_EQ(model.skipped,
            (SkippedEntities{{{"3DFACE", "layer \"Defpoints\" is not to be plotted"}, 1},
                             {{"3DFACE", "layer \"HELP\" is not to be plotted"}, 1}}));
}

TEST(Dxf, ALayersColorThatIsNoneCostsOnlyItself) {
  const Model model =
      ReadText(DxfText("0 SECTION\n2 TABLES\n0 LAYER\n2 W\n70 0\n62 red\n0 ENDSEC\n") +
               DrawingText(UnitSquare("W")));
  EXPECT_EQ(model.mesh.triangles.size(), 2u);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("the layer's colour is left out"), std::string::npos);
}

TEST(Dxf, ColorsComeFromEntityLayerOrInsert) {
  const std::string tables =
      "0 SECTION\n2 TABLES\n0 LAYER\n2 RED\n70 0\n62 1\n0 ENDSEC\n"
      "0 SECTION\n2 BLOCKS\n0 BLOCK\n2 B\n" +
      UnitSquare("RED") + "62 0\n0 ENDBLK\n0 ENDSEC\n";
  const Model model =
      ReadText(DxfText(tables +
                       EntitiesSection(UnitSquare("RED") + UnitSquare("RED") + "62 3\n" +
                                       UnitSquare("RED") + "420 16711935\n0 INSERT\n2 B\n62 5\n") +
                       "0 EOF"));
  ASSERT_EQ(model.mesh.surfaces.size(), 4u);
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(1, 0, 0));  // BYLAYER
  EXPECT_EQ(model.mesh.surfaces[1].rgb, Vector3d(0, 1, 0));  // its own
  EXPECT_EQ(model.mesh.surfaces[2].rgb, Vector3d(1, 0, 1));  // true colour
  EXPECT_EQ(model.mesh.surfaces[3].rgb, Vector3d(0, 0, 1));  // BYBLOCK
  EXPECT_EQ(model.mesh.surfaces[3].block, "B");
}

TEST(Dxf, CodePageOfTheDrawing) {
  const Model model =
      ReadText(DxfText("0 SECTION\n2 HEADER\n9 $DWGCODEPAGE\n3 ANSI_1251\n0 ENDSEC\n" +
                       EntitiesSection(UnitSquare("\xD1\xF2\xE5\xED\xE0")) + "0 EOF"));
  EXPECT_EQ(LayersOf(model.mesh), std::vector<std::string>{"Стена"});
}

TEST(Dxf, NamesBecomeUtf8) {
  EXPECT_EQ(Utf8FromDxf("T\xC3\xBCr"), "T\xC3\xBCr");  // UTF-8 already
  EXPECT_EQ(Utf8FromDxf("T\xFCr"), "T\xC3\xBCr");      // Windows-1252
  EXPECT_EQ(Utf8FromDxf("\x80"), "\xE2\x82\xAC");      // the euro sign, not Latin-1
  EXPECT_EQ(Utf8FromDxf("T\\U+00FCr"), "T\xC3\xBCr");  // AutoCAD's own way
  EXPECT_EQ(Utf8FromDxf("\x8A\xBF", "ANSI_932"), "漢");
  EXPECT_EQ(Utf8FromDxf("\\M+18ABF"), "漢");
  EXPECT_EQ(Utf8FromDxf("A\\U+D800\\U+12"), "A\\U+D800\\U+12");  // no characters: left alone
}

// AutoCAD names a state of a dynamic block *U3 and tells which block it is one of.
TEST(DxfBlocks, StatesOfDynamicBlocksHaveTheirName) {
  const Model model = ReadText(DxfText(
      "0 SECTION\n2 TABLES\n0 BLOCK_RECORD\n5 2F\n2 Fenster\n"
      "0 BLOCK_RECORD\n5 32\n2 *U3\n1001 AcDbBlockRepBTag\n1070 1\n1005 02f\n"
      "0 BLOCK_RECORD\n5 33\n2 *U4\n1001 OTHER\n1005 2F\n0 ENDSEC\n"
      "0 SECTION\n2 BLOCKS\n0 BLOCK\n2 *U3\n" +
      UnitSquare("W") + "0 ENDBLK\n0 BLOCK\n2 *U4\n" + UnitSquare("W", "1") +
      "0 ENDBLK\n0 ENDSEC\n" + EntitiesSection("0 INSERT\n2 *U3\n0 INSERT\n2 *U4\n") + "0 EOF\n"));
  ASSERT_EQ(model.mesh.surfaces.size(), 2u);
  EXPECT_EQ(model.mesh.surfaces[0].block, "Fenster");
  EXPECT_EQ(model.mesh.surfaces[1].block, "");
}

TEST(DxfReader, LinesMayEndInCarriageReturnsAlone) {
  std::string text = DrawingText(UnitSquare("W"));
  std::ranges::replace(text, '\n', '\r');
  EXPECT_EQ(ReadText(text).mesh.triangles.size(), 2u);
}

}  // namespace
}  // namespace insitu
