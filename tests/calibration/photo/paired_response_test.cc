// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/paired_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/calibration/photo/made_raw.h"

namespace insitu {
namespace {

constexpr int kRawWidth = 640, kRawHeight = 480, kWidth = 600, kHeight = 448;
constexpr double kRadial = 0.004;
const Eigen::Vector2d kShift(5.3, -3.8);

// Tiles of colours, to any place; tiles and edges of a pixel are evened.
class Tiles {
 public:
  Tiles() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> stops(-5, -0.4);
    for (Eigen::Vector3d& color : colors_) {
      const double level = std::exp2(stops(random));
      for (int c = 0; c < 3; ++c) color[c] = level * std::exp2(0.2 * (stops(random) + 2.7));
      color = color.cwiseMin(0.9);
    }
  }
  Eigen::Vector3d At(const Eigen::Vector2d& place) const {
    constexpr int kSteps = 4;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const int right = i % kSteps, down = i / kSteps;
      const Eigen::Vector2d at =
          place + Eigen::Vector2d((right + 0.5) / kSteps, (down + 0.5) / kSteps);
      const int column = static_cast<int>(std::floor(at.x() / 21)) + 8;
      const int row = static_cast<int>(std::floor(at.y() / 17)) + 8;
      sum += colors_.at(row * 48 + column);
    }
    return sum / (kSteps * kSteps);
  }

 private:
  std::vector<Eigen::Vector3d> colors_ = std::vector<Eigen::Vector3d>(size_t{48} * 48);
};

Eigen::Matrix3d ShownFromRaw() {
  Eigen::Matrix3d matrix;
  matrix << 1.25, -0.20, -0.05, -0.12, 1.20, -0.08, 0.02, -0.28, 1.26;
  return matrix;
}

double Tone(double light) {  // toe and shoulder [Narkowicz 2015], as sRGB shows it
  const double x = std::max(light, 0.0);
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

// What the camera makes of the light that its raw has, in 8 bits.
Raster PictureOf(const Tiles& tiles, const Eigen::Vector2d& jitter = Eigen::Vector2d::Zero()) {
  Raster picture(kWidth, kHeight, 3);
  const Eigen::Vector2d middle((kWidth - 1) / 2.0, (kHeight - 1) / 2.0);
  const Eigen::Vector2d raw_middle((kRawWidth - 1) / 2.0, (kRawHeight - 1) / 2.0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector2d from_middle = Eigen::Vector2d(x, y) - middle;
      const double r2 = from_middle.squaredNorm() / middle.squaredNorm();
      const Eigen::Vector2d wave(std::sin(y / 40.0) * jitter.x(), std::sin(x / 40.0) * jitter.y());
      const Eigen::Vector2d in_raw = raw_middle + kShift + (1 + kRadial * r2) * from_middle + wave;
      const Eigen::Vector3d shown = ShownFromRaw() * tiles.At(in_raw);
      for (int c = 0; c < 3; ++c) {
        const double code = std::round(255 * SrgbFromLinear(std::min(1.0, Tone(shown[c]))));
        picture.At(x, y)[c] = static_cast<float>(LinearFromSrgb(code / 255));
      }
    }
  }
  return picture;
}

struct Pair {
  Raster raw, picture;
};

// Made once, of a scratch folder of the first test that asks.
const Pair& MadePair() {
  static const Pair pair = [] {
    const ScratchFolder folder;
    const std::filesystem::path file = folder.path() / "A.dng";
    const Tiles tiles;
    MadeRaw made{kRawWidth, kRawHeight,
                 [&](int x, int y) { return tiles.At(Eigen::Vector2d(x, y)); }};
    WriteMadeRaw(file, made);
    return Pair{ReadPhotograph(file).linear, PictureOf(tiles)};
  }();
  return pair;
}

TEST(PairedResponse, CropAndLensCorrectionAreFound) {
  const PairRegistration found = RegisterPair(MadePair().raw, MadePair().picture);
  EXPECT_GT(found.pieces, 30);
  EXPECT_LT(found.residual_px, 0.3);
  const Eigen::Vector2d corner((kWidth - 1) / 2.0, (kHeight - 1) / 2.0);
  for (const double share : {0.0, 0.5, 0.9}) {  // of the way to the corner
    const Eigen::Vector2d pixel = share * corner;
    const double r2 = share * share;
    const Eigen::Vector2d known = kShift + (1 + kRadial * r2) * pixel;
    const Eigen::Vector2d in_raw = found.shift + found.scale * (1 + found.radial * r2) * pixel;
    EXPECT_LT((in_raw - known).norm(), 0.2) << share;
  }
}

TEST(PairedResponse, ThePicturesCodesAreTheRawsLight) {
  const PairRegistration pair = RegisterPair(MadePair().raw, MadePair().picture);
  const auto response = FitPairedResponse(MadePair().raw, MadePair().picture, pair);
  ASSERT_TRUE(response);
  EXPECT_GT(response->places, 1000);
  EXPECT_LT(response->sigma, 0.02);
  for (const double light : {0.05, 0.1, 0.2, 0.4}) {  // grey
    const Eigen::Vector3d shown = ShownFromRaw() * Eigen::Vector3d::Constant(light);
    Eigen::Vector3d by_curve;
    for (int c = 0; c < 3; ++c) {
      by_curve[c] = ResponseCurve(response->curves[c]).Linear(SrgbFromLinear(Tone(shown[c])));
    }
    const Eigen::Vector3d found = response->rec709 * by_curve;
    EXPECT_LT((found / light - Eigen::Vector3d::Ones()).cwiseAbs().maxCoeff(), 0.03) << light;
  }
}

TEST(PairedResponse, AnotherPictureLiesNowhere) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> light(0.1F, 0.5F);
  Raster noise(kWidth, kHeight, 3);
  for (float& value : noise.data) value = light(random);
  const PairRegistration found = RegisterPair(MadePair().raw, noise);
  EXPECT_TRUE(found.pieces == 0 || found.residual_px > 0.5);
}

TEST(PairedResponse, AFrameThatIsBentOtherwiseIsTold) {
  const PairRegistration found = RegisterPair(MadePair().raw, PictureOf(Tiles(), {2, 2}));
  EXPECT_TRUE(found.pieces == 0 || found.residual_px > 0.5) << found.residual_px;
}

}  // namespace
}  // namespace insitu
