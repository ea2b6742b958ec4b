// SPDX-License-Identifier: GPL-3.0-or-later
// Runs another project's program (mrcal's, mrgingham) without a shell.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace insitu {

inline constexpr char kPython[] = "/usr/bin/python3";  // Debian's own, which has mrcal

struct ExternalProgram {
  std::vector<std::string> command;          // program (looked up in PATH) and its arguments
  std::string package;                       // the Debian package that holds it, for messages
  std::filesystem::path folder;              // to run in
  std::filesystem::path output;              // receives its standard output; may equal `log`
  std::filesystem::path log;                 // receives its standard error
  std::function<void()> while_running = {};  // called again and again, to show progress
};

// Runs to the end, with linear algebra on one thread so that results are the same everywhere.
// Throws InputError: the program is not installed (names the package), or it fails (names the log
// and repeats its last line).
void RunExternal(const ExternalProgram& program);

}  // namespace insitu
