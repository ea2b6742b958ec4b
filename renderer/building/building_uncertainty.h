// SPDX-License-Identifier: GPL-3.0-or-later
// How well the image of a planned building is known in a photograph.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "reconstruction/geometry/projection_uncertainty.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

struct CornerUncertainty {
  Eigen::Vector3d corner;  // [m], world
  ImageUncertainty image;
};

// Of every distinct corner [m, world] that lies within the photograph's frame, hidden ones too, in
// their order. nullopt: the scene has no covariance for its cameras.
std::optional<std::vector<CornerUncertainty>> BuildingUncertainty(
    const SceneGeometry& scene, size_t camera, const std::vector<Eigen::Vector3d>& corners);

// At most 10 000 of them: where there are more, of those within some pixels of each other the least
// known one.
std::vector<CornerUncertainty> ThinnedOut(std::vector<CornerUncertainty> corners);

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
