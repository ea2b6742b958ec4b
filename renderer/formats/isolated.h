// SPDX-License-Identifier: GPL-3.0-or-later
// Work of a library that may break on bad input, done in a process of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "renderer/mesh/model.h"

namespace insitu {

struct IsolationLimits {
  int seconds = 600;          // of CPU time
  int64_t bytes = 3ll << 30;  // of address space beyond what this process has now

  void Check() const;  // throws CheckError that names the field that is wrong
};

struct IsolatedModel {
  std::optional<Model> model;
  std::string failure;  // what an exception said, or how the process ended; empty with a model
};

// Calls `read` in a forked process and brings its model back. A crash, an endless loop or an
// allocation beyond the limits there is a failure here.
IsolatedModel ReadIsolated(const std::function<Model()>& read, const IsolationLimits& limits = {});

}  // namespace insitu
