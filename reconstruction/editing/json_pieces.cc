// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/json_pieces.h"

#include <algorithm>
#include <iterator>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "reconstruction/editing/edited_tables.h"

namespace insitu {
namespace {

constexpr const char* kJsonBlanks = " \t\r\n";

size_t EndOfString(const std::string& text, size_t quote) {
  size_t at = quote + 1;
  while (text[at] != '"') at += text[at] == '\\' ? 2 : 1;
  return at + 1;
}

// Behind the value that begins at `at`.
size_t EndOfValue(const std::string& text, size_t at) {
  int depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      at = EndOfString(text, at);
      continue;
    }
    if (c == ']' || c == '}') --depth;
    if (depth < 0 ||
        (depth == 0 && (c == ',' || std::string(kJsonBlanks).find(c) != std::string::npos)))
      break;
    if (c == '[' || c == '{') ++depth;
    ++at;
  }
  return at;
}

std::string BlanksAt(const std::string& text, size_t at) {
  return text.substr(at, text.find_first_not_of(kJsonBlanks, at) - at);
}

JsonPiece PieceOfJson(const Json::Value& taken) {
  return {taken["lead"].asString(), taken["key"].asString(), taken["value"].asString(),
          taken["trail"].asString()};
}

Json::Value MeaningOfText(const std::string& text) {
  return ParseJson("json", "[" + text + "]")[0];
}

const Json::Value& MemberOf(const Json::Value& object, const std::string& key) {
  const Json::Value* member =
      object.isObject() ? object.find(key.data(), key.data() + key.size()) : nullptr;
  return member ? *member : Json::Value::nullSingleton();
}

std::string NewArray(const Json::Value& value, const JsonManner& manner) {
  std::string text;
  for (const Json::Value& item : value) {
    text += text.empty() ? manner.first : "," + manner.next;
    text += OneLineJson(item);
  }
  return text.empty() ? "[]" : "[" + text + manner.tail + "]";
}

std::string NewValue(const Json::Value& value, const JsonManner& arrays) {
  const bool is_flat =
      value.isArray() && std::none_of(value.begin(), value.end(), [](const Json::Value& item) {
        return item.isArray() || item.isObject();
      });
  return is_flat ? NewArray(value, arrays) : OneLineJson(value);
}

std::string RewrittenArray(const std::string& text, const Json::Value& before,
                           const Json::Value& after) {
  JsonPieces array = SplitJson(text);
  const JsonManner manner = MannerOf(array);
  array.pieces.resize(std::min<size_t>(array.pieces.size(), after.size()));
  Json::ArrayIndex i = 0;
  for (JsonPiece& piece : array.pieces) {
    piece.value = RewrittenJson(piece.value, before[i], after[i]);
    ++i;
  }
  for (; i < after.size(); ++i) {
    array.pieces.push_back({i == 0 ? manner.first : manner.next, "", OneLineJson(after[i]), ""});
  }
  if (array.pieces.empty()) array.tail.clear();
  return array.text();
}

std::vector<std::string> KeysInOrder(const Json::Value& object,
                                     const std::vector<std::string>& order) {
  std::vector<std::string> keys;
  for (const std::string& key : order) {
    if (object.isMember(key) && std::find(keys.begin(), keys.end(), key) == keys.end()) {
      keys.push_back(key);
    }
  }
  for (const std::string& key : object.getMemberNames()) {
    if (std::find(order.begin(), order.end(), key) == order.end()) keys.push_back(key);
  }
  return keys;
}

// Those that UpdateMembers took out, the last one first, so that each finds its neighbours.
void PutBackMembers(JsonPieces& object, const Json::Value& after, const Json::Value& trace) {
  std::vector<Json::Value> taken;
  if (!trace.isObject()) return;
  for (const std::string& key : trace.getMemberNames()) {
    const Json::Value& piece = trace[key];
    const bool is_wanted =
        piece.isMember("turn") && !object.Find(key) &&
        IsSameValue(MeaningOfText(piece["value"].asString()), MemberOf(after, key));
    if (is_wanted) taken.push_back(piece);
  }
  std::sort(taken.begin(), taken.end(), [](const Json::Value& a, const Json::Value& b) {
    return a["turn"].asUInt() > b["turn"].asUInt();
  });
  for (const Json::Value& piece : taken) object.PutBack(piece);
}

}  // namespace

std::string JsonPiece::KeyName() const {
  if (key.empty()) return "";
  return MeaningOfText(key.substr(0, EndOfString(key, 0))).asString();
}

std::string JsonPieces::text() const {
  std::string text(1, open);
  bool is_first = true;
  for (const JsonPiece& piece : pieces) {
    if (!is_first) text += ',';
    is_first = false;
    text.append(piece.lead).append(piece.key).append(piece.value).append(piece.trail);
  }
  return text + tail + (open == '[' ? ']' : '}');
}

JsonPiece* JsonPieces::Find(const std::string& key) {
  for (JsonPiece& piece : pieces) {
    if (piece.KeyName() == key) return &piece;
  }
  return nullptr;
}

Json::Value JsonPieces::TakeOut(std::list<JsonPiece>::iterator piece) {
  Json::Value taken(Json::objectValue);
  taken["at"] = static_cast<Json::UInt>(std::distance(pieces.begin(), piece));
  taken["lead"] = piece->lead;
  taken["key"] = piece->key;
  taken["value"] = piece->value;
  taken["trail"] = piece->trail;
  const auto next = std::next(piece);
  if (next != pieces.end()) taken["next"] = next->lead;
  if (piece == pieces.begin() && next != pieces.end()) next->lead = piece->lead;
  const auto previous = piece == pieces.begin() ? pieces.end() : std::prev(piece);
  if (next == pieces.end() && previous != pieces.end()) {
    taken["previous"] = previous->trail;
    previous->trail.clear();
  }
  pieces.erase(piece);
  return taken;
}

std::list<JsonPiece>::iterator JsonPieces::PutBack(const Json::Value& taken) {
  const auto at = std::min<size_t>(taken["at"].asUInt(), pieces.size());
  const auto next = std::next(pieces.begin(), static_cast<std::ptrdiff_t>(at));
  if (next != pieces.end() && taken.isMember("next")) next->lead = taken["next"].asString();
  if (next == pieces.end() && at > 0 && taken.isMember("previous")) {
    std::prev(next)->trail = taken["previous"].asString();
  }
  return pieces.insert(next, PieceOfJson(taken));
}

JsonPieces SplitJson(const std::string& text) {
  JsonPieces split{text[0]};
  const size_t last = text.size() - 1;
  size_t at = 1;
  while (true) {
    JsonPiece piece;
    piece.lead = BlanksAt(text, at);
    at += piece.lead.size();
    if (at == last) {
      split.tail = piece.lead;
      return split;
    }
    const size_t begin = at;
    if (split.open == '{') {
      at = text.find(':', EndOfString(text, at)) + 1;
      at += BlanksAt(text, at).size();
      piece.key = text.substr(begin, at - begin);
    }
    const size_t end = EndOfValue(text, at);
    piece.value = text.substr(at, end - at);
    const std::string blanks = BlanksAt(text, end);
    at = end + blanks.size();
    const bool is_last = at == last;
    (is_last ? split.tail : piece.trail) = blanks;
    split.pieces.push_back(std::move(piece));
    if (is_last) return split;
    ++at;  // the comma
  }
}

JsonManner MannerOf(const JsonPieces& sample) {
  if (sample.pieces.empty()) return {"", " ", ""};
  JsonManner manner;
  const JsonPiece& first = sample.pieces.front();
  manner.first = first.lead;
  manner.next = first.lead.empty() ? " " : first.lead;
  if (sample.pieces.size() > 1) manner.next = std::next(sample.pieces.begin())->lead;
  manner.tail = sample.tail;
  if (!first.key.empty()) manner.colon = first.key.substr(EndOfString(first.key, 0));
  return manner;
}

std::string NewObject(const Json::Value& value, const JsonManner& manner, const JsonManner& arrays,
                      const std::vector<std::string>& order) {
  JsonPieces object{'{'};
  for (const std::string& key : KeysInOrder(value, order)) {
    object.pieces.push_back({object.pieces.empty() ? manner.first : manner.next,
                             OneLineJson(Json::Value(key)) + manner.colon,
                             NewValue(value[key], arrays), ""});
  }
  if (!object.pieces.empty()) object.tail = manner.tail;
  return object.text();
}

std::string RewrittenJson(const std::string& text, const Json::Value& before,
                          const Json::Value& after) {
  if (IsSameValue(before, after)) return text;
  if (before.isArray() && after.isArray()) return RewrittenArray(text, before, after);
  if (!before.isObject() || !after.isObject()) return OneLineJson(after);
  JsonPieces object = SplitJson(text);
  UpdateMembers(object, before, after, Json::Value(), MannerOf(object), {"", " ", ""}, {});
  return object.text();
}

Json::Value UpdateMembers(JsonPieces& object, const Json::Value& before, const Json::Value& after,
                          const Json::Value& trace, const JsonManner& manner,
                          const JsonManner& arrays, const std::vector<std::string>& order) {
  Json::Value taken(Json::objectValue);
  for (auto piece = object.pieces.begin(); piece != object.pieces.end();) {
    const auto next = std::next(piece);
    const std::string key = piece->KeyName();
    const Json::Value& was = MemberOf(before, key);
    const Json::Value& wanted = MemberOf(after, key);
    if (wanted.isNull() && !was.isNull()) {
      const Json::ArrayIndex turn = taken.size();
      (taken[key] = object.TakeOut(piece))["turn"] = turn;
    } else if (before.isObject() && before.isMember(key) && !IsSameValue(was, wanted)) {
      taken[key]["value"] = piece->value;
      const Json::Value& old = MemberOf(MemberOf(trace, key), "value");
      const bool is_old = old.isString() && IsSameValue(MeaningOfText(old.asString()), wanted);
      piece->value = is_old ? old.asString() : RewrittenJson(piece->value, was, wanted);
    }
    piece = next;
  }
  PutBackMembers(object, after, trace);
  for (const std::string& key : KeysInOrder(after, order)) {
    if (after[key].isNull() || object.Find(key)) continue;
    const bool is_first = object.pieces.empty();
    object.pieces.push_back({is_first ? manner.first : manner.next,
                             OneLineJson(Json::Value(key)) + manner.colon,
                             NewValue(after[key], arrays), ""});
    if (is_first) object.tail = manner.tail;
  }
  return taken;
}

}  // namespace insitu
