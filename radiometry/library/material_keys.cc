// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/library/material_keys.h"

#include <algorithm>

namespace insitu {

void MaterialKeys::PutBelow(const MaterialKeys& lower) {
  entries_.insert(entries_.end(), lower.entries_.begin(), lower.entries_.end());
}

std::optional<JsonNode> MaterialKeys::Find(const std::string& key) const {
  for (const JsonNode& entry : entries_) {
    if (auto found = entry.Find(key)) return found;
  }
  return std::nullopt;
}

JsonNode MaterialKeys::At(const std::string& key) const {
  const auto found = Find(key);
  return found ? *found : entries_.front().At(key);
}

std::optional<JsonNode> MaterialKeys::WithAnyOf(const std::vector<std::string>& keys) const {
  for (const JsonNode& entry : entries_) {
    const auto has = [&](const std::string& key) { return entry.Find(key).has_value(); };
    if (std::ranges::any_of(keys, has)) return entry;
  }
  return std::nullopt;
}

}  // namespace insitu
