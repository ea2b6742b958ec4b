// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/aicon_camera.h"

#include <cstdio>

#include "calibration/camera_files/read_camera_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

const std::string kLens =
    "1 -999 -28.8 0.02 0.06 -1.1e-004 1.5e-007 13.5\n0.0e+000\n5.8e-006 -8.6e-006\n"
    "-7.0e-005 -3.1e-005\n";

class AiconCameras : public testing::Test {
 protected:
  std::vector<AiconCamera> Read(const std::string& text) {
    return ReadAiconCameras(folder_.Write("camera.ior", text));
  }
  ScratchFolder folder_;
};

// Square pixels: what the reader of projects and that of camera files agreed about.
TEST_F(AiconCameras, AreTheSameInAProjectAndAsACameraFile) {
  const std::string ior = kLens + "36 24 9000 6000\n";
  const MetricCamera lens = Read(ior).at(0).lens;
  const MetricCamera file = *ReadCameraFile(folder_.Write("camera.ior", ior)).metric;
  EXPECT_EQ(lens.parameters, file.parameters);
  EXPECT_EQ(lens.parameters, (std::vector<double>{28.8, 0.02, 0.06, -1.1e-4, 1.5e-7, 0, 5.8e-6,
                                                  -8.6e-6, -7e-5, -3.1e-5}));
  for (const MetricCamera& each : {lens, file}) {
    EXPECT_EQ(each.balanced_radius_mm, 13.5);
    EXPECT_EQ(each.pixel_mm, Eigen::Vector2d(0.004, 0.004));
    EXPECT_EQ(each.origin_px, Eigen::Vector2d(4499.5, 2999.5));
  }
  EXPECT_EQ(AiconPixel(lens, {4, -8}), Eigen::Vector2d(5499.5, 4999.5));
}

// The sensor's corner is the frame's, whatever the sides of a pixel: of JAICOV's example, where the
// width's pixel taken for both puts the upper edge 0.04 px off, and of a CCD of television's norm.
TEST_F(AiconCameras, SensorFillsTheFrame) {
  for (const char* sensor : {"35.96800 23.97900 8688 5792\n", "8.8 6.6 752 582\n"}) {
    const MetricCamera lens = Read(kLens + sensor).at(0).lens;
    double width, height;
    ASSERT_EQ(std::sscanf(sensor, "%lf %lf", &width, &height), 2);
    const Eigen::Vector2d corner = AiconPixel(lens, {-width / 2, height / 2});
    EXPECT_NEAR((corner - Eigen::Vector2d(-0.5, -0.5)).norm(), 0, 1e-9) << sensor;
  }
}

TEST_F(AiconCameras, SeveralHaveNumbers) {
  const std::string sensor = "36 24 9000 6000\n";
  std::string second = kLens + sensor;
  second[0] = '2';
  const std::vector<AiconCamera> both = Read(kLens + sensor + second);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[1].number, "2");
  EXPECT_EQ(both[1].place.line, 6);
  EXPECT_NE(InputErrorOf([&] { Read(kLens + sensor + kLens + sensor); }).find("stands twice"),
            std::string::npos);
}

TEST_F(AiconCameras, FaultsAreNamedWithTheirLine) {
  const auto error_of = [&](const std::string& text) { return InputErrorOf([&] { Read(text); }); };
  EXPECT_NE(error_of(kLens).find(":4: the file ends within a camera"), std::string::npos);
  EXPECT_NE(error_of(kLens + "36 0 9000 6000").find(":5: sensor and image"), std::string::npos);
  EXPECT_NE(error_of(kLens + "36 24 9000 0").find(":5: sensor and image"), std::string::npos);
  EXPECT_NE(error_of(kLens + "36 24 9000.5 6000").find("a whole number"), std::string::npos);
}

}  // namespace
}  // namespace insitu
