// SPDX-License-Identifier: GPL-3.0-or-later
// What every insitu program does alike: --help with an example, --version, exit status, progress.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "calibration/program/program_options.h"

namespace insitu {

// Parses the command line and calls `run`. Status 0; 2 for bad input (InputError, wrong
// options), 1 for any other failure, with one line on stderr.
int RunProgram(ProgramOptions& program, int argc, char** argv, const std::function<void()>& run);

// The same for what a program does before its command line is parsed.
int StatusOf(const std::string& program, const std::function<void()>& run);

// "12 s", "3 min", "2 h".
std::string DurationText(double seconds);

// insitu-montage asks its stages for their progress by this variable and knows it by this
// beginning.
inline constexpr char kProgressVariable[] = "INSITU_PROGRESS";
inline constexpr char kProgressPrefix[] = "progress: ";

// A progress line with the time left on stderr, only on a terminal and only for work that lasts
// over two seconds. Under insitu-montage, which sets INSITU_PROGRESS, a line "progress: TEXT" each.
// Thread-safe.
class Progress {
 public:
  // `steps` of about equal length; 0: unknown, only `what` is shown.
  Progress(std::string what, int steps);
  ~Progress();
  void Step();
  void Show();                  // within a step that takes long
  void Next(std::string what);  // what is done from now on

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insitu
