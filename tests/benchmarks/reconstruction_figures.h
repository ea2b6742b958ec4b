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

// Each data set's figures; `data` is the folder data of shared/.

// Shares of 95 % intervals of 500 random networks that hold the truth, false alarms, blunders
// found.
Json::Value CoverageFigures(const std::filesystem::path& data);
// Against every mark and point of AICON's report.
Json::Value AiconFigures(const std::filesystem::path& data);
// Against DBAT's reports: self-calibration, control fixed and weighted; an aerial block.
Json::Value DbatCamcalFigures(const std::filesystem::path& data);
Json::Value SxbFigures(const std::filesystem::path& data);
// Against DBAT's results; and with the time of COLMAP's adjustment beside ours, covariances and
// all.
Json::Value RomaAccuracy(const std::filesystem::path& data);
Json::Value RomaFigures(const std::filesystem::path& data);
// Resections from the pairs that MicMac lists of each photo, against MicMac's orientations.
Json::Value StonewallFigures(const std::filesystem::path& data);
// Photographs alone, with EXIF's focal length.
Json::Value BerlinFigures(const std::filesystem::path& data);
// Check points, sun and zenith against the truth. The truth of its poses is not handed out.
Json::Value GalleryFigures(const std::filesystem::path& data);

}  // namespace insitu
