// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/program/child_process.h"
#include "calibration/program/program.h"
#include "calibration/program/site_lock.h"
#include "renderer/commands/commands.h"
#include "renderer/stages/run_stages.h"
#include "renderer/stages/stage_program.h"

namespace insitu {
namespace {

struct MontageCommand {
  MontageRequest request;
  RunOptions options;
  std::string from, to, frame, quality, avr;
  bool no_building = false, self_calibrate = false, hard_planes = false, is_paper = false;
  std::optional<int> bounces;
};

void AddOptions(ProgramOptions* program, MontageCommand* command) {
  program->Site(&command->request.site);
  program->Value("--variant", &command->request.site.variant,
                 "the design in variants/VARIANT instead of building/; to montages/VARIANT");
  program->Flag("--no-building", &command->no_building, "render the empty site", "--variant");
  program->Value("--frame", &command->frame, "pixel grid of the montages: photo or pinhole",
                 {.one_of = {"photo", "pinhole"}});
  program->Value("--quality", &command->quality,
                 "of the montages: fast, draft, or final, which is the default",
                 {.one_of = {"fast", "draft", "final"}});
  program->Value("--avr", &command->avr,
                 "of the building 0 its silhouette, 1 its outline, 2 its form, to <photo>~avrN; 3 "
                 "its materials, which is the default",
                 {.one_of = {"0", "1", "2", "3"}});
  program->Flag("--tie-points", &command->request.with_tie_points,
                "search tie points also where every photograph shows enough control");
  program->Flag("--self-calibrate", &command->self_calibrate, "adjust the lens with the site");
  program->Flag("--hard-planes", &command->hard_planes, "hold walls flat");
  program->Value("--bounces", &command->bounces,
                 "bounces of light among surfaces; 0: sun and sky alone; without: all",
                 {.check = OptionCheck::kNonNegative});
  program->Flag("--paper", &command->is_paper,
                "light and rendering to the letter of the paper, as --light.paper and "
                "--render.paper",
                "--bounces");
  program->Value("--from", &command->from, "leave the stages before this one as they are");
  program->Value("--to", &command->to, "leave the stages after this one as they are");
  program->Value("--jobs", &command->options.jobs, "stages at a time",
                 {.shows_default = true, .check = OptionCheck::kPositive});
  program->Flag("--explain", &command->options.explains, "say why a stage runs");
  program->Flag("--despite-fail", &command->options.is_despite_fail,
                "go on though a verdict is fail");
  program->Footer(
      "--STAGE.OPTION [VALUE] hands an option to a stage: --reconstruct.plane-sigma 0.01;\n"
      "insitu STAGE --help tells them. Stages run whose inputs, options or program changed since\n"
      "their results were made. What a stage prints is in work/stages/STAGE.log.\n"
      "Example:\n  insitu montage sites/gallery --light.sky-facets 8 --explain");
}

// What our own options mean for the stages.
void Complete(MontageCommand* command) {
  MontageRequest& request = command->request;
  request.with_building = !command->no_building;
  RequireVariant(request.site);
  if (!request.site.variant.empty()) {
    for (const char* stage : {"convert", "render"}) {
      request.options[stage].push_back("--variant=" + request.site.variant);
    }
  }
  if (command->no_building) request.options["render"].push_back("--no-building");
  if (!command->frame.empty()) request.options["render"].push_back("--frame=" + command->frame);
  if (!command->quality.empty()) {
    request.options["render"].push_back("--quality=" + command->quality);
  }
  if (!command->avr.empty() && command->avr != "3") {
    request.options["render"].push_back("--avr=" + command->avr);
    request.site.beside = "avr" + command->avr;
  }
  for (const char* stage : {"light", "render"}) {
    if (command->is_paper) request.options[stage].push_back("--paper");
    if (!command->bounces) continue;
    request.options[stage].push_back("--bounces=" + std::to_string(*command->bounces));
  }
  if (command->self_calibrate) request.options["reconstruct"].push_back("--self-calibrate");
  if (command->hard_planes) request.options["reconstruct"].push_back("--hard-planes");
  if (!command->from.empty()) command->options.first = StageNamed(command->from);
  if (!command->to.empty()) command->options.last = StageNamed(command->to);
  command->options.Check();
}

void Montage(MontageCommand* command, const std::string& line, int* status) {
  Complete(command);
  const SitePaths& site = command->request.site;
  const SiteLock lock(site, line);
  ForwardSignalsToChildren();
  for (const auto& folder : {site.root / "work", site.montages()}) RemoveLeftovers(folder);
  const RunSummary summary = RunStages(command->request, command->options);
  for (const auto& folder : {site.root / "work", site.montages()}) RemoveLeftovers(folder);
  *status = summary.status;
  std::cout << summary.BriefReport();
  if (summary.status != 0) return;
  std::cout << "montages         " << site.montages().string() << "\n"
            << "residual report  " << site.residual_page().string() << "\n";
}

int RunMontage(int argc, char** argv) {
  ProgramOptions program(
      "From survey to picture: runs the stages of a site whose results do not hold any "
      "more, and leaves the montages in SITE/montages.",
      "insitu-montage");
  MontageCommand command;
  command.options.programs = OwnFolder();
  command.options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  AddOptions(&program, &command);
  std::vector<std::string> arguments(argv, argv + argc);
  int status = StatusOf(program.name(), [&] {
    command.request.options = TakeStageOptions(command.options.programs, &arguments);
  });
  if (status != 0) return status;
  std::vector<char*> rest;
  for (std::string& argument : arguments) rest.push_back(argument.data());
  const int own = RunProgram(program, static_cast<int>(rest.size()), rest.data(),
                             [&] { Montage(&command, program.CommandLine(), &status); });
  return own != 0 ? own : status;
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunMontage(argc, argv); }
