// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/end_signals.h"

#include <initializer_list>

namespace insitu {

EndSignals::EndSignals() {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
}

void EndSignals::Wait() const {
  int signal = 0;
  sigwait(&signals_, &signal);
}

}  // namespace insitu
