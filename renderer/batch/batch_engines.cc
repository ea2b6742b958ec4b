// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/batch_engines.h"

#include <json/value.h>

#include <iostream>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/program/child_process.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr int kNotFound = 127;

// One word for a shell.
std::string ShellWord(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string CommandOf(const EngineJobs& jobs) {
  return ShellWord(jobs.program.string()) + " " + ShellWord(fs::absolute(jobs.plan.file).string());
}

struct Answer {
  int status = 0;
  std::vector<std::string> lines, errors;
};

// A program looked up in PATH; its status is 127 if it is not there.
Answer Ask(std::vector<std::string> command) {
  Answer answer;
  command.insert(command.begin(), "/usr/bin/env");
  answer.status = RunChild({.command = std::move(command),
                            .environment = {},
                            .on_output = [&](const auto& line) { answer.lines.push_back(line); },
                            .on_error = [&](const auto& line) { answer.errors.push_back(line); }});
  return answer;
}

std::string FirstOf(const std::vector<std::string>& lines) {
  return lines.empty() ? std::string("it says nothing") : lines.front();
}

fs::path SlurmRecord(const BatchPlan& plan) { return plan.folder() / "slurm.json"; }

// What an earlier run submitted must have left the queue: no job is done twice at a time.
void RequireNoneQueued(const BatchPlan& plan) {
  if (!fs::exists(SlurmRecord(plan))) return;
  const std::string array = JsonNode::Load(SlurmRecord(plan)).At("array").Text();
  const Answer queue = Ask({"squeue", "--noheader", "--jobs=" + array});
  if (queue.status != 0 || queue.lines.empty()) return;  // Slurm has forgotten it
  throw InputError(plan.file, "array " + array + " of an earlier run is still in Slurm's queue (" +
                                  std::to_string(queue.lines.size()) +
                                  " lines of squeue): wait for it, or end it by scancel " + array);
}

std::string Submit(const std::vector<std::string>& options) {
  std::vector<std::string> command = {"sbatch", "--parsable"};
  command.insert(command.end(), options.begin(), options.end());
  const Answer answer = Ask(command);
  if (answer.status != 0 || answer.lines.size() != 1) {
    throw InputError("sbatch", "does not take the jobs: " + FirstOf(answer.errors));
  }
  return answer.lines.front().substr(0, answer.lines.front().find(';'));  // ID;CLUSTER
}

void RequireSlurm() {
  if (Ask({"sbatch", "--version"}).status != kNotFound) return;
  throw InputError("--engine slurm",
                   "there is no sbatch here: install slurm-wlm, or use another engine");
}

void RequireParallel() {
  const Answer answer = Ask({"parallel", "--version"});
  if (answer.status == 0 && FirstOf(answer.lines).starts_with("GNU parallel")) return;
  throw InputError("--engine parallel",
                   "there is no GNU parallel here: install parallel, or use another engine");
}

}  // namespace

std::string NumbersText(const std::vector<size_t>& numbers) {
  std::string text;
  for (size_t i = 0; i < numbers.size();) {
    size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(numbers[i]);
    if (last > i) text += "-" + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

std::string SubmitToSlurm(const EngineJobs& jobs) {
  const BatchPlan& plan = jobs.plan;
  RequireSlurm();
  RequireNoneQueued(plan);
  const fs::path script = plan.folder() / "slurm.sh", folder = fs::absolute(plan.folder());
  const std::string threads = jobs.threads > 0 ? std::to_string(jobs.threads)
                                               : std::string("\"${SLURM_CPUS_PER_TASK:-0}\"");
  WriteWhole(script,
             "#!/bin/sh\n# An array job of insitu-batch: a task is a line of jobs.jsonl.\nexec " +
                 CommandOf(jobs) + " --job \"$SLURM_ARRAY_TASK_ID\" --threads " + threads + "\n");
  const std::string numbers =
      NumbersText(jobs.numbers) + (jobs.jobs > 0 ? "%" + std::to_string(jobs.jobs) : "");
  std::vector<std::string> options = {"--job-name=insitu-" + plan.name(), "--array=" + numbers,
                                      "--chdir=" + folder.string(), "--output=slurm-%a.log"};
  if (jobs.threads > 0) options.push_back("--cpus-per-task=" + std::to_string(jobs.threads));
  options.push_back(script.string());
  Json::Value record;
  record["array"] = Submit(options);
  WriteJson(SlurmRecord(plan), record);  // before anything else can fail
  const std::string array = record["array"].asString();
  Submit({"--job-name=insitu-" + plan.name() + "-sheet", "--dependency=afterany:" + array,
          "--chdir=" + folder.string(), "--output=slurm-sheet.log",
          "--wrap=exec " + CommandOf(jobs) + " --sheet"});
  return array;
}

int RunByParallel(const EngineJobs& jobs) {
  RequireParallel();
  std::vector<std::string> command = {"/usr/bin/env", "parallel", "--line-buffer", "--joblog",
                                      (jobs.plan.folder() / "parallel.log").string()};
  if (jobs.jobs > 0) command.push_back("--jobs=" + std::to_string(jobs.jobs));
  command.push_back(CommandOf(jobs) + " --threads " + std::to_string(jobs.threads) + " --job {}");
  command.emplace_back(":::");
  for (const size_t number : jobs.numbers) command.push_back(std::to_string(number));
  const int failed =
      RunChild({.command = command,
                .environment = {"PARALLEL_HOME=" + jobs.plan.folder().string()},
                .on_output = [](const auto& line) { std::cout << line << std::endl; },
                .on_error = [](const auto& line) { std::cerr << line << std::endl; }});
  return failed == 0 || ReceivedSignal() ? failed : 1;  // it counts how many failed
}

fs::path WriteOpenJdTemplate(const EngineJobs& jobs) {
  const std::string plan = fs::absolute(jobs.plan.file).string();
  const auto action = [&](const std::vector<std::string>& arguments) {
    Json::Value script;
    Json::Value& run = script["actions"]["onRun"];
    run["command"] = jobs.program.string();
    run["args"].append(plan);
    for (const std::string& argument : arguments) run["args"].append(argument);
    return script;
  };
  Json::Value render;
  render["name"] = "Render";
  Json::Value& job = render["parameterSpace"]["taskParameterDefinitions"][0];
  job["name"] = "Job";
  job["type"] = "INT";
  job["range"] = NumbersText(jobs.numbers);
  render["script"] =
      action({"--job", "{{Task.Param.Job}}", "--threads", std::to_string(jobs.threads)});
  Json::Value sheet;
  sheet["name"] = "Sheet";
  sheet["dependencies"][0]["dependsOn"] = "Render";
  sheet["script"] = action({"--sheet"});
  Json::Value root;
  root["specificationVersion"] = "jobtemplate-2023-09";
  root["name"] = "insitu " + jobs.plan.name();
  root["steps"].append(render);
  root["steps"].append(sheet);
  const fs::path file = jobs.plan.folder() / "openjd.json";
  WriteJson(file, root);
  return file;
}

}  // namespace insitu
