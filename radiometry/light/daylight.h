// SPDX-License-Identifier: GPL-3.0-or-later
// The light source model: sun, ambient light, sky facets. [Durisch92, §3.3]
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "radiometry/light/sky.h"
#include "radiometry/spectrum/spectrum.h"

namespace insitu {

// The sun's disc seen from the earth: a cone of half angle 0.2666 degrees. Departure: the paper's
// 0.0004 sr is six discs; only k_s Omega_s enters Eq. (3), but soft shadows need the true disc.
constexpr double kSolarSolidAngle = 6.8e-5;  // [sr]
constexpr double kPrintedSolidAngle = 4e-4;  // [sr], the paper's [Durisch92, Tab. 1]

constexpr int kMostPolarFacets = 16;  // of an environment that is to be rendered

struct Daylight {
  Eigen::Vector3d sun_direction = Eigen::Vector3d::UnitZ();  // unit, world, towards the sun
  double sun_solid_angle = kSolarSolidAngle;                 // [sr]
  // The paper's: all its light comes from sun_direction, which the solid angle only scales.
  bool sun_is_one_direction = false;
  Spectrum sun_radiance = Spectrum::Zero();                     // k_s L
  Spectrum ambient_radiance = Spectrum::Zero();                 // k_u L
  Eigen::Vector3d zenith_direction = Eigen::Vector3d::UnitZ();  // unit, world
  int polar_facets = 8;                                         // m_h, 1 to kMostPolarFacets
  Spectrum sky_radiance = Spectrum::Zero();                     // k_h L
  // Departure: (5) has one weight for all facets. With the photographed surroundings, (k_u + k_h) L
  // is the sky's mean by cosine over open ground, and this tells how it is spread.
  SkyShape sky_shape = {};
  // The level of that shape that the photographs themselves show, for mirrors; nullopt: uniform.
  std::optional<Spectrum> photographed_sky = std::nullopt;

  // Of the sky in every direction; 1 if it is uniform.
  RelativeSky Sky() const { return {sky_shape, zenith_direction, sun_direction}; }
};

// The 4 m_h^2 directions to the centres of the sky facets, of equal solid angle, all above the
// horizon: m_h bands in polar direction times 4 m_h in azimuth, the centre of a band halving its
// solid angle. Ordered so that every 4th facet alone covers the sky evenly: as many of each band,
// evenly spaced in azimuth.
struct SkyFacets {
  std::vector<Eigen::Vector3d> directions;  // unit, world
  double solid_angle = 0;                   // of one facet [sr]; all sum to 2 pi
};
SkyFacets MakeSkyFacets(const Eigen::Vector3d& zenith, int polar_facets);

// Directions to points spread evenly over the sun's disc, as a sunflower's seeds, or to its middle
// if it is one direction: unit, world.
constexpr int kSunPoints = 16;
std::vector<Eigen::Vector3d> SunPoints(const Daylight& light);

// Irradiance of radiance from a small solid angle. [Durisch92, Eq. (1)]  dE = L n.l domega
Spectrum IrradianceElement(const Spectrum& radiance, double cosine, double solid_angle);

// What a surface element sees of the daylight, per unit radiance; irradiances follow by product.
struct LightGeometry {
  double sun = 0;      // n.d_s Omega_s, 0 if the sun is hidden or behind [sr]
  double ambient = 0;  // pi [sr]
  double sky = 0;      // sum of delta_i n.l_i domega [sr]
};

// Irradiance of the sun. [Durisch92, Eq. (3)]  E_s = k_s L n.d_s Omega_s
Spectrum SunIrradiance(const Daylight& light, const LightGeometry& geometry);
// Irradiance of the ambient light. [Durisch92, Eq. (4)]  E_u = k_u L pi
Spectrum AmbientIrradiance(const Daylight& light, const LightGeometry& geometry);
// Irradiance of the sky. [Durisch92, Eq. (5)]  E_h = k_h L sum delta_i n.l_i domega
Spectrum SkyIrradiance(const Daylight& light, const LightGeometry& geometry);
// Their sum.
Spectrum TotalIrradiance(const Daylight& light, const LightGeometry& geometry);

// The geometry of light at a point with unit normal, with visibility asked of `is_visible`
// (unit direction, world -> whether nothing natural stands in that direction).
// Departure: the scan of §3.3 prints d_s.l > 0 for the horizon; the zenith's d_h.l > 0 is meant.
LightGeometry MeasureLight(const Daylight& light, const SkyFacets& facets,
                           const Eigen::Vector3d& normal,
                           const std::function<bool(const Eigen::Vector3d&)>& is_visible);

}  // namespace insitu
