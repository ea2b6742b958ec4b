// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/materials/material_proposals.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include "calibration/files/json_file.h"
#include "renderer/mesh/model.h"

namespace insitu {
namespace {

constexpr size_t kShort = 4;  // a word of fewer letters is found in many others
constexpr size_t kMost = 3;   // proposals

// Letters and digits in lower case, everything else one blank, with one before and behind: " alu
// fenster ". Accents of Latin-1 in UTF-8 are dropped, ä ö ü become ae oe ue.
std::string WordsOf(const std::string& name) {
  static const std::map<std::string_view, std::string_view> kPlain = {
      {"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"}, {"Ä", "ae"}, {"Ö", "oe"}, {"Ü", "ue"},
      {"ß", "ss"}, {"é", "e"},  {"è", "e"},  {"ê", "e"},  {"É", "e"},  {"à", "a"},
      {"â", "a"},  {"ç", "c"},  {"î", "i"},  {"ô", "o"},  {"û", "u"},  {"ñ", "n"}};
  std::string words = " ";
  for (size_t i = 0; i < name.size(); ++i) {
    const auto plain = kPlain.find(std::string_view(name).substr(i, 2));
    const auto letter = static_cast<unsigned char>(name[i]);
    if (plain != kPlain.end()) {
      words += plain->second;
      ++i;
    } else if (letter < 0x80 && std::isalnum(letter)) {
      words += static_cast<char>(std::tolower(letter));
    } else if (words.back() != ' ') {
      words += ' ';
    }
  }
  return words.back() == ' ' ? words : words + ' ';
}

// Letters of the name that an entry's words explain.
size_t Likeness(const std::string& words, const std::vector<std::string>& of_entry) {
  size_t letters = 0;
  for (const std::string& word : of_entry) {
    const bool is_found = word.size() < kShort ? words.find(" " + word + " ") != std::string::npos
                                               : words.find(word) != std::string::npos;
    if (is_found) letters += word.size();
  }
  return letters;
}

std::vector<std::string> WordsOfEntry(const LibraryEntry& entry) {
  std::vector<std::string> words;
  const auto add = [&](const std::string& text) {
    const std::string plain = WordsOf(text);
    for (size_t from = 1; from < plain.size();) {
      const size_t end = plain.find(' ', from);
      words.push_back(plain.substr(from, end - from));
      from = end + 1;
    }
  };
  add(entry.name);
  if (const auto node = entry.content.Find("words")) {
    for (const std::string& word : node->Texts()) add(word);
  }
  std::ranges::sort(words);
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

}  // namespace

std::vector<std::string> ProposalsFor(const std::string& name, const MaterialLibrary& library) {
  const std::string words = WordsOf(name);
  std::vector<std::pair<size_t, std::string>> likely;
  for (const auto& [entry_name, entry] : library.entries()) {
    if (entry.content.At("kind").Text() != "material") continue;
    const size_t likeness = Likeness(words, WordsOfEntry(entry));
    if (likeness > 0) likely.emplace_back(likeness, entry_name);
  }
  std::ranges::stable_sort(likely, std::greater(), [](const auto& entry) { return entry.first; });
  std::vector<std::string> names;
  for (const auto& [likeness, entry_name] : likely) {
    if (names.size() < kMost) names.push_back(entry_name);
  }
  return names;
}

std::string ProposedMaterials(const std::vector<std::filesystem::path>& models,
                              const MaterialLibrary& library, const ImportOptions& options) {
  Json::Value root;
  const auto add = [&](const char* section, const std::string& name, const SurfaceNames& names) {
    if (name.empty() || root[section].isMember(name)) return;
    Json::Value& entry = root[section][name];
    entry["diffuse_rgb"] = ToJson(names.rgb.value_or(Eigen::Vector3d::Constant(0.5)));
    const std::vector<std::string> proposals = ProposalsFor(name, library);
    for (size_t i = 0; i < proposals.size(); ++i) {
      if (i == 0) {
        entry["proposed"] = proposals[i];
      } else {
        entry["or"].append(proposals[i]);
      }
    }
  };
  for (const std::filesystem::path& path : models) {
    for (const SurfaceNames& names : ReadModel(path, options).mesh.surfaces) {
      add("layers", names.layer, names);
      add("blocks", names.block, names);
      add("materials", names.material, names);
    }
  }
  return root.toStyledString();
}

}  // namespace insitu
