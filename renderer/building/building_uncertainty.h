// SPDX-License-Identifier: GPL-3.0-or-later
// How well the image of a planned building is known in a photograph.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "reconstruction/geometry/projection_uncertainty.h"
#include "reconstruction/geometry/scene_geometry.h"
#include "renderer/building/artificial_environment.h"

namespace insitu {

struct CornerUncertainty {
  Eigen::Vector3d corner;  // [m], world
  ImageUncertainty image;
};

// Of every distinct vertex of the building that lies within the photograph's frame, hidden ones
// too, in the mesh's order. nullopt: the scene has no covariance for its cameras.
std::optional<std::vector<CornerUncertainty>> BuildingUncertainty(
    const SceneGeometry& scene, size_t camera, const ArtificialEnvironment& building);

struct UncertaintySummary {
  int corners = 0;
  double median_px = 0, worst_px = 0;  // standard ellipses' major axes
  double median_m = 0, worst_m = 0;    // the same at the building
};

// Of at least one corner.
UncertaintySummary Summarize(const std::vector<CornerUncertainty>& corners);

// x,y,z,pixel_x,pixel_y,sigma_major_px,sigma_minor_px,sigma_mm; a line a corner.
void WriteUncertainty(const std::filesystem::path& path,
                      const std::vector<CornerUncertainty>& corners);

}  // namespace insitu
