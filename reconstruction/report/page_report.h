// SPDX-License-Identifier: GPL-3.0-or-later
// What of a report a browser can show.
#pragma once

#include <json/value.h>

namespace insitu {

// The report of a small network as it is; of a large one the photos and points that fit worst in
// full and of the rest the figures alone, numbers to six digits, and in "page_note" what is left
// out and where it stands.
Json::Value ForPage(Json::Value report);

}  // namespace insitu
