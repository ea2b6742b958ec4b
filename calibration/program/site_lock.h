// SPDX-License-Identifier: GPL-3.0-or-later
// One run at a time on a site.
#pragma once

#include <string>

#include "calibration/program/site.h"

namespace insitu {

// Holds site.lock() while it lives. The kernel lets go of it when its process ends, however it
// ends, so a dead process never holds one.
class SiteLock {
 public:
  // `command`: what the run is, for whoever finds the site locked. Makes work/ where it is missing.
  // Throws InputError: another run holds the site (says which, where and since when), or nothing
  // can be written there.
  SiteLock(const SitePaths& site, const std::string& command);
  ~SiteLock();
  SiteLock(const SiteLock&) = delete;
  SiteLock& operator=(const SiteLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace insitu
