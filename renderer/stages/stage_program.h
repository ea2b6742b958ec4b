// SPDX-License-Identifier: GPL-3.0-or-later
// The programs insitu-NAME of a folder, as insitu-montage runs them.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace insitu {

// Throws InputError: it is of another version than this program.
void RequireSameVersion(const std::filesystem::path& program);

// Takes `--STAGE.OPTION [VALUE]` and `--STAGE.OPTION=VALUE` out of a command line's arguments and
// returns them, `--OPTION=VALUE` or `--OPTION`, by stage. Which options a stage has and which of
// them take a value its program in `programs` tells. Throws InputError: no such stage or option, a
// value missing or not wanted.
std::map<std::string, std::vector<std::string>> TakeStageOptions(
    const std::filesystem::path& programs, std::vector<std::string>* arguments);

struct StageRun {
  int status = 0;
  std::vector<std::string> warnings;  // lines "warning: TEXT" on either of its streams
};

// Runs a program of ours. What it prints goes to `log`, its errors also to standard error;
// `on_progress` receives how far it is.
StageRun RunStageProgram(const std::vector<std::string>& command, const std::filesystem::path& log,
                         const std::function<void(const std::string&)>& on_progress,
                         const std::function<void(const std::string&)>& on_error);

}  // namespace insitu
