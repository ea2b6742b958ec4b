// SPDX-License-Identifier: GPL-3.0-or-later
// What a stage's results were made from, so that the next run knows whether they still hold.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

// Files by their path below the site folder, each with its SHA-256; "": there was none.
using FileStates = std::map<std::string, std::string>;

struct StageRecord {
  std::string version;       // of insitu
  std::string program_hash;  // SHA-256 of the program
  std::vector<std::string> options = {};
  FileStates inputs = {}, outputs = {};
  double seconds = 0;
  std::vector<std::string> warnings = {};  // that the program printed, without "warning: "
};

// Below work/stages/: the record of a stage, and what its program printed.
std::filesystem::path StageRecordFile(const SitePaths& site, const std::string& stage);
std::filesystem::path StageLog(const SitePaths& site, const std::string& stage);

// nullopt: the stage never ended well, or its record cannot be read by this version.
std::optional<StageRecord> ReadStageRecord(const SitePaths& site, const std::string& stage);
void WriteStageRecord(const SitePaths& site, const std::string& stage, const StageRecord& record);

// Before a stage runs: from here on its results are not to be trusted.
void RemoveStageRecord(const SitePaths& site, const std::string& stage);

// Why results made as `then` tells no longer hold, a phrase each: "survey/edges.csv is new". Of
// `now` the seconds and warnings do not count. Empty: they hold.
std::vector<std::string> WhatChanged(const StageRecord& then, const StageRecord& now);

}  // namespace insitu
