// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/site_edit.h"

#include <algorithm>
#include <utility>

#include "calibration/files/error.h"
#include "reconstruction/editing/make_survey_text.h"
#include "reconstruction/editing/merge_rows.h"
#include "reconstruction/editing/row_checks.h"

namespace insitu {
namespace {

EditOutcome Refused(int revision, const Sentence& why) {
  EditOutcome outcome{revision};
  outcome.refused = why;
  return outcome;
}

EditOutcome Repeated(int revision) {
  EditOutcome outcome{revision};
  outcome.is_repeated = true;
  return outcome;
}

}  // namespace

bool SiteEdit::is_saved() const {
  return std::none_of(files_.begin(), files_.end(),
                      [](const SiteFile& file) { return file.is_changed; });
}

SiteFile& SiteEdit::FileOf(const EditedTable& table) {
  const auto file = std::find_if(files_.begin(), files_.end(),
                                 [&](const SiteFile& each) { return each.name == table.file; });
  INSITU_CHECK(file != files_.end());
  return *file;
}

const SiteFile& SiteEdit::FileOf(const EditedTable& table) const {
  return const_cast<SiteEdit*>(this)->FileOf(table);
}

std::vector<Json::Value> SiteEdit::Rows(const std::string& table) const {
  const EditedTable* found = FindEditedTable(table);
  INSITU_CHECK(found);
  std::vector<Json::Value> rows;
  for (const Json::Value* row : FileOf(*found).now->Rows(*found)) rows.push_back(*row);
  return rows;
}

Json::Value SiteEdit::Tables() const {
  Json::Value tables(Json::objectValue);
  for (const EditedTable& table : EditedTables()) {
    Json::Value& rows = tables[table.name] = Json::Value(Json::arrayValue);
    for (const Json::Value* row : FileOf(table).now->Rows(table)) rows.append(*row);
  }
  return tables;
}

std::vector<ReadOnlyTable> SiteEdit::read_only() const {
  std::vector<ReadOnlyTable> tables;
  for (const SiteFile& file : files_) {
    if (!file.fault) continue;
    for (const EditedTable& table : file.tables) tables.push_back({table.name, *file.fault});
  }
  return tables;
}

std::optional<std::string> SiteEdit::ToUndo() const {
  const HistoryStep* step = history_.ToUndo();
  return step ? std::optional(step->operation.label) : std::nullopt;
}

std::optional<std::string> SiteEdit::ToRedo() const {
  const HistoryStep* step = history_.ToRedo();
  return step ? std::optional(step->operation.label) : std::nullopt;
}

Sentence SiteEdit::RefusalOfRow(const RowEdit& edit) const {
  const EditedTable& table = *FindEditedTable(edit.table);
  const SurveyText& text = *FileOf(table).now;
  for (const std::string& field : edit.after.getMemberNames()) {
    const Json::Value& value = edit.after[field];
    const bool is_default = value.isNull() || (value.isString() && value.asString().empty());
    if (!is_default && !text.CanHold(table, field)) {
      return Sentence("rowNoColumn", "{table}: there is no column \"{field}\"",
                      {{"table", table.name}, {"field", field}});
    }
  }
  const auto fault = FaultOfRow(table, edit.after, photos_);
  if (!fault) return {};
  return Sentence("rowOf", "{table}: {fault}", {{"table", table.name}, {"fault", fault->ToJson()}});
}

// Why edits cannot be made; empty if they can. Rows that are taken back were there before.
Sentence SiteEdit::RefusalOf(const std::vector<RowEdit>& edits, bool is_new) const {
  for (const RowEdit& edit : edits) {
    const EditedTable* table = FindEditedTable(edit.table);
    if (!table) {
      return Sentence("rowNoTable", "there is no table \"{table}\"", {{"table", edit.table}});
    }
    if (const auto& fault = FileOf(*table).fault) {
      return Sentence("rowReadOnly",
                      "{place}: {fault}; the table is read-only until that is mended",
                      {{"place", fault->file + ":" + std::to_string(fault->line)},
                       {"fault", fault->text.ToJson()}});
    }
    const Sentence refusal = is_new && !edit.after.isNull() ? RefusalOfRow(edit) : Sentence();
    if (!refusal.empty()) return refusal;
  }
  return {};
}

// `note` puts it into the journal; if it throws, the texts are as they were.
EditOutcome SiteEdit::Do(const Operation& operation, EqualRows equal_rows,
                         const std::vector<Json::Value>& traces,
                         const std::function<void(std::vector<Json::Value>)>& note) {
  const TextOf text_of = [&](const EditedTable& table) -> SurveyText& {
    return *FileOf(table).now;
  };
  AppliedEdits applied = ApplyEdits(operation.edits, text_of, equal_rows, traces);
  if (!applied.conflicts.empty()) {
    EditOutcome outcome{revision()};
    outcome.conflicts = std::move(applied.conflicts);
    return outcome;
  }
  try {
    note(applied.traces);
  } catch (...) {
    TakeBack(operation.edits, applied.traces, text_of);
    throw;
  }
  for (const RowEdit& edit : operation.edits) {
    FileOf(*FindEditedTable(edit.table)).is_changed = true;
  }
  EditOutcome outcome{revision()};
  outcome.operation = operation;
  return outcome;
}

EditOutcome SiteEdit::Apply(const Operation& operation) {
  if (const auto seen = history_.RevisionOf(operation.id)) return Repeated(*seen);
  if (operation.id.empty()) {
    return Refused(revision(), Sentence::Verbatim("the operation has no id"));
  }
  if (operation.edits.empty()) {
    return Refused(revision(), Sentence::Verbatim("the operation has no edits"));
  }
  const Sentence refusal = RefusalOf(operation.edits, true);
  if (!refusal.empty()) return Refused(revision(), refusal);
  return Do(operation, EqualRows::kRefused, {},
            [&](const std::vector<Json::Value>& traces) { history_.AddEdit(operation, traces); });
}

EditOutcome SiteEdit::Undo(const std::string& id) {
  if (const auto seen = history_.RevisionOf(id)) return Repeated(*seen);
  const HistoryStep* step = history_.ToUndo();
  if (!step) return Refused(revision(), Sentence("nothingToUndo", "there is nothing to undo"));
  const Operation inverse = Inverse(step->operation);
  const Sentence refusal = RefusalOf(inverse.edits, false);
  if (!refusal.empty()) return Refused(revision(), refusal);
  EditOutcome outcome = Do(inverse, EqualRows::kAllowed, Reversed(step->traces),
                           [&](const std::vector<Json::Value>&) { history_.AddUndo(id); });
  if (!outcome.conflicts.empty()) history_.DropUndo();
  return outcome;
}

EditOutcome SiteEdit::Redo(const std::string& id) {
  if (const auto seen = history_.RevisionOf(id)) return Repeated(*seen);
  const HistoryStep* step = history_.ToRedo();
  if (!step) return Refused(revision(), Sentence("nothingToRedo", "there is nothing to redo"));
  const Operation operation = step->operation;
  const Sentence refusal = RefusalOf(operation.edits, false);
  if (!refusal.empty()) return Refused(revision(), refusal);
  EditOutcome outcome =
      Do(operation, EqualRows::kAllowed, {},
         [&](const std::vector<Json::Value>& traces) { history_.AddRedo(id, traces); });
  if (!outcome.conflicts.empty()) history_.DropRedo();
  return outcome;
}

SiteEdit::MergeReport SiteEdit::Merge(const SitePaths& other, const std::string& id) {
  MergeReport report;
  Operation operation{id, "Merge " + other.root.string()};
  for (const SiteFile& theirs : SiteFiles(other.root, other.root)) {
    const SiteFile& ours = FileOf(theirs.tables.front());
    try {
      const auto text = MakeSurveyText(theirs.tables, theirs.path, ReadIfThere(theirs.path));
      MergedRows merged = MergeSurvey(theirs.tables, *ours.now, *text);
      report.conflicts.insert(report.conflicts.end(), merged.conflicts.begin(),
                              merged.conflicts.end());
      for (RowEdit& edit : merged.edits) {
        const Sentence refusal = RefusalOf({edit}, true);
        if (refusal.empty()) {
          operation.edits.push_back(std::move(edit));
        } else {
          report.remarks.push_back(Sentence::Verbatim(theirs.path.string() + ": " +
                                                      OneLineJson(edit.after) +
                                                      " is left out: " + refusal.text()));
        }
      }
    } catch (const InputError& error) {
      report.remarks.push_back(SentenceOf(error));
    }
  }
  report.outcome.revision = revision();
  if (!operation.edits.empty()) report.outcome = Apply(operation);
  return report;
}

}  // namespace insitu
