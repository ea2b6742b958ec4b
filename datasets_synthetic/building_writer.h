// SPDX-License-Identifier: GPL-3.0-or-later
// The planned building as its architect hands it over: an ASCII DXF of 2000 and its materials.
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "datasets_synthetic/pavilion.h"
#include "datasets_synthetic/spectral_light.h"

namespace insitu::demo {

// Survey coordinates in metres ($INSUNITS 6); layers are materials. Walls and roof are 3DFACEs, the
// windows INSERTs of one BLOCK, the ball a polyface, the mast a polygon mesh.
void WriteDxf(const std::filesystem::path& path, const Pavilion& pavilion,
              const Eigen::Vector3d& origin);

// materials.json: linear Rec. 709 reflectance of each layer as a grey card would tell it.
void WriteBuildingMaterials(const std::filesystem::path& path, const Daylight& daylight);

}  // namespace insitu::demo
