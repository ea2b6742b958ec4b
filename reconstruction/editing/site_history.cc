// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/site_history.h"

#include <algorithm>
#include <utility>

#include "calibration/files/error.h"

namespace insitu {
namespace {

Json::Value ArrayOf(const std::vector<Json::Value>& values) {
  Json::Value array(Json::arrayValue);
  for (const Json::Value& value : values) array.append(value);
  return array;
}

Json::Value Entry(const std::string& kind) {
  Json::Value entry(Json::objectValue);
  entry["kind"] = kind;
  return entry;
}

Json::Value StepEntry(const std::string& kind, const std::string& id,
                      const std::vector<Json::Value>& traces) {
  Json::Value entry = Entry(kind);
  entry["id"] = id;
  entry["traces"] = ArrayOf(traces);
  return entry;
}

// The last of `from` goes to `to`.
HistoryStep& MoveLast(std::vector<HistoryStep>& from, std::vector<HistoryStep>& to) {
  if (from.empty()) throw InputError("journal", "takes back what was not done");
  to.push_back(std::move(from.back()));
  from.pop_back();
  return to.back();
}

}  // namespace

std::vector<Json::Value> Reversed(std::vector<Json::Value> traces) {
  std::reverse(traces.begin(), traces.end());
  return traces;
}

SiteHistory::SiteHistory(const std::filesystem::path& journal) : journal_(journal) {
  int line = 0;
  for (const Json::Value& entry : journal_.entries()) {
    ++line;
    try {
      Do(entry, true);
    } catch (const InputError& error) {
      throw InputError(journal, line, error.what());
    }
  }
}

std::optional<int> SiteHistory::RevisionOf(const std::string& id) const {
  const auto revision = revision_of_id_.find(id);
  if (revision == revision_of_id_.end()) return std::nullopt;
  return revision->second;
}

const std::vector<FileMark>& SiteHistory::MarksOf(const std::string& file) const {
  static const std::vector<FileMark> none;
  const auto marks = marks_.find(file);
  return marks == marks_.end() ? none : marks->second;
}

// What an entry says, be it new or read.
void SiteHistory::Do(const Json::Value& entry, bool is_reading) {
  const std::string kind = RowText(entry, "kind"), id = RowText(entry, "id");
  if (kind == "file") {
    FileMark mark{RowText(entry, "hash"), revision_};
    if (entry.isMember("pending")) mark.pending = OperationFromJson(entry["pending"]).edits;
    marks_[RowText(entry, "file")].push_back(std::move(mark));
    return;
  }
  if (kind == "drop") {
    std::vector<HistoryStep>& steps = id == "undo" ? done_ : undone_;
    if (!steps.empty()) steps.pop_back();
    return;
  }
  const Json::Value& list = entry["traces"];
  std::vector<Json::Value> traces(list.begin(), list.end());
  DoneEdits now{revision_ + 1, {}, {}};
  if (kind == "edit" || kind == "outside") {
    HistoryStep step{now.revision, OperationFromJson(entry["operation"]), std::move(traces)};
    now.edits = step.operation.edits;
    revision_of_id_[step.operation.id] = now.revision;
    if (kind == "edit") {
      done_.push_back(std::move(step));
      undone_.clear();
    }
  } else if (kind == "undo") {
    HistoryStep& step = MoveLast(done_, undone_);
    now.edits = Inverse(step.operation).edits;
    now.traces = Reversed(std::move(step.traces));
    step.traces.clear();
  } else if (kind == "redo") {
    HistoryStep& step = MoveLast(undone_, done_);
    now.edits = step.operation.edits;
    step.traces = std::move(traces);
  } else {
    throw InputError("journal", "has an entry of kind \"" + kind + "\", which is unknown");
  }
  if (!id.empty()) revision_of_id_[id] = now.revision;
  ++revision_;
  if (is_reading) read_.push_back(std::move(now));
}

void SiteHistory::Append(Json::Value entry) {
  const bool is_step = entry["kind"] != "file" && entry["kind"] != "drop";
  entry["revision"] = revision_ + (is_step ? 1 : 0);
  journal_.Append(entry);
  Do(entry, false);
}

void SiteHistory::AddEdit(const Operation& operation, const std::vector<Json::Value>& traces) {
  Json::Value entry = Entry("edit");
  entry["operation"] = ToJson(operation);
  entry["traces"] = ArrayOf(traces);
  Append(std::move(entry));
}

void SiteHistory::AddOutside(const Operation& operation) {
  Json::Value entry = Entry("outside");
  entry["operation"] = ToJson(operation);
  Append(std::move(entry));
}

void SiteHistory::AddUndo(const std::string& id) { Append(StepEntry("undo", id, {})); }

void SiteHistory::AddRedo(const std::string& id, const std::vector<Json::Value>& traces) {
  Append(StepEntry("redo", id, traces));
}

void SiteHistory::DropUndo() {
  Json::Value entry = Entry("drop");
  entry["id"] = "undo";
  Append(std::move(entry));
}

void SiteHistory::DropRedo() {
  Json::Value entry = Entry("drop");
  entry["id"] = "redo";
  Append(std::move(entry));
}

void SiteHistory::AddMark(const std::string& file, const std::string& hash,
                          const std::vector<RowEdit>& pending) {
  Json::Value entry = Entry("file");
  entry["file"] = file;
  entry["hash"] = hash;
  if (!pending.empty()) entry["pending"] = ToJson(Operation{"pending", "", pending});
  Append(std::move(entry));
}

}  // namespace insitu
