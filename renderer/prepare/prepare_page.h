// SPDX-License-Identifier: GPL-3.0-or-later
// The files of prepare/page as the server gives them out.
#pragma once

#include <map>
#include <string>

#include "calibration/web/loopback_server.h"

namespace insitu {

// By path: "/", "/page.css", "/page/NAME.js".
std::map<std::string, PublicResource> PreparePage();

}  // namespace insitu
