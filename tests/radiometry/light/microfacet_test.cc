// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
const Roughness kRough[] = {{0.05, FacetDistribution::kBeckmann},
                            {0.5, FacetDistribution::kBeckmann},
                            {0.0225, FacetDistribution::kGgx},
                            {0.3, FacetDistribution::kGgx},
                            {1, FacetDistribution::kGgx}};

Vector3d At(double cosine, double angle) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

// Over facets, in steps of their tangent so that narrow lobes count too.
template <typename Function>
double OverFacets(double slope, const Function& function) {
  constexpr int kTangents = 4000, kAngles = 64;
  double sum = 0;
  for (int i = 0; i < kTangents; ++i) {
    const double s = (i + 0.5) / kTangents;  // tan = slope s / (1 - s)
    const double tangent = slope * s / (1 - s), cosine = 1 / std::sqrt(1 + tangent * tangent);
    const double step = slope / ((1 - s) * (1 - s) * kTangents);
    for (int j = 0; j < kAngles; ++j) {
      const double solid = tangent * std::pow(cosine, 3) * step * 2 * kPi / kAngles;
      sum += solid * function(At(cosine, 2 * kPi * (j + 0.5) / kAngles));
    }
  }
  return sum;
}

TEST(FacetDensity, CoversTheSurfaceOnce) {
  for (const Roughness& rough : kRough) {
    const double area =
        OverFacets(rough.slope, [&](const Vector3d& m) { return FacetDensity(rough, m) * m.z(); });
    EXPECT_NEAR(area, 1, 2e-3) << rough.slope;
  }
  EXPECT_THROW(FacetDensity({0}, Vector3d::UnitZ()), CheckError);
}

TEST(SmithMasking, LeavesTheProjectedAreaSeen) {  // [Heitz 2014, Eq. 14]
  for (const Roughness& rough : kRough) {
    for (const double cosine : {0.15, 0.6, 0.95}) {
      const Vector3d view = At(cosine, 0.3);
      const double seen = OverFacets(rough.slope, [&](const Vector3d& m) {
        return FacetDensity(rough, m) * std::max(0.0, m.dot(view));
      });
      EXPECT_NEAR(SmithMasking(rough, cosine) * seen, cosine, 4e-3 * cosine) << rough.slope;
    }
  }
}

TEST(MirrorLobe, IsReciprocalButForTheCosine) {
  const Vector3d a = At(0.3, 0.1), b = At(0.8, 2.9);
  for (const Roughness& rough : kRough) {
    EXPECT_NEAR(MirrorLobe(rough, a, b) * a.z(), MirrorLobe(rough, b, a) * b.z(), 1e-12);
  }
  EXPECT_EQ(MirrorLobe(kRough[0], a, -b), 0);
}

// What VisibleFacet draws, weighted, is the integral of MirrorLobe: of a radiance that varies.
TEST(VisibleFacet, DrawsWhatTheLobeSays) {
  const auto radiance = [](const Vector3d& to_light) { return 1 + 0.8 * to_light.x(); };
  for (const Roughness& rough : kRough) {
    for (const double cosine : {0.12, 0.5, 1.0}) {
      const Vector3d view = At(cosine, 0.7);
      const double lobe = OverFacets(rough.slope, [&](const Vector3d& m) {
        const Vector3d to_light = 2 * m.dot(view) * m - view;
        return m.dot(view) <= 0
                   ? 0.0
                   : MirrorLobe(rough, view, to_light) * 4 * m.dot(view) * radiance(to_light);
      });
      constexpr int kSide = 256;
      double drawn = 0;
      for (int i = 0; i < kSide * kSide; ++i) {
        const int column = i % kSide, row = i / kSide;
        const Vector2d uniform((column + 0.5) / kSide, (row + 0.5) / kSide);
        const Vector3d m = VisibleFacet(rough, view, uniform);
        const Vector3d to_light = 2 * m.dot(view) * m - view;
        drawn += SmithMasking(rough, to_light.z()) * radiance(to_light) / (kSide * kSide);
      }
      EXPECT_NEAR(drawn, lobe, 6e-3) << rough.slope << " at " << cosine;
    }
  }
}

// Single scattering: what a rough mirror loses between its facets is small where it is nearly flat.
TEST(MirrorLobe, WhiteFurnaceLosesOnlyWhatIsScatteredTwice) {
  for (const double cosine : {0.2, 0.5, 1.0}) {
    double sum = 0;
    constexpr int kSide = 128;
    const Roughness rough{0.05, FacetDistribution::kBeckmann};
    for (int i = 0; i < kSide * kSide; ++i) {
      const int column = i % kSide, row = i / kSide;
      const Vector2d uniform((column + 0.5) / kSide, (row + 0.5) / kSide);
      const Vector3d view = At(cosine, 0), m = VisibleFacet(rough, view, uniform);
      sum += SmithMasking(rough, (2 * m.dot(view) * m - view).z()) / (kSide * kSide);
    }
    EXPECT_NEAR(sum, 1, 0.01);
  }
}

}  // namespace
}  // namespace insitu
