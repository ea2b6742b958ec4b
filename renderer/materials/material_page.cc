// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/materials/material_page.h"

#include <algorithm>
#include <vector>

#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/html_text.h"
#include "calibration/program/program.h"
#include "renderer/building/building_materials.h"
#include "renderer/materials/swatch.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr int kHeight = 96;  // [px], of a swatch

bool IsLamp(const LibraryEntry& entry) { return entry.content.At("kind").Text() == "lamp"; }

std::string TextOf(const LibraryEntry& entry, const std::string& key) {
  const auto node = entry.content.Find(key);
  return node ? node->Text() : "";
}

// By group, in it by name.
std::vector<const LibraryEntry*> InOrder(const MaterialLibrary& library) {
  std::vector<const LibraryEntry*> entries;
  for (const auto& [name, entry] : library.entries()) entries.push_back(&entry);
  std::ranges::stable_sort(entries, {}, [](const LibraryEntry* entry) { return entry->group; });
  return entries;
}

Raster LampSwatch(const LibraryEntry& lamp) {
  const SpectralTable table = ReadSpectralTable(lamp.content.At("spectrum_table"));
  const Eigen::Vector3d rgb = ColorOfLight(table);
  Raster picture(2 * kHeight, kHeight);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) picture.SetRgb(x, y, rgb / rgb.maxCoeff());
  }
  return picture;
}

void PutInto(const Raster& part, int left, int top, Raster* picture) {
  for (int y = 0; y < part.height; ++y) {
    std::copy_n(part.At(0, y), 3 * part.width, picture->At(left, top + y));
  }
}

// One below the other; the site's light on the right.
Raster Swatches(const std::vector<const LibraryEntry*>& entries,
                const std::optional<NaturalEnvironment>& site) {
  const int rows = static_cast<int>(entries.size());
  Raster picture((site ? 4 : 2) * kHeight, rows * kHeight);
  const SpectralBasis spectra;
  Progress progress("swatches", rows);
  for (int i = 0; i < rows; ++i) {
    const LibraryEntry& entry = *entries[i];
    if (IsLamp(entry)) {
      PutInto(LampSwatch(entry), 0, i * kHeight, &picture);
    } else {
      const fs::path folder = entry.content.path().parent_path();
      const BuildingMaterial material = ReadBuildingMaterial(entry.name, entry.content, folder);
      PutInto(MakeSwatch(material.surface, D65Light(spectra.bins()), spectra, kHeight), 0,
              i * kHeight, &picture);
      if (site) {
        PutInto(MakeSwatch(material.surface, LightOf(site->light), site->spectra, kHeight),
                2 * kHeight, i * kHeight, &picture);
      }
    }
    progress.Step();
  }
  return picture;
}

constexpr char kHead[] = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Materials</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
 body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem;
        padding: 0 1rem; color: #222; }
 article { display: flex; gap: 1rem; padding: .5rem 0; border-bottom: 1px solid #eee; }
 h2 { margin: 1.5rem 0 .3rem; font-size: 1.2rem; }
 h3 { margin: 0; font-size: 1rem; }
 p { margin: .1rem 0; overflow-wrap: anywhere; }
 .swatch { flex: none; background-repeat: no-repeat; }
 small { color: #555; }
</style></head><body>
<h1>Materials</h1>
)";

std::string Article(const LibraryEntry& entry, const std::string& picture, int row, int width) {
  const bool is_wide = !IsLamp(entry);
  std::string article = Formatted(
      R"(<article><div class="swatch" role="img" aria-label="swatch" style="width: %dpx; )"
      R"(height: %dpx; background-image: url('%s'); background-position: 0 -%dpx"></div><div>)",
      is_wide ? width : 2 * kHeight, kHeight, picture.c_str(), row * kHeight);
  article += "<h3>" + HtmlText(entry.name) + "</h3>\n";
  for (const char* key : {"title", "note"}) {
    if (const std::string text = TextOf(entry, key); !text.empty()) {
      article += "<p>" + HtmlText(text) + "</p>\n";
    }
  }
  article += "<p><small>" + HtmlText(TextOf(entry, "source")) + "<br>" +
             HtmlText(TextOf(entry, "licence")) + "<br>" + HtmlText(entry.content.path().string()) +
             "</small></p></div></article>\n";
  return article;
}

}  // namespace

std::string MaterialList(const MaterialLibrary& library) {
  std::string list;
  for (const LibraryEntry* entry : InOrder(library)) {
    list +=
        Formatted("%-24s %-9s %s  (%s)\n", entry->name.c_str(),
                  IsLamp(*entry) ? "lamp" : entry->group.c_str(), TextOf(*entry, "title").c_str(),
                  entry->content.path().parent_path().lexically_normal().c_str());
  }
  return list;
}

void WriteMaterialPage(const fs::path& stem, const MaterialLibrary& library,
                       const std::optional<NaturalEnvironment>& site) {
  fs::path picture = stem, page = stem;
  picture += ".png";
  page += ".html";
  const std::vector<const LibraryEntry*> entries = InOrder(library);
  const Raster swatches = Swatches(entries, site);
  WritePng(picture, swatches, Encoding::kSrgb8);
  std::string text = kHead;
  text += site
              ? "<p>Each on a sphere and on a wall: left under D65, right under the site's sun and "
                "sky. A white wall is white in both. A lamp is its colour.</p>\n"
              : "<p>Each on a sphere and on a wall under D65. A lamp is its colour.</p>\n";
  std::string group = "\n";
  for (size_t i = 0; i < entries.size(); ++i) {
    if (entries[i]->group != group) text += "<h2>" + HtmlText(entries[i]->group) + "</h2>\n";
    group = entries[i]->group;
    text += Article(*entries[i], picture.filename().string(), static_cast<int>(i), swatches.width);
  }
  WriteWhole(page, text + "</body></html>\n");
}

}  // namespace insitu
