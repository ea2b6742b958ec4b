// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/batch_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "radiometry/light/simulated_daylight.h"
#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBuilding = "building", kMeasured = "measured";
const std::vector<std::string> kPlanQualities = {"fast", "draft", "final", "avr0", "avr1", "avr2"};
// What the jobs say themselves.
const std::vector<std::string> kJobsOptions = {
    "--photo", "--variant", "--hour",   "--quality",       "--beside",
    "--avr",   "--threads", "--stream", "--stream-base64", "--tev"};

void RequireKnownKeys(const JsonNode& node, const std::set<std::string>& known) {
  for (const auto& [key, value] : node.Members()) {
    if (known.contains(key)) continue;
    throw value.Error("is no key of a plan, expected " + QuotedList({known.begin(), known.end()}));
  }
}

// The items of a list that is not empty and names nothing twice; `otherwise` where it is missing.
std::vector<std::string> NamesIn(const JsonNode& plan, const std::string& key,
                                 const std::vector<std::string>& otherwise) {
  const auto list = plan.Find(key);
  if (!list) return otherwise;
  std::vector<std::string> names;
  for (const JsonNode& item : list->Items()) {
    names.push_back(item.Text());
    if (std::count(names.begin(), names.end(), names.back()) > 1) {
      throw item.Error("is " + Quoted(names.back()) + ", named twice, expected each once");
    }
  }
  if (names.empty()) throw list->Error("is empty, expected one name or more, or no such key");
  return names;
}

// All of a few names, the first of many.
std::string NamesText(const std::vector<std::string>& names) {
  constexpr size_t kFew = 8;
  if (names.size() > kFew) return QuotedList(names);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Throws InputError at the item that is not among `known`.
void RequireAmong(const JsonNode& plan, const std::string& key, const std::string& what,
                  const std::vector<std::string>& known) {
  const auto list = plan.Find(key);
  if (!list) return;
  for (const JsonNode& item : list->Items()) {
    if (std::find(known.begin(), known.end(), item.Text()) != known.end()) continue;
    throw item.Error("is " + Quoted(item.Text()) + ", no " + what + ", expected one of " +
                     NamesText(known));
  }
}

SitePaths SiteOf(const JsonNode& plan, const fs::path& file) {
  const auto node = plan.Find("site");
  fs::path root = file.parent_path().empty() ? "." : file.parent_path();
  if (node) root = (root / node->Text()).lexically_normal();
  SitePaths site{.root = root};
  if (fs::is_directory(site.photos())) return site;
  const std::string fault = "which is no site's folder (it has no photos/)";
  if (node) {
    throw node->Error("is " + root.string() + ", " + fault + ", expected one, from the plan's");
  }
  throw InputError(file, "lies in " + root.string() + ", " + fault +
                             ", expected it there, or \"site\" to name one");
}

std::vector<std::string> NamesOfPhotographs(const SitePaths& site) {
  std::vector<std::string> names;
  for (const fs::path& photo : ListPhotographs(site)) names.push_back(photo.stem().string());
  return names;
}

std::vector<std::string> NamesOfVariants(const SitePaths& site) {
  std::vector<std::string> names = {std::string(kBuilding)};
  if (!fs::is_directory(site.variants())) return names;
  for (const fs::directory_entry& entry : fs::directory_iterator(site.variants())) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && !name.starts_with('.')) names.push_back(name);
  }
  std::sort(names.begin() + 1, names.end());
  return names;
}

PlannedHour HourOf(const JsonNode& node, bool is_text) {
  PlannedHour hour;
  if (is_text) {
    if (node.Text() != kMeasured) hour.request.time = node.Text();
    return hour;
  }
  RequireKnownKeys(node, {"azimuth_deg", "elevation_deg"});
  const JsonNode azimuth = node.At("azimuth_deg"), elevation = node.At("elevation_deg");
  hour.request.sun = SunPosition{azimuth.Number() * kDegree, elevation.Number() * kDegree};
  if (azimuth.Number() < 0 || azimuth.Number() > 360) {
    throw azimuth.Error("is no azimuth, expected 0 to 360, from true north eastwards");
  }
  if (hour.request.sun->elevation < kLowestSimulatedSun || elevation.Number() > 90) {
    throw elevation.Error("is no elevation whose light can be simulated, expected 3 to 90");
  }
  return hour;
}

// By their names, were the photographs taken on no day at all.
std::vector<PlannedHour> HoursIn(const JsonNode& plan, const Json::Value& raw) {
  const auto list = plan.Find("hours");
  if (!list) return {PlannedHour()};
  std::vector<PlannedHour> hours;
  std::set<std::string> names;
  for (const JsonNode& item : list->Items()) {
    const auto i = static_cast<Json::ArrayIndex>(hours.size());
    hours.push_back(HourOf(item, raw["hours"][i].isString()));
    std::string name;
    try {
      if (!hours.back().is_measured()) name = HourName(hours.back().request, "");
    } catch (const InputError&) {
      throw item.Error("is " + Quoted(item.Text()) +
                       ", no time, expected for example 16:30, 2024-12-21T12:00 or measured");
    }
    if (!names.insert(name).second) throw item.Error("is named twice, expected each hour once");
  }
  if (hours.empty()) {
    throw list->Error("is empty, expected \"measured\", times or positions of the sun, or no key");
  }
  return hours;
}

std::vector<std::string> OptionsIn(const JsonNode& plan) {
  const auto list = plan.Find("options");
  if (!list) return {};
  for (const JsonNode& item : list->Items()) {
    const std::string text = item.Text(), name = text.substr(0, text.find('='));
    if (!name.starts_with("--") || std::ranges::find(kJobsOptions, name) != kJobsOptions.end()) {
      throw item.Error("is " + Quoted(text) +
                       ", expected options of insitu-render that the plan does not say otherwise, "
                       "as --OPTION or --OPTION=VALUE");
    }
  }
  return list->Texts();
}

}  // namespace

BatchPlan ReadBatchPlan(const fs::path& file) {
  const JsonNode root = JsonNode::Load(file);
  RequireKnownKeys(root, {"site", "views", "variants", "hours", "qualities", "options"});
  BatchPlan plan;
  plan.file = file;
  plan.site = SiteOf(root, file);
  const std::vector<std::string> photographs = NamesOfPhotographs(plan.site);
  plan.views = NamesIn(root, "views", photographs);
  RequireAmong(root, "views", "photograph", photographs);
  plan.variants = NamesIn(root, "variants", {std::string(kBuilding)});
  RequireAmong(root, "variants", "variant", NamesOfVariants(plan.site));
  std::replace(plan.variants.begin(), plan.variants.end(), std::string(kBuilding), std::string());
  plan.qualities = NamesIn(root, "qualities", {"final"});
  RequireAmong(root, "qualities", "quality", kPlanQualities);
  plan.hours = HoursIn(root, ReadJson(file));
  plan.options = OptionsIn(root);
  return plan;
}

}  // namespace insitu
