// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of a material that may stand on an entry of a library.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/files/json_file.h"

namespace insitu {

// Entries over each other: a key counts where it is found first. Errors name the file and line of
// the value at fault, or else those of the uppermost entry.
class MaterialKeys {
 public:
  MaterialKeys(const JsonNode& uppermost) : entries_{uppermost} {}  // NOLINT: an entry is its keys

  // `lower` goes below those that are there.
  void PutBelow(const MaterialKeys& lower);

  std::optional<JsonNode> Find(const std::string& key) const;  // nullopt: in none, or null
  JsonNode At(const std::string& key) const;                   // throws InputError: in none

  // The uppermost entry that has one of these keys, of which no lower one counts then.
  std::optional<JsonNode> WithAnyOf(const std::vector<std::string>& keys) const;

  InputError Error(const std::string& message) const { return entries_.front().Error(message); }

 private:
  std::vector<JsonNode> entries_;
};

}  // namespace insitu
