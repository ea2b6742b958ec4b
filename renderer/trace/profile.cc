// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/profile.h"

#include <sys/time.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>

#include "calibration/files/wording.h"

namespace insitu {
namespace {

constexpr std::array<const char*, 3> kNames = {"shading", "embree", "files"};
thread_local volatile int current_phase = static_cast<int>(Phase::kShading);
std::array<std::atomic<long>, kNames.size()> ticks;

void CountTick(int) { ticks[current_phase].fetch_add(1, std::memory_order_relaxed); }

void SetTimer(int microseconds) {
  const itimerval timer = {{0, microseconds}, {0, microseconds}};
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

PhaseScope::PhaseScope(Phase phase) : outer_(static_cast<Phase>(current_phase)) {
  current_phase = static_cast<int>(phase);
}

PhaseScope::~PhaseScope() { current_phase = static_cast<int>(outer_); }

Profile::Profile() {
  for (auto& tick : ticks) tick = 0;
  struct sigaction action = {};
  action.sa_handler = CountTick;
  action.sa_flags = SA_RESTART;
  sigaction(SIGPROF, &action, nullptr);
  SetTimer(2000);
}

Profile::~Profile() { SetTimer(0); }

std::string Profile::Report() const {
  long total = 0;
  for (const auto& tick : ticks) total += tick;
  std::string report;
  for (size_t i = 0; i < kNames.size(); ++i) {
    report += Formatted("%-8s %5.1f %%\n", kNames[i], 100.0 * ticks[i] / std::max(total, 1L));
  }
  return report;
}

}  // namespace insitu
