// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/sentence.h"

#include <utility>

namespace insitu {
namespace {

std::string TextOf(const Json::Value& value) {
  return value.isObject() ? value["text"].asString() : value.asString();
}

// Values are not looked at for places of others.
std::string Filled(const std::string& english, const Sentence::Values& values) {
  std::string filled;
  size_t places = 0, from = 0;
  for (size_t open; (open = english.find('{', from)) != std::string::npos;) {
    const size_t close = english.find('}', open);
    INSITU_CHECK(close != std::string::npos);
    const auto value = values.find(english.substr(open + 1, close - open - 1));
    INSITU_CHECK(value != values.end());
    filled += english.substr(from, open - from) + TextOf(value->second);
    from = close + 1;
    ++places;
  }
  INSITU_CHECK(places >= values.size());
  return filled + english.substr(from);
}

}  // namespace

Sentence::Sentence(const std::string& key, const std::string& english, const Values& values)
    : text_(Filled(english, values)) {
  said_["key"] = key;
  said_["values"] = Json::Value(Json::objectValue);
  for (const auto& [name, value] : values) said_["values"][name] = value;
}

Sentence Sentence::Verbatim(std::string text) {
  Sentence sentence;
  sentence.text_ = std::move(text);
  return sentence;
}

Sentence Sentence::SaidIn(const Json::Value& object, const std::string& member) {
  Sentence sentence = Verbatim(object[member].asString());
  sentence.said_ = object[member + "_said"];
  return sentence;
}

Json::Value Sentence::ToJson() const {
  Json::Value json;
  SayIn(&json, "text");
  return json;
}

void Sentence::SayIn(Json::Value* object, const std::string& member) const {
  (*object)[member] = text_;
  if (!said_.isNull()) (*object)[member + "_said"] = said_;
}

std::vector<std::string> TextsOf(const std::vector<Sentence>& sentences) {
  std::vector<std::string> texts;
  for (const Sentence& sentence : sentences) texts.push_back(sentence.text());
  return texts;
}

SaidError::SaidError(const InputError& english, const FilePlace& place, const Sentence& message)
    : InputError(english) {
  const std::string line = place.line > 0 ? ":" + std::to_string(place.line) : "";
  Json::Value said =
      Sentence("atPlace", "{place}: {message}",
               {{"place", place.path.filename().string() + line}, {"message", message.ToJson()}})
          .ToJson();
  said["text"] = english.what();
  sentence_ = Sentence::SaidIn(said, "text");
}

Sentence SentenceOf(const std::exception& error) {
  const auto* said = dynamic_cast<const SaidError*>(&error);
  return said ? said->sentence() : Sentence::Verbatim(error.what());
}

}  // namespace insitu
