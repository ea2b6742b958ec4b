// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/json_survey_text.h"

#include <algorithm>
#include <iterator>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"

namespace insitu {
namespace {

int LineOfOffset(const std::string& text, std::ptrdiff_t offset) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + offset, '\n'));
}

// A row without what its place says already.
Json::Value BodyOf(const EditedTable& table, const Json::Value& row) {
  Json::Value body = row;
  if (table.form == TableForm::kMembers && body.isObject()) body.removeMember("name");
  return body;
}

Json::Value RowOfMember(const EditedTable& table, const std::string& name,
                        const Json::Value& value) {
  Json::Value row = value;
  if (table.form == TableForm::kMembers) row["name"] = name;
  return row;
}

std::string BracketsOf(const EditedTable& table) {
  return table.form == TableForm::kMembers ? "{}" : "[]";
}

// The line break and blanks of what is so many levels deep; `lead` is those of one level.
std::string Deeper(const std::string& lead, int levels) {
  const std::string unit = lead.substr(lead.rfind('\n') + 1);
  std::string deeper = lead.find('\r') == std::string::npos ? "\n" : "\r\n";
  for (int i = 0; i < levels; ++i) deeper += unit;
  return deeper;
}

}  // namespace

JsonSurveyText::JsonSurveyText(std::vector<EditedTable> tables, std::filesystem::path path,
                               const std::string& text)
    : tables_(std::move(tables)), path_(std::move(path)) {
  Load(text);
}

void JsonSurveyText::Load(const std::string& text) {
  lists_.clear();
  root_.reset();
  root_row_ = Json::Value(Json::objectValue);
  before_.clear();
  after_.clear();
  for (const EditedTable& table : tables_) {
    if (table.form != TableForm::kRoot) lists_[table.member].table = table;
  }
  if (text.empty()) return;
  const Json::Value meaning = ParseJson(path_, text);
  if (!meaning.isObject()) throw InputError(path_, 1, "expected an object");
  const size_t begin = text.find('{'), end = text.rfind('}') + 1;
  before_ = text.substr(0, begin);
  after_ = text.substr(end);
  root_ = SplitJson(text.substr(begin, end - begin));
  root_row_ = meaning;
  for (const JsonPiece& piece : root_->pieces) {
    const std::string key = piece.KeyName();
    const auto listed = lists_.find(key);
    if (listed == lists_.end()) continue;
    CheckRows(listed->second, meaning[key], text);
    LoadList(listed->second, piece.value, meaning[key]);
    root_row_.removeMember(key);
  }
}

void JsonSurveyText::CheckRows(const Listed& listed, const Json::Value& meaning,
                               const std::string& text) const {
  const auto fault = [&](const Json::Value& value, const std::string& message) {
    return InputError(path_, LineOfOffset(text, value.getOffsetStart()),
                      "\"" + listed.table.member + "\" " + message);
  };
  const bool is_members = listed.table.form == TableForm::kMembers;
  if (meaning.isNull()) return;
  if (is_members ? !meaning.isObject() : !meaning.isArray()) {
    throw fault(meaning, is_members ? "expected an object" : "expected an array");
  }
  for (auto item = meaning.begin(); item != meaning.end(); ++item) {
    if (item->isObject() || (is_members && IsRemarkKey(item.name()))) continue;
    throw fault(*item, "holds what is no object, expected objects");
  }
}

void JsonSurveyText::LoadList(Listed& listed, const std::string& value,
                              const Json::Value& meaning) {
  listed.empty = value;
  if (meaning.empty()) return;
  listed.pieces = SplitJson(value);
  Json::ArrayIndex i = 0;
  for (auto piece = listed.pieces.pieces.begin(); piece != listed.pieces.pieces.end(); ++piece) {
    const std::string name = piece->KeyName();
    if (meaning.isObject() && IsRemarkKey(name)) continue;
    const Json::Value& item = meaning.isArray() ? meaning[i++] : meaning[name];
    listed.rows.push_back(RowOfMember(listed.table, name, item));
    AddPlace(listed, piece, std::prev(listed.rows.end()));
  }
}

void JsonSurveyText::AddPlace(Listed& listed, Pieces::iterator piece,
                              std::list<Json::Value>::iterator row) {
  listed.places.emplace(KeyOfRow(listed.table, *row), Listed::Place{piece, row});
}

void JsonSurveyText::RemovePlace(Listed& listed, const Listed::Place& place) {
  const auto [begin, end] = listed.places.equal_range(KeyOfRow(listed.table, *place.row));
  for (auto entry = begin; entry != end; ++entry) {
    if (entry->second.row != place.row) continue;
    listed.places.erase(entry);
    return;
  }
}

std::optional<JsonSurveyText::Listed::Place> JsonSurveyText::FindPlace(const Listed& listed,
                                                                       const Json::Value& row,
                                                                       bool exactly) {
  const auto [begin, end] = listed.places.equal_range(KeyOfRow(listed.table, row));
  for (auto place = begin; place != end; ++place) {
    if (IsSameRow(listed.table, *place->second.row, row)) return place->second;
  }
  if (exactly || begin == end) return std::nullopt;
  return begin->second;
}

std::string JsonSurveyText::text() const {
  if (!root_) return "";
  JsonPieces root = *root_;
  for (JsonPiece& piece : root.pieces) {
    const auto listed = lists_.find(piece.KeyName());
    if (listed == lists_.end()) continue;
    const bool is_empty = listed->second.rows.empty();
    piece.value = is_empty ? listed->second.empty : listed->second.pieces.text();
  }
  return before_ + root.text() + after_;
}

std::vector<const Json::Value*> JsonSurveyText::Rows(const EditedTable& table) const {
  std::vector<const Json::Value*> rows;
  if (table.form == TableForm::kRoot) {
    if (!root_row_.empty()) rows.push_back(&root_row_);
    return rows;
  }
  for (const Json::Value& row : lists_.at(table.member).rows) rows.push_back(&row);
  return rows;
}

const Json::Value* JsonSurveyText::Find(const EditedTable& table, const Json::Value& row) const {
  if (table.form == TableForm::kRoot) return root_row_.empty() ? nullptr : &root_row_;
  const auto place = FindPlace(lists_.at(table.member), row, false);
  return place ? &*place->row : nullptr;
}

bool JsonSurveyText::CanHold(const EditedTable& table, const std::string& field) const {
  return table.form != TableForm::kRoot || !lists_.contains(field);
}

Json::Value JsonSurveyText::Edit(const EditedTable& table, const Json::Value& before,
                                 const Json::Value& after, const Json::Value& trace) {
  if (table.form == TableForm::kRoot) return EditRoot(table, after, trace);
  Listed& listed = lists_.at(table.member);
  if (before.isNull()) return after.isNull() ? Json::Value() : Insert(listed, after, trace);
  const auto place = FindPlace(listed, before, true);
  INSITU_CHECK(place.has_value());
  return after.isNull() ? Erase(listed, *place, trace) : Change(listed, *place, after, trace);
}

// The file's text before, if it had nothing to be kept.
Json::Value JsonSurveyText::MakeRoot() {
  Json::Value taken(Json::objectValue);
  if (root_ && !root_->pieces.empty()) return taken;
  taken["text"] = text();
  if (!root_) {
    root_ = JsonPieces{'{'};
    after_ = "\n";
  }
  root_->tail = "\n";
  return taken;
}

Json::Value JsonSurveyText::EditRoot(const EditedTable& table, const Json::Value& after,
                                     const Json::Value& trace) {
  Json::Value taken = MakeRoot();
  JsonManner manner = MannerOf(*root_);
  if (root_->pieces.empty()) manner = {"\n ", "\n ", "\n"};
  const Json::Value wanted = after.isNull() ? Json::Value(Json::objectValue) : after;
  taken["members"] = UpdateMembers(*root_, root_row_, wanted, trace["members"], manner,
                                   {"", " ", ""}, table.columns);
  root_row_ = wanted;
  if (root_->pieces.empty() && trace.isMember("text")) Load(trace["text"].asString());
  return taken;
}

// The manner of what stands `depth` levels below the root.
JsonManner JsonSurveyText::ItemManner(const Listed&, int depth) const {
  const JsonManner root = MannerOf(*root_);
  if (root.first.find('\n') == std::string::npos) return {"", " ", "", root.colon};
  const std::string lead = Deeper(root.first, depth);
  return {lead, lead, Deeper(root.first, depth - 1), root.colon};
}

JsonPiece JsonSurveyText::NewPiece(const Listed& listed, const Json::Value& row) const {
  const bool has_sample = !listed.rows.empty();
  const JsonManner items = has_sample ? MannerOf(listed.pieces) : ItemManner(listed, 2);
  JsonManner manner = ItemManner(listed, 3), arrays{"", " ", ""};
  std::vector<std::string> order = listed.table.columns;
  if (has_sample) {
    const JsonPieces sample = SplitJson(listed.pieces.pieces.back().value);
    if (!sample.pieces.empty()) manner = MannerOf(sample);
    order.clear();
    for (const JsonPiece& piece : sample.pieces) {
      order.push_back(piece.KeyName());
      if (piece.value[0] == '[' && piece.value.size() > 2)
        arrays = MannerOf(SplitJson(piece.value));
    }
    order.insert(order.end(), listed.table.columns.begin(), listed.table.columns.end());
  }
  const bool is_member = listed.table.form == TableForm::kMembers;
  return {has_sample ? items.next : items.first,
          is_member ? OneLineJson(row["name"]) + items.colon : "",
          NewObject(BodyOf(listed.table, row), manner, arrays, order), ""};
}

// Gives the root a member for a list, or takes it away.
void JsonSurveyText::SyncMember(const Listed& listed) {
  const std::string& member = listed.table.member;
  const bool is_wanted = !listed.rows.empty() || !listed.empty.empty();
  const auto has_name = [&](const JsonPiece& piece) { return piece.KeyName() == member; };
  const auto piece = std::find_if(root_->pieces.begin(), root_->pieces.end(), has_name);
  if (is_wanted == (piece != root_->pieces.end())) return;
  if (!is_wanted) {
    root_->TakeOut(piece);
    return;
  }
  const JsonManner manner =
      root_->pieces.empty() ? JsonManner{"\n ", "\n ", "\n"} : MannerOf(*root_);
  root_->pieces.push_back({root_->pieces.empty() ? manner.first : manner.next,
                           OneLineJson(Json::Value(member)) + manner.colon, "", ""});
}

Json::Value JsonSurveyText::Insert(Listed& listed, const Json::Value& after,
                                   const Json::Value& trace) {
  Json::Value taken = MakeRoot();
  auto& pieces = listed.pieces.pieces;
  const bool is_first = listed.rows.empty();
  if (is_first) {
    taken["list"] = listed.empty;
    if (listed.empty.empty()) listed.empty = BracketsOf(listed.table);
    SyncMember(listed);
    listed.pieces = JsonPieces{BracketsOf(listed.table)[0]};
  }
  const auto means_the_same = [&](const std::string& value) {
    return IsSameValue(ParseJson(path_, value), BodyOf(listed.table, after));
  };
  auto piece = pieces.end();
  if (is_first && trace.isMember("list")) {
    JsonPieces was = SplitJson(trace["list"].asString());
    if (was.pieces.size() == 1 && means_the_same(was.pieces.front().value)) {
      listed.pieces = std::move(was);
      piece = pieces.begin();
    }
  } else if (trace.isMember("value") && means_the_same(trace["value"].asString())) {
    piece = listed.pieces.PutBack(trace);
  }
  if (piece == pieces.end()) {
    piece = pieces.insert(pieces.end(), NewPiece(listed, after));
    if (is_first) listed.pieces.tail = ItemManner(listed, 2).tail;
  }
  const auto at = std::distance(pieces.begin(), piece);
  const auto row = listed.rows.insert(std::next(listed.rows.begin(), at), after);
  AddPlace(listed, piece, row);
  return taken;
}

Json::Value JsonSurveyText::Erase(Listed& listed, Listed::Place place, const Json::Value& trace) {
  Json::Value taken(Json::objectValue);
  const bool is_last = listed.rows.size() == 1;
  if (is_last) taken["list"] = listed.pieces.text();
  RemovePlace(listed, place);
  listed.rows.erase(place.row);
  Json::Value piece = listed.pieces.TakeOut(place.piece);
  if (!is_last) return piece;
  listed.empty = listed.table.is_null_when_empty ? "null" : BracketsOf(listed.table);
  if (trace.isMember("list")) listed.empty = trace["list"].asString();
  SyncMember(listed);
  if (trace.isMember("text") && root_->pieces.empty()) Load(trace["text"].asString());
  return taken;
}

Json::Value JsonSurveyText::Change(Listed& listed, Listed::Place place, const Json::Value& after,
                                   const Json::Value& trace) {
  Json::Value taken(Json::objectValue);
  taken["value"] = place.piece->value;
  taken["key"] = place.piece->key;
  const EditedTable& table = listed.table;
  const bool is_renamed = !IsSameValue((*place.row)["name"], after["name"]);
  if (table.form == TableForm::kMembers && is_renamed) {
    const std::string colon = MannerOf(listed.pieces).colon;
    place.piece->key =
        trace.isMember("key") ? trace["key"].asString() : OneLineJson(after["name"]) + colon;
  }
  const Json::Value body = BodyOf(table, after);
  const std::string was = trace["value"].asString();
  const bool is_as_it_was = !was.empty() && IsSameValue(ParseJson(path_, was), body);
  place.piece->value =
      is_as_it_was ? was : RewrittenJson(place.piece->value, BodyOf(table, *place.row), body);
  RemovePlace(listed, place);
  *place.row = after;
  AddPlace(listed, place.piece, place.row);
  return taken;
}

}  // namespace insitu
