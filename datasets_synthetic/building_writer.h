// SPDX-License-Identifier: GPL-3.0-or-later
// The planned building as its architect hands it over: an ASCII DXF of 2000 and its materials.
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "datasets_synthetic/building.h"
#include "datasets_synthetic/spectral_light.h"

namespace insitu::demo {

// Survey coordinates in metres ($INSUNITS 6); layers are materials. Panels are 3DFACEs, windows
// INSERTs of one BLOCK, bodies polyfaces, round bodies polygon meshes.
void WriteDxf(const std::filesystem::path& path, const Building& building,
              const Eigen::Vector3d& origin);

// materials.json: linear Rec. 709 reflectance of each layer as a grey card would tell it.
void WriteBuildingMaterials(const std::filesystem::path& path, const Building& building,
                            const Daylight& daylight);

}  // namespace insitu::demo
