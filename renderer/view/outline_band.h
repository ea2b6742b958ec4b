// SPDX-License-Identifier: GPL-3.0-or-later
// The building's outline in a photograph, and where it may lie for all that the adjustment knows.
#pragma once

#include <json/value.h>

#include <memory>
#include <mutex>
#include <string>

#include "calibration/program/site.h"

namespace insitu {

// Any thread may ask.
class OutlineBands {
 public:
  explicit OutlineBands(const SitePaths& site);
  ~OutlineBands();

  // {lines: [{points, low, high, hidden}], corners: [{x, y, major, minor, angle}], known}: pieces
  // of the outline, each with two curves 2 sigma beside it, in upright pixels of the frame "photo"
  // or "pinhole"; corners with the semi-axes of their 2 sigma ellipses [px] and angle [rad] from +x
  // towards +y. known: false without covariances, then there are no curves and corners. hidden:
  // behind the building itself or a polygon. Throws InputError: a stage before is missing, no such
  // photograph.
  Json::Value Of(const std::string& photo, const std::string& frame);

 private:
  struct Scene;
  std::shared_ptr<const Scene> Newest();

  const SitePaths site_;
  std::mutex mutex_;
  std::string version_;
  std::shared_ptr<const Scene> scene_;
};

}  // namespace insitu
