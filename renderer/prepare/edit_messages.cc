// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/edit_messages.h"

#include "reconstruction/editing/edited_tables.h"

namespace insitu {

Json::Value ConflictsJson(const std::vector<RowConflict>& conflicts) {
  Json::Value json(Json::arrayValue);
  for (const RowConflict& conflict : conflicts) json.append(ToJson(conflict));
  return json;
}

Sentence OffFrame(const Operation& operation, const std::map<std::string, Eigen::Vector2i>& sizes) {
  for (const RowEdit& change : operation.edits) {
    if (change.table == "camera_positions") continue;  // its x and y are metres
    const Json::Value& row = change.after;
    if (!row.isObject() || !row["photo"].isString() || !row["x"].isNumeric()) continue;
    const auto size = sizes.find(row["photo"].asString());
    if (size == sizes.end()) continue;
    const Eigen::Array2d pixel(row["x"].asDouble(), row["y"].asDouble());
    if ((pixel >= -0.5).all() && (pixel <= size->second.cast<double>().array() - 0.5).all()) {
      continue;
    }
    return Sentence("offPhoto", "{table}: the pixel lies off photo {photo}",
                    {{"table", change.table}, {"photo", size->first}});
  }
  return {};
}

std::vector<Sentence> SentencesOf(const OutsideChanges& outside) {
  std::vector<Sentence> sentences = outside.remarks;
  for (const RowConflict& conflict : outside.conflicts) {
    sentences.push_back(
        Sentence("outsideConflict",
                 "{table}: a row was changed here and in the file; the file's stands, yours was "
                 "{row}",
                 {{"table", conflict.table}, {"row", OneLineJson(conflict.after)}}));
  }
  return sentences;
}

Sentence NotSaved(const std::vector<FileFault>& faults) {
  Sentence all;
  for (const FileFault& fault : faults) {
    const Sentence one("atPlace", "{place}: {message}",
                       {{"place", fault.file}, {"message", fault.text.ToJson()}});
    all = all.empty() ? one
                      : Sentence("then", "{one}; {other}",
                                 {{"one", all.ToJson()}, {"other", one.ToJson()}});
  }
  return all;
}

Json::Value ReadOnlyJson(const SiteEdit& edit) {
  Json::Value list(Json::arrayValue);
  for (const ReadOnlyTable& table : edit.read_only()) {
    Json::Value json;
    json["table"] = table.table;
    json["file"] = table.fault.file;
    json["line"] = table.fault.line;
    table.fault.text.SayIn(&json, "text");
    list.append(json);
  }
  return list;
}

std::string ReadOnlyText(const SiteEdit& edit) {
  std::string text, last;
  for (const ReadOnlyTable& table : edit.read_only()) {
    const FileFault& fault = table.fault;
    if (fault.file == last) continue;  // a file has several tables
    last = fault.file;
    text += (text.empty() ? "" : "\n") + fault.file + ":" + std::to_string(fault.line) + ": " +
            fault.text.text();
  }
  return text;
}

}  // namespace insitu
