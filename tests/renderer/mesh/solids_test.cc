// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/solids.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/mesh/overlaid_faces.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

void AddTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, ModelMesh* mesh) {
  const int first = static_cast<int>(mesh->vertices.size());
  mesh->vertices.insert(mesh->vertices.end(), {a, b, c});
  mesh->triangles.emplace_back(first, first + 1, first + 2);
  mesh->surface_of_triangle.push_back(0);
}

// Every face with vertices of its own, as 3DFACE gives them.
ModelMesh Cube(const Vector3d& corner) {
  ModelMesh mesh;
  mesh.surfaces.resize(1);
  mesh.surfaces[0].layer = std::string("W");
  const auto v = [&](int i) { return Vector3d(corner + Vector3d(i & 1, (i >> 1) & 1, i >> 2)); };
  for (const auto& f : {std::array{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}}) {
    AddTriangle(v(f[0]), v(f[1]), v(f[2]), &mesh);
    AddTriangle(v(f[0]), v(f[2]), v(f[3]), &mesh);
  }
  return mesh;
}

const Vector3d kFar(2600000.4, 1200000.7, 430.1);

TEST(Solids, CubeOfLooseFacesIsOneClosedBody) {
  ModelMesh cube = Cube(kFar);
  const SolidsReport report = MendSolids(&cube);
  EXPECT_EQ(cube.vertices.size(), 8u);
  EXPECT_EQ(report.bodies, 1);
  EXPECT_EQ(report.closed_bodies, 1);
  EXPECT_EQ(report.open_edges, 0);
  EXPECT_EQ(report.flipped_faces, 0);
}

TEST(Solids, FlippedFacesOfAClosedBodyAreTurnedOut) {
  for (const bool all : {false, true}) {
    ModelMesh cube = Cube(Vector3d::Zero());
    for (size_t t = 0; t < 12; ++t) {
      if (all || t == 3 || t == 7) std::swap(cube.triangles[t][0], cube.triangles[t][1]);
    }
    EXPECT_EQ(MendSolids(&cube).flipped_faces, all ? 12 : 2);
    EXPECT_NEAR(VolumeOf(cube), 1, 1e-12);
  }
}

// A box of 3 m with a hollow of 1 m; the same that looks outwards, or stands beside, is no hollow.
TEST(Solids, HollowsKeepTheirFacesInwards) {
  const auto volume = [](const Vector3d& corner, bool inwards, const std::string& layer) {
    ModelMesh boxes = Cube(Vector3d::Zero());
    for (Vector3d& v : boxes.vertices) v *= 3;
    ModelMesh small = Cube(corner);
    small.surfaces[0].layer = layer;
    for (auto& t : small.triangles) {
      if (inwards) std::swap(t[0], t[1]);
    }
    Append(small, &boxes);
    MendSolids(&boxes);
    return VolumeOf(boxes);
  };
  EXPECT_NEAR(volume({1, 1, 1}, true, "W"), 26, 1e-9);
  EXPECT_NEAR(volume({1, 1, 1}, false, "W"), 28, 1e-9);
  EXPECT_NEAR(volume({4, 1, 1}, true, "W"), 28, 1e-9);
  EXPECT_NEAR(volume({1, 1, 1}, true, "OTHER"), 28, 1e-9);
}

TEST(Solids, AMissingFaceLeavesOpenEdgesAndNothingIsTurned) {
  ModelMesh box = Cube(Vector3d::Zero());
  box.triangles.resize(10);
  box.surface_of_triangle.resize(10);
  std::swap(box.triangles[4][0], box.triangles[4][1]);
  const std::vector<Eigen::Vector3i> before = box.triangles;
  const SolidsReport report = MendSolids(&box);
  EXPECT_EQ(report.open_edges, 4);
  EXPECT_EQ(report.closed_bodies, 0);
  EXPECT_EQ(report.unmended_faces, 1);
  EXPECT_EQ(report.flipped_faces, 0);
}

TEST(Solids, DuplicateAndDegenerateFacesGo) {
  ModelMesh mesh = Cube(Vector3d::Zero());
  AddTriangle({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, &mesh);  // not a face of the cube's diagonal split
  AddTriangle({0, 0, 1}, {1, 0, 0}, {0, 0, 0}, &mesh);  // the same, turned
  AddTriangle({0, 0, 0}, {2, 0, 0}, {5, 0, 0}, &mesh);  // no area
  mesh.surfaces.resize(2);
  mesh.surfaces[1].layer = "OTHER";
  AddTriangle({1, 0, 0}, {0, 0, 1}, {0, 0, 0}, &mesh);
  mesh.surface_of_triangle.back() = 1;
  const SolidsReport report = MendSolids(&mesh);
  EXPECT_EQ(report.duplicate_faces, 1);
  EXPECT_EQ(report.degenerate_faces, 1);
  EXPECT_EQ(report.coincident_faces, 1);
  EXPECT_EQ(mesh.triangles.size(), 14u);
}

// Two vertices less than the tolerance apart are one for the question whether faces meet.
TEST(Solids, CracksBelowTheToleranceAreNone) {
  ModelMesh cube = Cube(kFar);
  for (size_t i = 0; i < cube.vertices.size(); ++i) cube.vertices[i].x() += 1e-6 * (i % 5);
  EXPECT_EQ(MendSolids(&cube).open_edges, 0);
  ModelMesh torn = Cube(kFar);
  torn.vertices[0].x() += 1e-3;
  EXPECT_GT(MendSolids(&torn).open_edges, 0);
}

TEST(Solids, TwoCubesThatShareAnEdgeAreTwoBodies) {
  ModelMesh cubes = Cube(Vector3d::Zero());
  Append(Cube({1, 1, 0}), &cubes);
  const SolidsReport report = MendSolids(&cubes);
  EXPECT_EQ(report.bodies, 2);
  EXPECT_EQ(report.closed_bodies, 2);
  EXPECT_EQ(report.crowded_edges, 1);
}

// Two windows that meet at the corner of a building, each drawn onto its wall.
TEST(OverlaidFaces, WindowsStandBeforeTheirWalls) {
  ModelMesh mesh;
  mesh.surfaces.resize(2);
  mesh.surfaces[1].layer = "WINDOW";
  const auto add = [&](const Vector3d& along, double low, double high, int surface) {
    const Vector3d a(0, 0, low), b(0, 0, high);
    AddTriangle(a, along + a, along + b, &mesh);
    AddTriangle(a, along + b, b, &mesh);
    mesh.surface_of_triangle.end()[-1] = mesh.surface_of_triangle.end()[-2] = surface;
  };
  for (const Vector3d& along : {Vector3d(8, 0, 0), Vector3d(0, -6, 0)}) {
    add(along, 0, 3, 0);
    add(0.9 * along, 1, 2, 1);
  }
  MendSolids(&mesh);
  const ModelMesh before = mesh;
  EXPECT_EQ(RaiseOverlaidFaces(&mesh, 0.002), 4);
  double moved = 0;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    moved = std::max(moved, (mesh.vertices[v] - before.vertices[v]).norm());
  }
  EXPECT_NEAR(moved, 0.002 * std::sqrt(2), 1e-12);  // the corner goes both ways
}

TEST(OverlaidFaces, BoxesThatStandFlushAreLeftAlone) {
  ModelMesh boxes = Cube(Vector3d::Zero());
  for (Vector3d& v : boxes.vertices) v *= 3;
  ModelMesh small = Cube({1, 1, 2});
  small.surfaces[0].layer = "SKYLIGHT";
  Append(small, &boxes);
  MendSolids(&boxes);
  EXPECT_EQ(RaiseOverlaidFaces(&boxes), 0);
}

// A tetrahedron on whose base others stand by their edges: its base hangs by crowded edges alone.
TEST(Solids, FacesAtCrowdedEdgesStayWithTheirBody) {
  ModelMesh mesh;
  mesh.surfaces.resize(2);
  mesh.surfaces[1].layer = "fins";
  mesh.vertices = {{5, -3, 0}, {1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}, {-4, 6, 0}};
  mesh.triangles = {{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}};
  for (const auto& [a, b] : {std::pair(1, 2), std::pair(2, 3), std::pair(3, 1)}) {
    mesh.triangles.emplace_back(a, b, 0);
    mesh.triangles.emplace_back(a, b, 5);
  }
  mesh.surface_of_triangle = {0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(MendSolids(&mesh).closed_bodies, 1);
  double volume = 0;
  for (int t = 0; t < 4; ++t) {
    const Eigen::Vector3i& corners = mesh.triangles[t];
    volume +=
        mesh.vertices[corners[0]].dot(mesh.vertices[corners[1]].cross(mesh.vertices[corners[2]])) /
        6;
  }
  EXPECT_NEAR(volume, 1.0 / 6, 1e-12);
}

}  // namespace
}  // namespace insitu
