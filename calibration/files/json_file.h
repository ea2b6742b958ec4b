// SPDX-License-Identifier: GPL-3.0-or-later
// Reading JSON so that every fault can name its file and line, and writing it whole or not at all.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {

// Keys that every object of a JSON file may have and no reader takes for its own: what people and
// their editors note.
inline bool IsRemarkKey(std::string_view key) { return key == "comment" || key == "$schema"; }

// One value of a JSON file. Every accessor throws InputError, at the value's line, when the value
// is not what is asked for.
class JsonNode {
 public:
  static JsonNode Load(const std::filesystem::path& path);

  JsonNode At(const std::string& key) const;                      // must exist, must not be null
  std::optional<JsonNode> Find(const std::string& key) const;     // nullopt if absent or null
  std::vector<JsonNode> Items() const;                            // of an array
  std::vector<std::pair<std::string, JsonNode>> Members() const;  // by key; no remarks

  double Number() const;  // finite
  int Integer() const;
  bool Boolean() const;
  std::string Text() const;
  std::vector<double> Numbers() const;
  std::vector<std::string> Texts() const;
  Eigen::Vector3d Vector3() const;
  Eigen::MatrixXd Matrix() const;  // array of rows of equal length
  bool IsNull() const;             // an item may be; Find and At have no node for null

  // An error about this value, to be thrown.
  InputError Error(const std::string& message) const;
  const std::filesystem::path& path() const;
  int line() const;

 private:
  struct Document;
  JsonNode(std::shared_ptr<const Document> document, const Json::Value* value, std::string place)
      : document_(std::move(document)), value_(value), place_(std::move(place)) {}
  std::shared_ptr<const Document> document_;
  const Json::Value* value_;
  std::string place_;  // e.g. "haze[2].pixel", for messages
};

Json::Value ToJson(const Eigen::VectorXd& vector);
Json::Value ToJson(const Eigen::Vector3d& vector);
Json::Value ToJson(const Eigen::MatrixXd& matrix);  // array of rows

// A whole file as it is, for what is only passed on. Throws InputError, at its line.
Json::Value ReadJson(const std::filesystem::path& path);

// The same of a text that was read already; `path` is for messages.
Json::Value ParseJson(const std::filesystem::path& path, const std::string& text);

// Indented, 17 digits; temporary file, then rename.
void WriteJson(const std::filesystem::path& path, const Json::Value& value);

}  // namespace insitu
