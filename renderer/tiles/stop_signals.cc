// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/stop_signals.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <string_view>

namespace insitu {
namespace {

constexpr std::array kStopSignals = {SIGINT, SIGTERM, SIGHUP};
std::atomic<bool> is_signalled = false;

void NoteSignal(int) {
  constexpr std::string_view kText =
      "stopping when the tiles at work are done; once more stops at once\n";
  is_signalled = true;
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kText.data(), kText.size());
}

}  // namespace

void NoteStopSignals() {
  struct sigaction action = {}, before = {};
  action.sa_handler = NoteSignal;
  action.sa_flags = SA_RESTART | SA_RESETHAND;
  sigemptyset(&action.sa_mask);
  for (const int signal : kStopSignals) {
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // as nohup wants it
  }
}

bool IsStopSignalled() { return is_signalled; }

}  // namespace insitu
