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

Json::Value StepsJson(const std::vector<HistoryStep>& steps) {
  Json::Value list(Json::arrayValue);
  for (const HistoryStep& step : steps) {
    Json::Value told(Json::objectValue);
    told["revision"] = step.revision;
    told["operation"] = ToJson(step.operation);
    told["traces"] = ArrayOf(step.traces);
    list.append(std::move(told));
  }
  return list;
}

std::vector<HistoryStep> StepsFromJson(const Json::Value& list) {
  std::vector<HistoryStep> steps;
  for (const Json::Value& told : list) {
    const Json::Value& traces = told["traces"];
    steps.push_back({told["revision"].asInt(), OperationFromJson(told["operation"]),
                     std::vector<Json::Value>(traces.begin(), traces.end())});
  }
  return steps;
}

Json::Value MarkEntry(const std::string& file, const FileMark& mark) {
  Json::Value entry = Entry("file");
  entry["file"] = file;
  entry["hash"] = mark.hash;
  if (!mark.pending.empty()) entry["pending"] = ToJson(Operation{"pending", "", mark.pending});
  return entry;
}

FileMark MarkFromJson(const Json::Value& entry, int revision) {
  FileMark mark{RowText(entry, "hash"), revision};
  if (entry.isMember("pending")) mark.pending = OperationFromJson(entry["pending"]).edits;
  return mark;
}

void KeepLast(size_t count, std::vector<HistoryStep>& steps) {
  if (steps.size() <= count) return;
  steps.erase(steps.begin(), steps.end() - static_cast<std::ptrdiff_t>(count));
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

SiteHistory::SiteHistory(const std::filesystem::path& journal, const HistoryLimits& limits)
    : journal_(journal), limits_(limits) {
  int line = 0;
  for (const Json::Value& entry : journal_.entries()) {
    ++line;
    try {
      Do(entry, true);
    } catch (const InputError& error) {
      throw InputError(journal, line, error.what());
    } catch (const Json::Exception& error) {
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
  const std::string kind = RowText(entry, "kind");
  if (kind == "begin") return Begin(entry);
  ++entry_count_;
  if (kind == "file") {
    marks_[RowText(entry, "file")].push_back(MarkFromJson(entry, revision_));
  } else if (kind == "drop") {
    std::vector<HistoryStep>& steps = RowText(entry, "id") == "undo" ? done_ : undone_;
    if (!steps.empty()) steps.pop_back();
  } else {
    DoStep(entry, kind, is_reading);
  }
}

// What makes a revision.
void SiteHistory::DoStep(const Json::Value& entry, const std::string& kind, bool is_reading) {
  const std::string id = RowText(entry, "id");
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
  Append(MarkEntry(file, {hash, revision_, pending}));
}

// What Shorten wrote.
void SiteHistory::Begin(const Json::Value& entry) {
  revision_ = entry["revision"].asInt();
  done_ = StepsFromJson(entry["done"]);
  undone_ = StepsFromJson(entry["undone"]);
  for (const std::string& id : entry["ids"].getMemberNames()) {
    revision_of_id_[id] = entry["ids"][id].asInt();
  }
  for (const Json::Value& mark : entry["files"]) {
    marks_[RowText(mark, "file")] = {MarkFromJson(mark, revision_)};
  }
}

void SiteHistory::Shorten() {
  KeepLast(limits_.steps, done_);
  KeepLast(limits_.steps, undone_);
  std::erase_if(revision_of_id_, [&](const auto& id) {
    return id.second + static_cast<int64_t>(limits_.ids) <= revision_;
  });
  Json::Value entry = Entry("begin");
  entry["revision"] = revision_;
  entry["done"] = StepsJson(done_);
  entry["undone"] = StepsJson(undone_);
  entry["ids"] = Json::Value(Json::objectValue);
  for (const auto& [id, revision] : revision_of_id_) entry["ids"][id] = revision;
  entry["files"] = Json::Value(Json::arrayValue);
  for (const auto& [file, marks] : marks_) {
    if (!marks.empty()) entry["files"].append(MarkEntry(file, marks.back()));
  }
  journal_.Replace({entry});
  for (auto& [file, marks] : marks_) marks = {{marks.back().hash, revision_, marks.back().pending}};
  entry_count_ = 0;
}

}  // namespace insitu
