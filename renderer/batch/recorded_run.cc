// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/recorded_run.h"

#include <chrono>

#include "renderer/stages/stage_program.h"

namespace insitu {
namespace {

StageRecord StateOf(const RecordedRun& run, FileHashes* hashes) {
  return {.version = INSITU_VERSION,
          .program_hash = hashes->Hash(run.program),
          .options = run.options,
          .inputs = StatesOf(run.site, run.inputs, hashes),
          .outputs = StatesOf(run.site, run.outputs, hashes)};
}

}  // namespace

std::vector<std::string> WhyToRun(const RecordedRun& run, FileHashes* hashes) {
  const auto then = ReadStageRecord(run.site, run.name);
  if (!then) return {"it has not run yet"};
  return WhatChanged(*then, StateOf(run, hashes));
}

RunOutcome RunAndRecord(const RecordedRun& run, FileHashes* hashes,
                        const std::function<void(const std::string&)>& on_progress) {
  StageRecord record = StateOf(run, hashes);
  RemoveStageRecord(run.site, run.name);
  std::vector<std::string> command = {run.program.string(), run.site.root.string()};
  for (const auto* more : {&run.options, &run.settings}) {
    command.insert(command.end(), more->begin(), more->end());
  }
  RunOutcome outcome;
  const auto start = std::chrono::steady_clock::now();
  const StageRun ran = RunStageProgram(command, StageLog(run.site, run.name), on_progress,
                                       [&](const std::string& line) { outcome.message = line; });
  outcome.status = ran.status;
  outcome.warnings = ran.warnings;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (ran.status != 0) return outcome;
  if (StatesOf(run.site, run.inputs, hashes) != record.inputs) {
    outcome.status = 1;
    outcome.message = "what it reads was changed while it ran; it runs again the next time";
    return outcome;
  }
  record.seconds = outcome.seconds;
  record.warnings = ran.warnings;
  record.outputs = StatesOf(run.site, run.outputs, hashes);
  std::erase_if(record.outputs, [](const auto& file) { return file.second.empty(); });
  WriteStageRecord(run.site, run.name, record);
  return outcome;
}

}  // namespace insitu
