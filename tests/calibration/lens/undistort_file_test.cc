// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/undistort_file.h"

#include <gtest/gtest.h>

#include <random>

#include "calibration/lens/undistort.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

// Higher than a band of rows, and bent so that a band needs rows far beyond it.
Camera BentLens() {
  return Camera("LENSMODEL_OPENCV4", {300, 302, 163, 298, -0.15, 0.02, 0.001, -0.002}, 320, 600);
}

Raster Noise() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(0, 1);
  Raster noise(320, 600);
  for (float& each : noise.data) each = value(random);
  return noise;
}

ColorSpace WideSpace() {
  ColorSpace wide;
  Eigen::Matrix3d matrix;
  matrix << 1.2, -0.2, 0, -0.04, 1.04, 0, -0.02, -0.08, 1.1;
  const ToneCurve curve(kSrgbTransfer);
  wide.conversion = MatrixConversion({curve, curve, curve}, matrix);
  return wide;
}

TEST(WriteReprojected, WritesWhatReprojectMakesOfTheWhole) {
  const ScratchFolder folder;
  const Camera lens = BentLens(), pinhole = PinholeCovering(lens);
  for (const Encoding encoding : {Encoding::kSrgb8, Encoding::kSrgb16, Encoding::kLinear}) {
    const char* name = encoding == Encoding::kLinear ? "photo.exr" : "photo.png";
    for (const ColorSpace& color : {ColorSpace(), WideSpace()}) {
      if (encoding == Encoding::kLinear && !color.IsDefault()) continue;
      CodedPhotograph coded = CodesOf(Noise(), encoding, {});
      WriteCodes(folder.path() / name, coded);
      const Photograph whole = ReadPhotograph(folder.path() / name);
      Raster linear = whole.linear;
      if (!color.IsDefault()) {
        coded.color = color;
        for (int y = 0; y < linear.height; ++y) {
          for (int x = 0; x < linear.width; ++x) {
            const Eigen::Vector3d encoded = ColorSpace().Encoded(whole.linear.Rgb(x, y));
            linear.SetRgb(x, y, color.Linear(encoded));
          }
        }
      }
      WriteReprojected(folder.path() / "out.exr", coded, lens, pinhole);
      const Raster found = ReadPhotograph(folder.path() / "out.exr").linear;
      const Raster expected = Reproject(linear, lens, pinhole);
      ASSERT_EQ(found.data.size(), expected.data.size());
      const double tolerance = color.IsDefault() ? 0 : 1e-6;  // of encoding once more, above
      for (size_t i = 0; i < found.data.size(); ++i) {
        ASSERT_NEAR(found.data[i], expected.data[i], tolerance) << name << " " << i;
      }
    }
  }
}

TEST(WriteReprojected, LeavesNothingWhereItCannotWrite) {
  const ScratchFolder folder;
  const CodedPhotograph coded = CodesOf(Noise(), Encoding::kSrgb8, {});
  std::filesystem::create_directories(folder.path() / "out.exr" / "in the way");
  EXPECT_ANY_THROW(WriteReprojected(folder.path() / "out.exr", coded, BentLens(), BentLens()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()),
                          std::filesystem::directory_iterator()),
            1);
}

}  // namespace
}  // namespace insitu
