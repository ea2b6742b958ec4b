// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/layers/layer_names.h"

#include <algorithm>
#include <set>

#include "calibration/files/error.h"

namespace insitu {

const std::vector<std::string>& SummedLayers() {
  static const std::vector<std::string> names = {
      "photo",
      "building_sun",
      "building_sky",
      "building_surroundings",
      "building_lamps",
      "building_reflection",
      "building_transmission",
      "building_haze",
      "sun_blocked",
      "sky_blocked",
      "surroundings_blocked",
      "bounced_light",
      "change_lamps",
      "change_reflection",
      "grain",
  };
  return names;
}

const std::vector<std::string>& LayerNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {kMontageLayer};
    all.insert(all.end(), SummedLayers().begin(), SummedLayers().end());
    all.insert(all.end(), {kRestLayer, kRestFineLayer});
    all.insert(all.end(), {"coverage", "depth", "normal", "object", "material", "uncertainty"});
    return all;
  }();
  return names;
}

std::vector<std::string> ChosenLayers(const std::string& text) {
  if (text == "all") return LayerNames();
  std::set<std::string> wanted;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    wanted.insert(text.substr(at, end - at));
    at = end + 1;
  }
  if (std::ranges::any_of(SummedLayers(),
                          [&](const auto& name) { return wanted.contains(name); })) {
    wanted.insert({kRestLayer, kRestFineLayer});
  }
  std::string known;
  std::vector<std::string> chosen;
  for (const std::string& name : LayerNames()) {
    known += ", " + name;
    if (wanted.erase(name) > 0) chosen.push_back(name);
  }
  if (wanted.empty()) return chosen;
  throw InputError("--layers",
                   "there is no layer \"" + *wanted.begin() + "\", expected all" + known);
}

std::string SumText(const std::vector<std::string>& chosen) {
  std::string text;
  for (const std::string& name : chosen) {
    const bool is_summed = name == kRestLayer || name == kRestFineLayer ||
                           std::ranges::count(SummedLayers(), name) > 0;
    if (!is_summed) continue;
    text += text.empty() ? std::string(kMontageLayer) + " = " : " + ";
    text += name;
  }
  return text;
}

}  // namespace insitu
