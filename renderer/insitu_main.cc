// SPDX-License-Identifier: GPL-3.0-or-later
// `insitu NAME ...` runs the program insitu-NAME that stands beside it.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "renderer/stages/montage_stages.h"
#include "renderer/stages/stage_program.h"

namespace insitu {
namespace {

using Command = std::pair<std::string, std::string>;  // name, summary

std::vector<Command> OtherCommands() {
  return {{"montage", "all of these, as far as their results do not hold any more"},
          {"prepare", "the measuring page: everything in survey/, measured on the photographs"},
          {"new", "a site's folder from photographs, with files that explain themselves"},
          {"matte", "what stands in front, from a rough drawing"},
          {"materials", "the library of materials and lamps: its list, swatches, proposals"},
          {"batch", "views, variants, hours and qualities by a plan, here or by Slurm"},
          {"relight", "photographs and daylight of another hour, simulated"},
          {"spectra", "the spectra that stand behind colours, in a page"},
          {"view", "the viewing page: before and after, pixel by pixel; renders as they run"},
          {"import-survey", "control points and marks of other programs for a site"},
          {"export-survey", "those of a site for other programs"},
          {"demo-site", "a site whose truth is known, to try all this on"}};
}

void PrintCommand(const Command& command) {
  std::string name = command.first;
  name.resize(15, ' ');
  std::cout << "  " << name << command.second << "\n";
}

void PrintHelp() {
  std::cout << "Puts a planned building into photographs of its site so that the picture can be "
               "checked.\nUsage: insitu COMMAND SITE [OPTIONS]; insitu COMMAND --help tells more.\n"
               "\nThe stages in their order, each on a site folder:\n";
  for (const MontageStage& stage : MontageStages()) PrintCommand({stage.name, stage.summary});
  std::cout << "\nAnd besides:\n";
  for (const Command& command : OtherCommands()) PrintCommand(command);
  std::cout << "\nExample: insitu montage sites/gallery\n";
}

std::string NamesOfCommands() {
  std::string names;
  for (const MontageStage& stage : MontageStages()) names += stage.name + ", ";
  for (const auto& [name, summary] : OtherCommands()) names += name + ", ";
  return names.substr(0, names.size() - 2);
}

bool IsCommand(const std::string& name) {
  for (const MontageStage& stage : MontageStages()) {
    if (stage.name == name) return true;
  }
  for (const auto& [other, summary] : OtherCommands()) {
    if (other == name) return true;
  }
  return false;
}

void BecomeCommand(const std::string& name, char** argv) {
  if (!IsCommand(name)) {
    throw InputError("insitu " + name, "no such command, expected one of " + NamesOfCommands());
  }
  const std::string program = FindProgram(OwnFolder(), name).string();
  std::string called = "insitu-" + name;
  argv[1] = called.data();
  execv(program.c_str(), argv + 1);
  throw InputError(program, std::string("cannot be run: ") + std::strerror(errno));
}

int RunInsitu(int argc, char** argv) {
  const std::string command = argc < 2 ? "--help" : argv[1];
  if (command == "--version") {
    std::cout << "insitu " INSITU_VERSION "\n";
  } else if (command == "--help" || command == "-h" || command == "help") {
    PrintHelp();
  } else {
    return StatusOf("insitu", [&] { BecomeCommand(command, argv); });
  }
  return 0;
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunInsitu(argc, argv); }
