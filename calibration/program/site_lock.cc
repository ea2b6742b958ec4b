// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/site_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

std::string Now() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  std::array<char, 32> text = {};
  std::strftime(text.data(), text.size(), "%F %T", &local);
  return text.data();
}

std::string HostName() {
  std::array<char, 256> name = {};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

[[noreturn]] void RefuseUnwritable(const std::filesystem::path& path, const std::string& reason) {
  throw InputError(path, "cannot be written (" + reason +
                             "); results go below the site folder: copy it to where you may write, "
                             "or make room there");
}

int OpenLock(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) RefuseUnwritable(path.parent_path(), error.message());
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) RefuseUnwritable(path, std::strerror(errno));
  return descriptor;
}

}  // namespace

SiteLock::SiteLock(const SitePaths& site, const std::string& command)
    : SiteLock(site, command, site.lock()) {}

SiteLock::SiteLock(const SitePaths& site, const std::string& command,
                   const std::filesystem::path& file)
    : descriptor_(OpenLock(file)) {
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor_);
    throw InputError(site.root,
                     "is in use by " + ReadWhole(file) + "; wait until it has ended, or stop it");
  }
  const std::string holder = command + " (process " + std::to_string(getpid()) + " on " +
                             HostName() + ", since " + Now() + ")";
  const bool is_written =
      ftruncate(descriptor_, 0) == 0 &&
      write(descriptor_, holder.data(), holder.size()) == static_cast<ssize_t>(holder.size());
  if (is_written) return;
  const std::string reason = std::strerror(errno);
  close(descriptor_);
  RefuseUnwritable(file, reason);
}

SiteLock::~SiteLock() { close(descriptor_); }

}  // namespace insitu
