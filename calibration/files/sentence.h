// SPDX-License-Identifier: GPL-3.0-or-later
// What a program has to say, in English for the terminal and by a key for pages in other languages.
#pragma once

#include <json/value.h>

#include <map>
#include <string>

namespace insitu {

// In `english`, {name} stands for the value of that name: a text, a number or another sentence.
// scripts/check_pages reads keys and English texts out of the sources, so that both are written
// where they are used, as literals.
class Sentence {
 public:
  using Values = std::map<std::string, Json::Value>;

  Sentence() = default;
  Sentence(const std::string& key, const std::string& english, const Values& values = {});

  // A text that is passed on as it is: what a file's reader says, a name.
  static Sentence Verbatim(std::string text);

  const std::string& text() const { return text_; }
  bool empty() const { return text_.empty(); }

  // {text, text_said}, as a value of another sentence, or alone in a list.
  Json::Value ToJson() const;
  // object[member] = text, object[member_said] = {key, values} unless it is verbatim.
  void SayIn(Json::Value* object, const std::string& member) const;

 private:
  std::string text_;
  Json::Value said_;
};

}  // namespace insitu
