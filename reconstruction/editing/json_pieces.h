// SPDX-License-Identifier: GPL-3.0-or-later
// An array or object of a JSON text, cut into pieces that give the text back byte for byte, and
// changed piece by piece in the manner in which the file is written.
#pragma once

#include <json/value.h>

#include <list>
#include <string>
#include <vector>

namespace insitu {

struct JsonPiece {
  std::string lead;   // blanks before it
  std::string key;    // of an object's member: the quoted key, blanks and colon; else ""
  std::string value;  // as it stands
  std::string trail;  // blanks before the comma
  std::string KeyName() const;
};

struct JsonPieces {
  char open = '{';
  std::list<JsonPiece> pieces = {};
  std::string tail = {};  // blanks before the closing bracket

  std::string text() const;
  JsonPiece* Find(const std::string& key);

  // Takes a piece out so that the others keep their manner. What is returned brings it back by
  // PutBack, if nothing else was changed meanwhile.
  Json::Value TakeOut(std::list<JsonPiece>::iterator piece);
  std::list<JsonPiece>::iterator PutBack(const Json::Value& taken);
};

// Of a text that is known to be valid JSON and an array or object.
JsonPieces SplitJson(const std::string& text);

// The manner of an array or object: blanks before the first piece, the others and the end.
struct JsonManner {
  std::string first, next, tail, colon = ": ";
};
JsonManner MannerOf(const JsonPieces& sample);

// A new object in that manner, its keys in that order, then in the alphabet's. Arrays in it follow
// the manner of arrays.
std::string NewObject(const Json::Value& value, const JsonManner& manner, const JsonManner& arrays,
                      const std::vector<std::string>& order);

// The text of a value that meant `before`, made to mean `after`; what is the same in both stays.
std::string RewrittenJson(const std::string& text, const Json::Value& before,
                          const Json::Value& after);

// The same of an object's members; others than those of `before` and `after` are left alone.
// Returns what UpdateMembers needs as `trace` to take it back byte for byte.
Json::Value UpdateMembers(JsonPieces& object, const Json::Value& before, const Json::Value& after,
                          const Json::Value& trace, const JsonManner& manner,
                          const JsonManner& arrays, const std::vector<std::string>& order);

}  // namespace insitu
