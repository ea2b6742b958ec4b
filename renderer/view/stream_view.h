// SPDX-License-Identifier: GPL-3.0-or-later
// `insitu view -`: the picture that comes out of a pipe, on the page, in the terminal, as a file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "renderer/tiles/tile_stream.h"

namespace insitu {

// A picture as a plain file of colours (PPM, binary), unfinished tiles hatched. Throws
// std::runtime_error: it cannot be written.
void WriteSnapshot(const std::filesystem::path& path, const StreamedPicture& streamed);

// The picture by colours of a terminal, two pixels a character, at most so many wide; unfinished
// tiles hatched. The last line tells how far it is.
std::string TerminalText(const StreamedPicture& streamed, int columns);

struct StreamViewOptions {
  std::filesystem::path snapshot;  // empty: none
  bool is_text = false;            // in the terminal
  int columns = 80;                // of the terminal
};

// Reads standard input to its end, at most a second behind what comes; `show` receives texts for
// the terminal. Throws InputError: it is no stream, or it ended before its picture did.
void ViewStream(const StreamViewOptions& options,
                const std::function<void(const std::string& text)>& show);

}  // namespace insitu
