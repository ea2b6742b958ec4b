// SPDX-License-Identifier: GPL-3.0-or-later
// Overviews of photographs that take long to decode, kept as files, so that only the first opening
// waits for them.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <utility>

namespace insitu {

class OverviewFiles {
 public:
  // An empty path: nothing is kept.
  explicit OverviewFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // To the bit what was kept of the photograph, unless that has changed since; empty: nothing.
  cv::Mat Read(const std::filesystem::path& photo) const;
  // Of 8 or 16 bits; others are not kept. A folder that cannot be written keeps nothing.
  void Keep(const std::filesystem::path& photo, const cv::Mat& overview) const;

 private:
  const std::filesystem::path folder_;
};

}  // namespace insitu
