// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/color.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <stdexcept>

namespace insitu {
namespace {

Spectrum Flat(const SpectralBins& bins) {
  Spectrum flat = Spectrum::Zero();
  flat.head(bins.count) = 1;
  return flat;
}

TEST(SpectralBins, CoverTheVisibleSpectrum) {
  for (const int count : {3, 9, 16}) {
    const SpectralBins bins{count};
    EXPECT_DOUBLE_EQ(bins.Edge(0), 380);
    EXPECT_DOUBLE_EQ(bins.Edge(count), 780);
    EXPECT_DOUBLE_EQ(bins.Center(0) - bins.Edge(0), bins.Width() / 2);
  }
}

TEST(ColorMatching, SumsAreIndependentOfTheBins) {
  const Eigen::Vector3d sum = ColorMatching({16}).rowwise().sum();
  for (const int count : {3, 9, 11}) {
    EXPECT_LT((ColorMatching({count}).rowwise().sum() - sum).norm(), 1e-9) << count;
  }
  // CIE 15: the integrals of the 1931 functions are equal, 106.8566 at 1 nm over 360 to 830 nm.
  EXPECT_NEAR(sum.x(), 106.86, 0.03);
  EXPECT_NEAR(sum.y(), 106.86, 0.03);
  EXPECT_NEAR(sum.z(), 106.86, 0.05);
}

TEST(ColorMatching, UnusedBinsCarryNoColor) {
  EXPECT_EQ(ColorMatching({9}).rightCols(kMaxBins - 9).norm(), 0);
}

TEST(Tristimulus, Eq11_EqualEnergyHasUnitLuminance) {
  for (const int count : {9, 16}) {
    EXPECT_NEAR(Tristimulus(Flat({count}), {count}).y(), 1, 1e-14);
  }
}

TEST(Tristimulus, Eq11_IsLinear) {
  const SpectralBins bins;
  const Spectrum a = Spectrum::LinSpaced(0, 1), b = IlluminantD65(bins);
  const Eigen::Vector3d sum = Tristimulus(2 * a + b, bins);
  EXPECT_LT((sum - 2 * Tristimulus(a, bins) - Tristimulus(b, bins)).norm(), 1e-13);
}

TEST(Tristimulus, Eq11_D65HasItsPublishedChromaticity) {
  // Bins of 25 nm average illuminant and observer apart, which costs 0.0004.
  const Eigen::Vector3d xyz = Chromaticity(Tristimulus(IlluminantD65({16}), {16}));
  EXPECT_NEAR(xyz.x(), 0.3127, 6e-4);
  EXPECT_NEAR(xyz.y(), 0.3290, 6e-4);
  const Eigen::Vector3d coarse = Chromaticity(Tristimulus(IlluminantD65({9}), {9}));
  EXPECT_NEAR(coarse.x(), 0.3127, 3e-3);
  EXPECT_NEAR(coarse.y(), 0.3290, 3e-3);
}

TEST(Chromaticity, Eq12_SumsToOne) {
  EXPECT_NEAR(Chromaticity({0.2, 0.7, 0.3}).sum(), 1, 1e-15);
  const Eigen::Vector3d equal_energy = Chromaticity(Tristimulus(Flat({16}), {16}));
  EXPECT_NEAR(equal_energy.x(), 1.0 / 3, 2e-4);
  EXPECT_NEAR(equal_energy.y(), 1.0 / 3, 2e-4);
}

TEST(RgbFromXyz, Eq13_MapsWhiteAndPrimaries) {
  for (const RgbPrimaries& p : {Rec709(), Ntsc1953()}) {
    const Eigen::Matrix3d M = RgbFromXyz(p);
    const Eigen::Vector3d white(p.white.x(), p.white.y(), 1 - p.white.sum());
    EXPECT_LT((M * white / p.white.y() - Eigen::Vector3d::Ones()).norm(), 1e-13);
    const Eigen::Vector3d green(p.green.x(), p.green.y(), 1 - p.green.sum());
    const Eigen::Vector3d rgb = M * green;
    EXPECT_NEAR(rgb.x(), 0, 1e-13);
    EXPECT_GT(rgb.y(), 0);
    EXPECT_NEAR(rgb.z(), 0, 1e-13);
  }
}

TEST(RgbFromXyz, Eq13_EqualsThePublishedMatrices) {
  Eigen::Matrix3d rec709, ntsc;  // ITU-R BT.709 / IEC 61966-2-1; Hall 1989
  rec709 << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  ntsc << 1.910, -0.532, -0.288, -0.985, 1.999, -0.028, 0.058, -0.118, 0.898;
  EXPECT_LT((RgbFromXyz(Rec709()) - rec709).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((RgbFromXyz(Ntsc1953()) - ntsc).cwiseAbs().maxCoeff(), 2e-3);
}

TEST(RgbFromXyz, P3AndRec2020EqualThePublishedMatrices) {
  Eigen::Matrix3d p3, rec2020;  // SMPTE EG 432-1, ITU-R BT.2020
  p3 << 2.4935, -0.9314, -0.4027, -0.8295, 1.7627, 0.0236, 0.0358, -0.0762, 0.9569;
  rec2020 << 1.7167, -0.3557, -0.2534, -0.6667, 1.6165, 0.0158, 0.0176, -0.0428, 0.9421;
  EXPECT_LT((RgbFromXyz(DisplayP3()) - p3).cwiseAbs().maxCoeff(), 2e-4);
  EXPECT_LT((RgbFromXyz(Rec2020()) - rec2020).cwiseAbs().maxCoeff(), 2e-4);
}

// CIE 015: chromaticities of monochromatic stimuli.
TEST(SpectrumLocus, PureColours) {
  const std::vector<SpectralColor> locus = SpectrumLocus();
  ASSERT_EQ(locus.size(), 81U);
  EXPECT_EQ(locus.front().wavelength, 380);
  EXPECT_EQ(locus.back().wavelength, 780);
  const auto at = [&](int nm) { return locus[(nm - 380) / 5].chromaticity; };
  EXPECT_LT((at(520) - Eigen::Vector2d(0.07430, 0.83380)).norm(), 2e-4);
  EXPECT_LT((at(600) - Eigen::Vector2d(0.62704, 0.37249)).norm(), 2e-4);
  EXPECT_LT((at(700) - Eigen::Vector2d(0.73469, 0.26531)).norm(), 2e-4);
}

TEST(RgbFromXyz, RefusesPrimariesOnOneLine) {
  const RgbPrimaries line{{0.2, 0.2}, {0.3, 0.3}, {0.4, 0.4}, {0.3127, 0.3290}};
  EXPECT_THROW(RgbFromXyz(line), std::invalid_argument);
}

}  // namespace
}  // namespace insitu
