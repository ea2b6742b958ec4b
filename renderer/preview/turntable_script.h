// SPDX-License-Identifier: GPL-3.0-or-later
// The script of the page on which the building is turned.
#pragma once

namespace insitu {

extern const char kTurntableScript[];  // JavaScript, for the browser

}  // namespace insitu
