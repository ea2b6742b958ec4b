// SPDX-License-Identifier: GPL-3.0-or-later
// The files of view/page, and those of prepare/page that it shares, as the server gives them out.
#pragma once

#include <map>
#include <string>

#include "calibration/web/loopback_server_options.h"

namespace insitu {

// By path: "/", "/view.css", "/view/page/NAME.js", "/prepare/page/NAME.js".
std::map<std::string, PublicResource> ViewPage();

}  // namespace insitu
