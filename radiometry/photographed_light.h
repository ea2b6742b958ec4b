// SPDX-License-Identifier: GPL-3.0-or-later
// What points of a site as it stands receive from around, as its photographs show that.
#pragma once

#include <vector>

#include "radiometry/light/photographed_color.h"
#include "radiometry/natural_environment.h"
#include "radiometry/transport/interreflection.h"

namespace insitu {

// Surfaces are in small pieces about these points.
struct LightFoci {
  const std::vector<SurfacePoint>& points;
  double piece_m = 0.15;  // of what surrounds a point, where that is nearest
};

class PhotographedLight {
 public:
  // `images` in the order of the scene's cameras. Keeps a reference to `environment`.
  PhotographedLight(const NaturalEnvironment& environment, std::vector<LocalImage> images,
                    const LightFoci& foci, const InterreflectionOptions& options);

  // As of Interreflection.
  void Solve(const Daylight& light) { interreflection_.Solve(light); }
  GatheredLight At(const SurfacePoint& point) const { return interreflection_.At(point); }

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
};

}  // namespace insitu
