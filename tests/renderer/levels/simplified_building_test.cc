// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/levels/simplified_building.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

// A ball of 2 * `rings` * 2 * `rings` triangles, about, of radius 1 m, 10 m from the camera.
ArtificialEnvironment Ball(const SmallSite& site, int rings, const SurfaceMaterial& material) {
  ArtificialEnvironment ball;
  ball.materials = {material};
  const Eigen::Vector3d center = site.natural.scene.origin + Eigen::Vector3d(0, 0, 3);
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double polar = std::numbers::pi * i / rings, turn = 2 * std::numbers::pi * j / around;
      ball.vertices.push_back(center + Eigen::Vector3d(std::sin(polar) * std::cos(turn),
                                                       std::sin(polar) * std::sin(turn),
                                                       std::cos(polar)));
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const int next = (j + 1) % around, a = i * around + j, b = i * around + next;
      ball.triangles.emplace_back(a, a + around, b);
      ball.triangles.emplace_back(b, a + around, b + around);
    }
  }
  ball.material_of_triangle.assign(ball.triangles.size(), 0);
  return ball;
}

double AreaOf(const ArtificialEnvironment& building) {
  double area = 0;
  for (const Eigen::Vector3i& t : building.triangles) {
    const auto corner = [&](int i) { return building.vertices[t[i]]; };
    area += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
  }
  return area;
}

TEST(OcclusionSize, IsWhatPixelsSpanAtTheNearestCamera) {
  const SmallSite site = MakeSmallSite();
  const double size = OcclusionSize(site.natural, Ball(site, 20, {}), 2);
  // The camera is 10 m south of the ball's middle; a pixel spans one over the focal length.
  const double focal = site.camera().camera.intrinsics()[0];
  EXPECT_NEAR(size, 2 * 9 / focal, 0.01 * size);
  ArtificialEnvironment about_it = Ball(site, 20, {});
  for (Eigen::Vector3d& vertex : about_it.vertices) vertex.y() *= 20;
  about_it.vertices.push_back(Center(site.camera().cam_from_world));
  EXPECT_EQ(OcclusionSize(site.natural, about_it, 2), 0);
  EXPECT_EQ(OcclusionSize(site.natural, {}, 2), 0);
}

TEST(Simplified, KeepsTheFormWithinItsCells) {
  const SmallSite site = MakeSmallSite();
  const ArtificialEnvironment ball = Ball(site, 160, {.name = "wall"});
  const ArtificialEnvironment simple = Simplified(ball, 0.05);
  EXPECT_LT(simple.triangles.size(), ball.triangles.size() / 5);
  EXPECT_NEAR(AreaOf(simple) / AreaOf(ball), 1, 0.03);
  ASSERT_EQ(simple.material_of_triangle.size(), simple.triangles.size());
  const Eigen::Vector3d center = site.natural.scene.origin + Eigen::Vector3d(0, 0, 3);
  for (const Eigen::Vector3i& t : simple.triangles) {
    const Eigen::Vector3d middle =
        (simple.vertices[t[0]] + simple.vertices[t[1]] + simple.vertices[t[2]]) / 3;
    ASSERT_NEAR((middle - center).norm(), 1, 0.05);
  }
}

TEST(Simplified, LeavesWhatIsSmallGlassOrTextured) {
  const SmallSite site = MakeSmallSite();
  const ArtificialEnvironment few = Ball(site, 20, {});
  EXPECT_EQ(Simplified(few, 0.5).triangles.size(), few.triangles.size());
  SurfaceMaterial glass{.name = "pane"}, papered{.name = "paper"};
  glass.glass = Glass();
  papered.texture = "a.png";
  for (const SurfaceMaterial& material : {glass, papered}) {
    const ArtificialEnvironment ball = Ball(site, 160, material);
    const ArtificialEnvironment simple = Simplified(ball, 0.05);
    EXPECT_EQ(simple.triangles, ball.triangles) << material.name;
  }
  const ArtificialEnvironment whole = Ball(site, 160, {});
  EXPECT_EQ(Simplified(whole, 0).triangles, whole.triangles);
}

// A building of kilometres has no cells as fine as they are wanted: none is coarser than that.
TEST(Simplified, LeavesWhatIsTooLargeForItsCells) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment ball = Ball(site, 160, {});
  for (Eigen::Vector3d& vertex : ball.vertices) vertex.x() *= 50;
  EXPECT_EQ(Simplified(ball, 0.05).triangles, ball.triangles);
  EXPECT_LT(Simplified(ball, 0.2).triangles.size(), ball.triangles.size());
}

// Spheres beside a mesh do not make its cells finer.
TEST(Simplified, CellsAreOfTheMesh) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment ball = Ball(site, 160, {});
  const size_t alone = Simplified(ball, 0.05).triangles.size();
  ball.spheres.push_back({ball.vertices[0] + Eigen::Vector3d(20, 0, 0), 1, 0});
  EXPECT_EQ(Simplified(ball, 0.05).triangles.size(), alone);
}

// Of a file that has them, each corner keeps a normal and a place on a texture.
TEST(Simplified, CornersKeepNormals) {
  const SmallSite site = MakeSmallSite();
  ArtificialEnvironment ball = Ball(site, 160, {});
  const Eigen::Vector3d center = site.natural.scene.origin + Eigen::Vector3d(0, 0, 3);
  for (const Eigen::Vector3i& t : ball.triangles) {
    for (const int corner : t) {
      ball.corner_normals.push_back((ball.vertices[corner] - center).cast<float>());
      ball.corner_uvs.emplace_back(0.5F, 0.5F);
    }
  }
  const ArtificialEnvironment simple = Simplified(ball, 0.05);
  ASSERT_EQ(simple.corner_normals.size(), 3 * simple.triangles.size());
  ASSERT_EQ(simple.corner_uvs.size(), 3 * simple.triangles.size());
  for (size_t i = 0; i < simple.corner_normals.size(); ++i) {
    const Eigen::Vector3d out =
        simple.vertices[simple.triangles[i / 3][static_cast<int>(i % 3)]] - center;
    ASSERT_LT((simple.corner_normals[i].cast<double>() - out).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace insitu
