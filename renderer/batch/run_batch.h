// SPDX-License-Identifier: GPL-3.0-or-later
// A plan carried out: prepared, run here or handed to an engine, gone on with, shown.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/batch/batch_plan.h"

namespace insitu {

enum class BatchEngine { kLocal, kSlurm, kParallel, kOpenJd };

struct BatchOptions {
  std::filesystem::path programs;  // folder of insitu-render and the others
  BatchEngine engine = BatchEngine::kLocal;
  int jobs = 0;     // at a time; 0: one here, else as the engine likes
  int threads = 0;  // of a job; 0: all cores shared among the jobs
  bool explains = false;

  void Check() const;  // throws CheckError that names the field that is wrong
};

// Converts the variants' models, relights the hours, writes jobs.jsonl and has those jobs done
// whose results do not hold; then the contact sheet. Prints what it does. Status as of a program: 1
// where a job failed, 128 + signal. Throws InputError as all of these do.
int RunBatch(const BatchPlan& plan, const BatchOptions& options);

// A task of an engine: the job of that line, unless its results hold. The status is its program's.
// Throws InputError: no such line, or what it is made from has changed since it was written.
int RunBatchJob(const BatchPlan& plan, int number, const BatchOptions& options);

// Writes the contact sheet of what is there, and tells how far the plan is.
void ShowBatch(const BatchPlan& plan, const BatchOptions& options);

}  // namespace insitu
