// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/daylight.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;

// Right-handed axes with `zenith` as the third.
Eigen::Matrix3d FrameAbout(const Eigen::Vector3d& zenith) {
  const Eigen::Vector3d x = zenith.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << x, zenith.cross(x), zenith;
  return axes;
}

Eigen::Vector3d Spherical(double cosine, double azimuth) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

// The part of the sun's disc that is seen, so that a sample in a penumbra gets its share.
double VisiblePartOfSun(const Daylight& light,
                        const std::function<bool(const Eigen::Vector3d&)>& is_visible) {
  const std::vector<Eigen::Vector3d> points = SunPoints(light);
  return static_cast<double>(std::count_if(points.begin(), points.end(), is_visible)) / kSunPoints;
}

}  // namespace

SkyFacets MakeSkyFacets(const Eigen::Vector3d& zenith, int polar_facets) {
  INSITU_CHECK(polar_facets >= 1);
  const Eigen::Matrix3d axes = FrameAbout(zenith);
  const int m = polar_facets;
  SkyFacets facets;
  facets.solid_angle = 2 * kPi / (4 * m * m);
  for (int band = 0; band < m; ++band) {
    for (int quarter = 0; quarter < m; ++quarter) {
      for (int residue = 0; residue < 4; ++residue) {
        // Neighbouring bands are staggered by half of the spacing of four facets.
        const int column = 4 * quarter + (residue + 2 * band) % 4;
        const double azimuth = (column + 0.5) * 2 * kPi / (4 * m);
        facets.directions.push_back(axes * Spherical((band + 0.5) / m, azimuth));
      }
    }
  }
  return facets;
}

std::vector<Eigen::Vector3d> SunPoints(const Daylight& light) {
  const Eigen::Matrix3d axes = FrameAbout(light.sun_direction);
  const double golden_angle = kPi * (3 - std::sqrt(5.0));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < kSunPoints; ++i) {
    const double disc = light.sun_is_one_direction ? 0 : light.sun_solid_angle;
    const double cosine = 1 - disc / (2 * kPi) * (i + 0.5) / kSunPoints;
    points.emplace_back(axes * Spherical(cosine, i * golden_angle));
  }
  return points;
}

Spectrum IrradianceElement(const Spectrum& radiance, double cosine, double solid_angle) {
  return radiance * (cosine * solid_angle);
}

Spectrum SunIrradiance(const Daylight& light, const LightGeometry& geometry) {
  return light.sun_radiance * geometry.sun;
}

Spectrum AmbientIrradiance(const Daylight& light, const LightGeometry& geometry) {
  return light.ambient_radiance * geometry.ambient;
}

Spectrum SkyIrradiance(const Daylight& light, const LightGeometry& geometry) {
  return light.sky_radiance * geometry.sky;
}

Spectrum TotalIrradiance(const Daylight& light, const LightGeometry& geometry) {
  return SunIrradiance(light, geometry) + AmbientIrradiance(light, geometry) +
         SkyIrradiance(light, geometry);
}

LightGeometry MeasureLight(const Daylight& light, const SkyFacets& facets,
                           const Eigen::Vector3d& normal,
                           const std::function<bool(const Eigen::Vector3d&)>& is_visible) {
  LightGeometry geometry;
  geometry.ambient = kPi;
  const double sun_cosine = normal.dot(light.sun_direction);
  if (sun_cosine > 0) {
    geometry.sun = sun_cosine * light.sun_solid_angle * VisiblePartOfSun(light, is_visible);
  }
  for (const Eigen::Vector3d& direction : facets.directions) {
    const double cosine = normal.dot(direction);
    if (cosine > 0 && light.zenith_direction.dot(direction) > 0 && is_visible(direction)) {
      geometry.sky += cosine * facets.solid_angle;
    }
  }
  return geometry;
}

}  // namespace insitu
