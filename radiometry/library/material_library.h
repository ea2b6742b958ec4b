// SPDX-License-Identifier: GPL-3.0-or-later
// Materials and lamps by name, one readable file each: data/ as it is installed, the user's own
// folder, and the site's.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/json_file.h"
#include "calibration/program/site.h"
#include "radiometry/spectrum/spectral_table.h"

namespace insitu {

// FOLDER/[GROUP/]NAME.json: {"kind": "material" or "lamp", "title": "...", "words": [...],
// "source": "...", "licence": "...", "note": "..."} and, of a material, the keys of an entry of
// building/materials.json, of a lamp "spectrum_table": [[nm, relative power], ...]. `words` are
// those that models call it by, in any language.
struct LibraryEntry {
  std::string name;   // the file's, without its ending
  std::string group;  // the folder it lies in, "" in FOLDER itself
  JsonNode content;
};

// Where entries are looked for: SITE/library, $XDG_DATA_HOME/insitu/library (~/.local/share if
// unset), and that of the installed programs, or $INSITU_LIBRARY. Some may not be there. Without
// a site only the other two.
std::vector<std::filesystem::path> LibraryFolders(const std::optional<SitePaths>& site);

class MaterialLibrary {
 public:
  MaterialLibrary() = default;  // empty
  // A name that several folders have is that of the first. Throws InputError: a file that is no
  // JSON, of an unknown kind, without source or licence, or two of one name in one folder.
  explicit MaterialLibrary(const std::vector<std::filesystem::path>& folders);

  const std::map<std::string, LibraryEntry>& entries() const { return entries_; }

  // The entry that `name` names. Throws InputError at its line: there is none, or it is of another
  // kind; a name that is near is told.
  const LibraryEntry& Material(const JsonNode& name) const;
  const LibraryEntry& Lamp(const JsonNode& name) const;

 private:
  const LibraryEntry& Get(const JsonNode& name, const std::string& kind) const;

  std::map<std::string, LibraryEntry> entries_;
};

// Of a material whose colour is a table. Throws InputError at the entry: it has none.
SpectralTable ReflectanceOf(const LibraryEntry& material);

// Relative spectral power of a lamp: of the library, or D65 and A. Throws InputError as Lamp does.
SpectralTable SpectrumOfLamp(const MaterialLibrary& library, const JsonNode& name);

// A table that leaves out part of what the eye sees says nothing about it: `fault` is thrown unless
// it has rows from 420 nm or less to 680 nm or more.
void RequireVisibleRange(const SpectralTable& table, const JsonNode& fault);

}  // namespace insitu
