// SPDX-License-Identifier: GPL-3.0-or-later
// Rectangles of known radiance, photographed all round from one place, and a planned building of
// rectangles: what light among surfaces has closed forms for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "radiometry/transport/interreflection.h"

namespace insitu {

// Set up by the Add functions; then Photograph, once; then the rest.
class Court {
 public:
  // A rectangle of the site, its normal u x v; `radiance` is grey, linear Rec. 709.
  void AddWall(const std::string& name, const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
               const Eigen::Vector3d& v, double radiance);
  // Ground and four walls about the vertical axis, all seen from inside; `half` is half their side.
  void AddOpenBox(double half, double height, double radiance);

  // One of the planned building, its normal u x v.
  void AddPlanned(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                  double albedo);
  // Six of them, their normals outwards.
  void AddPlannedBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double albedo);

  // Six photographs from one place, which together see every direction.
  void Photograph(const Eigen::Vector3d& from);

  Spectrum Grey(double radiance) const {
    return spectra_.SpectrumFromRgb(Eigen::Vector3d::Constant(radiance));
  }
  double Red(const Spectrum& stimulus) const { return spectra_.RgbFromSpectrum(stimulus).x(); }

  // Zenith along z; no sun.
  Daylight UnderSky(double radiance) const;
  TransportScene Scene(std::function<Spectrum(const SurfacePoint&)> lamps = {}) const;

 private:
  struct Planned {
    TriangleMesh mesh;
    std::vector<Eigen::Vector3d> normals;
    std::vector<int> materials;
    std::vector<Spectrum> brdfs;
  };

  SceneGeometry scene_;
  std::vector<double> radiance_of_polygon_;
  Planned planned_;
  Atmosphere air_;
  SpectralBasis spectra_;
  PolygonMesh polygons_;
  std::unique_ptr<RayScene> rays_, planned_rays_;
  std::vector<Raster> photos_;
  std::vector<LocalImage> images_;
};

}  // namespace insitu
