// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/program.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <optional>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr int kBadInput = 2;
constexpr int kFailure = 1;

}  // namespace

int RunProgram(ProgramOptions& program, int argc, char** argv, const std::function<void()>& run) {
  if (const std::optional<int> status = program.Parse(argc, argv)) return *status;
  return StatusOf(program.name(), run);
}

int StatusOf(const std::string& program, const std::function<void()>& run) {
  try {
    run();
    return 0;
  } catch (const InputError& error) {
    std::cerr << error.what() << "\n";
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << program << ": " << error.what() << "\n";
    return kFailure;
  }
}

std::string DurationText(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 100) return std::to_string(whole) + " s";
  if (whole < 6000) return std::to_string((whole + 30) / 60) + " min";
  return std::to_string((whole + 1800) / 3600) + " h";
}

struct Progress::State {
  using Clock = std::chrono::steady_clock;
  std::mutex mutex;
  std::string what;
  int steps = 0;
  int done = 0;
  bool shown = false;
  const bool in_montage = std::getenv(kProgressVariable) != nullptr;
  const bool on_terminal = isatty(STDERR_FILENO) == 1;
  const Clock::time_point start = Clock::now();
  Clock::time_point next = start + std::chrono::seconds(2);

  // "middle 40 %, 12 s left"
  std::string Text() const {
    if (steps == 0 || done == 0) return what;
    const double passed_s = std::chrono::duration<double>(Clock::now() - start).count();
    return what + " " + std::to_string(100 * done / steps) + " %, " +
           DurationText(passed_s / done * std::max(steps - done, 0)) + " left";
  }

  void Print() {
    const auto now = Clock::now();
    if (now < next) return;
    next = now + std::chrono::milliseconds(200);
    if (in_montage) {
      std::fprintf(stderr, "%s%s\n", kProgressPrefix, Text().c_str());
    } else if (on_terminal) {
      shown = true;
      std::fprintf(stderr, "\r\033[K%s", Text().c_str());
    }
  }
};

Progress::Progress(std::string what, int steps) : state_(std::make_unique<State>()) {
  state_->what = std::move(what);
  state_->steps = steps;
}

Progress::~Progress() {
  if (state_->shown) std::fputs("\r\033[K", stderr);  // the finished line is wiped
}

void Progress::Step() {
  const std::lock_guard lock(state_->mutex);
  ++state_->done;
  state_->Print();
}

void Progress::Show() {
  const std::lock_guard lock(state_->mutex);
  state_->Print();
}

void Progress::Next(std::string what) {
  const std::lock_guard lock(state_->mutex);
  state_->what = std::move(what);
  state_->Print();
}

}  // namespace insitu
