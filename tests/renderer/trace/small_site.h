// SPDX-License-Identifier: GPL-3.0-or-later
// A site small enough to reason about: a square lawn on a national grid, one camera, a photograph
// of one grey, daylight by hand.
#pragma once

#include "calibration/photo/raster.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

struct SmallSite {
  NaturalEnvironment natural;
  Camera pinhole = Camera::Pinhole(60, 60, 31.5, 23.5, 64, 48);
  Raster photo;

  MontageScene With(const ArtificialEnvironment& building) const;
  const PosedCamera& camera() const { return natural.scene.cameras[0]; }
};

constexpr double kLawnRadiance = 0.25;  // every pixel of the photograph

// Lawn: z = 0 of the local frame, 200 m wide, material "lawn". Camera 10 m south of the origin,
// 3 m up, looking north and 0.2 rad down. Sun 45 degrees up in the east; clear air.
SmallSite MakeSmallSite(int bins = kMaxBins);

// A lying square plate, `half` its half side [m], centred above a local point.
ArtificialEnvironment Plate(const SmallSite& site, const Eigen::Vector3d& center, double half,
                            const SurfaceMaterial& material);

// An upright closed box on the lawn from `low` to `high` (local).
ArtificialEnvironment Box(const SmallSite& site, const Eigen::Vector3d& low,
                          const Eigen::Vector3d& high, const SurfaceMaterial& material);

}  // namespace insitu
