// SPDX-License-Identifier: GPL-3.0-or-later
// What every insitu program does alike: --help with an example, --version, exit status, progress.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "calibration/program/site.h"

namespace insitu {

// The argument SITE, which every program on a site takes first: a folder that is there.
void AddSite(CLI::App* app, SitePaths* site);

// Parses the command line with `app` and calls `run`. Status 0; 2 for bad input (InputError, wrong
// options), 1 for any other failure, with one line on stderr.
int RunProgram(CLI::App& app, int argc, char** argv, const std::function<void()>& run);

// The command as given, to be repeated elsewhere: the program's name, its positional arguments by
// their names, then the options that were set, of paths the last part only.
std::string CommandLine(const CLI::App& app);

// A progress line on stderr, only on a terminal and only for work that lasts over two seconds.
// Thread-safe.
class Progress {
 public:
  Progress(std::string what, int steps);
  ~Progress();
  void Step();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insitu
