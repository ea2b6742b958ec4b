// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C as a wish: what is under way ends in good order.
#pragma once

namespace insitu {

// From now on the first SIGINT, SIGTERM and SIGHUP are only noted, with a line on standard error; a
// second one of a kind ends the process as always. Those that are ignored already stay so.
void NoteStopSignals();

bool IsStopSignalled();

}  // namespace insitu
