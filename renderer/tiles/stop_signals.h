// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C as a wish: what is under way ends in good order.
#pragma once

namespace insitu {

// From now on the first SIGINT, SIGTERM or SIGHUP is only noted, with a line on standard error; a
// second one ends the process as always.
void NoteStopSignals();

bool IsStopSignalled();

}  // namespace insitu
