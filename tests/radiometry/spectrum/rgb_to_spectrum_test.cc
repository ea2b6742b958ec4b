// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/rgb_to_spectrum.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

namespace insitu {
namespace {

Eigen::Vector3d RandomRgb(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  return {uniform(random), uniform(random), uniform(random)};
}

Eigen::Vector3d PrimaryXyz(const RgbPrimaries& primaries, int channel) {
  return RgbFromXyz(primaries).inverse().col(channel);
}

TEST(DomainIndicator, Eq19_IsOneInItsDomainOnly) {
  const Spectrum indicator = DomainIndicator(3, 7);
  for (int bin = 0; bin < kMaxBins; ++bin) EXPECT_EQ(indicator[bin], bin >= 3 && bin < 7 ? 1 : 0);
}

TEST(Evaluate, Eq18_IsConstantOnThreeDomains) {
  const Spectrum basis = Evaluate({2, 5, {0.1, 0.2, 0.3}, true}, {9});
  for (int bin = 0; bin < kMaxBins; ++bin) {
    EXPECT_EQ(basis[bin], bin < 2 ? 0.1 : bin < 5 ? 0.2 : bin < 9 ? 0.3 : 0.0) << bin;
  }
}

TEST(FindBasis, ReproducesTristimulusWithTheLowestPeak) {
  std::mt19937 random(1);
  for (const int count : {9, 16}) {
    const SpectralBins bins{count};
    const Eigen::Vector3d target = RgbFromXyz(Rec709()).inverse() * RandomRgb(random);
    const PiecewiseBasis found = FindBasis(target, bins);
    ASSERT_TRUE(found.exact);
    EXPECT_GE(found.weights.minCoeff(), 0);
    EXPECT_LT((Tristimulus(Evaluate(found, bins), bins) - target).norm(), 1e-12);
    for (int second = 1; second < count - 1; ++second) {
      for (int third = second + 1; third < count; ++third) {
        Eigen::Matrix3d xyz;
        xyz << Tristimulus(DomainIndicator(0, second), bins),
            Tristimulus(DomainIndicator(second, third), bins),
            Tristimulus(DomainIndicator(third, count), bins);
        const Eigen::Vector3d weights = xyz.inverse() * target;
        if (weights.minCoeff() < -1e-12) continue;
        EXPECT_GE(weights.maxCoeff(), found.weights.maxCoeff() - 1e-9);
      }
    }
  }
}

TEST(FindBasis, EqualEnergyIsFlat) {
  const SpectralBins bins;
  const Spectrum ones = DomainIndicator(0, kMaxBins);
  const PiecewiseBasis found = FindBasis(Tristimulus(ones, bins), bins);
  EXPECT_LT((Evaluate(found, bins) - ones).abs().maxCoeff(), 1e-9);
}

TEST(FindBasis, SaturatedColorsGetTheNearestBoxOfTheirLuminance) {
  const SpectralBins bins;
  const Eigen::Vector3d beyond_the_locus(0.9, 0.2, -0.1);
  const PiecewiseBasis found = FindBasis(beyond_the_locus, bins);
  EXPECT_FALSE(found.exact);
  const Spectrum box = Evaluate(found, bins);
  EXPECT_NEAR(Tristimulus(box, bins).y(), 0.2, 1e-14);
  const double distance = (Tristimulus(box, bins) - beyond_the_locus).norm();
  for (int second = 1; second < 15; ++second) {
    for (int third = second + 1; third < 16; ++third) {
      for (const bool inside : {true, false}) {
        Spectrum other = DomainIndicator(second, third);
        if (!inside) other = 1 - other;
        const Eigen::Vector3d xyz = Tristimulus(other, bins);
        EXPECT_GE((xyz * 0.2 / xyz.y() - beyond_the_locus).norm(), distance - 1e-12);
      }
    }
  }
}

TEST(FindBasis, Rec709IsExactWithBothCountsOfBins) {
  for (const int count : {9, 16}) {
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_TRUE(FindBasis(PrimaryXyz(Rec709(), channel), {count}).exact) << count << channel;
    }
    EXPECT_FALSE(FindBasis(PrimaryXyz(Ntsc1953(), 0), {count}).exact);  // red, near the locus
    EXPECT_TRUE(FindBasis(PrimaryXyz(Ntsc1953(), 1), {count}).exact);
    EXPECT_TRUE(FindBasis(PrimaryXyz(Ntsc1953(), 2), {count}).exact);
  }
}

TEST(SpectralBasis, Eq14_Eq17_RgbReturnsToRounding) {
  std::mt19937 random(2);
  for (const int count : {9, 16}) {
    for (const RgbPrimaries& primaries : {Rec709(), Ntsc1953()}) {
      const SpectralBasis spectra(primaries, {count});
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d rgb = 3 * RandomRgb(random) - Eigen::Vector3d::Ones();
        EXPECT_LT((spectra.RgbFromSpectrum(spectra.SpectrumFromRgb(rgb)) - rgb).norm(), 1e-14);
        const Eigen::Vector3d c = spectra.weights_from_rgb() * rgb;  // Eq. (17), then (14)
        EXPECT_LT((spectra.SpectrumFromRgb(rgb).matrix() - spectra.basis() * c).norm(), 1e-14);
      }
    }
  }
}

TEST(SpectralBasis, Eq15_Eq16_RgbFollowsFromTristimulusValues) {
  for (const int count : {9, 16}) {
    const SpectralBasis spectra(Ntsc1953(), {count});
    const Spectrum stimulus = spectra.Ones() * Spectrum::LinSpaced(0.2, 1.4);
    const Eigen::Vector3d rgb = RgbFromXyz(Ntsc1953()) * Tristimulus(stimulus, {count});
    EXPECT_LT((spectra.RgbFromSpectrum(stimulus) - rgb).norm(), 1e-14);
  }
}

TEST(SpectralBasis, SpectraOfColorsInGamutAreNotNegative) {
  std::mt19937 random(3);
  for (const int count : {9, 16}) {
    const SpectralBasis spectra(Rec709(), {count});
    for (int i = 0; i < 100; ++i) {
      EXPECT_GE(spectra.SpectrumFromRgb(RandomRgb(random)).minCoeff(), -1e-15);
    }
  }
}

TEST(SpectralBasis, RgbOfOneSpaceStandsOnThePrimariesOfAnother) {
  const SpectralBasis own(Rec709(), {9}), ntsc(Ntsc1953(), {9});
  const SpectralBasis mixed(Rec709(), {9}, Ntsc1953());
  const auto same_shape = [](const Spectrum& a, const Spectrum& b) {
    return (a / a.sum() - b / b.sum()).abs().maxCoeff() < 1e-12;
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(same_shape(mixed.basis().col(i).array(), ntsc.basis().col(i).array())) << i;
  }
  const Eigen::Vector3d rgb(0.7, 0.4, 0.2);
  EXPECT_LT((mixed.RgbFromSpectrum(mixed.SpectrumFromRgb(rgb)) - rgb).norm(), 1e-13);
  EXPECT_GT((mixed.SpectrumFromRgb(rgb) - own.SpectrumFromRgb(rgb)).abs().maxCoeff(), 0.01);
  EXPECT_TRUE((mixed.ReflectanceFromRgb(rgb) == own.ReflectanceFromRgb(rgb)).all());
  EXPECT_LT(
      (Tristimulus(mixed.SpectrumFromRgb(rgb), {9}) - Tristimulus(own.SpectrumFromRgb(rgb), {9}))
          .norm(),
      1e-13);
}

// Hall's published code takes D6500 for NTSC's white, we illuminant C.
TEST(SpectralBasis, TheWhiteOfTheBasisPlaysNoPart) {
  RgbPrimaries halls = Ntsc1953();
  halls.white = {0.313, 0.329};
  for (const int count : {9, 16}) {
    const SpectralBasis ours(Rec709(), {count}, Ntsc1953()), his(Rec709(), {count}, halls);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d rgb = Eigen::Vector3d::Unit(i);
      const Spectrum difference = ours.SpectrumFromRgb(rgb) - his.SpectrumFromRgb(rgb);
      EXPECT_LT(difference.abs().maxCoeff(), 1e-12) << count << " " << i;
    }
  }
}

TEST(SpectralBasis, UnusedBinsStayEmpty) {
  const SpectralBasis spectra(Rec709(), {9});
  EXPECT_EQ(spectra.Ones().sum(), 9);
  EXPECT_TRUE((spectra.SpectrumFromRgb({1, 2, 3}).tail(kMaxBins - 9) == 0).all());
  EXPECT_TRUE((spectra.ReflectanceFromRgb({0.1, 0.2, 0.3}).tail(kMaxBins - 9) == 0).all());
}

TEST(ReflectanceFromRgb, GreyIsFlat) {
  for (const int count : {9, 16}) {
    const SpectralBasis spectra(Rec709(), {count});
    const Spectrum grey = spectra.ReflectanceFromRgb(Eigen::Vector3d::Constant(0.18));
    EXPECT_LT((grey - 0.18 * spectra.Ones()).abs().maxCoeff(), 1e-15);
  }
}

TEST(ReflectanceFromRgb, StaysBetweenZeroAndOneAndShowsItsColorUnderWhite) {
  std::mt19937 random(4);
  const SpectralBasis spectra;
  const Spectrum white = spectra.SpectrumFromRgb(Eigen::Vector3d::Ones());
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d rgb = RandomRgb(random);
    const Spectrum reflectance = spectra.ReflectanceFromRgb(rgb);
    EXPECT_GE(reflectance.minCoeff(), -1e-15);
    EXPECT_LE(reflectance.maxCoeff(), 1 + 1e-15);
    EXPECT_LT((spectra.RgbFromSpectrum(reflectance * white) - rgb).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace insitu
