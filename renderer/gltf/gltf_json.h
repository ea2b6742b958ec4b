// SPDX-License-Identifier: GPL-3.0-or-later
// Values of glTF's JSON, whatever stands in their place: what is of another kind is not there.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace insitu {

// A member of an object; null: not there.
const Json::Value& MemberOf(const Json::Value& value, const char* name);

// value.extensions.NAME; null: not there.
const Json::Value& ExtensionOf(const Json::Value& value, const char* name);

// Finite, or `other`.
double NumberOf(const Json::Value& value, const char* name, double other);

// An index or count: whole, 0 to 2^31 - 1.
std::optional<int> IndexOf(const Json::Value& value, const char* name);

std::string TextOf(const Json::Value& value, const char* name);  // or empty

// An array of at least `size` finite numbers, the first `size` of them; nullopt: none such.
std::optional<Eigen::VectorXd> NumbersOf(const Json::Value& value, const char* name, int size);

// The texts of an array.
std::vector<std::string> TextsOf(const Json::Value& value, const char* name);

}  // namespace insitu
