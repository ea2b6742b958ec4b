// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/microfacet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kSqrtPi = 1.7724538509055160273;
constexpr double kUpright = 0.9999;  // cosine beyond which a view counts as along the normal

double SquareTangent(double cosine) { return std::max(0.0, 1 / (cosine * cosine) - 1); }

// Point on a disc whose half away from the viewer is foreshortened. [Heitz 2018, Listing 1]
Vector3d GgxHemisphereFacet(const Vector3d& view, const Vector2d& uniform) {
  const Vector3d across =
      view.head<2>().norm() > 0 ? Vector3d(-view.y(), view.x(), 0).normalized() : Vector3d::UnitX();
  const Vector3d along = view.cross(across);
  const double radius = std::sqrt(uniform.x()), angle = 2 * std::numbers::pi * uniform.y();
  const double t1 = radius * std::cos(angle);
  const double s = (1 + view.z()) / 2;
  const double t2 = (1 - s) * std::sqrt(1 - t1 * t1) + s * radius * std::sin(angle);
  return t1 * across + t2 * along + std::sqrt(std::max(0.0, 1 - t1 * t1 - t2 * t2)) * view;
}

// Slope towards the viewer, of the slopes that are seen at this cosine, for m = 1: the inverse of
// their distribution function by bracketed Newton steps over erf. [Heitz & d'Eon 2014; Pharr et
// al. 2016, 14.1.1]
double BeckmannSlope(double cosine, double uniform) {
  const double cotangent = cosine / std::sqrt(1 - cosine * cosine), tangent = 1 / cotangent;
  double low = -1, high = std::erf(cotangent);
  const double total = 1 + high + tangent / kSqrtPi * std::exp(-cotangent * cotangent);
  double b = high - (1 + high) * std::sqrt(1 - uniform);
  double slope = 0;
  for (int i = 0; i < 12; ++i) {
    if (!(b > low && b < high)) b = (low + high) / 2;
    slope = boost::math::erf_inv(std::clamp(b, -1 + 1e-12, 1 - 1e-12));
    const double value = (1 + b + tangent / kSqrtPi * std::exp(-slope * slope)) / total - uniform;
    if (std::abs(value) < 1e-7) break;
    (value > 0 ? high : low) = b;
    b -= value * total / (1 - slope * tangent);
  }
  return slope;
}

Vector3d BeckmannFacet(double m, const Vector3d& view, const Vector2d& uniform) {
  const double u = std::clamp(uniform.x(), 1e-7, 1 - 1e-7);
  const double v = std::clamp(uniform.y(), 1e-7, 1 - 1e-7);
  Vector2d slope;
  Vector2d heading = Vector2d::UnitX();
  if (view.z() > kUpright) {
    const double radius = std::sqrt(-std::log(1 - u));
    slope =
        radius * Vector2d(std::cos(2 * std::numbers::pi * v), std::sin(2 * std::numbers::pi * v));
  } else {
    slope = {BeckmannSlope(view.z(), u), boost::math::erf_inv(2 * v - 1)};
    heading = view.head<2>().normalized();
  }
  const Vector2d turned(heading.x() * slope.x() - heading.y() * slope.y(),
                        heading.y() * slope.x() + heading.x() * slope.y());
  return Vector3d(-m * turned.x(), -m * turned.y(), 1).normalized();
}

}  // namespace

double FacetDensity(const Roughness& roughness, const Vector3d& facet) {
  INSITU_CHECK(roughness.slope > 0);
  if (facet.z() <= 0) return 0;
  const double a2 = roughness.slope * roughness.slope;
  const double t2 = SquareTangent(facet.z()), c4 = std::pow(facet.z(), 4);
  if (roughness.distribution == FacetDistribution::kBeckmann) {
    return std::exp(-t2 / a2) / (std::numbers::pi * a2 * c4);
  }
  return 1 / (std::numbers::pi * a2 * c4 * std::pow(1 + t2 / a2, 2));
}

double SmithMasking(const Roughness& roughness, double cosine) {
  INSITU_CHECK(roughness.slope > 0);
  if (cosine <= 0) return 0;
  const double t2 = SquareTangent(cosine);
  if (t2 == 0) return 1;
  if (roughness.distribution == FacetDistribution::kGgx) {
    return 2 / (1 + std::sqrt(1 + roughness.slope * roughness.slope * t2));
  }
  const double a = 1 / (roughness.slope * std::sqrt(t2));
  const double shadow = (std::erf(a) - 1) / 2 + std::exp(-a * a) / (2 * a * kSqrtPi);
  return 1 / (1 + shadow);
}

double MirrorLobe(const Roughness& roughness, const Vector3d& to_viewer, const Vector3d& to_light) {
  if (to_viewer.z() <= 0 || to_light.z() <= 0) return 0;
  const double masking =
      SmithMasking(roughness, to_viewer.z()) * SmithMasking(roughness, to_light.z());
  return FacetDensity(roughness, (to_viewer + to_light).normalized()) * masking /
         (4 * to_viewer.z());
}

Vector3d VisibleFacet(const Roughness& roughness, const Vector3d& to_viewer,
                      const Vector2d& uniform) {
  const double a = roughness.slope;
  INSITU_CHECK(a > 0);
  // As seen by one for whom the surface is stretched until its slopes are those of unit roughness.
  const Vector3d view =
      Vector3d(a * to_viewer.x(), a * to_viewer.y(), std::max(1e-6, to_viewer.z())).normalized();
  if (roughness.distribution == FacetDistribution::kBeckmann) {
    return BeckmannFacet(a, view, uniform);
  }
  const Vector3d facet = GgxHemisphereFacet(view, uniform);
  return Vector3d(a * facet.x(), a * facet.y(), std::max(1e-9, facet.z())).normalized();
}

}  // namespace insitu
