// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/library/material_library.h"

#include <algorithm>
#include <cstdlib>

#include "calibration/files/error.h"
#include "calibration/files/file_beside.h"
#include "radiometry/library/json_fault.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr char kMaterial[] = "material", kLamp[] = "lamp";
constexpr double kCoveredFrom = 420, kCoveredTo = 680;  // [nm], where the eye sees most

std::string Variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

fs::path InstalledLibrary() {
  if (const std::string chosen = Variable("INSITU_LIBRARY"); !chosen.empty()) return chosen;
  std::error_code none;
  return fs::read_symlink("/proc/self/exe", none).parent_path() / "../share/insitu/library";
}

fs::path UsersLibrary() {
  const std::string data = Variable("XDG_DATA_HOME");
  if (!data.empty()) return fs::path(data) / "insitu/library";
  const std::string home = Variable("HOME");
  return home.empty() ? fs::path() : fs::path(home) / ".local/share/insitu/library";
}

LibraryEntry ReadEntry(const fs::path& folder, const fs::path& file) {
  const JsonNode content = JsonNode::Load(file);
  const JsonNode kind = content.At("kind");
  if (kind.Text() != kMaterial && kind.Text() != kLamp) {
    throw kind.Error("is \"" + kind.Text() + "\", expected material or lamp");
  }
  content.At("source").Text();
  content.At("licence").Text();
  if (kind.Text() == kLamp) ReadSpectralTable(content.At("spectrum_table"));
  return {file.stem().string(), file.lexically_relative(folder).parent_path().string(), content};
}

std::map<std::string, LibraryEntry> ReadFolder(const fs::path& folder) {
  std::map<std::string, LibraryEntry> entries;
  std::error_code none;
  if (!fs::is_directory(folder, none)) return entries;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".json") {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const LibraryEntry entry = ReadEntry(folder, file);
    const auto [known, is_new] = entries.try_emplace(entry.name, entry);
    if (is_new) continue;
    throw InputError(file, "has the name of " + known->second.content.path().string() +
                               ", expected one file a name");
  }
  return entries;
}

// Levenshtein's distance.
size_t EditsBetween(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<fs::path> LibraryFolders(const std::optional<SitePaths>& site) {
  std::vector<fs::path> folders;
  if (site) folders.push_back(site->root / "library");
  if (const fs::path users = UsersLibrary(); !users.empty()) folders.push_back(users);
  folders.push_back(InstalledLibrary());
  return folders;
}

MaterialLibrary::MaterialLibrary(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    entries_.merge(ReadFolder(folder));
  }
}

const LibraryEntry& MaterialLibrary::Get(const JsonNode& name, const std::string& kind) const {
  const auto found = entries_.find(name.Text());
  if (found != entries_.end() && found->second.content.At("kind").Text() == kind) {
    return found->second;
  }
  size_t nearest = 4;  // edits
  std::string near_name;
  for (const auto& [other, entry] : entries_) {
    const size_t edits = EditsBetween(name.Text(), other);
    if (entry.content.At("kind").Text() != kind || edits >= nearest) continue;
    nearest = edits;
    near_name = other;
  }
  Sentence near, lamps;
  if (!near_name.empty()) {
    near = Sentence("libraryNear", "; is {name} meant?", {{"name", near_name}});
  }
  if (kind == kLamp) {
    lamps = Sentence("libraryLamps", "; expected D65, A, blackbody or a lamp of the library");
  }
  const Sentence what = kind == kLamp ? Sentence("libraryLamp", "no lamp")
                                      : Sentence("libraryMaterial", "no material");
  throw JsonFault(name,
                  Sentence("libraryNone",
                           "is \"{name}\", which is {what} of the library{near}{lamps} (insitu "
                           "materials lists it)",
                           {{"name", name.Text()},
                            {"what", what.ToJson()},
                            {"near", near.ToJson()},
                            {"lamps", lamps.ToJson()}}));
}

const LibraryEntry& MaterialLibrary::Material(const JsonNode& name) const {
  return Get(name, kMaterial);
}

const LibraryEntry& MaterialLibrary::Lamp(const JsonNode& name) const { return Get(name, kLamp); }

SpectralTable ReflectanceOf(const LibraryEntry& material) {
  if (const auto rows = material.content.Find("reflectance")) return ReadSpectralTable(*rows);
  if (const auto file = material.content.Find("reflectance_file")) {
    return ReadSpectralTable(FileBeside(*file));
  }
  throw JsonFault(
      material.content,
      Sentence("libraryNoReflectance", "has no reflectance by wavelength, which is needed here"));
}

SpectralTable SpectrumOfLamp(const MaterialLibrary& library, const JsonNode& name) {
  if (name.Text() == "D65") return D65Table();
  if (name.Text() == "A") return IlluminantATable();
  return ReadSpectralTable(library.Lamp(name).content.At("spectrum_table"));
}

void RequireVisibleRange(const SpectralTable& table, const JsonNode& fault) {
  if (!table.empty() && table.front().x() <= kCoveredFrom && table.back().x() >= kCoveredTo) return;
  throw JsonFault(
      fault,
      Sentence(
          "libraryRange",
          "does not cover the visible range, expected rows from 420 nm or less to 680 or more"));
}

}  // namespace insitu
