// SPDX-License-Identifier: GPL-3.0-or-later
// The program that web-ifc is run by.
#pragma once

namespace insitu {

extern const char kIfcScript[];  // JavaScript, for Node.js

}  // namespace insitu
