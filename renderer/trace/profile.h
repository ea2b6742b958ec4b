// SPDX-License-Identifier: GPL-3.0-or-later
// Where the time goes: a statistical profile by phase, for scripts/bench.
#pragma once

#include <string>

namespace insitu {

enum class Phase { kShading, kEmbree, kFiles };

// Marks the calling thread as being in `phase` until the scope ends. Costs two stores.
class PhaseScope {
 public:
  explicit PhaseScope(Phase phase);
  ~PhaseScope();
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  Phase outer_;
};

// Interrupts the process every 2 ms of CPU time and counts the phase of the thread that runs.
// At most one at a time.
class Profile {
 public:
  Profile();
  ~Profile();
  Profile(const Profile&) = delete;
  Profile& operator=(const Profile&) = delete;

  std::string Report() const;  // one line a phase: its share of the CPU time in percent
};

}  // namespace insitu
