// SPDX-License-Identifier: GPL-3.0-or-later
// `insitu NAME ...` runs the program insitu-NAME that stands beside it.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "renderer/commands/commands.h"

namespace insitu {
namespace {

void PrintCommand(const Command& command) {
  std::string name = command.name;
  name.resize(15, ' ');
  std::cout << "  " << name << command.summary << "\n";
}

void PrintHelp() {
  std::cout << "Puts a planned building into photographs of its site so that the picture can be "
               "checked.\nUsage: insitu COMMAND SITE [OPTIONS]; insitu COMMAND --help tells more.\n"
               "\nThe stages in their order, each on a site folder:\n";
  for (const Command& command : StageCommands()) PrintCommand(command);
  std::cout << "\nAnd besides:\n";
  for (const Command& command : OtherCommands()) PrintCommand(command);
  std::cout << "\nExample: insitu montage sites/gallery\n";
}

std::vector<std::string> NamesOfCommands() {
  std::vector<std::string> names;
  for (const Command& command : StageCommands()) names.push_back(command.name);
  for (const Command& command : OtherCommands()) names.push_back(command.name);
  return names;
}

void BecomeCommand(const std::string& name, char** argv) {
  const std::vector<std::string> names = NamesOfCommands();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string list;
    for (const std::string& one : names) list += (list.empty() ? "" : ", ") + one;
    throw InputError("insitu " + name, "no such command, expected one of " + list);
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
