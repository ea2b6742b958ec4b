// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/run_batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <numeric>
#include <thread>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/program/child_process.h"
#include "calibration/program/program.h"
#include "calibration/program/warnings.h"
#include "renderer/batch/batch_engines.h"
#include "renderer/batch/batch_jobs.h"
#include "renderer/batch/contact_sheet.h"
#include "renderer/batch/prepare_batch.h"
#include "renderer/batch/progress_table.h"
#include "renderer/stages/stage_program.h"

namespace insitu {
namespace {

int CoresHere() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

int JobsAtOnce(const BatchOptions& options) { return std::max(1, options.jobs); }

// Shared among jobs that run beside each other here.
int ThreadsOfJob(const BatchOptions& options) {
  if (options.threads > 0) return options.threads;
  return std::max(1, CoresHere() / JobsAtOnce(options));
}

std::string EndText(const RunOutcome& outcome) {
  if (outcome.status == 0) return Number("done  %.1f s", outcome.seconds);
  std::string text = "failed (status " + std::to_string(outcome.status) + ")";
  if (!outcome.message.empty()) text += "  " + outcome.message;
  return text;
}

std::vector<std::string> NamesOf(const std::vector<BatchJob>& jobs) {
  std::vector<std::string> names;
  for (const BatchJob& job : jobs) names.push_back(job.Name());
  return names;
}

// What a picture says of a light that is not the photograph's.
std::string SimulationOf(const SitePaths& site) {
  if (site.hour.empty() || !std::filesystem::exists(site.environment())) return "";
  return JsonNode::Load(site.environment()).At("simulation").At("statement").Text();
}

class Batch {
 public:
  Batch(const BatchPlan& plan, const BatchOptions& options)
      : plan_(plan), options_(options), hashes_(plan.site.root / "work/batch/hashes.json") {}

  int Run() {
    if (const int status = PrepareBatch(plan_, options_.programs, &hashes_, &jobs_)) return status;
    WriteJobs(JobsFile(plan_), jobs_);
    FindWhatIsToDo();
    hashes_.Save();
    switch (options_.engine) {
      case BatchEngine::kSlurm:
        return HandToSlurm();
      case BatchEngine::kParallel:
        return Ended(to_do_.empty() ? 0 : RunByParallel(ForEngine()));
      case BatchEngine::kOpenJd:
        std::cout << WriteOpenJdTemplate(ForEngine()).string() << ": " << to_do_.size()
                  << " tasks; such templates were tried on no farm yet\n";
        return 0;
      case BatchEngine::kLocal:
        break;
    }
    return Ended(RunHere());
  }

  int RunOne(int number) {
    jobs_ = ReadJobs(JobsFile(plan_));
    if (number < 0 || number >= std::ssize(jobs_)) {
      throw InputError(JobsFile(plan_), "has no job " + std::to_string(number) +
                                            ", expected 0 to " + std::to_string(jobs_.size() - 1));
    }
    const BatchJob& job = jobs_[static_cast<size_t>(number)];
    const RecordedRun run = RunFor(job);
    RequireInputsOf(job, run);
    if (WhyToRun(run, &hashes_).empty()) {
      std::cout << job.Name() << ": its results hold\n";
      return 0;
    }
    const RunOutcome outcome = RunAndRecord(run, &hashes_, [](const auto&) {});
    WriteOutcome(plan_.site, job, outcome);
    std::cout << job.Name() << ": " << EndText(outcome) << "\n" << WarningLines(outcome.warnings);
    return outcome.status;
  }

  void Show() {
    jobs_ = ReadJobs(JobsFile(plan_));
    FindWhatIsToDo();
    Ended(0);
  }

 private:
  RecordedRun RunFor(const BatchJob& job) const {
    return RunOf(job, plan_.site, options_.programs, ThreadsOfJob(options_));
  }

  void FindWhatIsToDo() {
    for (size_t i = 0; i < jobs_.size(); ++i) {
      const std::vector<std::string> reasons = WhyToRun(RunFor(jobs_[i]), &hashes_);
      if (reasons.empty()) continue;
      to_do_.push_back(i);
      if (options_.explains) {
        std::cout << jobs_[i].Name() << " runs: " << ReasonText(reasons) << "\n";
      }
    }
    std::cout << jobs_.size() << " jobs, " << jobs_.size() - to_do_.size()
              << " of them done already" << std::endl;
  }

  // What has changed since the line was written was perhaps changed for other jobs.
  void RequireInputsOf(const BatchJob& job, const RecordedRun& run) {
    const StageRecord then{.version = "", .program_hash = "", .inputs = job.inputs},
        now{.version = "", .program_hash = "", .inputs = StatesOf(run.site, run.inputs, &hashes_)};
    const std::vector<std::string> changes = WhatChanged(then, now);
    if (changes.empty()) return;
    throw InputError(JobsFile(plan_), job.Name() + ": " + ReasonText(changes) +
                                          "; run insitu-batch again, which lays the jobs out anew");
  }

  EngineJobs ForEngine() const {
    return {plan_, to_do_, options_.programs / "insitu-batch", options_.jobs, options_.threads};
  }

  int HandToSlurm() {
    if (to_do_.empty()) return Ended(0);
    const std::string array = SubmitToSlurm(ForEngine());
    std::cout
        << "array " << array << ": " << to_do_.size()
        << " tasks submitted; the contact sheet comes after them. What they leave undone, the "
           "same command submits again\n";
    return 0;
  }

  // A record or log that cannot be written, a full disk, costs this job alone.
  RunOutcome OutcomeOf(const BatchJob& job,
                       const std::function<void(const std::string&)>& on_progress) {
    try {
      const RunOutcome outcome = RunAndRecord(RunFor(job), &hashes_, on_progress);
      WriteOutcome(plan_.site, job, outcome);
      return outcome;
    } catch (const std::exception& error) {
      return {.status = 1, .message = error.what()};
    }
  }

  int RunHere() {
    ProgressTable table(NamesOf(jobs_));
    for (size_t i = 0; i < jobs_.size(); ++i) {
      if (!std::binary_search(to_do_.begin(), to_do_.end(), i)) table.End(i, "done already", false);
    }
    std::atomic<size_t> next = 0;
    std::atomic<bool> has_failed = false;
    const auto work = [&] {
      for (size_t at = next++; at < to_do_.size() && !ReceivedSignal(); at = next++) {
        const size_t i = to_do_[at];
        table.Run(i, "begins");
        const RunOutcome outcome =
            OutcomeOf(jobs_[i], [&](const auto& told) { table.Run(i, told); });
        table.End(i, EndText(outcome), outcome.status != 0);
        if (outcome.status != 0) has_failed = true;
      }
    };
    std::vector<std::jthread> workers;
    for (int i = 0; i < JobsAtOnce(options_); ++i) workers.emplace_back(work);
    workers.clear();
    return has_failed ? 1 : 0;
  }

  // With the contact sheet. `status` of the jobs.
  int Ended(int status) {
    std::vector<SheetEntry> entries;
    size_t done = 0;
    for (const BatchJob& job : jobs_) {
      const SitePaths paths = job.PathsIn(plan_.site);
      const RecordedRun run = RunFor(job);
      SheetEntry entry{.job = job, .is_done = WhyToRun(run, &hashes_).empty()};
      done += entry.is_done;
      if (entry.is_done) {
        const auto record = ReadStageRecord(run.site, run.name);
        entry.seconds = record ? record->seconds : 0;
        if (record) entry.warnings = record->warnings;
      } else if (const auto outcome = ReadOutcome(plan_.site, job)) {
        entry.fault = EndText(*outcome);
      }
      entry.simulation = SimulationOf(paths);
      entries.push_back(std::move(entry));
    }
    WriteWhole(plan_.sheet(), ContactSheet(plan_, entries));
    hashes_.Save();
    std::cout << done << " of " << jobs_.size() << " pictures are there; contact sheet "
              << plan_.sheet().string() << std::endl;
    return ReceivedSignal() ? 128 + *ReceivedSignal() : status;
  }

  const BatchPlan& plan_;
  const BatchOptions& options_;
  FileHashes hashes_;
  std::vector<BatchJob> jobs_;
  std::vector<size_t> to_do_;  // ascending
};

}  // namespace

void BatchOptions::Check() const {
  INSITU_CHECK(jobs >= 0);
  INSITU_CHECK(threads >= 0);
}

int RunBatch(const BatchPlan& plan, const BatchOptions& options) {
  options.Check();
  return Batch(plan, options).Run();
}

int RunBatchJob(const BatchPlan& plan, int number, const BatchOptions& options) {
  options.Check();
  return Batch(plan, options).RunOne(number);
}

void ShowBatch(const BatchPlan& plan, const BatchOptions& options) {
  options.Check();
  Batch(plan, options).Show();
}

}  // namespace insitu
