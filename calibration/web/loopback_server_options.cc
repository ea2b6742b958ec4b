// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/loopback_server_options.h"

#include "calibration/files/error.h"

namespace insitu {

void LoopbackServerOptions::Check() const {
  if (port < 0 || port > 65535) {
    throw InputError("port " + std::to_string(port), "expected 0 to 65535");
  }
  INSITU_CHECK(token.size() >= 32);
  INSITU_CHECK(threads > 0 && slow_threads > 0 && most_connections > 0);
}

}  // namespace insitu
