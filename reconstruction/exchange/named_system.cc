// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/named_system.h"

#include <proj.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/plain_text.h"
#include "calibration/files/words.h"

namespace insitu {
namespace {

constexpr size_t kMostOffered = 5;

struct EndProjContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, EndProjContext>;

struct EndProjObject {
  void operator()(PJ* object) const { proj_destroy(object); }
};

ProjContext QuietProj() {
  ProjContext context(proj_context_create());
  proj_context_set_enable_network(context.get(), 0);
  proj_log_level(context.get(), PJ_LOG_NONE);
  return context;
}

// Words and numbers apart, small and without accents: "UTM33N" is utm, 33, n.
std::vector<std::string> SystemTokens(const std::string& text) {
  std::vector<std::string> tokens;
  enum class Class { kNone, kLetter, kDigit } last = Class::kNone;
  for (const char c : Folded(text)) {
    const auto letter = static_cast<unsigned char>(c);
    const Class now = std::isdigit(letter)   ? Class::kDigit
                      : std::isalpha(letter) ? Class::kLetter
                                             : Class::kNone;
    if (now != Class::kNone && now != last) tokens.emplace_back();
    if (now != Class::kNone) tokens.back() += c;
    last = now;
  }
  return tokens;
}

std::string JoinedTokens(const std::vector<std::string>& tokens) {
  std::string joined;
  for (const std::string& token : tokens) joined += token;
  return joined;
}

// What people call a system and PROJ does not, or several times.
const std::map<std::string, std::string>& Nicknames() {
  static const std::map<std::string, std::string> names = {
      {"mn95", "EPSG:2056"},         {"ch1903lv95", "EPSG:2056"},
      {"mn03", "EPSG:21781"},        {"lambert93", "EPSG:2154"},
      {"l93", "EPSG:2154"},          {"rgf93lambert93", "EPSG:2154"},
      {"rd", "EPSG:28992"},          {"bng", "EPSG:27700"},
      {"lambert72", "EPSG:31370"},   {"lambert2008", "EPSG:3812"},
      {"wgs84longlat", "EPSG:4326"}, {"wgs84lonlat", "EPSG:4326"},
      {"wgs84latlong", "EPSG:4326"}, {"wgs84latlon", "EPSG:4326"},
      {"longlat", "EPSG:4326"},      {"latlong", "EPSG:4326"},
      {"lonlat", "EPSG:4326"},       {"latlon", "EPSG:4326"},
      {"wgs84", "EPSG:4326"},        {"wgs84geographic", "EPSG:4326"}};
  return names;
}

CoordinateSystem OfCode(const std::string& code) {
  const auto system = CoordinateSystem::FromText(code);
  INSITU_CHECK(system.has_value());
  return *system;
}

NamedSystem Taken(const std::string& text, const CoordinateSystem& system,
                  const std::string& more = "") {
  return {system,
          "\"" + text + "\" is taken for " + system.name() + " (" + system.Code() + ")" + more};
}

std::string UtmCode(const std::string& datum, int zone, bool is_north) {
  const int first = datum == "etrs89" ? 25800 : is_north ? 32600 : 32700;
  return "EPSG:" + std::to_string(first + zone);
}

// "30U", "UTM33N", "WGS84 UTM 17S", "ETRS89 UTM32": a zone with its hemisphere or its band of
// latitude.
std::optional<NamedSystem> UtmByWords(const std::filesystem::path& path, const std::string& text) {
  std::vector<std::string> tokens = SystemTokens(text);
  const bool says_utm = std::erase(tokens, "utm") > 0;
  std::erase(tokens, "zone");
  std::string datum;
  while (tokens.size() > 2) {
    datum += tokens[0];
    tokens.erase(tokens.begin());
  }
  const bool has_letter = tokens.size() == 2 && tokens[1].size() == 1 && std::isalpha(tokens[1][0]);
  if (tokens.size() == 2 && !has_letter) {
    datum += tokens[0];
    tokens.erase(tokens.begin());
  }
  if (tokens.empty() || (!datum.empty() && datum != "wgs84" && datum != "etrs89"))
    return std::nullopt;
  if (!says_utm && !has_letter) return std::nullopt;
  const auto zone = ParseNumber(tokens[0]);
  if (!zone || *zone < 1 || *zone > 60 || tokens[0].size() > 2) return std::nullopt;
  const char band = has_letter ? tokens[1][0] : datum == "etrs89" ? 'n' : ' ';
  const std::string number = std::to_string(static_cast<int>(*zone));
  if (band == ' ' || band < 'c' || band > 'x' || band == 'i' || band == 'o') {
    throw InputError(path, "the coordinate system \"" + text +
                               "\" is a UTM zone without its hemisphere, expected " + number +
                               "N or " + number + "S");
  }
  const bool is_north = band >= 'n' && band != 's';
  const CoordinateSystem system = OfCode(UtmCode(datum, static_cast<int>(*zone), is_north));
  if (band == 's') {
    return Taken(text, system,
                 ", south of the equator; if S is the band from 32 to 40 degrees north, write " +
                     number + "N");
  }
  return Taken(text, system,
               band == 'n' ? ""
                           : std::string(", since band ") + static_cast<char>(std::toupper(band)) +
                                 " lies " + (is_north ? "north" : "south") + " of the equator");
}

// The words of a name, with "gk" for Gauss and Krüger, as some names have it.
std::set<std::string> SystemWords(const std::string& text) {
  const std::vector<std::string> tokens = SystemTokens(text);
  std::set<std::string> words(tokens.begin(), tokens.end());
  const bool has_kruger = words.erase("kruger") + words.erase("krueger") > 0;
  if (has_kruger) {
    words.erase("gauss");
    words.insert("gk");
  }
  return words;
}

struct SystemCandidate {
  std::string code, name;
  size_t excess = 0;   // words of its name that were not said
  size_t missing = 0;  // words said that its name lacks
};

// The projected and geographic systems of EPSG, best first.
std::vector<SystemCandidate> Candidates(const std::set<std::string>& said) {
  const ProjContext context = QuietProj();
  int count = 0;
  PROJ_CRS_INFO** infos =
      proj_get_crs_info_list_from_database(context.get(), "EPSG", nullptr, &count);
  std::vector<SystemCandidate> candidates;
  for (int i = 0; i < count; ++i) {
    const PROJ_CRS_INFO& info = *infos[i];
    if (info.deprecated || info.type != PJ_TYPE_PROJECTED_CRS) continue;
    const std::set<std::string> words = SystemWords(info.name);
    const auto shared = static_cast<size_t>(std::count_if(
        said.begin(), said.end(), [&](const auto& word) { return words.contains(word); }));
    if (shared == 0) continue;
    candidates.push_back(
        {std::string("EPSG:") + info.code, info.name, words.size() - shared, said.size() - shared});
  }
  proj_crs_info_list_destroy(infos);
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return std::pair(a.missing, a.excess) < std::pair(b.missing, b.excess);
  });
  return candidates;
}

std::string Offered(const std::vector<SystemCandidate>& candidates, size_t said) {
  std::string offered;
  for (size_t i = 0; i < std::min(candidates.size(), kMostOffered); ++i) {
    if (2 * candidates[i].missing > said) break;
    offered += (offered.empty() ? "" : ", ") + candidates[i].name + " (" + candidates[i].code + ")";
  }
  return offered;
}

// "25832", "EPSG 25832", "epsg25832": a code without its colon.
std::optional<NamedSystem> CodeByWords(const std::string& text) {
  std::vector<std::string> tokens = SystemTokens(text);
  if (tokens.size() == 2 && tokens[0] == "epsg") tokens.erase(tokens.begin());
  const bool is_code = tokens.size() == 1 && tokens[0].size() >= 4 && tokens[0].size() <= 6 &&
                       std::isdigit(static_cast<unsigned char>(tokens[0][0]));
  if (!is_code || text.find(':') != std::string::npos) return std::nullopt;
  const auto system = CoordinateSystem::FromText("EPSG:" + tokens[0]);
  if (!system) return std::nullopt;
  return Taken(text, *system);
}

// "EPSG:39791798743.39": the line end behind the code is lost.
bool IsGlued(const std::string& text) {
  const size_t digits = text.find_first_of("0123456789");
  if (!Folded(text).starts_with("epsg") || digits == std::string::npos) return false;
  const size_t end = std::min(text.find_first_not_of("0123456789", digits), text.size());
  return end - digits > 6 && end < text.size();
}

}  // namespace

NamedSystem SystemByWords(const std::filesystem::path& path, const std::string& text) {
  if (IsGlued(text)) {
    throw InputError(
        path, "the coordinate system \"" + text.substr(0, 24) +
                  "\" and what follows stand in one line, expected a line end behind the system");
  }
  const auto nickname = Nicknames().find(JoinedTokens(SystemTokens(text)));
  if (nickname != Nicknames().end()) return Taken(text, OfCode(nickname->second));
  if (text.find('+') == std::string::npos && text.find('[') == std::string::npos) {
    if (auto utm = UtmByWords(path, text)) return *utm;
  }
  if (auto code = CodeByWords(text)) return *code;
  if (auto system = CoordinateSystem::FromText(text)) return {*system, ""};
  const std::set<std::string> said = SystemWords(text);
  const bool is_of_words = text.find_first_of("[{=") == std::string::npos && !said.contains("epsg");
  std::vector<SystemCandidate> candidates;
  if (is_of_words) candidates = Candidates(said);
  const bool has_one = !candidates.empty() && candidates[0].missing == 0 &&
                       (candidates.size() == 1 || candidates[1].missing > 0 ||
                        candidates[1].excess > candidates[0].excess);
  if (has_one) return Taken(text, OfCode(candidates[0].code));
  const std::string offered = Offered(candidates, said.size());
  const bool are_several = !candidates.empty() && candidates[0].missing == 0;
  throw InputError(
      path, "the coordinate system \"" + text + "\" " +
                (are_several ? "may be one of several"
                             : "is not known to PROJ as a geographic, projected or local one") +
                ", expected for example EPSG:2056 or WGS84 UTM 32N" +
                (offered.empty() ? "" : "; did you mean " + offered + "?"));
}

double AreaOfUse::Excess(const Eigen::Vector2d& place) const {
  const bool crosses_date_line = west > east;
  double beside = std::max({west - place.x(), place.x() - east, 0.0});
  if (crosses_date_line)
    beside =
        place.x() > east && place.x() < west ? std::min(place.x() - east, west - place.x()) : 0;
  return std::max({beside, south - place.y(), place.y() - north, 0.0});
}

std::optional<AreaOfUse> AreaOf(const CoordinateSystem& system) {
  const ProjContext context = QuietProj();
  const std::unique_ptr<PJ, EndProjObject> object(
      proj_create(context.get(), system.Code().c_str()));
  AreaOfUse area;
  const char* name = nullptr;
  if (!object ||
      !proj_get_area_of_use(context.get(), object.get(), &area.west, &area.south, &area.east,
                            &area.north, &name) ||
      area.west < -180 || area.south < -90) {
    return std::nullopt;
  }
  if (name) area.name = name;
  return area;
}

}  // namespace insitu
