// SPDX-License-Identifier: GPL-3.0-or-later
// The viewing page on this machine, whatever it shows.
#pragma once

#include <json/value.h>

#include <functional>
#include <memory>
#include <string>

#include "calibration/web/web_request.h"

namespace insitu {

struct ViewOptions {
  int port = 0;  // 0: any that is free
  bool opens_browser = true;
};

// What answers the page.
class PageService {
 public:
  virtual ~PageService() = default;
  virtual WebResponse Answer(const WebRequest& request) = 0;  // from any thread
  virtual void Stop() = 0;                                    // when nothing is asked any more
};

WebResponse JsonAnswer(const Json::Value& json);

// Makes the service with what sends messages to all windows, serves until SIGINT, SIGTERM or SIGHUP
// ends it; `tell` receives the address with its token. Throws InputError: the port is taken, and
// what `make` throws.
void ServePage(
    const ViewOptions& options,
    const std::function<std::unique_ptr<PageService>(std::function<void(std::string)> send)>& make,
    const std::function<void(const std::string& url)>& tell);

}  // namespace insitu
