// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs relit by the light that was measured last: made when asked for, by a thread that
// gives way to all others, and given up when the light is another one.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "renderer/live/live_worker.h"

namespace insitu {

class RelitPhotos {
 public:
  // `live` gives the newest results, from any thread.
  RelitPhotos(std::vector<std::filesystem::path> photos,
              std::function<std::shared_ptr<const LiveState>()> live);
  ~RelitPhotos();

  // From any thread; never waits. `light` is "none", as without the sun, or "sun", it alone.
  struct Answer {
    // 200: {photo, light, revision, exposure, share}; the picture is `exposure` times as bright as
    // the light says, so that it can be seen; `share` of its pixels is relit. 202: {revision}, ask
    // again, it is being made. 409: {error}, it cannot be made. 404: no such photograph or light.
    int status = 200;
    Json::Value body;
    std::shared_ptr<const std::string> jpeg;  // of 200: at most 800 px, grey where nothing is relit
  };
  Answer Ask(int photo, const std::string& light);

  void Stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace insitu
