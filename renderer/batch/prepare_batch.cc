// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/prepare_batch.h"

#include <iostream>
#include <map>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "calibration/program/warnings.h"
#include "radiometry/natural_environment.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "renderer/commands/commands.h"
#include "renderer/stages/montage_stages.h"
#include "renderer/stages/run_stages.h"

namespace insitu {
namespace {

int ConvertVariant(const SitePaths& site, const std::filesystem::path& programs) {
  MontageRequest request{.site = site};
  if (!site.variant.empty()) request.options["convert"] = {"--variant=" + site.variant};
  const size_t convert = StageNamed("convert");
  const RunSummary summary =
      RunStages(request, {.programs = programs, .first = convert, .last = convert});
  std::cout << summary.BriefReport();
  return summary.status;
}

std::vector<std::string> OptionsOf(const HourRequest& hour) {
  if (!hour.sun) return {"--hour=" + hour.time};
  return {Number("--azimuth=%.17g", hour.sun->azimuth / kDegree),
          Number("--elevation=%.17g", hour.sun->elevation / kDegree)};
}

RecordedRun RelightingOf(const SitePaths& site, const std::filesystem::path& programs,
                         const HourRequest& hour, const std::string& name) {
  return {.site = site,
          .name = "hours/" + name,
          .program = FindProgram(programs, "relight"),
          .options = OptionsOf(hour),
          .settings = {},
          .inputs = {site.environment(), site.input_image("").parent_path(), site.photos(),
                     site.description(), site.survey() / "directions.json",
                     site.survey() / "observations.csv"},
          .outputs = {site.hours() / name}};
}

int Relight(const RecordedRun& run, FileHashes* hashes) {
  const std::string hour = run.name.substr(run.name.find('/') + 1);
  if (WhyToRun(run, hashes).empty()) {
    std::cout << "hour " << hour << "  up to date\n";
    return 0;
  }
  const RunOutcome outcome = RunAndRecord(run, hashes, [](const auto&) {});
  if (outcome.status != 0) {
    std::cerr << outcome.message << "\n";
    return outcome.status;
  }
  std::cout << "hour " << hour << "  relit, " << Number("%.1f s", outcome.seconds) << "\n"
            << WarningLines(outcome.warnings) << std::flush;
  return 0;
}

// Of the plan's hours, "" the photographs'. All are checked before anything is done.
std::vector<std::string> NamesOfHours(const BatchPlan& plan) {
  const NaturalEnvironment measured = ReadEnvironment(plan.site);
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const PlannedHour& hour : plan.hours) {
    names.push_back(hour.is_measured() ? "" : SiteHourAt(plan.site, measured, hour.request).name);
    if (!known.insert(names.back()).second) {
      throw InputError(plan.file, "hours: " + names.back() + " is named twice, expected each once");
    }
  }
  return names;
}

}  // namespace

int PrepareBatch(const BatchPlan& plan, const std::filesystem::path& programs, FileHashes* hashes,
                 std::vector<BatchJob>* jobs) {
  const std::vector<std::string> hours = NamesOfHours(plan);
  for (const std::string& variant : plan.variants) {
    SitePaths site = plan.site;
    site.variant = variant;
    if (const int status = ConvertVariant(site, programs)) return status;
  }
  for (size_t i = 0; i < hours.size(); ++i) {
    if (hours[i].empty()) continue;
    const RecordedRun run = RelightingOf(plan.site, programs, plan.hours[i].request, hours[i]);
    if (const int status = Relight(run, hashes)) return status;
  }
  *jobs = JobsOf(plan, hours);
  std::map<std::pair<std::string, std::string>, FileStates> states;  // by variant and hour
  for (BatchJob& job : *jobs) {
    FileStates& inputs = states[{job.variant, job.hour}];
    if (inputs.empty()) {
      const RecordedRun run = RunOf(job, plan.site, programs, 1);
      inputs = StatesOf(run.site, run.inputs, hashes);
    }
    job.inputs = inputs;
  }
  return 0;
}

}  // namespace insitu
