// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <optional>
#include <string>

#include "calibration/files/whole_file.h"
#include "calibration/program/child_process.h"
#include "calibration/program/program.h"
#include "calibration/program/site_lock.h"
#include "renderer/batch/run_batch.h"
#include "renderer/commands/commands.h"

namespace insitu {
namespace {

const std::map<std::string, BatchEngine> kEngines = {{"local", BatchEngine::kLocal},
                                                     {"slurm", BatchEngine::kSlurm},
                                                     {"parallel", BatchEngine::kParallel},
                                                     {"openjd", BatchEngine::kOpenJd}};

struct BatchCommand {
  std::filesystem::path plan;
  BatchOptions options;
  std::string engine = "local";
  std::optional<int> job;
  bool only_sheet = false;
};

void AddOptions(ProgramOptions* program, BatchCommand* command) {
  program->Value("PLAN", &command->plan, "what to make, a JSON file",
                 {.is_required = true, .check = OptionCheck::kFile});
  program->Value("--engine", &command->engine, "who does the jobs",
                 {.one_of = {"local", "slurm", "parallel", "openjd"},
                  .text = "local|slurm|parallel|openjd [local]"});
  program->Value("--jobs", &command->options.jobs,
                 "at a time; 0: one here, elsewhere as the engine likes",
                 {.shows_default = true, .check = OptionCheck::kNonNegative});
  program->Value("--threads", &command->options.threads,
                 "of a job; 0: all cores, shared among the jobs at a time",
                 {.shows_default = true, .check = OptionCheck::kNonNegative});
  program->Flag("--explain", &command->options.explains, "say why a job runs");
  program->Value("--job", &command->job,
                 "do this one job, counted from 0, as its line of jobs.jsonl says: for engines",
                 {.check = OptionCheck::kNonNegative});
  program->Flag("--sheet", &command->only_sheet, "only write the contact sheet of what is there");
  program->Footer(
      "PLAN.json: {\"site\": \"FOLDER\", \"views\": [\"IMG_1\"], \"variants\": [\"building\", "
      "\"tower\"],\n"
      "\"hours\": [\"measured\", \"16:30\", {\"azimuth_deg\": 180, \"elevation_deg\": 30}],\n"
      "\"qualities\": [\"draft\", \"final\"], \"options\": [\"--grain\"]}; what is missing is "
      "every\n"
      "photograph, building/, measured, final. The light of another hour is a simulation, and the\n"
      "pictures say so. The site's stages up to light must have run (insitu montage SITE --to "
      "light).\n"
      "Jobs whose results hold are not done again; one that was stopped goes on where it was.\n"
      "Writes work/batch/PLAN/jobs.jsonl, montages/ and the page montages/PLAN.sheet.html.\n"
      "Example: insitu batch evening.json --engine slurm --threads 4");
}

void Batch(BatchCommand* command, const std::string& line, int* status) {
  const BatchPlan plan = ReadBatchPlan(command->plan);
  command->options.engine = kEngines.at(command->engine);
  ForwardSignalsToChildren();
  if (command->job) {
    *status = RunBatchJob(plan, *command->job, command->options);
    return;
  }
  if (command->only_sheet) return ShowBatch(plan, command->options);
  const SiteLock lock(plan.site, line);
  for (const auto& folder : {plan.site.root / "work", plan.site.root / "montages"}) {
    RemoveLeftovers(folder);
  }
  *status = RunBatch(plan, command->options);
}

int RunBatchProgram(int argc, char** argv) {
  ProgramOptions program(
      "Renders a plan of views, variants, hours and qualities, here or by another engine, and goes "
      "on with what an earlier run left.",
      "insitu-batch");
  BatchCommand command;
  command.options.programs = OwnFolder();
  AddOptions(&program, &command);
  int status = 0;
  const int own =
      RunProgram(program, argc, argv, [&] { Batch(&command, program.CommandLine(), &status); });
  return own != 0 ? own : status;
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunBatchProgram(argc, argv); }
