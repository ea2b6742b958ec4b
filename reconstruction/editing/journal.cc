// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/journal.h"

#include <fcntl.h>
#include <json/reader.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>
#include <system_error>

#include "calibration/files/error.h"
#include "calibration/files/error_at.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/editing/edited_tables.h"

namespace insitu {
namespace {

// What the system says, of the faults that people meet in their language.
Sentence ReasonOf(const std::string& reason) {
  if (reason == std::strerror(ENOSPC)) return Sentence("diskFull", "No space left on device");
  if (reason == std::strerror(EROFS)) return Sentence("diskReadOnly", "Read-only file system");
  if (reason == std::strerror(EACCES)) return Sentence("noAccess", "Permission denied");
  return Sentence::Verbatim(reason);
}

[[noreturn]] void RefuseJournal(const std::filesystem::path& path, const std::string& reason) {
  throw ErrorAt({path}, Sentence("notWritable", "cannot be written ({reason})",
                                 {{"reason", ReasonOf(reason).ToJson()}}));
}

class EntryReader {
 public:
  EntryReader() {
    Json::CharReaderBuilder builder;
    Json::CharReaderBuilder::strictMode(&builder.settings_);
    reader_.reset(builder.newCharReader());
  }

  std::optional<Json::Value> Read(std::string_view line) const {
    Json::Value entry;
    try {
      const bool is_read = reader_->parse(line.data(), line.data() + line.size(), &entry, nullptr);
      if (is_read && entry.isObject()) return entry;
    } catch (const Json::Exception&) {  // nested too deeply: no entry of ours
    }
    return std::nullopt;
  }

 private:
  std::unique_ptr<Json::CharReader> reader_;
};

bool WriteAll(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

}  // namespace

Journal::Journal(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_.parent_path(), error);
  if (error) RefuseJournal(path_.parent_path(), error.message());
  const bool is_new = !std::filesystem::exists(path_);
  descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) RefuseJournal(path_, std::strerror(errno));
  try {
    if (is_new) SyncToDisk(path_.parent_path());
    Read();
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

Journal::~Journal() { close(descriptor_); }

void Journal::Read() {
  const std::string content = ReadWhole(path_);
  const EntryReader reader;
  size_t begin = 0;
  for (int line = 1; begin < content.size(); ++line) {
    const size_t end = content.find('\n', begin);
    const bool is_whole = end != std::string::npos;
    auto entry =
        is_whole ? reader.Read(std::string_view(content).substr(begin, end - begin)) : std::nullopt;
    if (!entry) {
      if (is_whole && end + 1 < content.size()) {
        throw InputError(path_, line,
                         "is no entry; move the file away to go on without what it holds");
      }
      remark_ = Sentence("journalTorn",
                         "{place}: the last line was torn and is cut off; it was never confirmed",
                         {{"place", path_.filename().string() + ":" + std::to_string(line)}});
      break;
    }
    entries_.push_back(std::move(*entry));
    begin = end + 1;
  }
  size_ = static_cast<off_t>(begin);
  if (remark_ && (ftruncate(descriptor_, size_) != 0 || fsync(descriptor_) != 0)) {
    RefuseJournal(path_, std::strerror(errno));
  }
}

void Journal::Append(const Json::Value& entry) {
  if (!is_name_on_disk_) SyncName();
  const std::string line = OneLineJson(entry) + "\n";
  if (WriteAll(descriptor_, line) && fsync(descriptor_) == 0) {
    size_ += static_cast<off_t>(line.size());
    return;
  }
  const std::string reason = std::strerror(errno);
  const bool is_cut = ftruncate(descriptor_, size_) == 0;
  RefuseJournal(path_, reason + (is_cut ? "" : "; its last line may be torn"));
}

void Journal::Replace(const std::vector<Json::Value>& entries) {
  std::string text;
  for (const Json::Value& entry : entries) text += OneLineJson(entry) + "\n";
  int descriptor = -1;
  try {
    WriteWhole(path_, [&](const std::filesystem::path& temporary) {
      const int flags = O_RDWR | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC;
      descriptor = open(temporary.c_str(), flags, 0666);
      if (descriptor < 0 || !WriteAll(descriptor, text) || fsync(descriptor) != 0) {
        RefuseJournal(temporary, std::strerror(errno));
      }
    });
  } catch (const std::exception& error) {
    if (descriptor >= 0) close(descriptor);
    throw ErrorAt({path_}, Sentence("journalLong", "cannot be made shorter: {why}",
                                    {{"why", SentenceOf(error).ToJson()}}));
  }
  close(descriptor_);
  descriptor_ = descriptor;
  size_ = static_cast<off_t>(text.size());
  is_name_on_disk_ = false;
  SyncName();
}

void Journal::SyncName() {
  SyncToDisk(path_.parent_path());
  is_name_on_disk_ = true;
}

void SyncToDisk(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) RefuseJournal(path, std::strerror(errno));
  const bool is_synced = fsync(descriptor) == 0 || errno == EINVAL;  // some disks cannot
  const std::string reason = std::strerror(errno);
  close(descriptor);
  if (!is_synced) RefuseJournal(path, reason);
}

}  // namespace insitu
