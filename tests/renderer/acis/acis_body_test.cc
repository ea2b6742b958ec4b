// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/acis_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/acis/acis_file.h"
#include "renderer/mesh/solids.h"
#include "tests/renderer/acis/sat_text.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using Way = SatText::Way;

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance = 1e-4;

AcisShape Faceted(const std::string& text) {
  const auto file = ReadSat(text);
  EXPECT_TRUE(file);
  return FacetedAcis(file.value_or(AcisFile{}), kTolerance);
}

ModelMesh MeshOf(const AcisShape& shape) {
  ModelMesh mesh;
  mesh.surfaces.emplace_back();
  mesh.vertices = shape.vertices;
  mesh.triangles = shape.triangles;
  mesh.surface_of_triangle.assign(shape.triangles.size(), 0);
  return mesh;
}

// Closed, looking outwards, of this volume within a share.
void ExpectSolid(const AcisShape& shape, double volume, double share) {
  EXPECT_TRUE(shape.unread.empty()) << (shape.unread.empty() ? "" : shape.unread.begin()->first);
  ModelMesh mesh = MeshOf(shape);
  EXPECT_NEAR(VolumeOf(mesh), volume, share * volume);
  const SolidsReport report = MendSolids(&mesh);
  EXPECT_EQ(report.open_edges, 0);
  EXPECT_EQ(report.crowded_edges, 0);
  EXPECT_EQ(report.flipped_faces, 0);
  EXPECT_EQ(report.closed_bodies, report.bodies);
}

TEST(AcisBody, ACubeOfEveryVersion) {
  for (const int version : {106, 200, 400, 500, 700, 20800, 21800, 22300}) {
    const AcisShape shape = Faceted(CubeText(version));
    EXPECT_EQ(shape.faces, 6) << version;
    EXPECT_EQ(shape.triangles.size(), 12u) << version;
    ExpectSolid(shape, 1, 1e-12);
  }
}

TEST(AcisBody, ItsTransformTurnsScalesAndMirrors) {
  const AcisShape turned =
      Faceted(CubeText(400, "0 1 0 -1 0 0 0 0 1 10 20 30 2 rotate no_reflect no_shear"));
  ExpectSolid(turned, 8, 1e-12);
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : turned.vertices) box.extend(v);
  EXPECT_LT((box.min() - Vector3d(8, 20, 30)).norm(), 1e-12);
  ExpectSolid(Faceted(CubeText(700, "-1 0 0 0 1 0 0 0 1 5 0 0 1 no_rotate reflect no_shear")), 1,
              1e-12);
}

// A round hole through a block, its wall a cylinder that looks inwards.
std::string BlockWithHole() {
  SatText text(700);
  const std::vector<Vector3d> corners = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0},
                                         {-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}};
  text.Polyhedron(corners, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
  const int low = text.Circle({0.5, 0, 0}, {0, 0, 1}, {1, 0, 0});
  const int high = text.Circle({0.5, 0, 1}, {0, 0, 1}, {0, 1, 0});
  const auto rim = [&](const std::vector<int>& order) {
    std::vector<int> vertices;
    for (const int c : order) vertices.push_back(text.Vertex(corners[c]));
    std::vector<Way> loop;
    for (size_t i = 0; i < order.size(); ++i) {
      const size_t j = (i + 1) % order.size();
      loop.emplace_back(
          text.Edge(vertices[i], vertices[j], text.Line(corners[order[i]], corners[order[j]])),
          false);
    }
    return loop;
  };
  text.Face(text.Plane({0, 0, 0}, {0, 0, -1}), false, {rim({3, 2, 1, 0}), {{low, false}}});
  text.Face(text.Plane({0, 0, 1}, {0, 0, 1}), false, {rim({4, 5, 6, 7}), {{high, true}}});
  text.Face(text.Cone({0.5, 0, 0}, {0, 0, 1}, {1, 0, 0}), true, {{{low, true}}, {{high, false}}});
  return text.Text();
}

TEST(AcisBody, ABlockWithAHole) { ExpectSolid(Faceted(BlockWithHole()), 16 - kPi, 2e-4); }

std::string Cylinder(bool is_cone) {
  SatText text(400);
  const int low = text.Circle({0, 0, 0}, {0, 0, 1}, {2, 0, 0});
  text.Face(text.Plane({0, 0, 0}, {0, 0, 1}), true, {{{low, true}}});
  if (is_cone) {  // a tip with a loop of its own, as Open Design writes it
    const int tip = text.Vertex({0, 0, 3});
    text.Face(text.Cone({0, 0, 0}, {0, 0, 1}, {0, 2, 0}, "-0.5547001962252291 0.8320502943378437"),
              false, {{{low, false}}, {{text.Edge(tip, tip, -1), false}}});
    return text.Text();
  }
  const int high = text.Circle({0, 0, 3}, {0, 0, 1}, {0, -2, 0});
  text.Face(text.Plane({0, 0, 3}, {0, 0, 1}), false, {{{high, false}}});
  text.Face(text.Cone({0, 0, 1}, {0, 0, 1}, {0, 2, 0}), false, {{{low, false}}, {{high, true}}});
  return text.Text();
}

TEST(AcisBody, ACylinderAndACone) {
  ExpectSolid(Faceted(Cylinder(false)), 12 * kPi, 2e-4);
  ExpectSolid(Faceted(Cylinder(true)), 4 * kPi, 2e-4);
}

// Its wall has one loop of arcs and lines; far from the origin no rim is a line to the last bit.
// The arcs may be splines, the upper one against its own direction.
std::string HalfCylinder(bool has_splines) {
  SatText text(700);
  const Vector3d middle(1000.1, 0.3, -70.7);
  const Vector3d a = middle - Vector3d::UnitX(), b = middle + Vector3d::UnitX(), up(0, 0, 2.1);
  const int va = text.Vertex(a), vb = text.Vertex(b), va2 = text.Vertex(a + up),
            vb2 = text.Vertex(b + up);
  const auto arc = [&](int from, int to, const Vector3d& center) {
    if (!has_splines) {
      const std::string data = SatText::Numbers(center) + " 0 0 1 1 0 0 1 I I";
      return text.Edge(from, to, text.Add("ellipse-curve", data));
    }
    const bool is_upper = center.z() > middle.z();
    std::string poles;
    for (const Vector3d& pole :
         {Vector3d(1, 0, 1), Vector3d(1, 1, std::sqrt(0.5)), Vector3d(0, 1, 1),
          Vector3d(-1, 1, std::sqrt(0.5)), Vector3d(-1, 0, 1)}) {  // x, y, weight
      const Vector3d off(is_upper ? -pole.x() : pole.x(), pole.y(), 0);
      poles += SatText::Numbers(center + off) + " " + std::to_string(pole.z()) + " ";
    }
    return text.Edge(
        from, to,
        text.Add("intcurve-curve", std::string(is_upper ? "reversed" : "forward") +
                                       " { exactcur full nurbs 2 open 3 0 2 0.5 2 1 2 " + poles +
                                       "0 } I I"));
  };
  const Vector3d bit = 1e-12 * Vector3d::UnitZ();  // off the ends, as in AutoCAD's files
  const int low = arc(vb, va, middle - bit), high = arc(vb2, va2, middle + up + bit);
  const int front_low = text.Edge(va, vb, text.Line(a, b)),
            front_high = text.Edge(va2, vb2, text.Line(a + up, b + up)),
            left = text.Edge(va, va2, text.Line(a, a + up)),
            right = text.Edge(vb, vb2, text.Line(b, b + up));
  text.Face(text.Plane(middle, {0, 0, -1}), false, {{{low, true}, {front_low, true}}});
  text.Face(text.Plane(middle + up, {0, 0, 1}), false, {{{high, false}, {front_high, false}}});
  text.Face(text.Plane(a, {0, -1, 0}), false,
            {{{front_low, false}, {right, false}, {front_high, true}, {left, true}}});
  text.Face(text.Cone(middle, {0, 0, 1}, {1, 0, 0}), false,
            {{{low, false}, {left, false}, {high, true}, {right, true}}});
  return text.Text();
}

TEST(AcisBody, AHalfCylinderCutAlongItsAxis) {
  ExpectSolid(Faceted(HalfCylinder(false)), 1.05 * kPi, 2e-4);
}

TEST(AcisBody, SplinesAsEdges) { ExpectSolid(Faceted(HalfCylinder(true)), 1.05 * kPi, 2e-4); }

TEST(AcisBody, AWholeSphereStaysOne) {
  const AcisShape shape = Faceted(SphereText(106, {1, 2, 3}, 0.5));
  EXPECT_TRUE(shape.triangles.empty());
  ASSERT_EQ(shape.spheres.size(), 1u);
  EXPECT_EQ(shape.spheres[0].center, Vector3d(1, 2, 3));
  EXPECT_EQ(shape.spheres[0].radius, 0.5);
}

// Also through both of its own poles.
TEST(AcisBody, ASphereCutByAPlane) {
  for (const double off : {0.25, 0.0, -0.6}) {
    SatText text(700);
    const int cut = text.Circle({off, 0, 0}, {1, 0, 0}, {0, 0, std::sqrt(1 - off * off)});
    text.Face(text.Add("sphere-surface", "0 0 0 1 1 0 0 0 0 1 forward_v I I I I"), false,
              {{{cut, true}}});
    text.Face(text.Plane({off, 0, 0}, {1, 0, 0}), false, {{{cut, false}}});
    const double cap = kPi * (1 - off) * (1 - off) * (2 + off) / 3;
    ExpectSolid(Faceted(text.Text()), 4 * kPi / 3 - cap, 1e-3);
  }
}

// Two loops about the drill's axis, which its poles are not on.
TEST(AcisBody, ADrilledSphere) {
  SatText text(700);
  const double half = std::sqrt(3);
  const int top = text.Circle({0, 0, half}, {0, 0, 1}, {1, 0, 0});
  const int bottom = text.Circle({0, 0, -half}, {0, 0, 1}, {1, 0, 0});
  text.Face(text.Add("sphere-surface", "0 0 0 2 1 0 0 0 0 1 forward_v I I I I"), false,
            {{{bottom, false}}, {{top, true}}});
  text.Face(text.Cone({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), true, {{{bottom, true}}, {{top, false}}});
  ExpectSolid(Faceted(text.Text()), 4 * kPi * half, 1e-3);
}

TEST(AcisBody, ATorusAndAQuarterOfOne) {
  SatText whole(700);
  const std::string torus = "0 0 0 0 0 1 2 0.5 1 0 0 forward_v I I I I";
  whole.Face(whole.Add("torus-surface", torus), false, {});
  ExpectSolid(Faceted(whole.Text()), kPi * kPi, 1e-3);
  SatText bend(700);
  const int begin = bend.Circle({2, 0, 0}, {0, 1, 0}, {0.5, 0, 0});
  const int end = bend.Circle({0, 2, 0}, {-1, 0, 0}, {0, 0.5, 0});
  bend.Face(bend.Plane({2, 0, 0}, {0, -1, 0}), false, {{{begin, true}}});
  bend.Face(bend.Plane({0, 2, 0}, {-1, 0, 0}), false, {{{end, false}}});
  bend.Face(bend.Add("torus-surface", torus), false, {{{begin, false}}, {{end, true}}});
  ExpectSolid(Faceted(bend.Text()), kPi * kPi / 4, 1e-3);
}

TEST(AcisBody, EndsWhereThereAreTooManyFacets) {
  const AcisShape shape = FacetedAcis(*ReadSat(CubeText(700)), kTolerance, 5);
  EXPECT_EQ(shape.faces, 6);
  EXPECT_LT(shape.triangles.size(), 12u);
  EXPECT_EQ(shape.unread.count("beyond the facets that a drawing may have"), 1u);
}

TEST(AcisBody, WhatIsNotReadIsCountedByReason) {
  SatText text(700);
  const int low = text.Circle({0, 0, 0}, {0, 0, 1}, {2, 0, 0});
  text.Face(text.Add("spline-surface", "forward { ruledsur } I I I I"), false, {{{low, true}}});
  const int start = text.Vertex({0, 0, 0}), end = text.Vertex({1, 0, 0});
  const int wave = text.Edge(start, end, text.Add("intcurve-curve", "forward { surfint } I I"));
  const int back = text.Edge(end, start, text.Line({1, 0, 0}, {0, 0, 0}));
  text.Face(text.Plane({0, 0, 0}, {0, 0, 1}), false, {{{wave, false}, {back, false}}});
  // A circle that the edge's ends are not on, and a spline.
  const std::string spline = "forward { exactcur nubs 1 open 2 0 1 1 1 ";
  for (const int curve : {text.Add("ellipse-curve", "9 0 0 0 0 1 2 0 0 1 I I"),
                          text.Add("intcurve-curve", spline + "0 5 0 1 5 0 0 } I I")}) {
    const int off = text.Edge(start, end, curve);
    text.Face(text.Plane({0, 0, 0}, {0, 0, 1}), false, {{{off, false}, {back, false}}});
  }
  const AcisShape shape = Faceted(text.Text());
  EXPECT_TRUE(shape.triangles.empty());
  EXPECT_EQ(shape.unread,
            (std::map<std::string, int>{{"bounded by a intcurve-curve", 1},
                                        {"on a spline-surface", 1},
                                        {"with an edge whose ends are off its curve", 2}}));
}

// Beside planes that are read.
TEST(AcisBody, AFaceOnASplineCostsOnlyItself) {
  std::string text = HalfCylinder(true);
  text.replace(text.find("cone-surface"), 12, "spline-surface");
  const AcisShape shape = Faceted(text);
  EXPECT_EQ(shape.faces, 4);
  EXPECT_EQ(shape.unread, (std::map<std::string, int>{{"on a spline-surface", 1}}));
  double area = 0;
  for (const Eigen::Vector3i& t : shape.triangles) {
    const Vector3d& a = shape.vertices[t[0]];
    area += (shape.vertices[t[1]] - a).cross(shape.vertices[t[2]] - a).norm() / 2;
  }
  const AcisShape whole = Faceted(HalfCylinder(true));
  EXPECT_GT(area, 0.4);
  EXPECT_LT(shape.triangles.size(), whole.triangles.size());
}

TEST(AcisBody, BinaryFilesHoldTheSame) {
  const std::string sab = SabOf(*ReadSat(BlockWithHole()));
  const auto file = ReadSab(sab);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->version, 700);
  ExpectSolid(FacetedAcis(*file, kTolerance), 16 - kPi, 2e-4);
  EXPECT_FALSE(ReadSab(sab.substr(0, 200)));
  EXPECT_FALSE(ReadSab("no such file"));
}

TEST(AcisText, IsTurnedAboutTheMiddleOfAscii) {
  EXPECT_EQ(DecodedAcisText("koo o n o"), "400 0 1 0");
  EXPECT_EQ(DecodedAcisText(DecodedAcisText("body $1 -1.5e-7 {#}")), "body $1 -1.5e-7 {#}");
}

}  // namespace
}  // namespace insitu
