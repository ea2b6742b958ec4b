// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/batch_jobs.h"

#include <json/writer.h>

#include <algorithm>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "renderer/commands/commands.h"
#include "renderer/stages/montage_stages.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAvr = "avr";

std::vector<std::string> OptionsFor(const BatchPlan& plan, const BatchJob& job) {
  std::vector<std::string> options = plan.options;
  options.push_back("--photo=" + job.view);
  if (!job.variant.empty()) options.push_back("--variant=" + job.variant);
  if (!job.hour.empty()) options.push_back("--hour=" + job.hour);
  if (job.quality.starts_with(kAvr)) {
    options.push_back("--avr=" + job.quality.substr(kAvr.size()));
  } else if (job.quality != "final") {
    options.push_back("--quality=" + job.quality);
    options.emplace_back("--beside");
  }
  return options;
}

Json::Value JobJson(const BatchJob& job, size_t number) {
  Json::Value json;
  json["job"] = Json::UInt64(number);
  json["name"] = job.Name();
  json["view"] = job.view;
  json["variant"] = job.variant;
  json["hour"] = job.hour;
  json["quality"] = job.quality;
  json["options"] = Json::Value(Json::arrayValue);
  for (const std::string& option : job.options) json["options"].append(option);
  json["inputs"] = Json::Value(Json::objectValue);
  for (const auto& [path, hash] : job.inputs) json["inputs"][path] = hash;
  return json;
}

BatchJob JobFrom(const Json::Value& json, const InputError& fault) {
  BatchJob job;
  for (const auto& [key, text] : {std::pair{"view", &job.view},
                                  {"variant", &job.variant},
                                  {"hour", &job.hour},
                                  {"quality", &job.quality}}) {
    if (!json.isObject() || !json[key].isString()) throw fault;
    *text = json[key].asString();
  }
  if (!json["options"].isArray() || !json["inputs"].isObject()) throw fault;
  for (const Json::Value& option : json["options"]) {
    if (!option.isString()) throw fault;
    job.options.push_back(option.asString());
  }
  for (const std::string& path : json["inputs"].getMemberNames()) {
    if (!json["inputs"][path].isString()) throw fault;
    job.inputs[path] = json["inputs"][path].asString();
  }
  return job;
}

fs::path OutcomeFile(const SitePaths& site, const BatchJob& job) {
  const SitePaths paths = job.PathsIn(site);
  return paths.stages() / "batch" / (paths.result_name(job.view) + ".outcome.json");
}

}  // namespace

std::string BatchJob::Name() const {
  const std::string result = PathsIn({}).result_name(view);
  return variant.empty() ? result : variant + "/" + result;
}

SitePaths BatchJob::PathsIn(const SitePaths& site) const {
  SitePaths paths = site;
  paths.variant = variant;
  paths.hour = hour;
  paths.beside = quality == "final" ? "" : quality;
  return paths;
}

std::vector<BatchJob> JobsOf(const BatchPlan& plan, const std::vector<std::string>& hours) {
  std::vector<BatchJob> jobs;
  for (const std::string& view : plan.views) {
    for (const std::string& variant : plan.variants) {
      for (const std::string& hour : hours) {
        for (const std::string& quality : plan.qualities) {
          BatchJob job{view, variant, hour, quality, {}, {}};
          job.options = OptionsFor(plan, job);
          jobs.push_back(std::move(job));
        }
      }
    }
  }
  return jobs;
}

RecordedRun RunOf(const BatchJob& job, const SitePaths& site, const fs::path& programs,
                  int threads) {
  const SitePaths paths = job.PathsIn(site);
  const MontageStage& stage = MontageStages()[StageNamed("render")];
  const MontageRequest request{.site = paths};
  RecordedRun run{.site = paths,
                  .name = "batch/" + paths.result_name(job.view),
                  .program = FindProgram(programs, "render"),
                  .options = job.options,
                  .settings = {"--threads=" + std::to_string(threads)},
                  .inputs = stage.inputs(request),
                  .outputs = {}};
  const std::string stem = paths.montage(job.view).string();
  for (const fs::path& output : stage.outputs(request)) {
    const std::string name = output.string();
    if (name.starts_with(stem + ".")) run.outputs.push_back(output);
  }
  return run;
}

fs::path JobsFile(const BatchPlan& plan) { return plan.folder() / "jobs.jsonl"; }

void WriteJobs(const fs::path& file, const std::vector<BatchJob>& jobs) {
  Json::StreamWriterBuilder one_line;
  one_line["indentation"] = "";
  std::string text;
  for (size_t i = 0; i < jobs.size(); ++i) {
    text += Json::writeString(one_line, JobJson(jobs[i], i)) + "\n";
  }
  WriteWhole(file, text);
}

std::vector<BatchJob> ReadJobs(const fs::path& file) {
  RequireResult(file, "insitu-batch");
  const std::string text = ReadWhole(file);
  std::vector<BatchJob> jobs;
  int line = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const InputError fault(file, ++line,
                           "is no job as insitu-batch writes it, expected one a line");
    try {
      jobs.push_back(JobFrom(ParseJson(file, text.substr(at, end - at)), fault));
    } catch (const InputError&) {
      throw fault;
    }
    at = end + 1;
  }
  return jobs;
}

void WriteOutcome(const SitePaths& site, const BatchJob& job, const RunOutcome& outcome) {
  Json::Value json;
  json["status"] = outcome.status;
  json["seconds"] = outcome.seconds;
  json["message"] = outcome.message;
  json["warnings"] = Json::Value(Json::arrayValue);
  for (const std::string& warning : outcome.warnings) json["warnings"].append(warning);
  WriteJson(OutcomeFile(site, job), json);
}

std::optional<RunOutcome> ReadOutcome(const SitePaths& site, const BatchJob& job) {
  const fs::path file = OutcomeFile(site, job);
  if (!fs::exists(file)) return std::nullopt;
  try {
    const JsonNode json = JsonNode::Load(file);
    return RunOutcome{json.At("status").Integer(), json.At("seconds").Number(),
                      json.At("message").Text(), json.At("warnings").Texts()};
  } catch (const InputError&) {  // it is only told
    return std::nullopt;
  }
}

}  // namespace insitu
