// SPDX-License-Identifier: GPL-3.0-or-later
// The jobs of a plan, one picture each, and the file that holds one a line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/batch/batch_plan.h"
#include "renderer/batch/recorded_run.h"

namespace insitu {

struct BatchJob {
  std::string view, variant;  // variant as SitePaths has it
  std::string hour;           // a folder of work/hours/; "": the photograph's
  std::string quality;
  std::vector<std::string> options;  // of insitu-render
  FileStates inputs;                 // when the jobs were laid out

  // As its results are named below montages/: "tower/IMG_1@1630~draft".
  std::string Name() const;
  SitePaths PathsIn(const SitePaths& site) const;
};

// In the order view, variant, hour, quality. `hours`: names of the plan's hours, "" the
// photographs'. Without inputs.
std::vector<BatchJob> JobsOf(const BatchPlan& plan, const std::vector<std::string>& hours);

// The run of insitu-render that makes it.
RecordedRun RunOf(const BatchJob& job, const SitePaths& site, const std::filesystem::path& programs,
                  int threads);

// jobs.jsonl in the plan's folder. Reading throws InputError at the line: not as it was written.
std::filesystem::path JobsFile(const BatchPlan& plan);
void WriteJobs(const std::filesystem::path& file, const std::vector<BatchJob>& jobs);
std::vector<BatchJob> ReadJobs(const std::filesystem::path& file);

// What became of a job when it last ran, whoever ran it; beside its record.
void WriteOutcome(const SitePaths& site, const BatchJob& job, const RunOutcome& outcome);
std::optional<RunOutcome> ReadOutcome(const SitePaths& site, const BatchJob& job);

}  // namespace insitu
