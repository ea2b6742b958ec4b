// SPDX-License-Identifier: GPL-3.0-or-later
// What a program has to say, in English for the terminal and by a key for pages in other languages.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "calibration/files/error.h"

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
  // What SayIn wrote.
  static Sentence SaidIn(const Json::Value& object, const std::string& member);

 private:
  std::string text_;
  Json::Value said_;
};

std::vector<std::string> TextsOf(const std::vector<Sentence>& sentences);

// Bad input that pages word in their language; what() is `english`.what().
class SaidError : public InputError {
 public:
  SaidError(const InputError& english, const FilePlace& place, const Sentence& message);
  const Sentence& sentence() const { return sentence_; }

 private:
  Sentence sentence_;
};

// What an error says: its sentence, else its text verbatim.
Sentence SentenceOf(const std::exception& error);

}  // namespace insitu
