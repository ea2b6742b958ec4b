// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/collada_library.h"

#include <charconv>
#include <limits>

#include "calibration/files/error.h"
#include "calibration/files/plain_text.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

std::string IdOf(const std::string& url) {
  const size_t hash = url.rfind('#');
  return hash == url.npos ? url : url.substr(hash + 1);
}

// Calls `use` with each word of a text.
template <typename Use>
void ForEachWord(std::string_view text, const Use& use) {
  size_t place = 0;
  while (place < text.size()) {
    while (place < text.size() && static_cast<unsigned char>(text[place]) <= ' ') ++place;
    size_t end = place;
    while (end < text.size() && static_cast<unsigned char>(text[end]) > ' ') ++end;
    if (end > place) use(text.substr(place, end - place));
    place = end;
  }
}

template <typename T>
bool ReadWord(std::string_view word, T* value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), *value);
  return status == std::errc() && end == word.data() + word.size();
}

}  // namespace

ColladaLibrary::ColladaLibrary(const XmlNode& root) {
  static constexpr std::pair<const char*, const char*> kLibraries[] = {
      {"library_images", "image"},           {"library_effects", "effect"},
      {"library_materials", "material"},     {"library_geometries", "geometry"},
      {"library_controllers", "controller"}, {"library_visual_scenes", "visual_scene"}};
  for (const auto& [library, kind] : kLibraries) {
    for (const XmlNode& node : root.Children(library)) {
      for (const XmlNode& element : node.Children(kind)) Add(element, kind);
    }
  }
  for (const XmlNode& node : root.Descendants("node")) Add(node, "node");
}

void ColladaLibrary::Add(const XmlNode& element, const std::string& kind) {
  if (const auto id = element.Attribute("id")) elements_.try_emplace({kind, *id}, element);
}

std::optional<XmlNode> ColladaLibrary::Find(const std::string& kind, const std::string& url) const {
  const auto found = elements_.find({kind, IdOf(url)});
  if (found == elements_.end()) return std::nullopt;
  return found->second;
}

XmlNode ColladaLibrary::At(const std::string& kind, const std::string& url,
                           const XmlNode& user) const {
  if (auto found = Find(kind, url)) return *found;
  throw user.Error("names the " + kind + " " + Quoted(url) + ", which is not there");
}

std::vector<double> ColladaNumbers(const XmlNode& element, int* faulty) {
  std::vector<double> numbers;
  ForEachWord(element.Text(), [&](std::string_view word) {
    double value = 0;
    if (!ReadWord(word, &value)) {
      if (!IsNoNumber(word)) ++*faulty;
      value = std::numeric_limits<double>::quiet_NaN();
    }
    numbers.push_back(value);
  });
  return numbers;
}

std::vector<int> ColladaIndices(const XmlNode& element) {
  std::vector<int> indices;
  ForEachWord(element.Text(), [&](std::string_view word) {
    int value = 0;
    if (!ReadWord(word, &value)) throw element.Error(Quoted(word) + ", expected whole numbers");
    indices.push_back(value);
  });
  return indices;
}

}  // namespace insitu
