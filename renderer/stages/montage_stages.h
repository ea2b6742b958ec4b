// SPDX-License-Identifier: GPL-3.0-or-later
// From survey to picture: the stages in their order, each with what it is made from and what it
// makes.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

// What a run of insitu-montage is asked for.
struct MontageRequest {
  SitePaths site;
  bool with_building = true;
  bool with_tie_points = false;  // also where every photograph shows enough control points
  std::map<std::string, std::vector<std::string>> options = {};  // stage -> for its program
};

// A stage is the program insitu-NAME, run on the site folder.
struct MontageStage {
  std::string name;                // the next of StageCommands()
  std::vector<std::string> after;  // stages that it takes results of
  // Files, or folders that stand for all files in them; what is not there counts too. Called when
  // the stages before have run. Throw InputError: the site cannot be right.
  std::function<std::vector<std::filesystem::path>(const MontageRequest&)> inputs, outputs;
  // Its reports (JSON) that hold a verdict.
  std::function<std::vector<std::filesystem::path>(const MontageRequest&)> reports;
  // Whether there is anything for it to do.
  std::function<bool(const MontageRequest&)> is_needed;
  bool is_of_design = false;    // reads the building: one record a variant
  bool makes_pictures = false;  // named by SitePaths::beside: one record for each
};

// Where the records of a stage are kept, and their name.
SitePaths RecordsOf(const MontageStage& stage, const MontageRequest& request);
std::string RecordNameOf(const MontageStage& stage, const MontageRequest& request);

const std::vector<MontageStage>& MontageStages();

// The stage of this name. Throws InputError, naming those there are.
size_t StageNamed(const std::string& name);

}  // namespace insitu
