// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/merge_conflicts.h"

#include <algorithm>
#include <filesystem>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/editing/edited_tables.h"

namespace insitu {
namespace {

std::filesystem::path MergeFile(const SitePaths& site) {
  return site.root / "work/prepare/merge.json";
}

// What cannot be read is taken as none: its rows differ still, another --merge tells them again.
Json::Value ReadMergeConflicts(const SitePaths& site) {
  try {
    if (std::filesystem::exists(MergeFile(site))) return ReadJson(MergeFile(site));
  } catch (const InputError&) {
  }
  return Json::arrayValue;
}

void WriteMergeConflicts(const SitePaths& site, const Json::Value& conflicts) {
  if (conflicts.empty()) {
    std::filesystem::remove(MergeFile(site));
    return;
  }
  WriteWhole(MergeFile(site), OneLineJson(conflicts) + "\n");
}

bool IsSameConflict(const Json::Value& a, const Json::Value& b) {
  return a["table"] == b["table"] && IsSameValue(a["current"], b["current"]) &&
         IsSameValue(a["after"], b["after"]);
}

}  // namespace

void KeepMergeConflicts(const SitePaths& site, const SitePaths& colleague,
                        const std::vector<RowConflict>& conflicts) {
  Json::Value kept = ReadMergeConflicts(site);
  for (const RowConflict& conflict : conflicts) {
    Json::Value json = ToJson(conflict);
    json["from"] = std::filesystem::canonical(colleague.root).filename().string();
    const bool is_kept = std::any_of(kept.begin(), kept.end(), [&](const Json::Value& other) {
      return IsSameConflict(other, json);
    });
    if (!is_kept) kept.append(json);
  }
  WriteMergeConflicts(site, kept);
}

Json::Value OpenMergeConflicts(const SitePaths& site, const SiteEdit& edit) {
  Json::Value open(Json::arrayValue);
  const std::vector<EditedTable>& tables = EditedTables();
  for (const Json::Value& conflict : ReadMergeConflicts(site)) {
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const EditedTable& each) {
      return each.name == conflict["table"].asString();
    });
    if (table == tables.end()) continue;
    const std::vector<Json::Value> rows = edit.Rows(table->name);
    if (std::any_of(rows.begin(), rows.end(), [&](const Json::Value& row) {
          return IsSameRow(*table, row, conflict["current"]);
        })) {
      open.append(conflict);
    }
  }
  return open;
}

void DropMergeConflict(const SitePaths& site, const Json::Value& conflict) {
  Json::Value rest(Json::arrayValue);
  for (const Json::Value& kept : ReadMergeConflicts(site)) {
    if (!IsSameConflict(kept, conflict)) rest.append(kept);
  }
  WriteMergeConflicts(site, rest);
}

}  // namespace insitu
