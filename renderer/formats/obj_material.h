// SPDX-License-Identifier: GPL-3.0-or-later
// The material files of OBJ (MTL).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "renderer/mesh/model.h"

namespace insitu {

struct ObjMaterial {
  std::optional<Eigen::Vector3d> rgb;
  double opacity = 1;
  std::string texture, texture_place;
};

// By name. "d" goes before "Tr": programs write both alike, and d is the defined one. A colour or
// opacity that is no number is counted as skipped. Throws InputError: unreadable.
std::map<std::string, ObjMaterial> ReadObjMaterials(const std::filesystem::path& path,
                                                    SkippedEntities* skipped);

}  // namespace insitu
