// SPDX-License-Identifier: GPL-3.0-or-later
// A file of the site that other programs and people may write as well.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "reconstruction/editing/survey_text.h"

namespace insitu {

struct FileFault {
  std::string file;  // below the site's folder
  int line = 0;      // 0: the file as a whole
  Sentence text;
};

// The tables of a file, as they stand now and as the file was when it was last read.
struct SiteFile {
  std::string name;            // as its tables have it
  std::string told;            // below the site's folder, for people
  std::filesystem::path path;  // a link is followed
  std::filesystem::path copy;  // of what was last read or written, for after a crash
  std::vector<EditedTable> tables;
  std::unique_ptr<SurveyText> now = {};  // what the journal says
  std::string on_disk = {};              // the last content that could be read as tables
  bool was_read = false;                 // on_disk is one; else nothing could be read yet
  bool is_changed = false;               // now may differ from on_disk
  std::optional<FileFault> fault = {};   // of the file's content; the tables are read-only then
  struct stat seen = {};                 // when the content was last looked at
  bool is_settled = false;               // what changes after `seen` has another time
};

// One for each file of EditedTables. Nothing is read yet.
std::vector<SiteFile> SiteFiles(const std::filesystem::path& site,
                                const std::filesystem::path& copies);

// "" if there is no such file. Throws InputError: cannot be read.
std::string ReadIfThere(const std::filesystem::path& path);

// The file's content, if it is another than `on_disk` or was at fault; cheap if nothing was written
// since. Throws InputError: cannot be read.
std::optional<std::string> ReadIfWritten(SiteFile& file);

// An error about the file, apart.
FileFault FaultOf(const SiteFile& file, const std::exception& error);

// Puts a text on disk in the place of a file; "" removes it. nullopt: done; else what stood there
// instead of `expected`, and nothing was changed. Throws std::exception: read-only, disk full.
std::optional<std::string> ReplaceFile(const std::filesystem::path& path, const std::string& text,
                                       const std::string& expected);

}  // namespace insitu
