// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/program_options.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <string_view>

namespace insitu {
namespace {

CLI::Validator ValidatorOf(OptionCheck check) {
  switch (check) {
    case OptionCheck::kNone:
      return {};
    case OptionCheck::kPositive:
      return CLI::PositiveNumber;
    case OptionCheck::kNonNegative:
      return CLI::NonNegativeNumber;
    case OptionCheck::kFile:
      return CLI::ExistingFile;
    case OptionCheck::kFolder:
      return CLI::ExistingDirectory;
    case OptionCheck::kPath:
      return CLI::ExistingPath;
  }
  return {};
}

// The range as --help shows it: of whole numbers without a point.
CLI::Validator RangeOf(const std::pair<double, double>& range, const OptionValue& value) {
  if (std::holds_alternative<int*>(value)) {
    return CLI::Range(static_cast<int>(range.first), static_cast<int>(range.second));
  }
  return CLI::Range(range.first, range.second);
}

void Apply(const OptionRules& rules, const OptionValue& value, CLI::Option* option) {
  if (rules.is_required) option->required();
  if (rules.takes_all) option->take_all();
  if (rules.check != OptionCheck::kNone) option->check(ValidatorOf(rules.check));
  if (rules.range) option->check(RangeOf(*rules.range, value));
  if (!rules.one_of.empty()) {
    CLI::IsMember members(rules.one_of);
    option->check(rules.text.empty() ? members : members.description(""));
  }
  if (rules.fault) option->check(CLI::Validator(rules.fault, ""));
  if (rules.shows_default) option->capture_default_str();
  if (!rules.text.empty()) option->option_text(rules.text);
}

std::string OptionList(const CLI::App& app) {
  std::string list;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional() || option->get_lnames().empty()) continue;
    const bool is_flag = option->get_expected_max() == 0;
    list += "--" + option->get_lnames().front() + (is_flag ? "" : " VALUE") + "\n";
  }
  return list;
}

}  // namespace

struct ProgramOptions::Parser {
  Parser(const std::string& description, const std::string& name) : app(description, name) {}
  CLI::App app;
};

ProgramOptions::ProgramOptions(const std::string& description, const std::string& name)
    : parser_(std::make_unique<Parser>(description, name)), name_(name) {}

ProgramOptions::~ProgramOptions() = default;
ProgramOptions::ProgramOptions(ProgramOptions&&) noexcept = default;

void ProgramOptions::Footer(const std::string& text) { parser_->app.footer(text); }

void ProgramOptions::Site(SitePaths* site) {
  Value("SITE", &site->root, "site folder", {.is_required = true, .check = OptionCheck::kFolder});
}

void ProgramOptions::Flag(const std::string& name, bool* value, const std::string& help,
                          const std::string& excludes) {
  CLI::Option* const flag = parser_->app.add_flag(name, *value, help);
  if (!excludes.empty()) flag->excludes(excludes);
}

void ProgramOptions::Value(const std::string& name, const OptionValue& value,
                           const std::string& help, const OptionRules& rules) {
  std::visit([&](auto* held) { Apply(rules, value, parser_->app.add_option(name, *held, help)); },
             value);
}

const std::string& ProgramOptions::name() const { return name_; }

std::string ProgramOptions::CommandLine() const {
  std::string positional, options;
  for (const CLI::Option* option : parser_->app.get_options()) {
    if (option->get_positional()) {
      positional += " " + option->get_name();
      continue;
    }
    if (option->count() == 0) continue;
    options += " " + option->get_name();
    if (option->get_expected_max() == 0) continue;  // a flag
    for (const std::string& value : option->results()) {
      options += " " + std::filesystem::path(value).filename().string();
    }
  }
  return name_ + positional + options;
}

std::optional<int> ProgramOptions::Parse(int argc, char** argv) {
  constexpr int kBadOptions = 2;
  CLI::App& app = parser_->app;
  app.set_version_flag("--version", name_ + " " INSITU_VERSION);
  if (argc == 2 && std::string_view(argv[1]) == kListOptions) {
    std::cout << OptionList(app);
    return 0;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    std::cerr << name_ << ": " << error.what() << " (see --help)\n";
    return kBadOptions;
  }
  return std::nullopt;
}

}  // namespace insitu
