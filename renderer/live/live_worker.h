// SPDX-License-Identifier: GPL-3.0-or-later
// From the survey's files to what the page is told of them: first the adjustment, then what follows
// from it.
#pragma once

#include <json/value.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "calibration/program/site.h"
#include "renderer/live/live_appearance.h"
#include "renderer/live/live_solution.h"

namespace insitu {

// The newest results.
struct LiveState {
  int serial = 0;     // of the adjustment: each has one more
  LiveResult result;  // its message holds type and revision
  LiveAppearance appearance;
  std::vector<Sentence> file_faults;  // files that took no part

  // False: what appears is still that of an earlier adjustment.
  bool is_lit() const { return appearance.serial == serial; }
};

// Not safe for several threads at once.
class LiveWorker {
 public:
  explicit LiveWorker(SitePaths site);

  // Lenses may be others now: a stage has run.
  void ForgetStages();

  // What the files say as they stand. Throws nothing for their content. `found` as of SolveLive,
  // with the serial that the state will have.
  LiveState Adjust(
      int revision,
      const std::function<void(int serial, const std::optional<SceneGeometry>&)>& found);

 private:
  SitePaths site_;
  std::vector<LivePhoto> photos_;
  bool has_lenses_ = false;
  int serial_ = 0;
  std::map<std::string, Rigid3> poses_;
};

}  // namespace insitu
