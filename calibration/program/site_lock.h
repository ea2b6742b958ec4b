// SPDX-License-Identifier: GPL-3.0-or-later
// One run at a time on a site, or one program of a kind.
#pragma once

#include <filesystem>
#include <string>

#include "calibration/program/site.h"

namespace insitu {

// Holds a site's lock file while it lives. The kernel lets go of it when its process ends, however
// it ends, so a dead process never holds one.
class SiteLock {
 public:
  // `command`: what the run is, for whoever finds the site locked. `file` is site.lock(), unless
  // the program may go together with runs. Makes the file's folder where it is missing. Throws
  // InputError: another run holds the site (says which, where and since when), or nothing can be
  // written there.
  SiteLock(const SitePaths& site, const std::string& command);
  SiteLock(const SitePaths& site, const std::string& command, const std::filesystem::path& file);
  ~SiteLock();
  SiteLock(const SiteLock&) = delete;
  SiteLock& operator=(const SiteLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace insitu
