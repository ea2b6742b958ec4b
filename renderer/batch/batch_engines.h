// SPDX-License-Identifier: GPL-3.0-or-later
// The jobs of a batch as other engines take them: Slurm, GNU parallel, Open Job Description.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/batch/batch_plan.h"

namespace insitu {

struct EngineJobs {
  const BatchPlan& plan;
  std::vector<size_t> numbers;    // of the jobs to do, lines of jobs.jsonl
  std::filesystem::path program;  // insitu-batch
  int jobs = 0;                   // at a time; 0: as many as the engine likes
  int threads = 0;                // of each; 0: all of its machine, or what Slurm gives a task
};

// "0-2,5": as Slurm and Open Job Description write sets of whole numbers.
std::string NumbersText(const std::vector<size_t>& numbers);

// Submits an array job, and after it one that writes the contact sheet; what each task prints is in
// the plan's folder. Returns the array's number. Throws InputError: no Slurm here, an array of the
// same plan still in its queue, or it takes the array not.
std::string SubmitToSlurm(const EngineJobs& jobs);

// Runs them to the end. Status as of a program; throws InputError: GNU parallel is not installed.
int RunByParallel(const EngineJobs& jobs);

// openjd.json in the plan's folder, a template of version jobtemplate-2023-09. Tried on no farm.
std::filesystem::path WriteOpenJdTemplate(const EngineJobs& jobs);

}  // namespace insitu
