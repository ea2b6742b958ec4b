// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/site_file.h"

#include <algorithm>
#include <charconv>
#include <ctime>
#include <fstream>
#include <system_error>

#include "calibration/camera_files/film.h"
#include "calibration/files/error.h"
#include "calibration/files/error_at.h"
#include "calibration/files/whole_file.h"
#include "calibration/program/site.h"
#include "reconstruction/editing/journal.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr std::time_t kSettled = 2;  // [s], coarser than any disk's clock

// Thrown from within WriteWhole, so that nothing is renamed.
struct WrittenMeanwhile {
  std::string content;
};

bool IsSameFile(const struct stat& a, const struct stat& b) {
  return a.st_ino == b.st_ino && a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
         a.st_mtim.tv_nsec == b.st_mtim.tv_nsec && a.st_ctim.tv_sec == b.st_ctim.tv_sec &&
         a.st_ctim.tv_nsec == b.st_ctim.tv_nsec;
}

void RequireWritable(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (!fs::exists(status)) return;
  const bool is_writable = (status.permissions() & fs::perms::owner_write) != fs::perms::none;
  if (is_writable) return;
  throw ErrorAt({path},
                Sentence("fileReadOnly", "is read-only, expected a file that may be written"));
}

void WriteOnDisk(const fs::path& temporary, const fs::path& target, const std::string& text) {
  std::ofstream stream(temporary, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    throw ErrorAt({target}, Sentence("fileNotWritten", "cannot be written; is the disk full?"));
  }
  if (fs::exists(target)) fs::permissions(temporary, fs::status(target).permissions());
  SyncToDisk(temporary);
}

// Of film the folder that holds it.
fs::path PathOf(const EditedTable& table, const fs::path& site) {
  const fs::path file(table.file), calibration = SitePaths{site}.boards();
  if (site / file.parent_path() != calibration) return site / file;
  return FilmFolder(calibration) / file.filename();
}

}  // namespace

std::vector<SiteFile> SiteFiles(const fs::path& site, const fs::path& copies) {
  std::vector<SiteFile> files;
  for (const EditedTable& table : EditedTables()) {
    if (files.empty() || files.back().name != table.file) {
      std::error_code none;
      const fs::path path = PathOf(table, site);
      const fs::path target = fs::is_symlink(path, none) ? fs::weakly_canonical(path, none) : path;
      files.push_back({table.file,
                       path.lexically_relative(site).string(),
                       target.empty() ? path : target,
                       copies / path.filename(),
                       {}});
    }
    files.back().tables.push_back(table);
  }
  return files;
}

std::string ReadIfThere(const fs::path& path) {
  std::error_code none;
  return fs::exists(path, none) ? ReadWhole(path) : "";
}

std::optional<std::string> ReadIfWritten(SiteFile& file) {
  struct stat now = {};
  const std::time_t time = std::time(nullptr);
  if (stat(file.path.c_str(), &now) != 0) now = {};
  if (file.is_settled && IsSameFile(now, file.seen)) return std::nullopt;
  std::string content = ReadIfThere(file.path);
  file.seen = now;
  file.is_settled = std::max(now.st_mtim.tv_sec, now.st_ctim.tv_sec) + kSettled < time;
  if (content == file.on_disk && !file.fault) return std::nullopt;
  return content;
}

FileFault FaultOf(const SiteFile& file, const std::exception& error) {
  const Sentence message = MessageOf(error);
  std::string text = error.what();
  int line = 0;
  const std::string path = file.path.string() + ":";
  if (!text.starts_with(path)) return {file.told, line, message};
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data() + path.size(), end, line);
  const size_t used = parsed.ec == std::errc() && *parsed.ptr == ':'
                          ? static_cast<size_t>(parsed.ptr - text.data()) + 1
                          : path.size();
  text = text.substr(std::min(used + 1, text.size()));
  return {file.told, line, message.text() == text ? message : Sentence::Verbatim(text)};
}

std::optional<std::string> ReplaceFile(const fs::path& path, const std::string& text,
                                       const std::string& expected) {
  RequireWritable(path);
  const auto require_expected = [&] {
    std::string content = ReadIfThere(path);
    if (content != expected) throw WrittenMeanwhile{std::move(content)};
  };
  try {
    if (text.empty()) {
      require_expected();
      if (!fs::remove(path)) return std::nullopt;
    } else {
      WriteWhole(path, [&](const fs::path& temporary) {
        WriteOnDisk(temporary, path, text);
        require_expected();
      });
    }
  } catch (const WrittenMeanwhile& meanwhile) {
    return meanwhile.content;
  }
  SyncToDisk(path.parent_path());
  return std::nullopt;
}

}  // namespace insitu
