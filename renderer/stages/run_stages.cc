// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/run_stages.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iostream>
#include <mutex>
#include <thread>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "calibration/program/child_process.h"
#include "calibration/program/program.h"
#include "renderer/commands/commands.h"
#include "renderer/stages/file_states.h"
#include "renderer/stages/stage_program.h"
#include "renderer/stages/stage_record.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// ---- what is printed -----------------------------------------------------------------------

// Lines of finished stages, and below them on a terminal one that tells what is running.
class Console {
 public:
  void SetRunning(size_t stage, const std::string& what) {
    const std::lock_guard lock(mutex_);
    running_[stage] = what;
    ShowRunning();
  }

  // `line`: empty for none.
  void Finish(size_t stage, const std::string& line) {
    const std::lock_guard lock(mutex_);
    running_.erase(stage);
    if (!line.empty()) Write(std::cout, line);
  }

  void Print(const std::string& line) {
    const std::lock_guard lock(mutex_);
    Write(std::cout, line);
  }

  void Error(const std::string& line) {
    const std::lock_guard lock(mutex_);
    Write(std::cerr, line);
  }

 private:
  void Write(std::ostream& stream, const std::string& line) {
    if (on_terminal_) std::cout << "\r\033[K" << std::flush;
    stream << line << std::endl;
    ShowRunning();
  }

  void ShowRunning() {
    if (!on_terminal_) return;
    std::string line;
    for (const auto& [stage, what] : running_) line += (line.empty() ? "" : "   ") + what;
    std::cout << "\r\033[K" << line << std::flush;
  }

  const bool on_terminal_ = isatty(STDOUT_FILENO) == 1;
  std::mutex mutex_;
  std::map<size_t, std::string> running_;
};

// The worst of a stage's reports that are there.
void JudgeReports(const std::vector<fs::path>& reports, StageOutcome* outcome) {
  static const std::vector<std::string> kFromBest = {"pass", "review", "fail"};
  const auto rank = [&](const std::string& verdict) {
    return std::find(kFromBest.begin(), kFromBest.end(), verdict) - kFromBest.begin();
  };
  for (const fs::path& report : reports) {
    if (!fs::exists(report)) continue;
    const std::string verdict = ReadJson(report)["verdict"]["status"].asString();
    if (outcome->verdict && rank(verdict) <= rank(*outcome->verdict)) continue;
    outcome->verdict = verdict;
    outcome->report = fs::path(report).replace_extension(".html");
  }
}

// ---- the stages ----------------------------------------------------------------------------

class Run {
 public:
  Run(const MontageRequest& request, const RunOptions& options)
      : request_(request),
        options_(options),
        stages_(MontageStages()),
        states_(stages_.size(), State::kWaiting),
        outcomes_(stages_.size()),
        hashes_(SitePaths{request.site.root}.stages() / "hashes.json") {
    for (size_t i = 0; i < stages_.size(); ++i) {
      if (i < options.first || i > options.last) states_[i] = State::kDone;
      outcomes_[i].stage = stages_[i].name;
    }
  }

  RunSummary RunAll() {
    const int threads = std::min(options_.jobs, static_cast<int>(stages_.size()));
    std::vector<std::thread> workers;
    for (int i = 0; i < threads; ++i) workers.emplace_back([this] { Work(); });
    for (std::thread& worker : workers) worker.join();
    hashes_.Save();
    if (failure_ && !ReceivedSignal()) std::rethrow_exception(failure_);
    RunSummary summary;
    summary.status = ReceivedSignal() ? 128 + *ReceivedSignal() : status_;
    for (size_t i = options_.first; i < stages_.size() && i <= options_.last; ++i) {
      const bool has_results = states_[i] == State::kDone || outcomes_[i].verdict;
      if (has_results) summary.outcomes.push_back(outcomes_[i]);
    }
    return summary;
  }

 private:
  enum class State { kWaiting, kRunning, kDone, kFailed };

  // Takes one stage after the other that can run, until there is none any more.
  void Work() {
    while (const std::optional<size_t> stage = NextStage()) {
      int status = 0;
      try {
        status = RunStage(*stage);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        status = 1;
      }
      const std::lock_guard lock(mutex_);
      states_[*stage] = status == 0 ? State::kDone : State::kFailed;
      if (status_ == 0) status_ = status;
      changed_.notify_all();
    }
  }

  // Waits while only stages that are running can bring it forth; nullopt: nothing is left to start.
  std::optional<size_t> NextStage() {
    std::unique_lock lock(mutex_);
    for (;;) {
      if (status_ != 0 || failure_ || ReceivedSignal()) return std::nullopt;
      bool is_any_waiting = false;
      for (size_t i = 0; i < stages_.size(); ++i) {
        if (states_[i] != State::kWaiting) continue;
        is_any_waiting = true;
        if (!IsReady(stages_[i])) continue;
        states_[i] = State::kRunning;
        return i;
      }
      if (!is_any_waiting) return std::nullopt;
      changed_.wait(lock);
    }
  }

  bool IsReady(const MontageStage& stage) const {
    return std::all_of(stage.after.begin(), stage.after.end(), [&](const std::string& name) {
      return states_[StageNamed(name)] == State::kDone;
    });
  }

  std::string Line(size_t i, const std::string& what) const {
    std::string name = stages_[i].name;
    name.resize(std::max<size_t>(name.size(), 12), ' ');
    return "[" + std::to_string(i + 1) + "/" + std::to_string(stages_.size()) + "] " + name + " " +
           what;
  }

  // Status as of a program.
  int RunStage(size_t i) {
    const MontageStage& stage = stages_[i];
    if (!stage.is_needed(request_)) {
      console_.Finish(i, Line(i, "not needed"));
      return 0;
    }
    const fs::path program = FindProgram(options_.programs, stage.name);
    StageRecord now = CurrentState(stage, program);
    const std::optional<StageRecord> then =
        ReadStageRecord(RecordsOf(stage, request_), RecordNameOf(stage, request_));
    const std::vector<std::string> reasons =
        then ? WhatChanged(*then, now) : std::vector<std::string>{"it has not run yet"};
    if (reasons.empty()) {
      outcomes_[i].warnings = then->warnings;
      console_.Finish(i, Line(i, "up to date"));
      return Judge(i);
    }
    if (options_.explains) console_.Print(Line(i, "runs: " + ReasonText(reasons)));
    RequireSameVersion(program);
    const int status = RunProgramOf(i, program, then ? then->seconds : 0, &now);
    return status == 0 ? Judge(i) : status;
  }

  StageRecord CurrentState(const MontageStage& stage, const fs::path& program) {
    const auto options = request_.options.find(stage.name);
    return {
        .version = INSITU_VERSION,
        .program_hash = hashes_.Hash(program),
        .options = options == request_.options.end() ? std::vector<std::string>() : options->second,
        .inputs = StatesOf(request_.site, stage.inputs(request_), &hashes_),
        .outputs = StatesOf(request_.site, stage.outputs(request_), &hashes_)};
  }

  int RunProgramOf(size_t i, const fs::path& program, double last_seconds, StageRecord* record) {
    const MontageStage& stage = stages_[i];
    std::vector<std::string> command = {program.string(), request_.site.root.string()};
    command.insert(command.end(), record->options.begin(), record->options.end());
    const std::string expected =
        last_seconds < 2 ? "…" : "… (" + DurationText(last_seconds) + " last time)";
    console_.SetRunning(i, Line(i, expected));
    RemoveStageRecord(RecordsOf(stage, request_), RecordNameOf(stage, request_));
    const auto start = std::chrono::steady_clock::now();
    const StageRun run = RunStageProgram(
        command, StageLog(RecordsOf(stage, request_), RecordNameOf(stage, request_)),
        [&](const std::string& progress) { console_.SetRunning(i, Line(i, progress)); },
        [&](const std::string& line) { console_.Error(line); });
    if (run.status != 0) {
      console_.Finish(i, "");
      return StatusOf(i, run.status);
    }
    record->seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    record->warnings = outcomes_[i].warnings = run.warnings;
    outcomes_[i].ran = true;
    KeepRecord(stage, record);
    console_.Finish(i, Line(i, Number("%.1f s", record->seconds)));
    return 0;
  }

  // An input that changed while the program ran was perhaps not read as it is now.
  void KeepRecord(const MontageStage& stage, StageRecord* record) {
    const FileStates inputs = StatesOf(request_.site, stage.inputs(request_), &hashes_);
    if (inputs != record->inputs) {
      console_.Error("warning: what insitu-" + stage.name +
                     " reads was changed while it ran; it runs again the next time");
      return;
    }
    record->outputs = StatesOf(request_.site, stage.outputs(request_), &hashes_);
    std::erase_if(record->outputs, [](const auto& file) { return file.second.empty(); });
    WriteStageRecord(RecordsOf(stage, request_), RecordNameOf(stage, request_), *record);
  }

  int StatusOf(size_t i, int status) {
    if (ReceivedSignal()) return 128 + *ReceivedSignal();
    if (status <= 2) return status;  // it has said why
    const std::string how = status > 128 ? "was ended by signal " + std::to_string(status - 128)
                                         : "ended with status " + std::to_string(status);
    console_.Error(
        "insitu-" + stages_[i].name + " " + how + "; what it printed is in " +
        StageLog(RecordsOf(stages_[i], request_), RecordNameOf(stages_[i], request_)).string());
    return 1;
  }

  // 1: a verdict of fail ends the run.
  int Judge(size_t i) {
    JudgeReports(stages_[i].reports(request_), &outcomes_[i]);
    if (outcomes_[i].verdict != "fail" || options_.is_despite_fail) return 0;
    console_.Error("insitu-" + stages_[i].name + ": the verdict is fail, see " +
                   outcomes_[i].report.string() +
                   "; do what it says, or go on all the same with --despite-fail");
    return 1;
  }

  const MontageRequest& request_;
  const RunOptions& options_;
  const std::vector<MontageStage>& stages_;
  std::vector<State> states_;
  std::vector<StageOutcome> outcomes_;
  FileHashes hashes_;
  Console console_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr failure_;
  int status_ = 0;
};

}  // namespace

void RunOptions::Check() const {
  if (jobs < 1) throw InputError("--jobs", std::to_string(jobs) + ", expected 1 or more");
  if (first > last) throw InputError("--from", "comes after --to, expected a stage before it");
}

std::string RunSummary::BriefReport() const {
  std::string text;
  for (const StageOutcome& outcome : outcomes) {
    std::vector<std::string> lines;
    if (outcome.verdict) {
      lines.push_back("verdict " + *outcome.verdict +
                      (*outcome.verdict == "pass" ? "" : ", see " + outcome.report.string()));
    }
    for (const std::string& warning : outcome.warnings) lines.push_back("warning: " + warning);
    std::string name = outcome.stage;
    name.resize(16, ' ');
    for (size_t i = 0; i < lines.size(); ++i) {
      text += (i == 0 ? name : std::string(16, ' ')) + " " + lines[i] + "\n";
    }
  }
  return text;
}

RunSummary RunStages(const MontageRequest& request, const RunOptions& options) {
  options.Check();
  return Run(request, options).RunAll();
}

}  // namespace insitu
