// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/camera.h"

#include <cmath>

#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

Camera RealLens() {
  return Camera("LENSMODEL_OPENCV8",
                {1502.35, 1501.58, 907.95, 595.19, -0.117, 0.032, 0.00037, -0.00044, -0.006, 0.0047,
                 -0.00067, -0.0018},
                1800, 1200);
}

// A pose whose translation has all the digits of a national grid.
PosedCamera GridPose() {
  const Eigen::AngleAxisd turn(2.8, Eigen::Vector3d(0.2, -0.9, 0.4).normalized());
  const Eigen::Vector3d center(2600512.123456789, 1200301.987654321, 431.25);
  Rigid3 pose{Eigen::Quaterniond(turn), Eigen::Vector3d::Zero()};
  pose.translation = -(pose.rotation * center);
  return {"IMG_1", RealLens(), pose};
}

TEST(Camera, PinholeInClosedForm) {
  const Camera camera = Camera::Pinhole(1000, 900, 320, 240, 640, 480);
  const auto pixel = camera.Project({0.1, -0.2, 2});
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Eigen::Vector2d(320 + 50, 240 - 90)).norm(), 1e-12);
}

TEST(Camera, RadialDistortionInClosedForm) {
  // OpenCV's model, radial only: x' = x (1 + k1 r^2 + k2 r^4).
  const Camera camera("LENSMODEL_OPENCV4", {1000, 1000, 500, 400, -0.1, 0.02, 0, 0}, 1000, 800);
  const double x = 0.3, y = -0.2, r2 = x * x + y * y, scale = 1 - 0.1 * r2 + 0.02 * r2 * r2;
  const auto pixel = camera.Project({x, y, 1});
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Eigen::Vector2d(500 + 1000 * scale * x, 400 + 1000 * scale * y)).norm(),
            1e-10);
}

TEST(Camera, UnprojectInvertsProject) {
  const Camera camera = RealLens();
  for (double y = -0.5; y < camera.height(); y += 37) {
    for (double x = -0.5; x < camera.width(); x += 41) {
      const Eigen::Vector3d sight = camera.Unproject({x, y});
      EXPECT_NEAR(sight.norm(), 1, 1e-14);
      const auto pixel = camera.Project(7.5 * sight);
      ASSERT_TRUE(pixel);
      ASSERT_LT((*pixel - Eigen::Vector2d(x, y)).norm(), 5e-12) << x << ", " << y;
    }
  }
}

TEST(Camera, JacobianAgainstDifferences) {
  const Camera camera = RealLens();
  const Eigen::Vector3d point(1.1, -0.7, 3.2);
  Eigen::Matrix<double, 2, 3> jacobian;
  ASSERT_TRUE(camera.Project(point, &jacobian));
  const double step = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d shift = step * Eigen::Vector3d::Unit(i);
    const Eigen::Vector2d difference =
        (*camera.Project(point + shift) - *camera.Project(point - shift)) / (2 * step);
    EXPECT_LT((difference - jacobian.col(i)).norm(), 1e-6);
  }
}

TEST(Camera, NothingIsSeenBehind) {
  EXPECT_FALSE(RealLens().Project({0.1, 0.1, -1}));
  EXPECT_FALSE(RealLens().Project({0.1, 0.1, 0}));
  EXPECT_FALSE(RealLens().Project({0.1, 0.1, std::nan("")}));
}

TEST(Camera, SeesItsOutermostHalfPixels) {
  const Camera camera = RealLens();
  EXPECT_TRUE(camera.Sees({-0.5, -0.5}));
  EXPECT_TRUE(camera.Sees({1799.5, 1199.5}));
  EXPECT_FALSE(camera.Sees({-0.51, 10}));
  EXPECT_FALSE(camera.Sees({10, 1199.51}));
  EXPECT_FALSE(camera.Sees({std::nan(""), 10}));
}

TEST(Camera, RefusesWrongIntrinsics) {
  EXPECT_THROW(Camera("LENSMODEL_OPENCV9", {1, 1, 1, 1}, 10, 10), std::invalid_argument);
  EXPECT_THROW(Camera("LENSMODEL_PINHOLE", {1, 1, 1}, 10, 10), std::invalid_argument);
  EXPECT_THROW(Camera("LENSMODEL_PINHOLE", {1, 1, 1, std::nan("")}, 10, 10), std::invalid_argument);
  EXPECT_THROW(Camera::Pinhole(-1, 1, 1, 1, 10, 10), std::invalid_argument);
  EXPECT_THROW(Camera::Pinhole(1, 1, 1, 1, 0, 10), std::invalid_argument);
}

TEST(CameraFile, NationalGridReturnsToTheLastBit) {
  const ScratchFolder folder;
  const auto path = folder.path() / "IMG_1.cameramodel";
  const PosedCamera written = GridPose();
  WritePosedCamera(path, written, "made by a test\nin two lines");
  const PosedCamera read = ReadPosedCamera(path);
  EXPECT_EQ(read.photo, "IMG_1");
  EXPECT_EQ(read.camera.lens_model(), written.camera.lens_model());
  EXPECT_EQ(read.camera.intrinsics(), written.camera.intrinsics());
  EXPECT_EQ(read.camera.width(), 1800);
  EXPECT_EQ(read.camera.height(), 1200);
  EXPECT_EQ(read.cam_from_world.translation, written.cam_from_world.translation);
  EXPECT_LT(read.cam_from_world.rotation.angularDistance(written.cam_from_world.rotation), 1e-15);
  EXPECT_LT((Center(read.cam_from_world) - Center(written.cam_from_world)).norm(), 1e-8);
}

TEST(CameraFile, RotationReturnsForEveryAngle) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.cameramodel";
  for (const double angle : {0.0, 1e-9, 0.5, 3.0, 3.14159265, 3.5, 6.0}) {
    PosedCamera posed = GridPose();
    posed.cam_from_world.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d(0.6, 0, 0.8));
    WritePosedCamera(path, posed, "");
    const Rigid3 read = ReadPosedCamera(path).cam_from_world;
    EXPECT_LT((read.rotation.matrix() - posed.cam_from_world.rotation.matrix()).norm(), 2e-15);
  }
}

TEST(CameraFile, NamesTheFileThatIsBad) {
  const ScratchFolder folder;
  const auto good = folder.path() / "good.cameramodel";
  WritePosedCamera(good, GridPose(), "");
  const std::string text = ReadWhole(good);
  const auto expect_bad = [&](const std::string& content) {
    const auto path = folder.Write("bad.cameramodel", content);
    EXPECT_EQ(InputErrorOf([&] { ReadCamera(path); }),
              path.string() + ": not a camera model, expected a complete .cameramodel of mrcal");
  };
  expect_bad("");
  expect_bad("no model at all");
  expect_bad(text.substr(0, text.size() / 2));
  std::string with_nan = text;
  with_nan.replace(with_nan.find("1502.3"), 6, "nan");
  expect_bad(with_nan);
  const auto missing = folder.path() / "missing.cameramodel";
  EXPECT_EQ(InputErrorOf([&] { ReadCamera(missing); }), missing.string() + ": cannot be read");
}

TEST(CameraFile, RefusesAnImpossibleCamera) {
  const ScratchFolder folder;
  const auto path = folder.Write("flat.cameramodel",
                                 "{'lensmodel': 'LENSMODEL_PINHOLE', 'intrinsics': [0, 1, 2, 3],"
                                 "'extrinsics': [0, 0, 0, 0, 0, 0], 'imagersize': [10, 10]}");
  EXPECT_EQ(InputErrorOf([&] { ReadCamera(path); }),
            path.string() + ": a focal length that is not positive");
}

}  // namespace
}  // namespace insitu
