// SPDX-License-Identifier: GPL-3.0-or-later
// What points of a site as it stands receive from around, as its photographs show that.
#pragma once

#include <vector>

#include "radiometry/light/photographed_color.h"
#include "radiometry/transport/interreflection.h"

namespace insitu {

// Where light is wanted; surfaces are in small pieces about these points.
struct LightFoci {
  const std::vector<SurfacePoint>& points;
  double piece_m = 0.15;  // of what surrounds a point, where that is nearest
};

// A site without a plan.
struct LitSite {
  const SceneGeometry& scene;
  const Atmosphere& air;
  const SpectralBasis& spectra;
  const Daylight& light;  // of which the geometry and the sky's shape count
};

class PhotographedLight {
 public:
  // Keeps references to all of `site` but its images, which are in the order of its cameras.
  PhotographedLight(const LitSite& site, std::vector<LocalImage> images, const LightFoci& foci,
                    const InterreflectionOptions& options);

  void Solve(const Daylight& light) { interreflection_.Solve(light); }  // as of Interreflection
  GatheredLight AtFocus(size_t point) const;

 private:
  // For a site as it stands.
  struct NothingPlanned {
    TriangleMesh mesh;
    RayScene rays{mesh};
    std::vector<Eigen::Vector3d> normals;
    std::vector<int> materials;
    std::vector<Spectrum> brdfs;
    PlannedFaces faces{mesh, rays, normals, materials, brdfs};
  };

  PolygonMesh polygons_;
  RayScene rays_;
  std::vector<LocalImage> images_;
  NothingPlanned nothing_;
  TransportScene scene_;
  Interreflection interreflection_;
  std::vector<std::vector<Meeting>> meetings_;  // of each focus
};

}  // namespace insitu
