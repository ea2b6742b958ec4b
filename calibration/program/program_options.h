// SPDX-License-Identifier: GPL-3.0-or-later
// A program's options, read by CLI11 [https://github.com/CLIUtils/CLI11], which is compiled here
// once: a header of its size takes ten seconds wherever it is included.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

// Where an option's value goes. What it holds before is the default.
using OptionValue =
    std::variant<int*, double*, std::string*, std::filesystem::path*, std::optional<int>*,
                 std::optional<double>*, std::optional<std::string>*, std::vector<std::string>*,
                 std::vector<std::filesystem::path>*, std::set<std::string>*>;

// Each option of a program on a line, "--frame VALUE" or "--no-building", is what this option
// prints, for programs that hand options on.
inline constexpr char kListOptions[] = "--list-options";

enum class OptionCheck { kNone, kPositive, kNonNegative, kFile, kFolder, kPath };

struct OptionRules {
  bool is_required = false;
  bool shows_default = false;  // in --help
  bool takes_all = false;      // of several times given each counts
  OptionCheck check = OptionCheck::kNone;
  std::optional<std::pair<double, double>> range = {};        // both ends included
  std::vector<std::string> one_of = {};                       // the values there are
  std::function<std::string(const std::string&)> fault = {};  // what is wrong, "" where nothing
  std::string text = {};  // instead of type and checks in --help
};

class ProgramOptions {
 public:
  // `name` as insitu-render.
  ProgramOptions(const std::string& description, const std::string& name);
  ~ProgramOptions();
  ProgramOptions(ProgramOptions&&) noexcept;

  void Footer(const std::string& text);  // below the options in --help

  // The argument SITE, which every program on a site takes first: a folder that is there.
  void Site(SitePaths* site);

  // "--name" is an option, "NAME" an argument by its place. The flag "!--no-name" makes it false.
  // `excludes`: a flag or option that was added before, with which this one cannot be given.
  void Flag(const std::string& name, bool* value, const std::string& help,
            const std::string& excludes = "");
  void Value(const std::string& name, const OptionValue& value, const std::string& help,
             const OptionRules& rules = {});

  const std::string& name() const;

  // The command as given, to be repeated elsewhere: the program's name, its positional arguments by
  // their names, then the options that were set, of paths the last part only.
  std::string CommandLine() const;

  // Status with which the program ends at once: 0 after --help, --version and --list-options, 2 for
  // wrong options, told on stderr. nullopt: it goes on.
  std::optional<int> Parse(int argc, char** argv);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::string name_;
};

}  // namespace insitu
