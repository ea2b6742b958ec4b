// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/stage_record.h"

#include <json/value.h>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr char kFormat[] = "insitu stage record";
constexpr int kVersion = 1;

Json::Value ToJson(const std::vector<std::string>& texts) {
  Json::Value json(Json::arrayValue);
  for (const std::string& text : texts) json.append(text);
  return json;
}

Json::Value ToJson(const FileStates& files) {
  Json::Value json(Json::objectValue);
  for (const auto& [path, hash] : files) json[path] = hash;
  return json;
}

FileStates FilesOf(const JsonNode& node) {
  FileStates files;
  for (const auto& [path, hash] : node.Members()) files[path] = hash.Text();
  return files;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text.empty() ? "none" : text;
}

void CompareInputs(const FileStates& then, const FileStates& now,
                   std::vector<std::string>* changes) {
  for (const auto& [path, hash] : now) {
    const auto before = then.find(path);
    const bool was_there = before != then.end() && !before->second.empty();
    if (!was_there && !hash.empty()) changes->push_back(path + " is new");
    if (was_there && hash.empty()) changes->push_back(path + " is gone");
    if (was_there && !hash.empty() && hash != before->second) {
      changes->push_back(path + " has changed");
    }
  }
  for (const auto& [path, hash] : then) {
    if (!hash.empty() && !now.contains(path)) changes->push_back(path + " is gone");
  }
}

void CompareOutputs(const FileStates& then, const FileStates& now,
                    std::vector<std::string>* changes) {
  for (const auto& [path, hash] : then) {
    const auto found = now.find(path);
    if (found == now.end() || found->second.empty()) {
      changes->push_back(path + " is missing");
    } else if (found->second != hash) {
      changes->push_back(path + " is not as it was written");
    }
  }
}

}  // namespace

fs::path StageRecordFile(const SitePaths& site, const std::string& stage) {
  return site.stages() / (stage + ".json");
}

fs::path StageLog(const SitePaths& site, const std::string& stage) {
  return site.stages() / (stage + ".log");
}

std::optional<StageRecord> ReadStageRecord(const SitePaths& site, const std::string& stage) {
  const fs::path path = StageRecordFile(site, stage);
  if (!fs::exists(path)) return std::nullopt;
  try {
    const JsonNode json = JsonNode::Load(path);
    if (json.At("format").Text() != kFormat || json.At("version").Integer() != kVersion) {
      return std::nullopt;
    }
    return StageRecord{.version = json.At("insitu").Text(),
                       .program_hash = json.At("program_sha256").Text(),
                       .options = json.At("options").Texts(),
                       .inputs = FilesOf(json.At("inputs")),
                       .outputs = FilesOf(json.At("outputs")),
                       .seconds = json.At("seconds").Number(),
                       .warnings = json.At("warnings").Texts()};
  } catch (const InputError&) {  // of a killed run or another version: the stage runs again
    return std::nullopt;
  }
}

void WriteStageRecord(const SitePaths& site, const std::string& stage, const StageRecord& record) {
  Json::Value json;
  json["format"] = kFormat;
  json["version"] = kVersion;
  json["insitu"] = record.version;
  json["program_sha256"] = record.program_hash;
  json["options"] = ToJson(record.options);
  json["inputs"] = ToJson(record.inputs);
  json["outputs"] = ToJson(record.outputs);
  json["seconds"] = record.seconds;
  json["warnings"] = ToJson(record.warnings);
  WriteJson(StageRecordFile(site, stage), json);
}

void RemoveStageRecord(const SitePaths& site, const std::string& stage) {
  fs::remove(StageRecordFile(site, stage));
}

std::vector<std::string> WhatChanged(const StageRecord& then, const StageRecord& now) {
  std::vector<std::string> changes;
  if (then.version != now.version) {
    changes.push_back("insitu is version " + now.version + ", was " + then.version);
  } else if (then.program_hash != now.program_hash) {
    changes.push_back("its program was built anew");
  }
  if (then.options != now.options) {
    changes.push_back("its options are " + Joined(now.options) + ", were " + Joined(then.options));
  }
  CompareInputs(then.inputs, now.inputs, &changes);
  CompareOutputs(then.outputs, now.outputs, &changes);
  return changes;
}

}  // namespace insitu
