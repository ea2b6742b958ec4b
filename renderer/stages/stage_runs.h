// SPDX-License-Identifier: GPL-3.0-or-later
// Stages of the site run from the page: insitu-montage as a child process, one at a time.
#pragma once

#include <json/value.h>

#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

class StageRuns {
 public:
  // `tell` receives the messages `run`, from a thread of its own: {run, stage} with `line` or
  // `progress` (0..1), at the end with `status`.
  StageRuns(SitePaths site, std::function<void(Json::Value)> tell);
  ~StageRuns() { End(); }
  StageRuns(const StageRuns&) = delete;
  StageRuns& operator=(const StageRuns&) = delete;

  // "montage": every stage whose results do not hold any more; else that stage alone, whatever
  // holds. Its number. `options` are the program's. Throws InputError: no such stage, or one is
  // running.
  int Start(const std::string& stage, const std::vector<std::string>& options = {});

  void Stop();  // as Ctrl-C does; nothing if none runs
  void End();   // and waits for its end

 private:
  void Run(int run, const std::string& stage, const std::vector<std::string>& options,
           const std::stop_token& stop);

  SitePaths site_;
  std::function<void(Json::Value)> tell_;
  std::mutex mutex_;
  bool is_running_ = false;
  int last_ = 0;
  std::jthread thread_;
};

}  // namespace insitu
