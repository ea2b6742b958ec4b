// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_json.h"

#include <cmath>
#include <limits>

namespace insitu {

const Json::Value& MemberOf(const Json::Value& value, const char* name) {
  static const Json::Value kNull;
  return value.isObject() ? value[name] : kNull;
}

const Json::Value& ExtensionOf(const Json::Value& value, const char* name) {
  return MemberOf(MemberOf(value, "extensions"), name);
}

double NumberOf(const Json::Value& value, const char* name, double other) {
  const Json::Value& number = MemberOf(value, name);
  if (!number.isNumeric() || !std::isfinite(number.asDouble())) return other;
  return number.asDouble();
}

std::optional<int> IndexOf(const Json::Value& value, const char* name) {
  const double number = NumberOf(value, name, -1);
  if (number < 0 || number > std::numeric_limits<int>::max() || number != std::floor(number)) {
    return std::nullopt;
  }
  return static_cast<int>(number);
}

std::string TextOf(const Json::Value& value, const char* name) {
  const Json::Value& text = MemberOf(value, name);
  return text.isString() ? text.asString() : "";
}

std::optional<Eigen::VectorXd> NumbersOf(const Json::Value& value, const char* name, int size) {
  const Json::Value& array = MemberOf(value, name);
  if (!array.isArray() || static_cast<int>(array.size()) < size) return std::nullopt;
  Eigen::VectorXd numbers(size);
  for (int i = 0; i < size; ++i) {
    if (!array[i].isNumeric() || !std::isfinite(array[i].asDouble())) return std::nullopt;
    numbers[i] = array[i].asDouble();
  }
  return numbers;
}

std::vector<std::string> TextsOf(const Json::Value& value, const char* name) {
  const Json::Value& array = MemberOf(value, name);
  std::vector<std::string> texts;
  if (!array.isArray()) return texts;
  for (const Json::Value& text : array) {
    if (text.isString()) texts.push_back(text.asString());
  }
  return texts;
}

}  // namespace insitu
