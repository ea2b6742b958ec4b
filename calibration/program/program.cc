// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/program.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <mutex>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr int kBadInput = 2;
constexpr int kFailure = 1;

}  // namespace

void AddSite(CLI::App* app, SitePaths* site) {
  app->add_option("SITE", site->root, "site folder")->required()->check(CLI::ExistingDirectory);
}

int RunProgram(CLI::App& app, int argc, char** argv, const std::function<void()>& run) {
  app.set_version_flag("--version", app.get_name() + " " INSITU_VERSION);
  try {
    app.parse(argc, argv);
    run();
    return 0;
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    std::cerr << app.get_name() << ": " << error.what() << " (see --help)\n";
    return kBadInput;
  } catch (const InputError& error) {
    std::cerr << error.what() << "\n";
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << error.what() << "\n";
    return kFailure;
  }
}

std::string CommandLine(const CLI::App& app) {
  std::string positional, options;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      positional += " " + option->get_name();
      continue;
    }
    if (option->count() == 0) continue;
    options += " " + option->get_name();
    if (option->get_expected_max() == 0) continue;  // a flag
    for (const std::string& value : option->results()) {
      options += " " + std::filesystem::path(value).filename().string();
    }
  }
  return app.get_name() + positional + options;
}

struct Progress::State {
  using Clock = std::chrono::steady_clock;
  std::mutex mutex;
  std::string what;
  int steps = 0;
  int done = 0;
  bool shown = false;
  const bool on_terminal = isatty(STDERR_FILENO) == 1;
  Clock::time_point next = Clock::now() + std::chrono::seconds(2);
};

Progress::Progress(std::string what, int steps) : state_(std::make_unique<State>()) {
  state_->what = std::move(what);
  state_->steps = std::max(steps, 1);
}

Progress::~Progress() {
  if (state_->shown) std::fputs("\r\033[K", stderr);  // the finished line is wiped
}

void Progress::Step() {
  const std::lock_guard lock(state_->mutex);
  ++state_->done;
  const auto now = State::Clock::now();
  if (!state_->on_terminal || now < state_->next) return;
  state_->next = now + std::chrono::milliseconds(100);
  state_->shown = true;
  std::fprintf(stderr, "\r%s %d %%", state_->what.c_str(), 100 * state_->done / state_->steps);
}

}  // namespace insitu
