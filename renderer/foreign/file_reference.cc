// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/file_reference.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "renderer/mesh/model.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

std::string WithoutQuotes(const std::string& name) {
  constexpr char kAround[] = " \t\r\"'";
  const size_t first = name.find_first_not_of(kAround);
  if (first == name.npos) return "";
  return name.substr(first, name.find_last_not_of(kAround) - first + 1);
}

// "%20" -> " "; what is no code stays.
std::string PercentDecoded(const std::string& text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      decoded += static_cast<char>(byte);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

std::vector<std::string> PartsOf(std::string path) {
  std::ranges::replace(path, '\\', '/');
  std::vector<std::string> parts;
  for (size_t from = 0; from <= path.size();) {
    const size_t end = std::min(path.find('/', from), path.size());
    const std::string part = path.substr(from, end - from);
    if (!part.empty() && part != ".") parts.push_back(part);
    from = end + 1;
  }
  return parts;
}

bool IsAscii(const std::string& text) {
  return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

// As keys are equal; of most entries of a large folder it is seen at a glance that they are not.
bool IsNamed(const std::string& entry, const std::string& name, const std::string& key) {
  if (IsAscii(entry) && IsAscii(name) && entry.size() != name.size()) return false;
  return NameKey(entry) == key;
}

// The entry of a folder of that name, or else of that name in another case.
std::optional<fs::path> EntryOf(const fs::path& folder, const std::string& name) {
  std::error_code none;
  if (name == ".." || fs::exists(folder / name, none)) return folder / name;
  std::vector<fs::path> alike;
  const std::string key = NameKey(name);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (IsNamed(entry.path().filename().string(), name, key)) alike.push_back(entry.path());
  }
  if (alike.empty()) return std::nullopt;
  return *std::ranges::min_element(alike);
}

std::optional<fs::path> Below(const fs::path& folder, const std::vector<std::string>& parts,
                              size_t first) {
  std::optional<fs::path> path = folder;
  for (size_t i = first; i < parts.size() && path; ++i) path = EntryOf(*path, parts[i]);
  std::error_code none;
  if (!path || !fs::is_regular_file(*path, none)) return std::nullopt;
  return path->lexically_normal();
}

std::optional<fs::path> Find(const fs::path& folder, const std::string& name) {
  std::error_code none;
  if (name.starts_with('/') && fs::is_regular_file(name, none)) return fs::path(name);
  const std::vector<std::string> parts = PartsOf(name);
  for (size_t first = 0; first < parts.size(); ++first) {
    if (const auto path = Below(folder, parts, first)) return path;
  }
  return std::nullopt;
}

// By its name alone, in the folders beside the model, as textures are packed.
std::optional<fs::path> FindInFolders(const fs::path& folder, const std::string& name) {
  const std::vector<std::string> parts = PartsOf(name);
  if (parts.empty()) return std::nullopt;
  std::error_code none;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (!entry.is_directory(none) || entry.path().filename().string().starts_with('.')) continue;
    if (const auto path = Below(entry.path(), {parts.back()}, 0)) found.push_back(*path);
  }
  if (found.empty()) return std::nullopt;
  return *std::ranges::min_element(found);
}

std::optional<fs::path> FindAsWritten(const fs::path& folder, const std::string& name) {
  const auto path = Find(folder, name);
  return path ? path : FindInFolders(folder, name);
}

// "wall.png?v=3#part": what an address has behind a file's name.
std::string WithoutQuery(const std::string& name) {
  return name.substr(0, name.find_first_of("?#"));
}

}  // namespace

std::optional<fs::path> FindReference(const fs::path& model, const std::string& name) {
  std::string plain = WithoutQuotes(name);
  if (plain.empty()) return std::nullopt;
  const fs::path folder = fs::absolute(model).parent_path();
  if (const auto path = FindAsWritten(folder, plain)) return path;
  if (NameKey(plain.substr(0, 5)) == "FILE:") plain.erase(0, 5);
  if (const auto path = FindAsWritten(folder, PercentDecoded(plain))) return path;
  return FindAsWritten(folder, PercentDecoded(WithoutQuery(plain)));
}

}  // namespace insitu
