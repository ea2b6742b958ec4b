// SPDX-License-Identifier: GPL-3.0-or-later
// The true colour of the site's surfaces, looked up in its photographs. [Durisch92, §6.2 case D]
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "calibration/photo/raster.h"
#include "radiometry/light/atmosphere.h"
#include "radiometry/spectrum/rgb_to_spectrum.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {

// A surface element, in the scene's local frame (world minus its origin).
struct SurfacePoint {
  Eigen::Vector3d position;  // [m]
  Eigen::Vector3d normal;    // unit, towards the side that is lit and looked at
};

// Light rays start this far off a surveyed surface: survey noise leaves polygons that lie on each
// other about a centimetre apart, and the lower of two must not be shaded by the upper. [m]
constexpr double kSurveyClearance = 0.02;

// A photograph, or the input image made from it, with its camera in the local frame.
struct LocalImage {
  // [px] to linear RGB, as Interpolate makes it of a raster.
  using ImageFunction = std::function<Eigen::Vector3d(const Eigen::Vector2d& pixel)>;
  LocalImage(const PosedCamera& posed, const Eigen::Vector3d& origin, ImageFunction image);
  // `image` must outlive it.
  LocalImage(const PosedCamera& posed, const Eigen::Vector3d& origin, const Raster& image);

  PosedCamera camera;
  Eigen::Vector3d center;  // of projection [m]
  ImageFunction rgb;
  // Whether it shows a polygon there, and not something before it; empty: wherever nothing hides
  // it.
  std::function<bool(int polygon, const Eigen::Vector2d& pixel)> shows = {};
};

// What a look-up needs. All references are the caller's.
struct PhotographedSite {
  const SceneGeometry& scene;
  const RayScene& rays;  // of MeshOfPolygons(scene)
  const std::vector<int>& polygon_of_triangle;
  const std::vector<LocalImage>& images;  // in the order of scene.cameras
  const Atmosphere& air;
  const SpectralBasis& spectra;
  bool by_attribute_alone = false;  // as printed: no other photo, unless there is no attribute
};

// What one photograph shows of a place.
struct PhotographedColor {
  Spectrum true_color;        // L_0 >= 0, haze removed by [Durisch92, Eq. (8)]
  Eigen::Vector3d to_camera;  // unit, towards the photograph
  double weight = 1;          // those of a place are 1 in all
};

// A point of a polygon as the photo of its image attribute shows it. Towards the edge of that one's
// frame, and where it does not show the point (out of frame, hidden, other side), as up to three
// others do, those that resolve it best, by the pixels on its area: so that what moves from one
// photo to another does so without a seam, but for the outline of what hides it from one. Empty:
// none shows it. Departure: the paper asks the attribute's alone.
std::vector<PhotographedColor> LookUpColors(const PhotographedSite& site, int polygon,
                                            const SurfacePoint& surface);

// Their mean; nullopt: none shows it.
std::optional<Spectrum> LookUpColor(const PhotographedSite& site, int polygon,
                                    const SurfacePoint& surface);

}  // namespace insitu
