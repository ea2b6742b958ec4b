// SPDX-License-Identifier: GPL-3.0-or-later
// A site from a folder of photographs: what a person is to write, as templates that explain
// themselves. FILES.md beside this file tells of every file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

struct NewSite {
  std::vector<std::string> written;  // files, relative to the site's folder, in order
  std::vector<std::string> remarks;  // what was found and what is to be done next
};

// Makes the folder, if it is not there, copies the photographs of `photographs`, a folder, where
// one is given, and writes site.json with what EXIF tells of place and time, the tables and JSON
// files of survey/ without content but with a word on each, and their schemas in schemas/. What is
// there already stays as it is. Throws InputError: no photographs, or one that stands in photos/
// with another content; then nothing is written.
NewSite MakeNewSite(const SitePaths& site, const std::filesystem::path& photographs = {});

}  // namespace insitu
