// SPDX-License-Identifier: GPL-3.0-or-later
// The adjustment's figures beside those that other programs print for the same data.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace insitu {

struct ReconstructionFigure {
  std::string key;
  std::string folder;  // what it needs of the shared data; empty: nothing
  std::function<Json::Value(const std::filesystem::path& data)> measure;
};

const std::vector<ReconstructionFigure>& ReconstructionFigures();

}  // namespace insitu
