// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of insitu: programs insitu-NAME that stand beside each other. Apart from all that
// they do, so that `insitu` itself starts in milliseconds: of libraries it needs a dozen, not 289.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace insitu {

struct Command {
  std::string name, summary;  // one line, for insitu --help
};

// The stages on a site folder, in the order in which insitu-montage runs them.
const std::vector<Command>& StageCommands();

const std::vector<Command>& OtherCommands();

// The folder of the program that is running.
std::filesystem::path OwnFolder();

// insitu-NAME in a folder. Throws InputError: it is not there, or cannot be run.
std::filesystem::path FindProgram(const std::filesystem::path& folder, const std::string& name);

}  // namespace insitu
