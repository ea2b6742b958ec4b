// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/operation.h"

#include <algorithm>
#include <optional>

#include "calibration/files/error.h"

namespace insitu {
namespace {

[[noreturn]] void RefuseOperation(const std::string& message) {
  throw InputError("operation", message);
}

const EditedTable& TableOf(const std::string& name) {
  const EditedTable* table = FindEditedTable(name);
  if (!table) RefuseOperation("there is no table \"" + name + "\"");
  return *table;
}

RowEdit EditFromJson(const Json::Value& json) {
  if (!json.isObject()) RefuseOperation("an edit is no object");
  RowEdit edit{RowText(json, "table"), json["before"], json["after"]};
  TableOf(edit.table);
  for (const Json::Value* row : {&edit.before, &edit.after}) {
    if (!row->isNull() && !row->isObject()) RefuseOperation("a row is no object");
  }
  if (edit.before.isNull() && edit.after.isNull()) RefuseOperation("an edit is empty");
  return edit;
}

// The row that hinders an edit, or null within; nullopt: none does.
std::optional<Json::Value> Hindrance(const EditedTable& table, const RowEdit& edit,
                                     const SurveyText& text, EqualRows equal_rows) {
  const auto current = [](const Json::Value* row) { return row ? *row : Json::Value(); };
  if (!edit.before.isNull()) {
    const Json::Value* row = text.Find(table, edit.before);
    if (!row || !IsSameRow(table, *row, edit.before)) return current(row);
  }
  if (edit.after.isNull() || equal_rows == EqualRows::kAllowed) return std::nullopt;
  const bool keeps_key =
      !edit.before.isNull() && KeyOfRow(table, edit.before) == KeyOfRow(table, edit.after);
  const Json::Value* other = keeps_key ? nullptr : text.Find(table, edit.after);
  return other ? std::optional(*other) : std::nullopt;
}

}  // namespace

Operation OperationFromJson(const Json::Value& json) {
  if (!json.isObject() || !json["edits"].isArray())
    RefuseOperation("expected an object with edits");
  Operation operation{RowText(json, "id"), RowText(json, "label")};
  if (operation.id.empty()) RefuseOperation("has no id");
  for (const Json::Value& edit : json["edits"]) operation.edits.push_back(EditFromJson(edit));
  if (operation.edits.empty()) RefuseOperation("has no edits");
  return operation;
}

Json::Value ToJson(const Operation& operation) {
  Json::Value json;
  json["id"] = operation.id;
  json["label"] = operation.label;
  json["edits"] = Json::Value(Json::arrayValue);
  for (const RowEdit& edit : operation.edits) {
    Json::Value row;
    row["table"] = edit.table;
    row["before"] = edit.before;
    row["after"] = edit.after;
    json["edits"].append(row);
  }
  return json;
}

Json::Value ToJson(const RowConflict& conflict) {
  Json::Value json;
  json["table"] = conflict.table;
  json["before"] = conflict.before;
  json["current"] = conflict.current;
  json["after"] = conflict.after;
  return json;
}

Operation Inverse(const Operation& operation) {
  Operation inverse{operation.id, operation.label};
  for (auto edit = operation.edits.rbegin(); edit != operation.edits.rend(); ++edit) {
    inverse.edits.push_back({edit->table, edit->after, edit->before});
  }
  return inverse;
}

AppliedEdits ApplyEdits(const std::vector<RowEdit>& edits,
                        const std::function<SurveyText&(const EditedTable&)>& text_of,
                        EqualRows equal_rows, const std::vector<Json::Value>& traces) {
  AppliedEdits applied;
  std::vector<RowEdit> done;
  for (size_t i = 0; i < edits.size(); ++i) {
    const EditedTable& table = TableOf(edits[i].table);
    SurveyText& text = text_of(table);
    if (const auto current = Hindrance(table, edits[i], text, equal_rows)) {
      applied.conflicts.push_back({table.name, edits[i].before, *current, edits[i].after});
      continue;
    }
    const Json::Value trace = i < traces.size() ? traces[i] : Json::Value();
    applied.traces.push_back(text.Edit(table, edits[i].before, edits[i].after, trace));
    done.push_back(edits[i]);
  }
  if (applied.conflicts.empty()) return applied;
  TakeBack(done, applied.traces, text_of);
  applied.traces.clear();
  return applied;
}

void TakeBack(const std::vector<RowEdit>& edits, const std::vector<Json::Value>& traces,
              const std::function<SurveyText&(const EditedTable&)>& text_of) {
  for (size_t i = edits.size(); i > 0; --i) {
    const RowEdit& edit = edits[i - 1];
    const EditedTable& table = TableOf(edit.table);
    text_of(table).Edit(table, edit.after, edit.before, traces[i - 1]);
  }
}

}  // namespace insitu
