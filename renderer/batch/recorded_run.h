// SPDX-License-Identifier: GPL-3.0-or-later
// A run of one of our programs with a record of what it was made from, as a stage has it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/stages/file_states.h"
#include "renderer/stages/stage_record.h"

namespace insitu {

struct RecordedRun {
  SitePaths site;                     // whose stages() holds record and log
  std::string name;                   // of both
  std::filesystem::path program;      // insitu-NAME
  std::vector<std::string> options;   // that change its results
  std::vector<std::string> settings;  // that do not: threads
  std::vector<std::filesystem::path> inputs, outputs;
};

// Empty: its results hold. Else why not, a phrase each.
std::vector<std::string> WhyToRun(const RecordedRun& run, FileHashes* hashes);

struct RunOutcome {
  int status = 0;  // of the program
  double seconds = 0;
  std::string message = {};  // its last line of error
  std::vector<std::string> warnings = {};
};

// Runs it, keeps what it prints in StageLog and, where it ended well and its inputs stayed the
// same, its record.
RunOutcome RunAndRecord(const RecordedRun& run, FileHashes* hashes,
                        const std::function<void(const std::string&)>& on_progress);

}  // namespace insitu
