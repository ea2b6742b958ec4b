// SPDX-License-Identifier: GPL-3.0-or-later
// A site that is being measured: what its page asks for, and what it is told unasked. Operations
// are confirmed at once; a thread then writes the survey, adjusts what is determined, measures the
// light and tells the page.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "calibration/program/site.h"
#include "renderer/live/live_worker.h"

namespace insitu {

class PrepareSession {
 public:
  // `send` receives messages to all windows, `warn` in English what must not stay unseen without
  // one: what is not saved, faults of files, photos that are left out for them; from any thread.
  // Throws InputError: no photographs, another server has the site, its journal cannot be written.
  PrepareSession(const SitePaths& site, std::function<void(std::string)> send,
                 std::function<void(const std::string&)> warn);
  ~PrepareSession();

  // Each from any thread.
  Json::Value Site();  // all that a page begins with, but the photographs
  // The first message to a window: how much has been told, so that it asks again for what it missed
  // since it asked for the site.
  Json::Value Hello() const;
  struct Answer {
    int status = 200;
    Json::Value body;
  };
  // 200 with the revision; 400: refused; 409 with conflicts; 507: it cannot be kept, the disk is
  // full.
  Answer Apply(const Json::Value& operation);
  Answer Undo(const std::string& id);
  Answer Redo(const std::string& id);

  // The marks of a point [px], by photo, but those that are switched off.
  std::map<std::string, Eigen::Vector2d> MarksOf(const std::string& point) const;

  // Members for site.json; those that it has already are left alone. Undo shows the label. Answers
  // as Apply.
  Answer TakeSite(const Json::Value& members, const std::string& label);

  // A row of a colleague's copy that differed: which version stands has been chosen. All windows
  // are told.
  void Decided(const Json::Value& conflict);

  // The newest results.
  std::shared_ptr<const LiveState> live() const;

  // What a stage may have changed: lenses, the building.
  void Reload();

  // Ends when the survey is written.
  void Stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace insitu
