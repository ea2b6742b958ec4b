// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/stage_runs.h"

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "calibration/files/error_at.h"
#include "calibration/files/text_table.h"
#include "calibration/program/child_process.h"
#include "calibration/program/program.h"
#include "renderer/commands/commands.h"
#include "renderer/stages/montage_stages.h"

namespace insitu {
namespace {

constexpr char kMontage[] = "montage";

std::vector<std::string> CommandOf(const std::string& stage, const SitePaths& site,
                                   const std::vector<std::string>& options) {
  const auto program = FindProgram(OwnFolder(), stage);
  std::vector<std::string> command = {program.string(), site.root.string()};
  command.insert(command.end(), options.begin(), options.end());
  return command;
}

// "progress: middle 40 %, 12 s left" is 0.4; nullopt: it is not known how far.
std::optional<double> ShareOf(const std::string& progress) {
  const size_t percent = progress.find(" %");
  if (percent == std::string::npos || percent == 0) return std::nullopt;
  const size_t blank = progress.rfind(' ', percent - 1);
  const auto number =
      ParseNumber(std::string_view(progress).substr(blank + 1, percent - blank - 1));
  return number ? std::optional(*number / 100) : std::nullopt;
}

}  // namespace

StageRuns::StageRuns(SitePaths site, std::function<void(Json::Value)> tell)
    : site_(std::move(site)), tell_(std::move(tell)) {}

int StageRuns::Start(const std::string& stage, const std::vector<std::string>& options) {
  if (stage != kMontage) StageNamed(stage);
  const std::lock_guard lock(mutex_);
  if (is_running_) {
    throw ErrorAt({stage},
                  Sentence("stageBusy", "another stage is running: stop it or wait for its end"));
  }
  is_running_ = true;
  const int run = ++last_;
  thread_ =
      std::jthread([=, this](const std::stop_token& stop) { Run(run, stage, options, stop); });
  return run;
}

void StageRuns::Stop() { thread_.request_stop(); }

void StageRuns::End() {
  Stop();
  if (thread_.joinable()) thread_.join();
}

void StageRuns::Run(int run, const std::string& stage, const std::vector<std::string>& options,
                    const std::stop_token& stop) {
  const auto message = [&](const char* what, const Json::Value& value) {
    Json::Value json;
    json["type"] = "run";
    json["run"] = run;
    json["stage"] = stage;
    json[what] = value;
    tell_(json);
  };
  const auto tell_line = [&](const std::string& line) {
    if (!line.starts_with(kProgressPrefix)) return message("line", line);
    if (const auto share = ShareOf(line)) message("progress", *share);
  };
  int status = 1;
  try {
    status = RunChild({.command = CommandOf(stage, site_, options),
                       .environment = {std::string(kProgressVariable) + "=1"},
                       .on_output = tell_line,
                       .on_error = tell_line,
                       .stop = stop});
  } catch (const std::exception& error) {
    tell_line(error.what());
  }
  {
    const std::lock_guard lock(mutex_);
    is_running_ = false;
  }
  message("status", status);
}

}  // namespace insitu
