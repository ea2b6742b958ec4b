// SPDX-License-Identifier: GPL-3.0-or-later
// Runs those stages of a site whose results do not hold any more.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/stages/montage_stages.h"

namespace insitu {

struct RunOptions {
  std::filesystem::path programs;  // folder of insitu-calibrate and the others
  size_t first = 0;                // indices into MontageStages(); those outside are left as they
  size_t last = SIZE_MAX;          // are
  int jobs = 1;                    // stages at a time
  bool explains = false;           // says why a stage runs
  bool is_despite_fail = false;    // goes on after a verdict of fail
  void Check() const;              // throws InputError naming the option
};

// What became of a stage.
struct StageOutcome {
  std::string stage;
  bool ran = false;
  std::optional<std::string> verdict;  // pass, review or fail, the worst of its reports
  std::filesystem::path report;        // that holds it
  std::vector<std::string> warnings;   // of its program, when it last ran
};

struct RunSummary {
  int status = 0;  // exit status: 0, 1 (failure, or a verdict of fail), 2 (bad input), 128 + signal
  std::vector<StageOutcome> outcomes;  // of the stages that have results, in their order
  std::string BriefReport() const;     // verdicts and warnings; empty if there are none
};

// Prints a line a stage on standard output, `[3/7] reconstruct  2.1 s`; what its program prints is
// kept in StageLog, its errors appear on standard error. Stages that do not need each other run
// side by side. Throws InputError: a program is missing or of another version, an option that a
// program does not have, a site that cannot be right; what was finished before stays.
RunSummary RunStages(const MontageRequest& request, const RunOptions& options);

}  // namespace insitu
