// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/tiled_image.h"

#include <gtest/gtest.h>

#include <random>

#include "calibration/files/error.h"
#include "calibration/photo/linear_rows.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

// Some tiles wide and high, the last ones cut.
Raster Noise(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  Raster noise(150, 300);
  for (float& each : noise.data) each = value(random);
  return noise;
}

void WriteTiled(const std::filesystem::path& file, const Raster& picture) {
  ExrRows rows(file, picture.width, picture.height);
  rows.Append(picture);
  rows.Close();
}

// Everywhere, beyond the border, too.
void ExpectAlike(const TiledImage& tiled, const Raster& whole) {
  for (double y = -1.5; y < whole.height + 1; y += 0.75) {
    for (double x = -1.5; x < whole.width + 1; x += 0.75) {
      ASSERT_EQ(tiled.At({x, y}), Interpolate(whole, {x, y})) << x << " " << y;
    }
  }
}

TEST(TiledImage, IsTheWholeToTheLastBit) {
  const ScratchFolder folder;
  const Raster noise = Noise(1);
  WriteTiled(folder.path() / "tiled.exr", noise);
  WriteExr(folder.path() / "rows.exr", noise);
  for (const char* name : {"tiled.exr", "rows.exr"}) {
    ExpectAlike(TiledImage(folder.path() / name, Eigen::Vector3f::Ones()), noise);
  }
}

TEST(TiledImage, MultipliesEachChannelByItsFactor) {
  const ScratchFolder folder;
  Raster noise = Noise(2);
  WriteTiled(folder.path() / "a.exr", noise);
  const Eigen::Vector3f factor(0.7f, 1.1f, 3);
  for (size_t i = 0; i < noise.data.size(); ++i) noise.data[i] *= factor[i % 3];
  ExpectAlike(TiledImage(folder.path() / "a.exr", factor), noise);
}

TEST(TiledImage, SeesAFileThatWasWrittenAnew) {
  const ScratchFolder folder;
  WriteTiled(folder.path() / "a.exr", Noise(3));
  ExpectAlike(TiledImage(folder.path() / "a.exr", Eigen::Vector3f::Ones()), Noise(3));
  WriteTiled(folder.path() / "a.exr", Noise(4));
  ExpectAlike(TiledImage(folder.path() / "a.exr", Eigen::Vector3f::Ones()), Noise(4));
}

TEST(TiledImage, RefusesWhatIsNoPictureOfThreeChannels) {
  const ScratchFolder folder;
  EXPECT_THROW(TiledImage(folder.path() / "none.exr", Eigen::Vector3f::Ones()), InputError);
}

}  // namespace
}  // namespace insitu
