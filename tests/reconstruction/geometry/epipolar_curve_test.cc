// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/epipolar_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

PosedCamera Looking(const Camera& camera, const Vector3d& center, const Vector3d& target) {
  Eigen::Matrix3d cam_from_world;
  cam_from_world.row(2) = (target - center).normalized();
  cam_from_world.row(0) = (target - center).cross(Vector3d::UnitZ()).normalized();
  cam_from_world.row(1) = cam_from_world.row(2).cross(cam_from_world.row(0));
  const Eigen::Quaterniond rotation(cam_from_world);
  return {"photo", camera, {rotation, -(rotation * center)}};
}

Camera WideLens() {
  return Camera("LENSMODEL_OPENCV8",
                {1500, 1502, 899.5, 601.5, -0.22, 0.05, 5e-4, -3e-4, 0, 0, 0, 0}, 1800, 1200);
}

double DistanceFrom(const std::vector<Polyline>& curve, const Vector2d& pixel) {
  double least = std::numeric_limits<double>::infinity();
  for (const Polyline& piece : curve) {
    for (size_t i = 0; i + 1 < piece.size(); ++i) {
      const Vector2d along = piece[i + 1] - piece[i];
      const double t = std::clamp((pixel - piece[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (pixel - piece[i] - t * along).norm());
    }
  }
  return least;
}

TEST(EpipolarCurve, HoldsThePointsAtAnyDepth) {
  const PosedCamera first = Looking(WideLens(), {1000, 2000, 402}, {1020, 2010, 404});
  const PosedCamera second = Looking(WideLens(), {1012, 1992, 403}, {1018, 2012, 403});
  int seen = 0;
  for (const Vector2d& pixel : {Vector2d(300, 200), Vector2d(900, 600), Vector2d(1700, 1100)}) {
    const auto curve = EpipolarCurve(first, pixel, second);
    const Vector3d ray = first.cam_from_world.rotation.conjugate() * first.camera.Unproject(pixel);
    for (double depth = 0.5; depth < 1e5; depth *= 1.05) {
      const Vector3d point = Center(first.cam_from_world) + depth * ray;
      const auto image = second.camera.Project(second.cam_from_world * point);
      const Vector3d in_cam = second.cam_from_world * point;
      const bool is_near_axis = in_cam.z() > 0.7 * in_cam.norm();  // the corners look at 0.80
      if (!image || !second.camera.Sees(*image) || !is_near_axis) continue;
      ++seen;
      EXPECT_LT(DistanceFrom(curve, *image), 0.01) << depth;
    }
    for (const Polyline& piece : curve) {
      for (const Vector2d& at : piece) EXPECT_TRUE(second.camera.Sees(at));
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(EpipolarCurve, BendsWithTheLens) {
  const PosedCamera first = Looking(WideLens(), {0, 0, 0}, {20, 10, 9});
  const PosedCamera second = Looking(WideLens(), {12, -8, 1}, {18, 12, 3});
  const auto curve = EpipolarCurve(first, {900, 1100}, second);
  ASSERT_FALSE(curve.empty());
  EXPECT_GT(DistanceFrom({{curve[0].front(), curve[0].back()}}, curve[0][curve[0].size() / 2]), 2);
}

TEST(EpipolarCurve, IsEmptyWithoutASharedView) {
  const PosedCamera first = Looking(WideLens(), {0, 0, 0}, {20, 0, 0});
  EXPECT_TRUE(
      EpipolarCurve(first, {900, 600}, Looking(WideLens(), {-5, 3, 0}, {-20, 9, 0})).empty());
  EXPECT_TRUE(EpipolarCurve(first, {900, 600}, first).empty());
  EXPECT_TRUE(EpipolarCurve(first, {900, 600}, Looking(WideLens(), {0, 0, 0}, {20, 3, 0})).empty());
}

// k1 = -0.3 alone turns back at 1 / sqrt(0.9) of the focal length, 1.05: beyond, the model puts
// what stands at 60 degrees and more into the frame.
TEST(LensView, EndsWhereTheModelFolds) {
  const Camera camera("LENSMODEL_OPENCV4", {1000, 1000, 600, 400, -0.3, 0, 0, 0}, 1201, 801);
  const LensView view(camera);
  const Vector3d far_out(1.9, 0, 1);
  ASSERT_TRUE(camera.Sees(*camera.Project(far_out)));
  EXPECT_FALSE(view.PixelOf(far_out));
  EXPECT_TRUE(view.PixelOf({0.4, 0.2, 1}));
  EXPECT_FALSE(view.PixelOf({0.4, 0.2, -1}));
  for (const Polyline& piece : ImageOfArc(view, {-0.5, 0.1, 1}, {9, 0.1, 1}, 0.25)) {
    for (size_t i = 0; i + 1 < piece.size(); ++i) EXPECT_GT(piece[i + 1].x(), piece[i].x());
  }
}

TEST(LensView, OutlineOfASquareIsOnePieceOrCutAtTheFrame) {
  const Camera camera = Camera::Pinhole(1000, 1000, 500, 400, 1001, 801);
  const LensView view(camera);
  const auto square = [](double half) {
    return std::vector<Vector3d>{
        {-half, -half, 10}, {half, -half, 10}, {half, half, 10}, {-half, half, 10}};
  };
  const auto whole = ImageOfOutline(view, Rigid3(), square(2), 0.25);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_LT((whole[0].front() - whole[0].back()).norm(), 1e-9);
  EXPECT_LT((whole[0].front() - Vector2d(300, 200)).norm(), 1e-9);
  const auto cut = ImageOfOutline(view, Rigid3(), square(4.5), 0.25);
  EXPECT_EQ(cut.size(), 2u);  // left and right sides, from the frame's top to its bottom
  for (const Polyline& piece : cut) {
    EXPECT_NEAR(std::abs(piece.front().y() - piece.back().y()), 801, 1e-6);
  }
  EXPECT_TRUE(ImageOfOutline(view, Rigid3(), square(40), 0.25).empty());
}

}  // namespace
}  // namespace insitu
