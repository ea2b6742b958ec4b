// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/whole_file.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <regex>
#include <stdexcept>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

// ".stem.PID.ending", in the target's folder so that the rename stays on one disk.
fs::path TemporaryFor(const fs::path& target) {
  fs::path temporary = target.parent_path() / ".";
  temporary += target.stem();
  temporary += "." + std::to_string(getpid());
  temporary += target.extension();
  return temporary;
}

// The process that writes a file named as TemporaryFor does; nullopt: it is no such file.
std::optional<pid_t> WriterOf(const fs::path& file) {
  static const std::regex kTemporary(R"(\..+\.([0-9]{1,9})(\.[^.]+)?)");
  const std::string name = file.filename().string();
  std::smatch match;
  if (!std::regex_match(name, match, kTemporary)) return std::nullopt;
  return std::stoi(match[1]);
}

bool Runs(pid_t process) { return kill(process, 0) == 0 || errno == EPERM; }

}  // namespace

void WriteWhole(const fs::path& target,
                const std::function<void(const fs::path& temporary)>& write) {
  if (target.has_parent_path()) fs::create_directories(target.parent_path());
  const fs::path temporary = TemporaryFor(target);
  try {
    write(temporary);
    fs::rename(temporary, target);
  } catch (...) {
    std::error_code ignored;  // the first failure is the one to report
    fs::remove(temporary, ignored);
    throw;
  }
}

void WriteWhole(const fs::path& target, const std::string& content) {
  WriteWhole(target, [&](const fs::path& temporary) {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary);
    stream << content;
    stream.close();
    if (stream) return;
    const std::string reason = errno == 0 ? "" : std::string(": ") + std::strerror(errno);
    throw std::runtime_error(target.string() + ": cannot be written" + reason);
  });
}

std::vector<fs::path> RemoveLeftovers(const fs::path& folder) {
  std::vector<fs::path> removed;
  if (!fs::is_directory(folder)) return removed;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.is_symlink()) continue;
    const std::optional<pid_t> writer = WriterOf(entry.path());
    if (writer && !Runs(*writer)) removed.push_back(entry.path());
  }
  for (const fs::path& path : removed) fs::remove(path);
  return removed;
}

std::string ReadWhole(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || fs::is_directory(path)) throw InputError(path, "cannot be read");
  std::string content;
  std::vector<char> block(size_t{1} << 16);
  do {  // by characters a photograph would take a quarter of a second
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    content.append(block.data(), static_cast<size_t>(stream.gcount()));
  } while (stream);
  if (stream.bad()) throw InputError(path, "cannot be read");
  return content;
}

}  // namespace insitu
