// SPDX-License-Identifier: GPL-3.0-or-later
// A server runs until a signal ends it.
#pragma once

#include <signal.h>

namespace insitu {

// SIGINT, SIGTERM and SIGHUP are blocked in this thread and all that it starts from now on.
class EndSignals {
 public:
  EndSignals();
  void Wait() const;  // for the first one

 private:
  sigset_t signals_ = {};
};

}  // namespace insitu
