// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/stage_program.h"

#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "calibration/files/error.h"
#include "calibration/program/child_process.h"
#include "calibration/program/program.h"
#include "renderer/commands/commands.h"
#include "renderer/stages/montage_stages.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWarning = "warning: ";

// What a program prints with one option; nullopt: it failed.
std::optional<std::vector<std::string>> LinesOf(const fs::path& program, const char* option) {
  std::vector<std::string> lines;
  const int status = RunChild({.command = {program.string(), option},
                               .environment = {},
                               .on_output = [&](const auto& line) { lines.push_back(line); },
                               .on_error = [](const auto&) {}});
  return status == 0 ? std::optional(lines) : std::nullopt;
}

// --reconstruct.plane-sigma=0.01
struct StageOption {
  std::string stage, name;
  std::optional<std::string> value;
};

// nullopt: the argument is no option of a stage.
std::optional<StageOption> ParseStageOption(const std::string& argument) {
  if (!argument.starts_with("--")) return std::nullopt;
  const size_t equals = argument.find('=');
  const size_t dot = argument.find('.');
  if (dot == std::string::npos || dot > equals) return std::nullopt;
  StageOption option = {argument.substr(2, dot - 2), "--" + argument.substr(dot + 1), {}};
  if (equals != std::string::npos) {
    option.name = "--" + argument.substr(dot + 1, equals - dot - 1);
    option.value = argument.substr(equals + 1);
  }
  return option;
}

// Name of each option of a program, and whether it takes a value.
using ProgramOptions = std::map<std::string, bool>;

ProgramOptions OptionsOf(const fs::path& program) {
  const auto lines = LinesOf(program, kListOptions);
  if (!lines) throw InputError(program, "does not tell its options; install insitu again");
  ProgramOptions options;
  for (const std::string& line : *lines) {
    options[line.substr(0, line.find(' '))] = line.find(' ') != std::string::npos;
  }
  return options;
}

bool TakesValue(const std::string& argument, const StageOption& option, const fs::path& program) {
  const ProgramOptions known = OptionsOf(program);
  const auto found = known.find(option.name);
  if (found != known.end()) return found->second;
  std::string names;
  for (const auto& [name, takes_value] : known) names += " " + name;
  throw InputError(argument,
                   "insitu-" + option.stage + " has no such option, expected one of" + names);
}

}  // namespace

void RequireSameVersion(const fs::path& program) {
  const std::string expected = program.filename().string() + " " INSITU_VERSION;
  const auto lines = LinesOf(program, "--version");
  const std::string version = lines && lines->size() == 1 ? lines->front() : "of no known version";
  if (version == expected) return;
  throw InputError(program, "is " + version + ", expected " + expected +
                                "; install all of insitu anew, its programs belong together");
}

std::map<std::string, std::vector<std::string>> TakeStageOptions(
    const fs::path& programs, std::vector<std::string>* arguments) {
  std::map<std::string, std::vector<std::string>> options;
  std::vector<std::string> rest;
  for (size_t i = 0; i < arguments->size(); ++i) {
    const std::string& argument = (*arguments)[i];
    std::optional<StageOption> option = ParseStageOption(argument);
    if (!option) {
      rest.push_back(argument);
      continue;
    }
    StageNamed(option->stage);
    const bool takes_value = TakesValue(argument, *option, FindProgram(programs, option->stage));
    if (takes_value && !option->value) {
      if (i + 1 == arguments->size()) throw InputError(argument, "expected a value after it");
      option->value = (*arguments)[++i];
    }
    if (!takes_value && option->value) throw InputError(argument, "takes no value");
    options[option->stage].push_back(option->name + (takes_value ? "=" + *option->value : ""));
  }
  *arguments = rest;
  return options;
}

StageRun RunStageProgram(const std::vector<std::string>& command, const fs::path& log,
                         const std::function<void(const std::string&)>& on_progress,
                         const std::function<void(const std::string&)>& on_error) {
  StageRun run;
  fs::create_directories(log.parent_path());
  std::ofstream file(log);
  const auto keep = [&](const std::string& line) {
    file << line << "\n";
    if (line.starts_with(kWarning)) run.warnings.push_back(line.substr(kWarning.size()));
    return line.starts_with(kWarning);
  };
  run.status = RunChild({.command = command,
                         .environment = {std::string(kProgressVariable) + "=1"},
                         .on_output = keep,
                         .on_error = [&](const std::string& line) {
                           if (line.starts_with(kProgressPrefix)) {
                             on_progress(line.substr(std::string_view(kProgressPrefix).size()));
                           } else if (!keep(line)) {
                             on_error(line);
                           }
                         }});
  return run;
}

}  // namespace insitu
